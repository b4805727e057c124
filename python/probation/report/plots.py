"""Plots of records, fits and simulations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.report.diagnosis_words import short_ids
from probation.report.figures import house_style, legend_outside, new_figure, number_logarithmic, styled_figure, thinned
from probation.report.style import colour, series_colour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.simulation import Simulation


_DOTS = 400  # measured points that are drawn
_TOO_WIDE = 4.0  # times the residual: a band that hides it


@dataclass(frozen=True, eq=False)
class Curve:
    """One record with the law.

    Attributes
    ----------
    true_strain : ndarray, shape (n_times,) [-]
    measured : ndarray, shape (n_times,) [MPa]
    model : ndarray, shape (n_times,) [MPa]
    noise_MPa : float or None
        Standard deviation, drawn as a band of two either way around zero.
    band95 : ndarray, shape (n_times,) [MPa], or None
        Half the width of the 95 % band of measured samples, drawn as dashed lines around zero; where it would make
        the residual a flat line, its largest value is written instead.
    """

    name: str
    true_strain: FloatArray
    measured: FloatArray
    model: FloatArray
    noise_MPa: float | None = None  # noqa: N815 - the unit is part of the name, as in JSON
    band95: FloatArray | None = None


def stress_strain_with_residuals(curves: Sequence[Curve], title: str = "") -> Figure:
    """Measured and model stress over strain; below, the residuals (model - measured) of each on their own scale.

    The paper's Figure 2. Each lower axis says how many times it is magnified.
    """
    names = short_ids([curve.name for curve in curves], 44)
    with house_style():
        count = len(curves)
        figure = new_figure(7.2, 3.9 + 1.3 * count)
        above, *below = figure.subplots(1 + count, 1, sharex=True, height_ratios=[3.4] + [1.2] * count)
        for at, curve in enumerate(curves):
            measured = thinned(curve.true_strain, curve.measured, _DOTS)
            label = "measured" if at == 0 else None
            dots = colour("data") if count == 1 else series_colour(at)
            above.plot(
                *measured, ".", ms=5, color=dots, alpha=1.0 if count == 1 else 0.35, mew=0, zorder=1.5, label=label
            )
            name = names[curve.name] if count > 1 else "model"
            above.plot(*thinned(curve.true_strain, curve.model), color=series_colour(at), lw=1.1, label=name)
            _residual(below[at], curve, series_colour(at))
        above.set(ylabel="true stress [MPa]", title=title)
        below[-1].set_xlabel("true strain [–]")
        legend_outside(figure, *above.get_legend_handles_labels())
        figure.canvas.draw()
        for at, axes in enumerate(below):
            prefix = f"{names[curves[at].name]}, " if count > 1 else ""
            times = float(f"{_magnification(above, axes):.2g}")
            magnified = f", magnified {times:g} times" if times > 1.2 else ""  # at about one it says nothing
            _note(axes, f"{prefix}model − measured{magnified}")
    return figure


def _residual(axes: Axes, curve: Curve, shade: str) -> None:
    residual, noise = curve.model - curve.measured, 2.0 * (curve.noise_MPa or 0.0)
    axes.plot(*thinned(curve.true_strain, residual), color=shade, lw=0.8)
    notes = []
    if noise:
        axes.axhspan(-noise, noise, color=colour("data"), alpha=0.18, lw=0)
        notes.append(f"band: ±2 noise, {noise:.2g} MPa")
    if curve.band95 is not None:
        widest = float(curve.band95.max())
        if widest > _TOO_WIDE * max(float(np.abs(residual).max()), noise):
            notes.append(f"95 % prediction: ±{widest:.2g} MPa")
        else:
            notes.append("dashed: 95 % prediction")
            for side in (-1.0, 1.0):
                axes.plot(*thinned(curve.true_strain, side * curve.band95), "--", color=colour("muted"), lw=0.8)
    if notes:
        _note(axes, "; ".join(notes), above=False)
    axes.axhline(0.0, color=colour("muted"), lw=0.8)
    axes.margins(y=0.3)
    axes.set_ylabel("residual [MPa]")


def sensitivities(strain: FloatArray, sensitivity: FloatArray, names: Sequence[str]) -> Figure:
    """Scaled sensitivities, parameter times derivative of the stress, over strain.

    Parameters
    ----------
    strain : ndarray, shape (n_times,) [-]
    sensitivity : ndarray, shape (n_times, n_parameters) [MPa]
        Already multiplied by the parameters.
    names : sequence of str
    """
    with styled_figure(7.2, 3.4) as figure:
        axes = figure.subplots()
        for at, name in enumerate(names):
            axes.plot(*thinned(strain, sensitivity[:, at]), color=series_colour(at), label=name)
        axes.axhline(0.0, color=colour("muted"), lw=0.8)
        axes.set(xlabel="true strain [–]", ylabel="parameter × ∂σ/∂parameter [MPa]")
        axes.legend()
    return figure


def strain_rates(records: Sequence[tuple[str, FloatArray, FloatArray]]) -> Figure:
    """Strain rate over strain, the paper's Figure 1.

    Parameters
    ----------
    records : sequence of (name, true_strain [-], strain_rate [1/s]), both of shape (n_times,)
    """
    with styled_figure(7.2, 3.6) as figure:
        axes = figure.subplots()
        for at, (name, strain, rate) in enumerate(records):
            axes.plot(*thinned(strain, rate), color=series_colour(at), label=name)
        lowest = min(float(rate.min()) for _, _, rate in records)
        highest = max(float(rate.max()) for _, _, rate in records)
        if 0.0 < 1.5 * lowest < highest:
            axes.set_yscale("log")
            number_logarithmic(axes.yaxis)
        elif lowest > 0.0:  # constant but for its noise: zero shows how little that is
            axes.set_ylim(0.0, 1.25 * highest)
        axes.set(xlabel="true strain [–]", ylabel="true strain rate [1/s]")
        legend_outside(figure, *axes.get_legend_handles_labels())
    return figure


def simulation_plot(simulation: Simulation) -> Figure:
    """Stress over strain, and both over time."""
    time, strain, stress = simulation.time, simulation.true_strain, simulation.true_stress
    with styled_figure(7.2, 4.4) as figure:
        grid = figure.add_gridspec(2, 2, width_ratios=(1.35, 1))
        whole = figure.add_subplot(grid[:, 0])
        upper = figure.add_subplot(grid[0, 1])
        lower = figure.add_subplot(grid[1, 1], sharex=upper)
        whole.plot(*thinned(strain, stress), color=colour("model"))
        upper.plot(*thinned(time, stress), color=colour("model"))
        lower.plot(*thinned(time, strain), color=colour("second"))
        whole.set(xlabel="true strain [–]", ylabel="true stress [MPa]")
        upper.set(ylabel="true stress [MPa]")
        lower.set(xlabel="time [s]", ylabel="true strain [–]")
        upper.tick_params(labelbottom=False)
        figure.suptitle(simulation.name, x=0.01, ha="left", fontsize=10, fontweight="bold")
    return figure


def _note(axes: Axes, text: str, *, above: bool = True) -> None:
    y, side = (0.96, "top") if above else (0.04, "bottom")
    axes.text(0.012, y, text, transform=axes.transAxes, ha="left", va=side, fontsize=8)


def _magnification(above: Axes, below: Axes) -> float:
    """How many times longer one MPa is drawn below than above."""

    def length_of_one(axes: Axes) -> float:
        low, high = axes.get_ylim()
        return axes.get_window_extent().height / float(np.abs(high - low))

    return length_of_one(below) / length_of_one(above)
