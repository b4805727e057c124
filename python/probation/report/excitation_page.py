"""The excitation of records as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.provenance import provenance
from probation.report import excitation_figures as figures
from probation.report.excitation_summary import facts_table
from probation.report.page import Page, Section, picture
from probation.report.table import Table

if TYPE_CHECKING:
    from pathlib import Path

    from probation.report.page import Picture
    from probation.smoothing.answer import ExcitationAnswer, RecordExcitation
    from probation.smoothing.necking import NeckingFit


def write_excitation_page(answer: ExcitationAnswer, path: Path) -> None:
    """Write the page."""
    sections = []
    for record in answer.records:
        sections += [_record(record), *([_two_steps(record, record.necking)] if record.necking else [])]
    hashes = [record.record.sha256 for record in answer.records]
    Page(
        title=f"Strain and strain rate of {answer.source}",
        verdict="; ".join(record.verdict for record in answer.records) + ".",
        lead="What drives the law: the strain that is used in place of the measured one, its rate, and how well both "
        "are known.",
        sections=tuple(sections),
        provenance=provenance(hashes[0] if len(set(hashes)) == 1 else ""),
    ).write(path)


def _record(record: RecordExcitation) -> Section:
    name = record.id
    parts: list[str | Table | Picture] = [facts_table(record), *record.warnings]
    parts += [
        picture(figures.strain_figure(record), f"{name}: measured and used strain; below, their difference."),
        picture(
            figures.rate_figure(record), f"{name}: the rate with two standard errors either way; below, one of them."
        ),
        picture(figures.integration_figure(record), f"{name}: the integrated rate beside the measured strain."),
    ]
    return Section(name, tuple(parts))


def _two_steps(record: RecordExcitation, fit: NeckingFit) -> Section:
    name = record.id
    rows = tuple(
        (
            what,
            f"{steps.history.a:.5g}",
            f"{steps.history.b:.5g}",
            f"{steps.history.c:.5g}",
            f"{steps.history.d:.5g}",
            f"{len(steps.sines.frequencies)}",
            f"{steps.first_residual.std():.2g}",
            f"{steps.final_residual.std():.2g}",
        )
        for what, steps in (("strain", fit.strain), ("rate", fit.rate))
    )
    headings = ("fit of the", "a [1/s]", "b", "c", "d", "sines", "rms after step 1", "rms after step 2")
    return Section(
        f"{name}: the two steps of the supplementary information",
        (
            "First (A-1), b t/(t^c + d e^(at)), through the strain, then sines through what it leaves, as many as the "
            "Bayesian information criterion wants; the same for the differentiated strain; last, the fitted rate is "
            "integrated and compared with the strain.",
            Table(headings, rows),
            picture(figures.figure_s3(fit), f"{name}, Figure S3: strain and (A-1); below, the residuals."),
            picture(figures.figure_s4(fit), f"{name}, Figure S4: the residuals and the sines through them."),
            picture(figures.figure_s5(fit), f"{name}, Figure S5: residuals after the first and the second step."),
            picture(figures.figure_s6(fit), f"{name}, Figure S6: the final fit of the strain."),
            picture(figures.figure_s7(fit), f"{name}, Figure S7: the differentiated strain and its fits."),
            picture(figures.figure_s8(fit), f"{name}, Figure S8: the fitted rate, integrated, beside the strain."),
        ),
    )
