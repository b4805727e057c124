"""A predicted stress with its bands, and the joint confidence of the parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtri

from probation.errors import InputError
from probation.inference.parameter import SYMBOLS, UNITS
from probation.normal import TWO_SIDED_95
from probation.report.figures import styled_figure
from probation.report.style import colour
from probation.wording import percentage

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.identify.band import StressBand
    from probation.identify.result import Fit

ELLIPSE_PROBABILITIES = (0.683, 0.95)
"""Joint probabilities of the ellipses."""

REACH = 3.5
"""Standard errors that an axis of the corner plot shows either way."""


def band_figure(found: StressBand) -> Figure:
    """The stress over strain with its confidence band within its prediction band."""
    with styled_figure(7.2, 4.2) as figure:
        axes = figure.subplots()
        level = percentage(found.level)
        for band, alpha, label in (
            (found.prediction, 0.18, f"{level} % of measured samples"),
            (found.confidence, 0.45, f"{level} % confidence of the law's stress"),
        ):
            if np.all(np.isfinite(band)):
                axes.fill_between(found.true_strain, *band, color=colour("model"), alpha=alpha, lw=0, label=label)
        axes.plot(found.true_strain, found.true_stress, color=colour("model"), lw=1.1, label="predicted")
        axes.set(xlabel="true strain [–]", ylabel="true stress [MPa]", title=found.name)
        axes.legend(loc="upper left")
    return figure


def corner_figure(fit: Fit) -> Figure:
    """Every pair of identified parameters: ellipses of joint confidence; on the diagonal each by itself.

    Raises
    ------
    InputError
        If the records do not determine a parameter, or none was identified.
    """
    matrix = fit.covariance.matrix
    if not len(matrix) or not np.all(np.isfinite(matrix)):
        raise InputError(f"corner plot of {fit.campaign!r}: found a parameter without standard error, expected none")
    centre = np.array([getattr(fit.law, name) for name in fit.names])
    errors = np.sqrt(np.diag(matrix))
    count = len(centre)
    with styled_figure(1.2 + 2.1 * count, 1.0 + 1.9 * count) as figure:
        panels = figure.subplots(count, count, squeeze=False, sharex="col")
        for row in range(count):
            for column in range(count):
                axes = panels[row, column]
                if column > row:
                    axes.set_visible(False)
                elif column == row:
                    _alone(axes, centre[row], errors[row])
                else:
                    pair = np.ix_([column, row], [column, row])
                    _together(axes, centre[[column, row]], matrix[pair])
                axes.locator_params(nbins=4)
                axes.set_xlim(centre[column] - REACH * errors[column], centre[column] + REACH * errors[column])
                if row == count - 1:
                    axes.set_xlabel(_label(fit.names[column]))
                    axes.tick_params(axis="x", labelrotation=30)
                if column == 0 and row > 0:
                    axes.set_ylabel(_label(fit.names[row]))
                elif column != row:
                    axes.tick_params(axis="y", labelleft=False)
        figure.suptitle(f"{fit.campaign}: ellipses hold 68 % and 95 %", fontsize=10)
    return figure


def _alone(axes: Axes, centre: float, error: float) -> None:
    x = np.linspace(centre - REACH * error, centre + REACH * error, 200)
    density = np.exp(-0.5 * ((x - centre) / error) ** 2)
    inside = np.abs(x - centre) <= TWO_SIDED_95 * error
    axes.fill_between(x[inside], density[inside], color=colour("model"), alpha=0.25, lw=0)
    axes.plot(x, density, color=colour("model"))
    axes.set_yticks([])


def _together(axes: Axes, centre: FloatArray, matrix: FloatArray) -> None:
    spread, basis = np.linalg.eigh(matrix)
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    circle = np.stack([np.cos(angle), np.sin(angle)])
    for level, alpha in zip(ELLIPSE_PROBABILITIES, (0.45, 0.2), strict=True):
        root = basis * np.sqrt(np.maximum(spread, 0.0) * chdtri(2, 1.0 - level))
        x, y = centre[:, None] + root @ circle
        axes.fill(x, y, color=colour("model"), alpha=alpha, lw=0)
        axes.plot(x, y, color=colour("model"), lw=0.9)
    axes.plot(*centre, "+", color=colour("ink"))
    reach = REACH * np.sqrt(matrix[1, 1])
    axes.set_ylim(centre[1] - reach, centre[1] + reach)


def _label(name: str) -> str:
    return f"{SYMBOLS[name]} [{UNITS[name] or '–'}]"
