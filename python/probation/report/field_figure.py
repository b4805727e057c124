"""The maps as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np

from probation.report.field_summary import SYMBOLS
from probation.report.figures import house_style, new_figure
from probation.report.style import colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.field.maps import FieldMaps


def field_figure(maps: FieldMaps) -> Figure:
    """E_u tau_max, G and the residual; below, standard errors, and the residual over the noise."""
    product, hardening = maps.names[0], maps.names[3]
    with house_style(), np.errstate(invalid="ignore", divide="ignore"):
        drawn = new_figure(10.6, 6.6)
        axes = drawn.subplots(2, 3)
        for at, name in enumerate((product, hardening)):
            values = maps.maps[name]
            _draw(axes[0, at], maps, values, SYMBOLS[name], maps.units[name])
            error = 100.0 * maps.maps[f"{name}_standard_error"] / np.abs(values)
            _draw(axes[1, at], maps, error, f"standard error of {SYMBOLS[name]}", "%", "cividis")
        _draw(axes[0, 2], maps, maps.maps["rms_residual"], "residual, rms", "MPa", "magma")
        ratio = maps.maps["rms_residual"] / maps.maps["noise"]
        _draw(axes[1, 2], maps, ratio, "residual over noise", "", "magma")
        good, beyond = np.count_nonzero(maps.identified), np.count_nonzero(maps.beyond_noise)
        drawn.suptitle(
            f"{good} of {maps.identified.size} pixels identified, {beyond} beyond the noise; grey: refused, or no data",
            x=0.01,
            ha="left",
            fontsize=10,
        )
    return drawn


def _draw(axes: Axes, maps: FieldMaps, values: FloatArray, title: str, unit: str, colours: str = "viridis") -> None:
    """One map; its colours span 1 to 99 % of the pixels."""
    shown = np.where(maps.identified, values, np.nan)
    finite = shown[np.isfinite(shown)]
    low, high = np.percentile(finite, [1, 99]) if len(finite) else (0.0, 1.0)
    scale = mpl.colormaps[colours].with_extremes(bad=colour("grid"))
    y, x = _borders(maps.y), _borders(maps.x)
    mesh = axes.pcolormesh(x, y, np.ma.masked_invalid(shown), cmap=scale, vmin=low, vmax=high, rasterized=True)
    axes.set_facecolor(colour("grid"))
    axes.set(aspect="equal", title=title, xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    place = maps.length_unit or "pixel"
    axes.set(xlabel=f"x [{place}]", ylabel=f"y [{place}]")
    axes.grid(visible=False)
    axes.figure.colorbar(
        mesh, ax=axes, label=f"[{unit}]" if unit not in ("", "1") else "[-]", extend="both", shrink=0.7, aspect=14
    )


def _borders(centres: FloatArray) -> FloatArray:
    """Borders of pixels from their centres."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    between = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2 * centres[0] - between[0]], between, [2 * centres[-1] - between[-1]]])
