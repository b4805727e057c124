"""How far the schemes agree, as an answer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from probation.answers import json_answer
from probation.report.table import Table

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from os import PathLike

    from matplotlib.figure import Figure

    from probation.report.page import Section
    from probation.schemes.steps import StepStudy

PAPERS_START = "be2, paper's start"


@dataclass(frozen=True)
class SchemeCheck:
    """One scheme on one record.

    Attributes
    ----------
    name : str
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
    record : str
    samples : int
    reference : str
        What errors are against, for people.
    schemes : tuple of SchemeCheck
    steps : StepStudy or None
    data_sha256 : str
    """

    record: str
    samples: int
    reference: str
    schemes: tuple[SchemeCheck, ...]
    steps: StepStudy | None
    data_sha256: str

    def table(self) -> Table:
        """One row per scheme."""
        rows = tuple(
            (
                each.name,
                _short(each.largest_error_MPa) if not each.failure else "failed",
                _short(each.rms_error_MPa),
                "–" if math.isnan(each.order) else f"{each.order:.2f}",
                "–" if math.isnan(each.time_us) else f"{each.time_us:.0f}",
            )
            for each in self.schemes
        )
        headings = ("scheme", "largest error [MPa]", "rms [MPa]", "order", "time [µs]")
        caption = f"{self.record}: {self.samples} samples, error against {self.reference}"
        return Table(headings, rows, caption)

    def notes(self) -> list[str]:
        """CVODE's statistics, and why a scheme failed."""
        lines = []
        for each in self.schemes:
            if each.failure:
                lines.append(f"{each.name} failed: {each.failure}")
            elif each.statistics:
                numbers = ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in each.statistics.items())
                lines.append(f"{each.name}: {numbers}")
        if self.steps is not None:
            lines.append(
                f"orders observed on a smooth history ({self.steps.history}), steps {self.steps.step[0]:.3g} to "
                f"{self.steps.step[-1]:.3g} s, errors over its last two thirds"
            )
        return lines


@dataclass(frozen=True)
class CrossCheck:
    """How far the schemes agree.

    Attributes
    ----------
    records : tuple of RecordCheck
    law : str
        Which law it was done with, for people.
    """

    records: tuple[RecordCheck, ...]
    law: str

    @property
    def agreement_MPa(self) -> float:
        """Largest error of any scheme that did not fail [MPa]."""
        return _largest(each for record in self.records for each in record.schemes)

    @property
    def verdict(self) -> str:
        """One sentence."""
        checks = [each for record in self.records for each in record.schemes]
        failed = sorted({each.name for each in checks if each.failure})
        who = "All schemes agree" if not failed else f"All schemes but {' and '.join(failed)}, which failed, agree"
        sentence = f"{who} within {_short(self.agreement_MPa)} MPa"
        without = _largest(each for each in checks if each.name != PAPERS_START)
        if without < 0.9 * self.agreement_MPa:
            sentence += f"; leaving out be2 with the paper's start, within {_short(without)} MPa"
        return sentence + "."

    def summary(self) -> str:
        """The verdict, one table per record, CVODE's statistics."""
        parts = [self.verdict, f"Law: {self.law}."]
        for record in self.records:
            parts.append("\n".join([record.table().text(), *(f"  {note}" for note in record.notes())]))
        return "\n\n".join(parts)

    def plot(self) -> Figure:
        """Error against step and against time, with the slopes of the orders."""
        from probation.schemes.plot import crosscheck_plot  # noqa: PLC0415 - plots are slow to load

        return crosscheck_plot([record.steps for record in self.records if record.steps is not None])

    def to_json(self) -> str:
        """The answer, schema "probation.crosscheck/1"."""
        return json_answer(
            "probation.crosscheck/1",
            {
                "verdict": self.verdict,
                "agreement_MPa": self.agreement_MPa,
                "law": self.law,
                "records": [
                    {
                        "record": record.record,
                        "data_sha256": record.data_sha256,
                        "samples": record.samples,
                        "reference": record.reference,
                        "schemes": [vars(each) for each in record.schemes],
                        "steps": None if record.steps is None else _steps_answer(record.steps),
                    }
                    for record in self.records
                ],
            },
        )

    def report(self, path: str | PathLike[str]) -> None:
        """Write one self-contained HTML page.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        from probation.report.page import Page  # noqa: PLC0415 - pages are slow to load

        Page("Cross-check of the schemes", self.verdict, self.sections(), lead=f"Law: {self.law}.").write(path)

    def sections(self) -> tuple[Section, ...]:
        """The parts of the page."""
        from probation.report.page import Section, picture  # noqa: PLC0415

        tables = [Section(each.record, (each.table(), *each.notes())) for each in self.records]
        if not any(record.steps for record in self.records):
            return tuple(tables)
        caption = "Largest error away from the start, against the step and against the time of one solve"
        return (Section("Error, step and time", (picture(self.plot(), caption),)), *tables)


def _steps_answer(steps: StepStudy) -> dict[str, object]:
    return {
        "history": steps.history,
        "step_s": steps.step,
        "largest_error_MPa": steps.largest_error_MPa,
        "time_us": steps.time_us,
    }


def _largest(checks: Iterable[SchemeCheck]) -> float:
    return max((each.largest_error_MPa for each in checks if not each.failure), default=math.nan)


def _short(value: float) -> str:
    return "–" if math.isnan(value) else f"{value:.2g}"
