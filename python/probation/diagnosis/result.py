"""What `probation.diagnose` found: where the simulation departs from reality, why, and how far that can be mended."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from probation._arrays import one_of
from probation.inference.calibration_check import CalibrationCheck
from probation.results.data import CURVE, Stored, WithCurves
from probation.results.frames import by_record, over_samples, rows_frame
from probation.results.rendering import Result
from probation.settings.certificate import CERTIFICATE
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.design.isolability_result import Isolability
    from probation.detection.gap_test import GapTest
    from probation.detection.where import Located, Where
    from probation.diagnosis.attribution import EffectShare
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.remainder import Remainder
    from probation.diagnosis.skipped import Skipped
    from probation.inference.deviation_trend import DeviationTrend
    from probation.inference.gap import GapSize, HeldOutGap
    from probation.inference.parameter import Status
    from probation.inference.scatter import Scatter

Verdict = Literal["no_gap", "not_predicted", "explained", "unexplained"]


@dataclass(frozen=True)
class BaseParameter:
    """A parameter of the base law; `name` with its unit."""

    name: str
    value: float
    se: float | None
    status: Status


@dataclass(frozen=True)
class EffectSize:
    """The value of an effect's parameter.

    Attributes
    ----------
    effect, name, unit : str
        `name` includes the unit.
    records : tuple of str
        Ids of the records that it acts in.
    value : float
    """

    effect: str
    name: str
    unit: str
    records: tuple[str, ...]
    value: float


@dataclass(frozen=True)
class CauseParameter(EffectSize):
    """A parameter of an explanation's effect.

    Attributes
    ----------
    se : float or None
        None where the data say nothing beyond the prior.
    bound : {"lower", "upper"} or None
        The physical bound at which it ended.
    """

    se: float | None
    bound: Literal["lower", "upper"] | None = None


@dataclass(frozen=True)
class Checks:
    """What speaks for or against an explanation in addition to its probability.

    Attributes
    ----------
    left_out : float or None
        Closure of records that were left out one by one; None with fewer than three records, or where the explanation
        sits in single records.
    amplitude_p_value : float or None
        That every record wants the same amplitude (Cochran's Q).
    remaining_p_value : float
        Gap test after the explanation.
    notes : tuple of str
        Sentences: a parameter at its bound, an amplitude that differs from record to record ...
    """

    left_out: float | None
    amplitude_p_value: float | None
    remaining_p_value: float
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Explanation:
    """A set of effects that may cause the gap.

    Attributes
    ----------
    effects : tuple of str
        Sorted; empty: no effect is needed; ("unknown",): one outside the catalogue; a name and "unknown": both.
    titles : tuple of str
        The same for people.
    forms : tuple of str
        Functional form of each, as often as it acts, in the order of `parameters`.
    records : tuple of str
        Ids of the records that it touches.
    probability : float
    parameters : tuple of CauseParameter
        In the order of `effects`.
    checks : Checks or None
        For the leading ones.
    log_evidence : float or None
        Natural logarithm of the marginal likelihood over that of the base law alone, errors of its forms allowed for:
        what the records say, before it is taken to a power and weighed with what was probable beforehand. None where
        nothing was fitted.
    """

    effects: tuple[str, ...]
    titles: tuple[str, ...]
    forms: tuple[str, ...]
    records: tuple[str, ...]
    probability: float
    parameters: tuple[CauseParameter, ...] = ()
    checks: Checks | None = None
    log_evidence: float | None = None


@dataclass(frozen=True, eq=False)
class RecordCurves(WithCurves):
    """One record with the base law's prediction, and that with the effects of `Shrink.effects`.

    Attributes
    ----------
    id : str
    role : {"identify", "held-out"}
    time, true_strain, strain_rate, data : ndarray, shape (n,) [s], [-], [1/s], [MPa]
    base : ndarray, shape (n,) [MPa]
    explained : ndarray, shape (n,) [MPa], or None
        None where there are none.
    noise : ndarray, shape (n,) [MPa]
        Standard deviation of a sample, by noise of the stress and of the strain.
    noise_MPa : float
        Standard deviation of the stress noise alone, over the record.
    noise_given : bool
        Whether it is what the campaign states; else it was estimated, or seen to be larger than stated.
    strain_noise : float
        Standard deviation of the strain noise.
    strain_noise_given : bool
        Whether the campaign states it; else it was estimated.
    """

    id: str
    role: str
    time: FloatArray = field(metadata=CURVE)
    true_strain: FloatArray = field(metadata=CURVE)
    strain_rate: FloatArray = field(metadata=CURVE)
    data: FloatArray = field(metadata=CURVE)
    base: FloatArray = field(metadata=CURVE)
    explained: FloatArray | None = field(metadata=CURVE)
    noise: FloatArray = field(metadata=CURVE)
    noise_MPa: float  # noqa: N815 - as it leaves the program
    noise_given: bool
    strain_noise: float
    strain_noise_given: bool

    def to_dict(self) -> dict[str, Any]:
        """As in `records` of docs/formats.md."""
        return {
            "role": self.role,
            "noise_MPa": self.noise_MPa,
            "noise_given": self.noise_given,
            "strain_noise": self.strain_noise,
            "strain_noise_given": self.strain_noise_given,
        }


@dataclass(frozen=True)
class Signature:
    """Something sharp or drifting in the fit residual that points at a cause; `text` is a sentence."""

    kind: Literal["line", "step", "parameter"]
    record: str | None
    p_value: float
    text: str


@dataclass(frozen=True)
class Shrink:
    """How far the gap shrinks.

    Attributes
    ----------
    identify : Closure
    held_out : Closure or None
    records : dict of str to Closure
    regions : tuple of (Located, Closure)
        The regions of `where`.
    ceiling : Closure or None
        What any smooth curve through the identify records' residuals could close.
    effects : tuple of str
        With which known effects: those of the best explanation; where an unknown effect leads alone, of the most
        probable refitted one that has any.
    """

    identify: Closure
    held_out: Closure | None
    records: Mapping[str, Closure]
    regions: tuple[tuple[Located, Closure], ...]
    ceiling: Closure | None
    effects: tuple[str, ...] = ()


@dataclass(frozen=True)
class NextTest:
    """An experiment that separates what is still ambiguous.

    Attributes
    ----------
    what : str
        One sentence.
    separates : tuple of tuple of str
        Effects of the explanations that it discriminates, or variables that the remainder may depend on.
    probability_before, probability_after : float
        Of the answer being right, now and after the test.
    cost : str
        Such as "one specimen, 20 minutes".
    """

    what: str
    separates: tuple[tuple[str, ...], ...]
    probability_before: float
    probability_after: float
    cost: str = ""

    def to_dict(self) -> dict[str, Any]:
        """As in `next_tests` of docs/formats.md."""
        return {
            "what": self.what,
            "separates": [list(names) for names in self.separates],
            "probability_before": self.probability_before,
            "probability_after": self.probability_after,
            "cost": self.cost,
        }


@dataclass(frozen=True, eq=False)
class Diagnosis(Result, Stored):
    """Where, which, how far.

    `plot` draws every record before and after the explanation that `shrink` tells of, the regions of the gap marked.

    Attributes
    ----------
    campaign : str
    verdict : {"no_gap", "not_predicted", "explained", "unexplained"}
        "not_predicted": the records that were fitted hold no gap, records that were only predicted do.
    headline : str
        One sentence a person can act on.
    law : str
        The base law in words.
    scheme : str
    base : tuple of BaseParameter
    gap : GapTest
        Of the records that the base law was fitted to.
    held_out : dict of str to HeldOutGap
        Of every record that was only predicted.
    size : GapSize
        Of the gap where it is largest relative to the stress.
    scatter : Scatter or None
        How far specimens differ: estimated, assumed or stated.
    gap_if_alike : bool
        Whether there would be a gap if specimens were alike, by the test for a gap alone.
    trend : DeviationTrend or None
        Where that is all that speaks against a gap: what of the specimens' deviations is in an order.
    tolerance : float
        Part of the largest stress below which a gap does not matter.
    matters : bool
        Whether the gap may be larger.
    judged_on : str or None
        Where records were not predicted: the one that no cause was fitted to.
    rms_MPa, noise_MPa : float
        Of the base law's fit residual on the identify records.
    located : tuple of Located
        By share, most first.
    where : Where
        Every region that was looked at.
    acts : tuple of Located
        Where the best explanation's own contribution is certain.
    signatures : tuple of Signature
    explanations : tuple of Explanation
        By probability, which sums to 1.
    answer_set : tuple of tuple of str
        Every explanation that the data cannot distinguish from the best, best first.
    shrink : Shrink
    next_test : NextTest or None
        The first of `next_tests`.
    curves : dict of str to RecordCurves
    warnings : tuple of str
        Fall-backs for want of data, records that stand out, ...
    data_sha256 : str
    seed : int
    isolability : Isolability or None
        Which effects these tests could distinguish, whatever they show.
    effects : tuple of EffectShare
        How probable each effect is, and how much of the gap it closes; by share.
    remainder : Remainder or None
        What the best explanation leaves beyond the noise, described: all of the gap where an unknown effect leads
        alone. None where it leaves nothing.
    next_tests : tuple of NextTest
        The best test of every kind that helps, the most worth first; where the gap is unexplained, first those that
        settle on what the remainder depends.
    skipped : tuple of Skipped
        Hypotheses and parts of the answer that were left out, and why.
    calibration : CalibrationCheck
        Whether the probabilities were calibrated on campaigns such as this one.
    leaves_a_gap : bool
        Whether the best explanation leaves more than noise and its forms' errors, an unknown effect leads, or a
        held-out record refuses it: what makes a diagnosis "unexplained". Told with "not_predicted", too.
    """

    SCHEMA: ClassVar[str] = "probation.diagnosis/1"

    campaign: str
    verdict: Verdict
    headline: str
    law: str
    scheme: str
    base: tuple[BaseParameter, ...]
    gap: GapTest
    rms_MPa: float  # noqa: N815 - as it leaves the program
    noise_MPa: float  # noqa: N815
    located: tuple[Located, ...]
    where: Where
    acts: tuple[Located, ...]
    signatures: tuple[Signature, ...]
    explanations: tuple[Explanation, ...]
    answer_set: tuple[tuple[str, ...], ...]
    shrink: Shrink
    next_test: NextTest | None
    curves: Mapping[str, RecordCurves]
    warnings: tuple[str, ...]
    data_sha256: str
    seed: int
    isolability: Isolability | None = None
    effects: tuple[EffectShare, ...] = ()
    skipped: tuple[Skipped, ...] = ()
    remainder: Remainder | None = None
    next_tests: tuple[NextTest, ...] = ()
    held_out: Mapping[str, HeldOutGap] = field(default_factory=dict)
    size: GapSize | None = None
    judged_on: str | None = None
    scatter: Scatter | None = None
    gap_if_alike: bool = False
    trend: DeviationTrend | None = None
    tolerance: float = DETECTION.tolerance
    matters: bool = True
    calibration: CalibrationCheck = field(default_factory=lambda: CalibrationCheck(inside=True))
    leaves_a_gap: bool = False

    def to_dataframe(self, what: Literal["causes", "where", "curves"] = "causes") -> Any:
        """As a pandas DataFrame.

        Parameters
        ----------
        what : {"causes", "where", "curves"}
            A row an explanation, a row a region of the gap, or a row a sample of every record.

        Raises
        ------
        InputError
            Where pandas is not installed, or for curves of a diagnosis that was read from JSON without them.
        """
        if one_of(what, "what", ("causes", "where", "curves")) == "causes":
            causes = [
                {
                    "effects": " + ".join(explanation.effects) or "none",
                    "probability": explanation.probability,
                    "records": ", ".join(explanation.records),
                    "in_answer_set": explanation.effects in self.answer_set,
                }
                for explanation in self.explanations
            ]
            return rows_frame(causes, ("effects", "probability", "records", "in_answer_set"))
        if what == "where":
            columns = ("record", "start_s", "end_s", "lowest_strain", "highest_strain", "rms_MPa", "share", "p_value")
            regions = [
                (region.record, *region.time_s, *region.true_strain, region.rms_MPa, region.share, region.p_value)
                for region in self.located
            ]
            return rows_frame([dict(zip(columns, row, strict=True)) for row in regions], columns)
        return by_record(self._columns())

    def to_xarray(self) -> Any:
        """Curves as an xarray Dataset over "sample", with the coordinates "record" and "time_s".

        Raises
        ------
        InputError
            Where xarray is not installed, or for a diagnosis that was read from JSON without its curves.
        """
        return over_samples(self._columns())

    def _columns(self) -> dict[str, dict[str, Any]]:
        return {
            name: {
                "time_s": record.time,
                "true_strain": record.true_strain,
                "true_stress_MPa": record.data,
                "base_stress_MPa": record.base,
                "explained_stress_MPa": np.nan if record.explained is None else record.explained,
                "noise_MPa": record.noise,
            }
            for name, record in self.curves.items()
        }

    @property
    def best(self) -> Explanation:
        """The most probable explanation."""
        return self.explanations[0]

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects, `probation.diagnosis/1` of docs/formats.md."""
        shrink = self.shrink
        return {
            "campaign": self.campaign,
            "data_sha256": self.data_sha256,
            "seed": self.seed,
            "scheme": self.scheme,
            "verdict": self.verdict,
            "headline": self.headline,
            "base": {
                "parameters": {
                    parameter.name: {"value": parameter.value, "se": parameter.se, "status": parameter.status}
                    for parameter in self.base
                }
            },
            "gap": {
                "rms_MPa": self.rms_MPa,
                "noise_MPa": self.noise_MPa,
                "p_value": self.gap.p_value,
                "p_value_low_noise": self.gap.p_value_low_noise,
                "p_value_high_noise": self.gap.p_value_high_noise,
                "level": self.gap.level,
                "size": None
                if self.size is None
                else {
                    **self.size.to_dict(),
                    "tolerance": self.tolerance,
                    "matters": self.matters,
                    "of_certificate_tolerance": self.size.relative / CERTIFICATE.tolerance,
                },
            },
            "records": {name: record.to_dict() for name, record in self.curves.items()},
            "held_out_gap": {name: gap.to_dict() for name, gap in self.held_out.items()},
            "judged_on": self.judged_on,
            "scatter": {} if self.scatter is None else self.scatter.to_dict(),
            "gap_if_alike": self.gap_if_alike,
            "trend": None if self.trend is None else asdict(self.trend),
            "where": [_located(region) for region in self.located],
            "acts": [_located(region) for region in self.acts],
            "signatures": [
                {
                    "kind": signature.kind,
                    "record": signature.record,
                    "p_value": signature.p_value,
                    "text": signature.text,
                }
                for signature in self.signatures
            ],
            "causes": [_explanation(explanation) for explanation in self.explanations],
            "effects": [effect.to_dict() for effect in self.effects],
            "answer_set": [list(effects) for effects in self.answer_set],
            "shrink": {
                "effects": list(shrink.effects),
                "identify": shrink.identify.to_dict(),
                "held_out": None if shrink.held_out is None else shrink.held_out.to_dict(),
                "records": {name: closure.to_dict() for name, closure in shrink.records.items()},
                "regions": [{**_located(place), **closure.to_dict()} for place, closure in shrink.regions],
                "ceiling": None if shrink.ceiling is None else shrink.ceiling.to_dict(),
            },
            "next_test": None if self.next_test is None else self.next_test.to_dict(),
            "next_tests": [test.to_dict() for test in self.next_tests],
            "isolability": None if self.isolability is None else self.isolability.to_dict(),
            "leaves_a_gap": self.leaves_a_gap,
            "remainder": None if self.remainder is None else self.remainder.to_dict(),
            "skipped": [entry.to_dict() for entry in self.skipped],
            "calibration": self.calibration.to_dict(),
            "warnings": list(self.warnings),
        }


def _located(region: Located) -> dict[str, Any]:
    return {
        "record": region.record,
        "time_s": region.time_s,
        "true_strain": region.true_strain,
        "rms_MPa": region.rms_MPa,
        "share": region.share,
        "p_value": region.p_value,
    }


def _explanation(explanation: Explanation) -> dict[str, Any]:
    parameters: dict[str, dict[str, Any]] = {}
    for parameter in explanation.parameters:
        longer = f"{parameter.effect}.{parameter.name}"
        names = (parameter.name, longer, f"{longer}.{'+'.join(parameter.records)}")
        name = next((each for each in names if each not in parameters), names[-1])
        parameters[name] = {
            "value": parameter.value,
            "se": parameter.se,
            "unit": parameter.unit,
            "bound": parameter.bound,
            "records": list(parameter.records),
        }
    checks = explanation.checks
    return {
        "effects": list(explanation.effects),
        "records": list(explanation.records),
        "probability": explanation.probability,
        "log_evidence": explanation.log_evidence,
        "forms": list(explanation.forms),
        "parameters": parameters,
        "checks": None
        if checks is None
        else {
            "left_out_closure": checks.left_out,
            "amplitude_p_value": checks.amplitude_p_value,
            "remaining_p_value": checks.remaining_p_value,
            "notes": list(checks.notes),
        },
    }
