"""A cross-check of the schemes as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.crosscheck_figure import crosscheck_figure
from probation.report.crosscheck_summary import notes, record_table
from probation.report.page import Page, Section, picture

if TYPE_CHECKING:
    from pathlib import Path

    from probation.schemes.result import CrossCheck


def write_crosscheck_page(found: CrossCheck, path: Path) -> None:
    """Write the page."""
    Page("Cross-check of the schemes", found.verdict, sections(found), lead=f"Law: {found.law}.").write(path)


def sections(found: CrossCheck) -> tuple[Section, ...]:
    """The parts of the page."""
    tables = [Section(each.record, (record_table(each), *notes(each))) for each in found.records]
    if not any(record.steps for record in found.records):
        return tuple(tables)
    caption = "Largest error away from the start, against the step and against the time of one solve"
    return (Section("Error, step and time", (picture(crosscheck_figure(found), caption),)), *tables)
