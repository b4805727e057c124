"""The paper made again, as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.provenance import provenance
from probation.report.page import Page, Picture, Section, picture
from probation_studies.paper.exhibit import TOLERANCE, Drawing

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation.report.table import Table
    from probation_studies.paper.exhibit import Exhibit

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


def paper_page(
    verdict: str, overview: Table, exhibits: Iterable[Exhibit], *, good: bool, data_sha256: str, seed: int
) -> Page:
    """The page: the verdict, how the numbers of each exhibit came out, and the exhibits."""
    return Page(
        title="The paper, reproduced",
        verdict=verdict,
        mood="good" if good else "bad",
        lead=_LEAD,
        sections=(Section("What came out", (_READING, overview)), *map(_section, exhibits)),
        provenance=provenance(data_sha256, seed),
    )


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
