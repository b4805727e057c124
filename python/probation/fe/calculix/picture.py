"""The neck as a picture: force, strain rate beside the paper's Figure 1, shape coloured by strain and by its rate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from probation.published.experiments import experiment_1, experiment_2, experiment_3
from probation.report.figures import save_figure, styled_figure, thinned
from probation.report.style import series_colour

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes

    from probation._arrays import FloatArray
    from probation.fe.calculix.necking import NeckingRun

_MIRRORS = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])


def draw(necking: NeckingRun, file: Path) -> None:
    """Save the picture, as PNG, SVG or PDF by the ending.

    Raises
    ------
    InputError
        For another ending, or where the file cannot be written.
    """
    with styled_figure(10.0, 7.4) as figure:
        upper, lower = np.asarray(figure.subfigures(2, 1, height_ratios=(1.1, 1.0)))
        left, right = upper.subplots(1, 2)
        _force(left, necking)
        _rates(right, necking)
        _shapes(lower, necking)
        save_figure(figure, file)


def _instants(necking: NeckingRun) -> dict[str, int]:
    """What is drawn, and the increment it is drawn at."""
    return {"largest force": necking.top, "centre fastest": necking.fastest, "end": len(necking.time) - 1}


def _force(axes: Axes, necking: NeckingRun) -> None:
    axes.plot(necking.nominal_strain, necking.nominal_stress)
    for at, (name, increment) in enumerate(_instants(necking).items(), start=1):
        where = necking.nominal_strain[increment], necking.nominal_stress[increment]
        axes.plot(*where, "o", color=series_colour(at), label=name)
    axes.set(
        title="Force",
        xlabel="grip displacement / half gauge [–]",
        ylabel="force / initial area [MPa]",
        ylim=(0.0, None),
    )
    axes.legend(loc="lower right")


def _rates(axes: Axes, necking: NeckingRun) -> None:
    axes.plot(necking.centre_strain, necking.centre_rate, label="centre of this specimen")
    twins = (("experiment 3", experiment_3()), ("experiment 1", experiment_1()), ("experiment 2", experiment_2()))
    for at, (name, twin) in enumerate(twins, start=1):
        curve = thinned(twin.true_strain, twin.strain_rate)
        axes.plot(*curve, "--", color=series_colour(at), label=f"Figure 1, {name}")
    axes.set(
        title="Strain rate of the centre",
        xlabel="true strain of the centre [–]",
        ylabel="true strain rate [1/s]",
        yscale="log",
    )
    axes.legend(loc="lower center")


def _shapes(figure: Any, necking: NeckingRun) -> None:
    """The broad side, all of it, to scale, at three instants."""
    instants = _instants(necking)
    axes = figure.subplots(len(instants), 2, sharex=True, sharey=True)
    columns = (
        ("true strain along the specimen [–]", "viridis", necking.face_strain.__getitem__),
        ("its rate [10⁻³ 1/s]", "inferno", lambda at: 1e3 * necking.face_rate(at)),
    )
    for column, (title, colours, values_at) in enumerate(columns):
        values = {name: values_at(at) for name, at in instants.items()}
        lowest = min(0.0, *(value.min() for value in values.values()))
        limits = (lowest, max(value.max() for value in values.values()))
        for row, (name, at) in enumerate(instants.items()):
            each = axes[row, column]
            drawn = _elements(each, necking.face[at], values[name], colours, limits)
            each.set(aspect="equal", title=f"{name}, nominal strain {necking.nominal_strain[at]:.2f}")
            each.grid(visible=False)
        axes[-1, column].set(xlabel="mm")
        figure.colorbar(drawn, ax=axes[:, column], label=title, shrink=0.9)


def _elements(axes: Axes, corners: FloatArray, values: FloatArray, colours: str, limits: tuple[float, float]) -> Any:
    """The faces of a quarter, mirrored into all four."""
    from matplotlib.collections import PolyCollection  # noqa: PLC0415 -- slow to import

    faces = corners.reshape(-1, 4, 2)
    polygons = np.concatenate([faces * mirror for mirror in _MIRRORS])
    drawn = PolyCollection(list(polygons), cmap=colours, edgecolors="face", linewidths=0.2)
    drawn.set_array(np.tile(values.ravel(), len(_MIRRORS)))
    drawn.set_clim(*limits)
    axes.add_collection(drawn)
    reach = np.abs(polygons).max(axis=(0, 1))
    axes.set(xlim=(-1.02 * reach[0], 1.02 * reach[0]), ylim=(-1.2 * reach[1], 1.2 * reach[1]))
    return drawn
