"""How far the schemes agree, as an answer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from probation.results.data import Stored
from probation.results.rendering import Result

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from probation.schemes.steps import StepStudy

PAPERS_START = "be2, paper's start"


@dataclass(frozen=True)
class SchemeCheck:
    """One scheme on one record.

    Attributes
    ----------
    scheme : str or None
        None for eq. (7).
    start : str or None
        bE2's first step.
    largest_error_MPa, rms_error_MPa : float
        Against the reference; NaN where it failed.
    order : float
        Observed by halving the step on a smooth history; NaN where there is none to observe.
    time_us : float
        Of one solve of the record [µs].
    statistics : mapping of str to int
        CVODE's.
    failure : str
        Empty where it did not fail.
    """

    name: str
    scheme: str | None
    start: str | None
    largest_error_MPa: float  # noqa: N815 - the unit is part of the name, as in JSON
    rms_error_MPa: float  # noqa: N815
    order: float
    time_us: float
    statistics: Mapping[str, int]
    failure: str


@dataclass(frozen=True)
class RecordCheck:
    """All schemes on one record.

    Attributes
    ----------
    reference : str
        What errors are against, for people.
    schemes : tuple of SchemeCheck
    steps : StepStudy or None
    """

    record: str
    samples: int
    reference: str
    schemes: tuple[SchemeCheck, ...]
    steps: StepStudy | None
    data_sha256: str


@dataclass(frozen=True)
class CrossCheck(Result, Stored):
    """How far the schemes agree.

    `plot` draws the error against the step and against the time of one solve, with the slopes of the orders.

    Attributes
    ----------
    records : tuple of RecordCheck
    law : str
        Which law it was done with, for people.
    """

    SCHEMA: ClassVar[str] = "probation.crosscheck/1"

    records: tuple[RecordCheck, ...]
    law: str

    @property
    def agreement_MPa(self) -> float:
        """Largest error of any scheme that did not fail [MPa]."""
        return _largest(scheme for record in self.records for scheme in record.schemes)

    @property
    def verdict(self) -> str:
        """One sentence."""
        checks = [scheme for record in self.records for scheme in record.schemes]
        failed = sorted({check.name for check in checks if check.failure})
        who = "All schemes agree" if not failed else f"All schemes but {' and '.join(failed)}, which failed, agree"
        sentence = f"{who} within {short(self.agreement_MPa)} MPa"
        without = _largest(check for check in checks if check.name != PAPERS_START)
        if without < 0.9 * self.agreement_MPa:
            sentence += f"; leaving out be2 with the paper's start, within {short(without)} MPa"
        return sentence + "."

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects, `probation.crosscheck/1`."""
        return {
            "verdict": self.verdict,
            "agreement_MPa": self.agreement_MPa,
            "law": self.law,
            "records": [
                {
                    "record": record.record,
                    "data_sha256": record.data_sha256,
                    "samples": record.samples,
                    "reference": record.reference,
                    "schemes": [vars(scheme) for scheme in record.schemes],
                    "steps": None if record.steps is None else _steps_answer(record.steps),
                }
                for record in self.records
            ],
        }


def _steps_answer(steps: StepStudy) -> dict[str, object]:
    return {
        "history": steps.history,
        "step_s": steps.step,
        "largest_error_MPa": steps.largest_error_MPa,
        "time_us": steps.time_us,
    }


def _largest(checks: Iterable[SchemeCheck]) -> float:
    return max((check.largest_error_MPa for check in checks if not check.failure), default=math.nan)


def short(value: float) -> str:
    """An error to two significant digits; a dash where there is none."""
    return "–" if math.isnan(value) else f"{value:.2g}"
