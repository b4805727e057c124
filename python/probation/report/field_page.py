"""Maps of a field: their picture and their page."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np

from probation.provenance import provenance
from probation.report.field_summary import (
    SYMBOLS,
    beyond_noise,
    closeness_table,
    field_verdict,
    origin,
    parameter_table,
    pixel_table,
    residual_text,
)
from probation.report.figures import house_style, new_figure, styled_figure
from probation.report.page import Gallery, Page, Section, picture
from probation.report.style import colour
from probation.wording import sentence

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.field.maps import FieldMaps

COLOURS = "Colours span 1 to 99 % of the pixels; a grey pixel was refused or has no data."


def field_figure(maps: FieldMaps) -> Figure:
    """E_u tau_max, G and the residual; below, standard errors, and the residual over the noise."""
    with styled_figure(10.6, 6.6) as drawn:
        for axes, panel in zip(drawn.subplots(2, 3).flat, _panels(maps), strict=True):
            _draw(axes, maps, panel)
        good, beyond = np.count_nonzero(maps.identified), np.count_nonzero(maps.beyond_noise)
        drawn.suptitle(
            f"{good} of {maps.identified.size} pixels identified, {beyond} beyond the noise; grey: refused, or no data",
            x=0.01,
            ha="left",
            fontsize=10,
        )
    return drawn


def map_figures(maps: FieldMaps) -> dict[str, Figure]:
    """The same maps by their titles, a figure each, as a page has them side by side."""
    drawn: dict[str, Figure] = {}
    with house_style():
        for panel in _panels(maps):
            drawn[panel.title] = new_figure(4.1, 3.3)
            _draw(drawn[panel.title].subplots(), maps, panel)
    return drawn


@dataclass(frozen=True)
class _Panel:
    title: str
    values: FloatArray
    unit: str
    colours: str


def _panels(maps: FieldMaps) -> list[_Panel]:
    names = maps.names[0], maps.names[3]
    values = [(SYMBOLS[name], name, maps.maps[name]) for name in names]
    with np.errstate(invalid="ignore", divide="ignore"):
        errors = [
            (f"standard error of {symbol}", 100.0 * maps.maps[f"{name}_standard_error"] / np.abs(values_of))
            for symbol, name, values_of in values
        ]
        ratio = maps.maps["rms_residual"] / maps.maps["noise"]
    return [
        *(_Panel(symbol, values_of, maps.units[name], "viridis") for symbol, name, values_of in values),
        _Panel("residual, rms", maps.maps["rms_residual"], "MPa", "magma"),
        *(_Panel(title, error, "%", "cividis") for title, error in errors),
        _Panel("residual over noise", ratio, "", "magma"),
    ]


def _draw(axes: Axes, maps: FieldMaps, panel: _Panel) -> None:
    """One map; its colours span 1 to 99 % of the pixels."""
    shown = np.where(maps.identified, panel.values, np.nan)
    finite = shown[np.isfinite(shown)]
    low, high = np.percentile(finite, [1, 99]) if len(finite) else (0.0, 1.0)
    scale = mpl.colormaps[panel.colours].with_extremes(bad=colour("grid"))
    y, x = _borders(maps.y), _borders(maps.x)
    mesh = axes.pcolormesh(x, y, np.ma.masked_invalid(shown), cmap=scale, vmin=low, vmax=high, rasterized=True)
    axes.set_facecolor(colour("grid"))
    axes.set(aspect="equal", title=panel.title, xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    place = maps.length_unit or "pixel"
    axes.set(xlabel=f"x [{place}]", ylabel=f"y [{place}]")
    axes.grid(visible=False)
    label = f"[{panel.unit}]" if panel.unit not in ("", "1") else "[-]"
    axes.figure.colorbar(mesh, ax=axes, label=label, extend="both", shrink=0.7, aspect=14)


def _borders(centres: FloatArray) -> FloatArray:
    """Borders of pixels from their centres."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    between = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2 * centres[0] - between[0]], between, [2 * centres[-1] - between[-1]]])


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
