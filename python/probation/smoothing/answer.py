"""What is known about the strain and rate of records: the answer of ``probation excitation``."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import cumulative_simpson

from probation._arrays import FloatArray
from probation.errors import InputError
from probation.results.data import CURVE, Stored, WithCurves, from_curves
from probation.results.rendering import Plotted, Result
from probation.settings.smoothing import SMOOTHING
from probation.smoothing.differences import differences
from probation.smoothing.excitation import Excitation, excite_each
from probation.smoothing.necking import NeckingFit, fit_necking
from probation.wording import percentage

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation.records.record import Record
    from probation.smoothing.methods import Method

CSV_HEADER = "time_s,true_strain,strain_rate_per_s,true_strain_se,strain_rate_se_per_s"


@dataclass(frozen=True, eq=False)
class RecordExcitation(Plotted, WithCurves):
    """One record's smoothed strain history, with what was measured.

    `plot` draws strain, residual, and the rate with its band.

    Attributes
    ----------
    necking : NeckingFit or None
        The two steps of the paper's procedure, for the methods that take them.
    """

    record: Record = field(metadata=CURVE)
    excitation: Excitation = field(metadata=CURVE)
    necking: NeckingFit | None = field(default=None, metadata=CURVE)

    @from_curves
    def id(self) -> str:
        """The record's."""
        return self.record.id

    @property
    def time(self) -> FloatArray:
        """Shape (n_times,) [s]."""
        return self.record.time

    @property
    def measured(self) -> FloatArray:
        """Measured true strain, shape (n_times,) [-]."""
        return self.record.true_strain

    @property
    def residual(self) -> FloatArray:
        """Measured - used strain, shape (n_times,) [-]."""
        return self.measured - self.excitation.true_strain

    @cached_property
    def differences(self) -> FloatArray:
        """Three-point central differences of the measured strain, shape (n_times,) [1/s]."""
        return differences(self.time, self.measured)

    @cached_property
    def integrated(self) -> FloatArray:
        """The rate integrated from the used strain's start, jump by jump, shape (n_times,) [-]."""
        excitation, time = self.excitation, self.time
        strain = np.empty_like(time)
        strain[0] = excitation.true_strain[0]
        borders = [0, *excitation.jumps, len(time) - 1]
        for first, last in pairwise(borders):
            rate = excitation.rate[first : last + 1].copy()
            if first > 0 and last > first + 1:  # the sample at a jump has the rate before it
                ahead = (rate[2] - rate[1]) / (time[first + 2] - time[first + 1])
                rate[0] = rate[1] - ahead * (time[first + 1] - time[first])
            elif first > 0:
                rate[0] = rate[1]
            strain[first : last + 1] = strain[first] + cumulative_simpson(rate, x=time[first : last + 1], initial=0.0)
        return strain

    @cached_property
    def relative_error(self) -> FloatArray:
        """Standard error over the rate where it is not near zero, shape (at most n_times,) [-]."""
        rate = np.abs(self.excitation.rate)
        moving = rate > SMOOTHING.near_zero * rate.max()
        return np.asarray(self.excitation.rate_se[moving] / rate[moving])

    @from_curves
    def facts(self) -> dict[str, Any]:
        """The answer as Python objects: what is known, as numbers."""
        excitation, warnings = self.excitation, self._warnings()
        rate, rate_se, strain = excitation.rate, excitation.rate_se, excitation.true_strain
        facts: dict[str, Any] = {
            "verdict": self._verdict(),
            "method": excitation.method,
            "differentiator": excitation.differentiator,
            "samples": len(self.time),
            "degrees_of_freedom": excitation.freedom,
            "strain_noise": excitation.strain_noise,
            "strain_noise_given": self.record.noise.strain is not None,
            "noise_inflation": excitation.noise_inflation,
            "rate_jumps_s": [float(self.time[jump]) for jump in excitation.jumps],
            "true_strain": {"first": float(strain[0]), "last": float(strain[-1])},
            "median_se_of_strain": float(np.median(excitation.strain_se)),
            "strain_rate_per_s": {
                "smallest": float(rate.min()),
                "largest": float(rate.max()),
                "first": float(rate[0]),
                "se_of_first": float(rate_se[0]),
                "last": float(rate[-1]),
                "se_of_last": float(rate_se[-1]),
            },
            "rate_is_that_of_the_scheme": excitation.strain_rate is None,
            "relative_se_of_rate": dict(zip(("median", "p95", "largest"), spread(self.relative_error), strict=True)),
            "integrated_rate_minus_measured_strain": float(np.abs(self.integrated - self.measured).max()),
            "data_sha256": self.record.sha256,
            "warnings": list(warnings),
        }
        if self.necking is not None:
            facts["two_steps"] = {
                name: {
                    "a_per_s": steps.history.a,
                    "b": steps.history.b,
                    "c": steps.history.c,
                    "d": steps.history.d,
                    "offset": steps.offset,
                    "sines_Hz": steps.sines.frequencies.tolist(),
                    "rms_after_step_1": float(np.std(steps.first_residual)),
                    "rms_after_step_2": float(np.std(steps.final_residual)),
                }
                for name, steps in (("strain", self.necking.strain), ("rate", self.necking.rate))
            }
            facts["two_steps"]["rate"]["integrated_minus_measured_strain"] = self.necking.largest_drift
        return facts

    @property
    def verdict(self) -> str:
        """One line: the rate, how well it is known, its jumps."""
        return str(self.facts["verdict"])

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader should know."""
        return tuple(self.facts["warnings"])

    def to_csv(self) -> str:
        """Columns `CSV_HEADER`, every digit kept."""
        excitation = self.excitation
        columns = (self.time, excitation.true_strain, excitation.rate, excitation.strain_se, excitation.rate_se)
        rows = zip(*(column.tolist() for column in columns), strict=True)
        return "\n".join([CSV_HEADER, *(",".join(repr(value) for value in row) for row in rows)]) + "\n"

    def _verdict(self) -> str:
        rate, error = self.excitation.rate, self.excitation.rate_se
        known = rate[error <= SMOOTHING.uncertain * float(np.median(error))]  # a start's few samples are known poorly
        low, high = float(known.min()), float(known.max())
        if low > 0.0 and high < SMOOTHING.varies * low:
            said = f"strain rate {float(np.median(rate)):.3g} 1/s"
        elif low > 0.0:
            said = f"strain rate {low:.2g} … {high:.2g} 1/s (×{high / low:.2g})"
        else:
            said = f"strain rate {low:.2g} … {high:.2g} 1/s"
        if not rate.any():
            return f"{self.id}: strain rate zero"
        median = float(np.median(self.relative_error))
        accuracy = f"known to {percentage(median)} % (median standard error)" if median > 0.0 else "without noise"
        jumps = [f"{float(self.time[jump]):.4g}" for jump in self.excitation.jumps]
        count = f"{len(jumps)} jump{'s' if len(jumps) > 1 else ''}" if jumps else "no jumps"
        return f"{self.id}: {said}, {accuracy}; {count}" + (f" at {', '.join(jumps)} s" if jumps else "")

    def _warnings(self) -> list[str]:
        excitation = self.excitation
        warnings = list(self.record.warnings)
        if excitation.noise_inflation > SMOOTHING.correlated:
            warnings.append(
                "neighbouring samples err together: slow averages of the strain noise vary "
                f"{excitation.noise_inflation:.2g} times as much as white noise; the standard errors say so"
            )
        if missed := self._missed():
            warnings.append(missed)
        if (
            excitation.strain_rate is None
            and self.relative_error.size
            and np.median(self.relative_error) > SMOOTHING.mostly_noise
        ):
            warnings.append("the differences of the strain are mostly noise: another method smooths it")
        return warnings

    def _missed(self) -> str:
        """Where the used strain misses the measured one by far more than noise, such as the run-up of a machine."""
        off = np.flatnonzero(np.abs(self.residual) > SMOOTHING.far_residual * self.excitation.strain_noise)
        if self.excitation.operators is None or not off.size or self.excitation.strain_noise == 0.0:
            return ""
        first = ", ".join(f"{self.time[at]:.4g}" for at in off[:3])
        more = ", …" if off.size > 3 else ""
        return (
            f"{off.size} sample{'s are' if off.size > 1 else ' is'} off by more than "
            f"{SMOOTHING.far_residual:.0f} times the noise, at {first}{more} s: the strain is sharper there than the "
            "method follows, or they are outliers; raw takes them as they are"
        )


@dataclass(frozen=True, eq=False)
class ExcitationAnswer(Result, Stored):
    """The excitation of some records.

    `plot` draws strain, residual, and the rate with its band, of one record; with several it raises InputError.

    Attributes
    ----------
    source : str
        File or campaign.
    records : tuple of RecordExcitation
    """

    SCHEMA = "probation.excitation/1"

    source: str
    records: tuple[RecordExcitation, ...]

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects."""
        return {"source": self.source, "records": {record.id: record.facts for record in self.records}}

    def to_csv(self) -> str:
        """Strain and rate with their standard errors at the samples.

        Raises
        ------
        InputError
            If there is more than one record.
        """
        return self.only("a CSV file").to_csv()

    def only(self, what: str) -> RecordExcitation:
        """The one record.

        Parameters
        ----------
        what : str
            What needs it, for the message.

        Raises
        ------
        InputError
            If there are several.
        """
        if len(self.records) > 1:
            names = ", ".join(record.id for record in self.records)
            raise InputError(f"{self.source}: found the records {names}, expected one for {what}; choose by its id")
        return self.records[0]


def describe_excitation(
    records: Sequence[Record],
    method: Method = "auto",
    *,
    source: str = "",
    progress: Callable[[int, int, str], None] | None = None,
) -> ExcitationAnswer:
    """Strain and rate of records, and what is known about them.

    Parameters
    ----------
    records : sequence of Record
    method : str
        As in `excite`.
    source : str
        Where they are from, for the page and for JSON.
    progress : callable, optional
        Called with (done, total, what).

    Raises
    ------
    InputError
        For an unknown method, or one that does not describe a record.
    """
    described = []
    for done, (record, excitation) in enumerate(zip(records, excite_each(records, method), strict=True)):
        if progress:
            progress(done + 1, len(records), record.id)
        necking = fit_necking(record.time, record.true_strain) if excitation.method.startswith("necking") else None
        described.append(RecordExcitation(record, excitation, necking))
    return ExcitationAnswer(source or ", ".join(record.id for record in records), tuple(described))


def spread(error: FloatArray) -> tuple[float, float, float]:
    """Median, 95 % quantile and largest."""
    if not error.size:
        return 0.0, 0.0, 0.0
    return float(np.median(error)), float(np.quantile(error, 0.95)), float(error.max())
