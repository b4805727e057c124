"""Whether there is a gap, in records that were fitted and in records that were only predicted, and its size.

One test for `fit`, `certify` and `diagnose` (docs/diagnosis-method.md, sections 2 and 11).
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from probation._arrays import as_number
from probation.detection.gap_test import GapTest, GapTester
from probation.detection.sharp_gap import with_sharp
from probation.errors import InputError
from probation.inference.calibration_check import check_calibration
from probation.inference.candidate import WhitenedColumns, for_a_test
from probation.inference.deviation_trend import deviation_trend
from probation.inference.model import CampaignModel
from probation.inference.prediction import jointly, predictions
from probation.inference.screen import screen
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.normal import TWO_SIDED_95
from probation.records.noise import noise_level
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect
    from probation.inference.base_fit import BaseFit
    from probation.inference.calibration_check import CalibrationCheck
    from probation.inference.deviation_trend import DeviationTrend
    from probation.inference.scatter import Scatter
    from probation.inference.screen import Column
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.noise.uncertain_scatter import UncertainScatter


@dataclass(frozen=True)
class HeldOutGap:
    """A record that was only predicted.

    Attributes
    ----------
    rms_MPa : float
        Of the prediction's error.
    expected_MPa : float
        Of what the noise and the uncertainty of the parameters make.
    p_value : float
        Of the gap test, both allowed for; of two, see `inference.prediction`, the one that is further from its level.
    level : float
        Below which it is a gap, if it is the only one.
    """

    rms_MPa: float  # noqa: N815 - as it leaves the program
    expected_MPa: float  # noqa: N815
    p_value: float
    level: float = DETECTION.gap_level

    def to_dict(self) -> dict[str, float]:
        """As in `held_out_gap` of docs/formats.md."""
        return {"rms_MPa": self.rms_MPa, "expected_MPa": self.expected_MPa, "p_value": self.p_value}


@dataclass(frozen=True)
class GapSize:
    """How large the gap of one record is, the noise taken off.

    Attributes
    ----------
    record : str
    rms_MPa : float
    interval_MPa : (float, float)
        95 %.
    stress_MPa : float
        The largest of the record, to compare with.
    """

    record: str
    rms_MPa: float  # noqa: N815
    interval_MPa: tuple[float, float]  # noqa: N815
    stress_MPa: float  # noqa: N815

    @property
    def relative(self) -> float:
        """Over the largest stress of the record."""
        return self.rms_MPa / max(self.stress_MPa, 1e-300)

    @property
    def relative_interval(self) -> tuple[float, float]:
        """95 %."""
        low, high = self.interval_MPa
        return low / max(self.stress_MPa, 1e-300), high / max(self.stress_MPa, 1e-300)

    def to_dict(self) -> dict[str, Any]:
        """As in `gap.size` of docs/formats.md."""
        return {
            "record": self.record,
            "rms_MPa": self.rms_MPa,
            "interval95_MPa": list(self.interval_MPa),
            "relative": self.relative,
            "relative_interval95": list(self.relative_interval),
        }


@dataclass(frozen=True, eq=False)
class Gap:
    """Whether a law departs from a campaign's records.

    Attributes
    ----------
    test : GapTest
        Of the records that were fitted.
    held_out : dict of str to HeldOutGap
        Of those that were not, by id.
    sizes : dict of str to GapSize
        Of every record.
    scatter : Scatter
        How far specimens may differ without a gap.
    alike : GapTest or None
        Of the fitted records if specimens were alike, where they may differ.
    trend : DeviationTrend or None
        What of the specimens' deviations is in an order, where there would be a gap if they were alike.
    """

    test: GapTest
    held_out: Mapping[str, HeldOutGap]
    sizes: Mapping[str, GapSize]
    scatter: Scatter
    alike: GapTest | None = None
    trend: DeviationTrend | None = None

    @property
    def hangs_on_scatter(self) -> bool:
        """Whether there would be a gap in the fitted records if specimens were alike."""
        return self.alike is not None and self.alike.rejected and not self.in_fitted

    @property
    def if_alike(self) -> bool:
        """Whether there would be a gap anywhere if specimens were alike."""
        return self.in_held_out or (self.test if self.alike is None else self.alike).rejected

    @property
    def in_fitted(self) -> bool:
        """Whether the fitted records hold more than noise."""
        return self.test.rejected

    @property
    def held_out_p_value(self) -> float:
        """Of all predicted records together, by Bonferroni; 1 where there are none."""
        return min((len(self.held_out) * gap.p_value for gap in self.held_out.values()), default=1.0)

    @property
    def in_held_out(self) -> bool:
        """Whether a predicted record holds more than noise and the uncertainty of the parameters."""
        return bool(self.missed)

    @property
    def exists(self) -> bool:
        """Whether there is a gap anywhere."""
        return self.in_fitted or self.in_held_out

    @property
    def missed(self) -> tuple[str, ...]:
        """Ids of the predicted records that hold a gap, the least probable first."""
        count = len(self.held_out)
        ranked = sorted(self.held_out, key=lambda name: (self.held_out[name].p_value, -self.sizes[name].relative))
        return tuple(name for name in ranked if count * self.held_out[name].p_value < self.held_out[name].level)

    @property
    def size(self) -> GapSize:
        """Of the record in which it is largest relative to the stress, among the fitted ones and those that are missed.

        Where there is no gap it is that of a fitted record, and what a gap might have that was not seen.
        """
        return max(self._looked_at, key=lambda size: size.relative)

    def matters(self, tolerance: float = DETECTION.tolerance) -> bool:
        """Whether the gap may be larger than so much of a record's largest stress, in any record that holds it."""
        return self.exists and max(size.relative_interval[1] for size in self._looked_at) >= tolerance

    @property
    def _looked_at(self) -> tuple[GapSize, ...]:
        """Sizes of the fitted records, if they hold a gap or none does, and of those that are missed."""
        fitted = [name for name in self.sizes if name not in self.held_out]
        names = [*(fitted if self.in_fitted or not self.missed else ()), *self.missed]
        return tuple(self.sizes[name] for name in names)

    def to_dict(self) -> dict[str, Any]:
        """As in `gap` of docs/formats.md, for fits and certificates."""
        return {
            "fitted": self.in_fitted,
            "held_out": self.in_held_out,
            "p_value": self.test.p_value,
            "level": self.test.level,
            "size": self.size.to_dict(),
            "scatter": self.scatter.to_dict(),
            "if_alike": self.if_alike,
            "trend": None if self.trend is None else asdict(self.trend),
            "held_out_gap": {name: gap.to_dict() for name, gap in self.held_out.items()},
        }


def as_tolerance(tolerance: float) -> float:
    """A tolerance that is possible.

    Raises
    ------
    InputError
        Unless it is positive.
    """
    if as_number(tolerance, "tolerance") <= 0.0:
        raise InputError(f"tolerance is {tolerance!r}; a positive fraction of the largest stress is needed")
    return tolerance


def find_gap(
    base: BaseFit, effects: Sequence[Effect], *, predicted: bool = True, threads: int = 1, seed: int = 0
) -> Gap:
    """Test a base fit on its records, and its predictions of those that were held out.

    Parameters
    ----------
    base : BaseFit
        With the signals of these effects, `BaseFit.screened`.
    effects : sequence of Effect
        Further directions in which a gap is looked for: smooth waves, lines and steps are always among them.
    predicted : bool
        Whether to test the predictions, too.
    threads, seed : int
    """
    stress = {view.id: float(np.max(np.abs(view.data))) for view in base.views}
    sizes = {
        record.name: _size(base.errors[index], noise, stress[record.name])
        for index, (record, noise) in enumerate(zip(base.whitened.records, base.whitened.noises, strict=True))
    }
    calibration = check_calibration(base)
    test = _survivor(base.whitened, base.smooth_columns, sizes, seed, base.uncertain_scatter, calibration)
    alike = _if_alike(base, test, seed) if base.scatter.any else None
    held_out = {}
    for index, (record, noise) in enumerate(zip(*predictions(base), strict=True)) if predicted else ():
        model = CampaignModel(base.law, [base.view(record.name)])
        signals = screen(model, base.parameters, effects, threads=threads, only=for_a_test)
        judged = partial(
            _of_prediction,
            signals=signals,
            stress=stress[record.name],
            seed=seed,
            scatter=base.uncertain_scatter_of(index, noise),
            calibration=calibration,
        )
        error, sizes[record.name], found = judged(record, noise)
        if found.rejected and (again := jointly(base, index)) is not None:
            *_, other = judged(*again)
            found = max(found, other, key=lambda test: test.p_value / test.level)
        held_out[record.name] = HeldOutGap(_rms(error), _rms(noise.deviation), found.p_value, found.level)
    gap = Gap(test, held_out, sizes, base.scatter, alike)
    return replace(gap, trend=deviation_trend(base)) if gap.hangs_on_scatter else gap


def _of_prediction(
    record: RecordResidual,
    noise: NoiseModel,
    signals: Sequence[Column],
    stress: float,
    seed: int,
    scatter: UncertainScatter | None,
    calibration: CalibrationCheck,
) -> tuple[FloatArray, GapSize, GapTest]:
    """What the prediction of a record errs by, shape (n,) [MPa], how large that is without the noise, and its test."""
    whitened = Whitened.of([record], [noise])
    error = whitened.clean(0)
    size = _size(error, _own(record, noise), stress)
    columns = _columns(signals, whitened)
    return error, size, _survivor(whitened, columns, {record.name: size}, seed, scatter, calibration)


def _survivor(
    whitened: Whitened,
    columns: WhitenedColumns,
    sizes: Mapping[str, GapSize],
    seed: int,
    scatter: UncertainScatter | None,
    calibration: CalibrationCheck,
) -> GapTest:
    """The test of some records; of a gap that is a fraction of the noise, the most doubtful of its answers.

    Such a gap rests on the model of the noise, and is declared only where it survives those that the records allow: a
    level 1.25 times as high, and a drift that goes along with an effect as with anything else.
    """
    level, noises = calibration.gap_level(misfit_over_noise(whitened)), whitened.noises
    test = _tested(whitened, columns, seed, level, scatter)
    if not test.rejected or any(
        sizes[noise.name].rms_MPa > DETECTION.fraction_of_noise * _rms(noise.deviation) for noise in noises
    ):
        return test
    drifting = Whitened.of(whitened.records, tuple(noise.drifting for noise in noises))
    other = _tested(drifting, _columns(columns.columns, drifting), seed, level, scatter)
    return replace(test, p_value=max(test.p_value, test.p_value_high_noise, other.p_value))


def misfit_over_noise(whitened: Whitened) -> float:
    """What is left of a record over its noise from sample to sample, in the record where this is largest."""
    return max(
        _rms(whitened.clean(index)) / max(noise_level(record.time, record.residual), 1e-300)
        for index, record in enumerate(whitened.records)
    )


def _if_alike(base: BaseFit, test: GapTest, seed: int) -> GapTest:
    """The test if specimens were alike; of records that hold a gap it mostly needs no more than smooth curves."""
    if test.rejected:
        along_curves = GapTester(base.alike, seed=seed)(level=test.level)
        if along_curves.rejected:
            return along_curves
    return _tested(base.alike, _columns(base.signals, base.alike), seed, test.level)


def _tested(
    whitened: Whitened, columns: WhitenedColumns, seed: int, level: float, scatter: UncertainScatter | None = None
) -> GapTest:
    return with_sharp(GapTester(whitened, columns.by_effect(), scatter=scatter, seed=seed)(level=level), whitened)


def _columns(signals: Sequence[Column], whitened: Whitened) -> WhitenedColumns:
    return WhitenedColumns.of_smooth(signals, Whitener(whitened.noises), len(whitened))


def _own(record: RecordResidual, noise: NoiseModel) -> NoiseModel:
    """A record's own noise: without what parameters and specimens do to its prediction."""
    propagated = np.zeros((len(record), 0)) if record.propagated is None else record.propagated
    return replace(noise, propagated=propagated, specimen=None)


def _size(error: FloatArray, noise: NoiseModel, stress: float) -> GapSize:
    """Of what is left of a record's error, shape (n,) [MPa], when its noise is taken off."""
    count = len(error)
    floor = noise.deviation**2
    gap = float(np.mean(error**2 - floor))
    rough = float(np.mean(floor - np.sum(noise.propagated**2, axis=1)))
    level = noise.level_variance + noise.shape_variance
    # Of the noise's own mean square, of its level, and of its product with the gap.
    variance = rough**2 * (2.0 * noise.square_inflation / count + level)
    variance += 4.0 * max(gap, 0.0) * rough * noise.slow_inflation / count
    variance += 2.0 * float(np.sum((noise.propagated.T @ noise.propagated) ** 2)) / count**2
    variance += 4.0 * float(np.sum((noise.propagated.T @ error) ** 2)) / count**2
    low, high = (np.sqrt(max(gap + side * TWO_SIDED_95 * np.sqrt(variance), 0.0)) for side in (-1.0, 1.0))
    return GapSize(noise.name, float(np.sqrt(max(gap, 0.0))), (float(low), float(high)), stress)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
