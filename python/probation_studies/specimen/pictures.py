"""A picture of the virtual specimen: Figure 1 made by the law itself, and the triaxiality gap."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.published.experiments import experiment
from probation.report.figures import save_figure, styled_figure, thinned
from probation.report.style import series_colour

if TYPE_CHECKING:
    from os import PathLike

    from matplotlib.axes import Axes

    from probation_studies.specimen.trial import Specimen


def draw_specimen(specimen: Specimen, path: str | PathLike[str]) -> None:
    """Draw strain rate over strain beside the synthetic data of the paper's Figure 1, and the gap beside Bridgman's.

    Parameters
    ----------
    specimen : Specimen
    path : path-like
        PNG, SVG or PDF, by the ending.
    """
    with styled_figure(10.0, 4.0) as figure:
        rates, gaps = figure.subplots(1, 2)
        _rates(rates, specimen)
        _gaps(gaps, specimen)
    save_figure(figure, path)


def _rates(axes: Axes, specimen: Specimen) -> None:
    for at, each in enumerate(specimen.experiments):
        twin = experiment((1, 2, 3)[at])
        shade = series_colour(at)
        axes.plot(each.true_strain, each.strain_rate, color=shade, label=each.name)
        axes.plot(*thinned(twin.true_strain, twin.strain_rate), color=shade, ls="--", lw=0.9)
    axes.plot([], [], color="0.4", ls="--", lw=0.9, label="Figure 1")
    axes.set(xlabel="true strain [–]", ylabel="strain rate [1/s]", yscale="log")
    axes.legend()


def _gaps(axes: Axes, specimen: Specimen) -> None:
    for at, each in enumerate(specimen.experiments):
        shade = series_colour(at)
        axes.plot(each.true_strain, each.gap, color=shade, label=each.name)
        axes.plot(each.true_strain, (each.bridgman - 1.0) * each.uniaxial_stress, color=shade, ls="--", lw=0.9)
    axes.plot([], [], color="0.4", ls="--", lw=0.9, label="by Bridgman's factor")
    axes.set(xlabel="true strain [–]", ylabel="mean axial stress − law in one dimension [MPa]")
    axes.legend()
