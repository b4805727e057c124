"""Maps of a field as a page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from probation.provenance import provenance
from probation.report.field_figure import map_figures
from probation.report.field_summary import (
    beyond_noise,
    closeness_table,
    field_verdict,
    origin,
    parameter_table,
    pixel_table,
    residual_text,
)
from probation.report.page import Gallery, Page, Section, picture
from probation.wording import sentence

if TYPE_CHECKING:
    from probation.field.maps import FieldMaps

COLOURS = "Colours span 1 to 99 % of the pixels; a grey pixel was refused or has no data."


def write_field_page(maps: FieldMaps, path: Path) -> None:
    """Write the page."""
    where, identified = beyond_noise(maps), maps.identified.any()
    drawn = Gallery(tuple(picture(figure, f"The map of {title}") for title, figure in map_figures(maps).items()))
    sections = [
        *([Section("The maps", (COLOURS, drawn))] if identified else []),
        Section("The pixels", (pixel_table(maps), *([sentence(where)] if where else []))),
        *([Section("The parameters", (parameter_table(maps), sentence(residual_text(maps))))] if identified else []),
        *([Section("How near to the truth", (closeness_table(maps),))] if maps.closeness else []),
        Section("How it was made", tuple(origin(maps))),
    ]
    Page(
        title=f"The law on every pixel: {Path(maps.path).name}",
        verdict=sentence(field_verdict(maps)),
        sections=tuple(sections),
        provenance=provenance(maps.run["field_sha256"]),
    ).write(path)
