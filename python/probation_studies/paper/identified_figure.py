"""Figures 5 and 6: tests between grips and the law identified on them, residuals magnified five times."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.report.figures import legend_outside, styled_figure, thinned
from probation.report.style import colour, series_colour
from probation_studies.paper.exhibit import Drawing, Exhibit, Settings, compare
from probation_studies.paper.grip_tests import PUBLISHED, fit_residual, identified, twin
from probation_studies.paper.wavy_bias import bias_study

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation_studies.paper.grip_tests import Grip

MAGNIFIED = 5.0
"""The paper's magnification of the residuals."""

EARLY = 0.1
"""True strain up to which E_u acts on the stress: from there on it flows."""

_WHY = "the paper's residual is bias; the synthetic record has none, the right-hand plot has one of the paper's size"


def identified_figure(figure_number: int, experiment: Grip, settings: Settings) -> Exhibit:
    """The three identifications beside the data."""
    test, found = twin(experiment, settings.seed), identified(experiment, settings.seed)
    study = bias_study(experiment, settings.seed, settings.draws)
    printed = PUBLISHED[experiment]
    largest = {option: float(np.abs(fit_residual(each)).max()) for option, each in found.items()}
    start = test.true_strain <= EARLY
    early, late = (
        {option: float(np.sqrt(np.mean(left[part] ** 2))) for option, left in study.example_residuals.items()}
        for part in (start, ~start)
    )
    figure = _figure(
        experiment,
        test.true_strain,
        (test.true_stress, {option: fit_residual(each) for option, each in found.items()}),
        (study.example_stress, study.example_residuals),
    )
    return Exhibit(
        title=f"Figure {figure_number}: the identified law on experiment {experiment}",
        says="The three identifications give the same curve; the residuals, magnified five times, are pure bias, at "
        f"most {printed.largest_residual:g} MPa.",
        explanation="The three curves of the synthetic record cannot be distinguished either. What identifications 2 "
        f"and 4 leave is the noise; identification 3, with (12), leaves up to {largest[3]:.2f} MPa: so near do (11) "
        "and (12) come to each other once α is free. Beside it the same synthetic record with a drawn bias of the "
        "paper's size, the one that moves E_u by the median amount: identification 4 finds E_u = "
        f"{study.unrelaxed_modulus_4[study.example]:.0f} MPa; the rms of the residual goes from {early[2]:.2f} to "
        f"{early[4]:.2f} MPa up to a strain of {EARLY:g}, where E_u acts, and from {late[2]:.2f} to {late[4]:.2f} MPa "
        "beyond. The paper, too, sees the gain of identification 4 at short times.",
        comparisons=(
            compare(
                "largest residual, identification 2", printed.largest_residual, largest[2], unit="MPa", because=_WHY
            ),
        ),
        parts=(
            Drawing(
                f"figure-{figure_number}",
                figure,
                f"Figure {figure_number} from the synthetic record (left) and from the synthetic record with a drawn "
                "bias (right): true stress, and model minus data magnified five times.",
            ),
        ),
        answer={"largest_residual_MPa": {str(option): value for option, value in largest.items()}},
    )


def _figure(
    experiment: Grip,
    strain: FloatArray,
    exact: tuple[FloatArray, Mapping[int, FloatArray]],
    biased: tuple[FloatArray, Mapping[int, FloatArray]],
) -> Figure:
    with styled_figure(7.2, 4.0) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        _draw(left, strain, *exact)
        _draw(right, strain, *biased)
        left.set(title=f"synthetic record of experiment {experiment}", ylabel="true stress; residual × 5 [MPa]")
        right.set(title="with a wavy bias of the paper's size")
        legend_outside(figure, *left.get_legend_handles_labels())
    return figure


def _draw(axes: Axes, strain: FloatArray, stress: FloatArray, residuals: Mapping[int, FloatArray]) -> None:
    axes.plot(*thinned(strain, stress, 300), ".", ms=4, mew=0, color=colour("data"), label="data")
    for at, (option, residual) in enumerate(residuals.items()):
        shade = series_colour({2: 0, 3: 1, 4: 2}[option])
        axes.plot(*thinned(strain, stress + residual, 400), color=shade, lw=1.0, ls=("-", "--", ":")[at])
        axes.plot(*thinned(strain, MAGNIFIED * residual, 600), color=shade, lw=0.9, label=f"identification {option}")
    axes.axhline(0.0, color=colour("muted"), lw=0.8)
    axes.set_xlabel("true strain [–]")
