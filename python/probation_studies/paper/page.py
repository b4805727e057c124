"""The paper made again, as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.provenance import provenance
from probation.report.page import Page, Picture, Section, picture
from probation_studies.paper.exhibit import TOLERANCE, Drawing

if TYPE_CHECKING:
    from pathlib import Path

    from probation.report.table import Table
    from probation_studies.paper.exhibit import Exhibit
    from probation_studies.paper.reproduction import Reproduction

_LEAD = (
    "André, Becker, Noûs, Farge and Delconte, “Certifying the intrinsic character of a constitutive law for "
    "semi-crystalline polymers: a probation test”. Its raw data was never published: what is shown is made from "
    "synthetic data of its three experiments, whose truth is known."
)
_READING = (
    f"A number is reproduced if ours is within {100 * TOLERANCE:.0f} % of the paper's, the error that the paper gives "
    "its own parameters; recovered, if the synthetic record was made with it, so that finding it again checks the "
    "method and not the paper; else it differs, and below the table stands why."
)


def write_paper_page(reproduction: Reproduction, path: Path) -> Path:
    """Write the page and return its path."""
    Page(
        title="The paper, reproduced",
        verdict=reproduction.verdict,
        mood="bad" if reproduction.unexplained else "good",
        lead=_LEAD,
        sections=(
            Section("What came out", (_READING, reproduction.overview())),
            *(_section(each) for each in reproduction.exhibits.values()),
        ),
        provenance=provenance(reproduction.data_sha256, reproduction.settings.seed),
    ).write(path)
    return path


def _section(exhibit: Exhibit) -> Section:
    parts: list[str | Table | Picture] = []
    if exhibit.says:
        parts.append(f"The paper: {exhibit.says}")
    if exhibit.comparisons:
        parts.append(exhibit.comparison_table())
        parts += exhibit.reasons()
    parts.append(exhibit.explanation)
    parts += [picture(part.figure, part.caption) if isinstance(part, Drawing) else part for part in exhibit.parts]
    return Section(exhibit.title, tuple(parts))
