"""Plots of what is left of a record, and of how well that bounds the parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.identify.bias import low_frequency
from probation.inference.parameter import SYMBOLS
from probation.report.figures import house_style, new_figure, styled_figure, thinned
from probation.report.style import colour, series_colour

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.identify.record_fit import RecordFit
    from probation.identify.result import Fit


def residual_parts(record: RecordFit) -> Figure:
    """The fit residual over strain with its low-frequency part, whose largest value is marked."""
    with styled_figure(7.2, 2.6) as figure:
        axes = figure.subplots()
        strain, low = record.true_strain, record.bias.low
        axes.plot(*thinned(strain, record.fit_residual), color=colour("data"), lw=0.6, label="model − measured")
        axes.plot(*thinned(strain, low), color=colour("model"), label="low-frequency part")
        if record.bias.significant:
            at = int(np.argmax(np.abs(low)))
            axes.plot(strain[at], low[at], "o", ms=5, color=colour("second"), label=record.bias.text)
        axes.axhline(0.0, color=colour("muted"), lw=0.8)
        axes.set(xlabel="true strain [–]", ylabel="residual [MPa]")
        figure.legend(ncols=3, loc="outside upper center")
    return figure


def profile_figure(fit: Fit) -> Figure:
    """The signed root of each parameter's profile, the line of its standard error, and both intervals' ends."""
    with house_style():
        count = len(fit.profiles)
        figure = new_figure(2.4 + 2.2 * count, 3.2)
        panels = figure.subplots(1, count, sharey=True, squeeze=False)[0]
        for axes, (name, profile) in zip(panels, fit.profiles.items(), strict=True):
            parameter = fit.parameters[name]
            axes.plot(profile.values, profile.root, "o-", ms=3, color=colour("model"), label="profile")
            if parameter.se:
                straight = (profile.values - profile.value) / parameter.se
                axes.plot(profile.values, straight, "--", lw=1.0, color=colour("muted"), label="standard error")
            for end in profile.interval95:
                if profile.values[0] <= end <= profile.values[-1]:
                    axes.axvline(end, color=colour("second"), lw=1.0)
            for level in (-profile.quantile, profile.quantile):
                axes.axhline(level, color=colour("muted"), lw=0.6)
            axes.set_ylim(-1.5 * profile.quantile, 1.5 * profile.quantile)
            axes.set_xlabel(f"{SYMBOLS[name]} [{parameter.unit}]" if parameter.unit else f"{SYMBOLS[name]} [–]")
            axes.locator_params(axis="x", nbins=4)
        panels[0].set_ylabel("signed root of the deviance [–]")
        panels[0].legend(loc="upper left")
    return figure


def residual_and_strain_error(
    true_strain: FloatArray,
    measured: FloatArray,
    model: FloatArray,
    strain_error: FloatArray,
) -> Figure:
    """The paper's Figure 2: stress on the left axis; on the right the residual and the strain's distance to its ramp.

    Parameters
    ----------
    true_strain, measured, model : ndarray, shape (n_times,) [-], [MPa], [MPa]
    strain_error : ndarray, shape (n_times,) [-]
        Measured strain minus the ramp that was asked for; drawn as tall as the residual's high frequencies.
    """
    magnified, level = 4.0, 40.0  # of the residual, and where the strain error is drawn, on the right axis [MPa]
    residual = magnified * (model - measured)
    fast = residual - low_frequency(residual)
    scale = float(np.std(fast) / max(float(np.std(strain_error)), 1e-300))
    with styled_figure(7.2, 4.4) as figure:
        axes = figure.subplots()
        right = axes.twinx()
        axes.plot(*thinned(true_strain, measured, 400), ".", ms=5, mew=0, color=colour("data"), label="measured")
        axes.plot(*thinned(true_strain, model), color=series_colour(0), lw=1.1, label="model")
        right.plot(*thinned(true_strain, residual), color=series_colour(1), lw=0.6, label=f"residual × {magnified:g}")
        shifted = level + scale * strain_error
        label = f"strain error × {float(f'{scale:.2g}'):g} MPa, shifted to {level:g}"
        right.plot(*thinned(true_strain, shifted), color=series_colour(2), lw=0.6, label=label)
        right.spines["right"].set_visible(True)
        right.grid(visible=False)
        right.set(ylabel="residual and strain error [MPa]", ylim=(-0.5 * level, 2.5 * level))
        axes.set(xlabel="true strain [–]", ylabel="true stress [MPa]")
        handles = [*axes.get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
        axes.legend(handles=handles, loc="upper left")
    return figure
