"""Pictures of a neck: force, strain rate over strain beside the paper's Figure 1, and the deformed mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm, Normalize

from probation.published.experiments import experiment_1, experiment_3
from probation.report.figures import house_style, new_figure, save_figure, thinned
from probation.report.style import colour

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.fe.bar import Snapshot
    from probation.fe.neck import Necking


def draw_neck(necking: Necking, path: str | PathLike[str]) -> None:
    """Draw force and centre rate, and below them the deformed mesh coloured by strain rate and by strain.

    Parameters
    ----------
    path : path-like
        PNG, SVG or PDF, by the ending.
    """
    with house_style():
        meshes = 0.8 + 0.8 * len(necking.snapshots)
        figure = new_figure(9.0, 3.6 + meshes)
        above, below = np.asarray(figure.subfigures(2, 1, height_ratios=[3.6, meshes]))
        force, rate = above.subplots(1, 2)
        force.plot(necking.nominal_strain, necking.nominal_stress, color=colour("model"))
        force.set(xlabel="grip displacement / half length [–]", ylabel="force / initial area [MPa]", ylim=(0.0, None))
        _rates_beside_figure_1(rate, necking)
        _meshes(below, necking.snapshots)
    save_figure(figure, path)


def _rates_beside_figure_1(axes: Axes, necking: Necking) -> None:
    """Over the first rate, since bar and material need not be the paper's."""
    twins = (("experiment 1", experiment_1(), "muted"), ("experiments 2, 3", experiment_3(), "second"))
    for name, twin, shade in twins:
        relative = twin.strain_rate / twin.strain_rate[0]
        axes.plot(*thinned(twin.true_strain, relative), color=colour(shade), ls="--", label=f"Figure 1, {name}")
    relative = necking.centre_rate / necking.centre_rate[0]
    axes.plot(necking.centre_strain, relative, color=colour("model"), label="centre of the bar")
    axes.set(xlabel="true strain [–]", ylabel="strain rate / that at the start [–]", yscale="log")
    axes.set_ylim(bottom=0.1)
    axes.legend(loc="lower left")


def _meshes(figure: Figure, snapshots: Sequence[Snapshot]) -> None:
    """One row each: above the axis the strain rate, below it the strain."""
    rows = np.atleast_1d(figure.subplots(len(snapshots), 1, sharex=True))
    rates = np.concatenate([shot.rate for shot in snapshots])
    by_rate = LogNorm(max(float(rates.min()), 1e-3 * float(rates.max())), float(rates.max()))
    by_strain = Normalize(0.0, max(float(shot.strain.max()) for shot in snapshots))
    for axes, snapshot in zip(rows, snapshots, strict=True):
        upper = _cells(axes, snapshot.outlines, +1.0, snapshot.rate, by_rate, "viridis")
        lower = _cells(axes, snapshot.outlines, -1.0, snapshot.strain, by_strain, "magma")
        reach = 1.1 * float(snapshot.outlines[..., 1].max())
        axes.set(aspect="equal", ylim=(-reach, reach), ylabel="[mm]")
        axes.set_title(f"{snapshot.time:.4g} s", fontweight="normal")
        axes.grid(visible=False)
    rows[-1].set(xlabel="along the bar from its centre [mm]", xlim=(-0.3, None))
    rows[-1].autoscale_view(scaley=False)
    figure.colorbar(upper, ax=rows, pad=0.01, label="above: strain rate [1/s]")
    figure.colorbar(lower, ax=rows, pad=0.01, label="below: strain [–]")


def _cells(
    axes: Axes, outlines: FloatArray, side: float, values: FloatArray, scale: Normalize, colours: str
) -> PolyCollection:
    cells = PolyCollection(
        list(outlines * [1.0, side]), array=values, norm=scale, cmap=colours, edgecolor="white", linewidth=0.15
    )
    axes.add_collection(cells, autolim=True)
    return cells
