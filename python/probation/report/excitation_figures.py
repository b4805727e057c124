"""Figures of the excitation: strain, rate and their bands, and the supplementary Figures S3 to S8."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import LogFormatter

from probation.report.figures import house_style, legend_outside, new_figure, styled_figure, thinned
from probation.report.style import colour, series_colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.smoothing.answer import ExcitationAnswer, RecordExcitation
    from probation.smoothing.comparison import Comparison
    from probation.smoothing.necking import NeckingFit

_TIME = "time [s]"
_STRAIN = "true strain [–]"
_RATE = "true strain rate [1/s]"
_DOTS = 600
_SAME = 1e-9  # relative: curves that vary by less are constant


def excitation_figure(answer: RecordExcitation) -> Figure:
    """Strain, what smoothing took away, and the rate with its band of two standard errors."""
    with styled_figure(7.2, 6.6) as figure:
        above, middle, below = figure.subplots(3, 1, sharex=True, height_ratios=(1.0, 0.7, 1.2))
        _strain(above, answer)
        _residual(middle, answer)
        _rate(below, answer)
        above.set_title(answer.id)
        below.set_xlabel(_TIME)
        figure.align_ylabels()
    return figure


def answer_figure(answer: ExcitationAnswer) -> Figure:
    """The one record of an answer."""
    return excitation_figure(answer.only("a plot"))


def strain_figure(answer: RecordExcitation) -> Figure:
    """Measured and smoothed strain, and their difference."""
    with styled_figure(7.2, 4.4) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.4, 1.0))
        _strain(above, answer)
        _residual(below, answer)
        below.set_xlabel(_TIME)
        figure.align_ylabels()
    return figure


def rate_figure(answer: RecordExcitation) -> Figure:
    """The rate with its band, and the standard error as a part of it."""
    with styled_figure(7.2, 4.8) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.6, 1.0))
        _rate(above, answer)
        time, rate = answer.time, np.abs(answer.excitation.rate)
        part = answer.excitation.rate_se / np.maximum(rate, 1e-3 * rate.max())
        below.plot(*thinned(time, 100.0 * part), color=colour("model"), lw=1.0)
        if part.max() > 0.0:
            below.set_yscale("log")
            for formatter in (below.yaxis.set_major_formatter, below.yaxis.set_minor_formatter):
                formatter(LogFormatter(minor_thresholds=(1.0, 0.4)))  # 0.5, not 5×10⁻¹
        below.set(xlabel=_TIME, ylabel="standard error [%]")
        figure.align_ylabels()
    return figure


def integration_figure(answer: RecordExcitation) -> Figure:
    """The integrated rate beside the measured strain, and their difference: Figure S8 for any method."""
    return _integration(answer.time, answer.measured, answer.integrated)


def figure_s3(fit: NeckingFit) -> Figure:
    """Strain and its first fit (A-1); below, the residuals."""
    steps = fit.strain
    with styled_figure(7.2, 4.6) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.4, 1.0))
        _dots(above, steps.time, steps.measured, "measured")
        above.plot(*thinned(steps.time, steps.first), color=colour("model"), lw=1.1, label="(A-1)")
        above.set_ylabel(_STRAIN)
        above.legend()
        below.plot(*thinned(steps.time, steps.first_residual), color=colour("model"), lw=0.8)
        _zero(below)
        below.set(xlabel=_TIME, ylabel="measured − fit [–]")
        figure.align_ylabels()
    return figure


def figure_s4(fit: NeckingFit) -> Figure:
    """The residuals of the first step and the sines through them."""
    steps = fit.strain
    with styled_figure(7.2, 3.4) as figure:
        axes = figure.subplots()
        _dots(axes, steps.time, steps.first_residual, "residual after step 1")
        label = _sines(len(steps.sines.frequencies))
        axes.plot(*thinned(steps.time, steps.sines(steps.time)), color=colour("second"), label=label)
        _zero(axes)
        axes.set(xlabel=_TIME, ylabel="measured − (A-1) [–]")
        axes.legend()
    return figure


def figure_s5(fit: NeckingFit) -> Figure:
    """The residuals of the first step with their fit; below, what the second step leaves."""
    steps = fit.strain
    with styled_figure(7.2, 4.6) as figure:
        above, below = figure.subplots(2, 1, sharex=True)
        _dots(above, steps.time, steps.first_residual, "after step 1")
        above.plot(*thinned(steps.time, steps.sines(steps.time)), color=colour("second"), label="its fit")
        above.legend()
        below.plot(*thinned(steps.time, steps.final_residual), color=colour("second"), lw=0.8)
        for axes, ylabel in ((above, "after step 1 [–]"), (below, "after step 2 [–]")):
            _zero(axes)
            axes.set_ylabel(ylabel)
        _note(below, f"rms {np.std(steps.final_residual):.2g}")
        below.set_xlabel(_TIME)
        figure.align_ylabels()
    return figure


def figure_s6(fit: NeckingFit) -> Figure:
    """The final fit of the strain."""
    steps = fit.strain
    with styled_figure(7.2, 3.6) as figure:
        axes = figure.subplots()
        _dots(axes, steps.time, steps.measured, "measured")
        label = f"(A-1) and {_sines(len(steps.sines.frequencies))}"
        axes.plot(*thinned(steps.time, steps.final), color=colour("second"), lw=1.1, label=label)
        axes.set(xlabel=_TIME, ylabel=_STRAIN)
        axes.legend()
    return figure


def figure_s7(fit: NeckingFit) -> Figure:
    """The differentiated strain, its fits after one and two steps, and the derivative of the strain's own fit."""
    steps, time = fit.rate, fit.rate.time
    with styled_figure(7.2, 3.8) as figure:
        axes = figure.subplots()
        _dots(axes, time, steps.measured, fit.differentiator)
        axes.plot(*thinned(time, steps.first), color=colour("model"), lw=1.1, label="derivative of (A-1)")
        label = f"... and {_sines(len(steps.sines.frequencies))}"
        axes.plot(*thinned(time, steps.final), color=colour("second"), lw=1.1, label=label)
        axes.plot(
            *thinned(time, fit.strain_slope),
            color=colour("third"),
            lw=1.1,
            ls="--",
            label="derivative of the strain's fit",
        )
        low, high = _around(steps.measured, (steps.first, steps.final, fit.strain_slope))
        axes.set(xlabel=_TIME, ylabel=_RATE, ylim=(low, high))
        axes.legend()
    return figure


def figure_s8(fit: NeckingFit) -> Figure:
    """The integrated fit of the rate beside the measured strain."""
    return _integration(fit.rate.time, fit.strain.measured, fit.integrated)


def comparison_figure(comparison: Comparison) -> Figure:
    """The error of every method over the noise, one panel per history."""
    histories = list(dict.fromkeys(key[0] for key in comparison.results))
    with house_style():
        rows = -(-len(histories) // 3)
        figure = new_figure(9.2, 0.6 + 2.7 * rows)
        panels = np.ravel(figure.subplots(rows, min(3, len(histories)), sharex=True, sharey=True, squeeze=False))
        for panel, history in zip(panels, histories, strict=False):
            for at, method in enumerate(comparison.methods):
                noises, errors = comparison.errors_over_noise(history, method)
                if noises:
                    panel.plot(noises, errors, ".-", ms=6, color=series_colour(at), label=method)
            panel.set(xscale="log", yscale="log", title=history)
        for panel in panels[len(histories) :]:
            panel.set_axis_off()
        figure.supxlabel("strain noise [–]", fontsize=9)
        figure.supylabel("p95 of the relative error of the rate [%]", fontsize=9)
        legend_outside(figure, *panels[0].get_legend_handles_labels(), columns=3)
    return figure


def _strain(axes: Axes, answer: RecordExcitation) -> None:
    _dots(axes, answer.time, answer.measured, "measured")
    axes.plot(*thinned(answer.time, answer.excitation.true_strain), color=colour("model"), lw=1.1, label="used")
    _jumps(axes, answer)
    axes.set_ylabel(_STRAIN)
    axes.legend()


def _residual(axes: Axes, answer: RecordExcitation) -> None:
    noise = answer.excitation.strain_noise
    axes.plot(*thinned(answer.time, answer.residual), color=colour("model"), lw=0.7)
    if noise > 0.0:
        axes.axhspan(-2 * noise, 2 * noise, color=colour("data"), alpha=0.18, lw=0)
        _note(axes, f"band: ±2 noise, {2 * noise:.2g}")
    _zero(axes)
    axes.set_ylabel("measured − used [–]")


def _rate(axes: Axes, answer: RecordExcitation) -> None:
    excitation, time = answer.excitation, answer.time
    if excitation.strain_rate is not None:
        _dots(axes, time, answer.differences, "differences of the measured strain")
    rate, error = excitation.rate, excitation.rate_se
    borders = [0, *excitation.jumps, len(time) - 1]
    for at in range(len(borders) - 1):
        # The rate of the sample at a jump belongs to the side before.
        part = slice(borders[at] + (at > 0), borders[at + 1] + 1)
        label = "rate" if at == 0 else None
        axes.fill_between(
            time[part],
            (rate - 2 * error)[part],
            (rate + 2 * error)[part],
            color=colour("model"),
            alpha=0.25,
            lw=0,
            label="± 2 standard errors" if at == 0 else None,
        )
        axes.plot(*thinned(time[part], rate[part]), color=colour("model"), lw=1.1, label=label)
    _jumps(axes, answer)
    axes.set(ylabel=_RATE, ylim=_around(answer.differences, (rate - 2 * error, rate + 2 * error)))
    axes.legend()


def _integration(time: FloatArray, measured: FloatArray, integrated: FloatArray) -> Figure:
    with styled_figure(7.2, 4.4) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.4, 1.0))
        _dots(above, time, measured, "measured")
        above.plot(*thinned(time, integrated), color=colour("second"), lw=1.1, label="integrated rate")
        above.set_ylabel(_STRAIN)
        above.legend()
        below.plot(*thinned(time, integrated - measured), color=colour("second"), lw=0.8)
        _zero(below)
        _note(below, f"largest {np.abs(integrated - measured).max():.2g}")
        below.set(xlabel=_TIME, ylabel="integrated − measured [–]")
        figure.align_ylabels()
    return figure


def _dots(axes: Axes, x: FloatArray, y: FloatArray, label: str) -> None:
    every = slice(None, None, -(-len(x) // _DOTS))  # not the extremes of each segment: these are samples, not a line
    axes.plot(x[every], y[every], ".", ms=4, mew=0, color=colour("data"), label=label, zorder=1.5)


def _zero(axes: Axes) -> None:
    axes.axhline(0.0, color=colour("muted"), lw=0.8)
    axes.margins(y=0.2)


def _jumps(axes: Axes, answer: RecordExcitation) -> None:
    for jump in answer.excitation.jumps:
        axes.axvline(answer.time[jump], color=colour("muted"), lw=0.8, ls=":")


def _note(axes: Axes, text: str) -> None:
    axes.text(0.988, 0.95, text, transform=axes.transAxes, ha="right", va="top", fontsize=8)


def _around(scattered: FloatArray, curves: tuple[FloatArray, ...]) -> tuple[float, float]:
    """Limits that show the curves, and of the scattered samples what is not far away from them."""
    low, high = min(float(curve.min()) for curve in curves), max(float(curve.max()) for curve in curves)
    room = 0.5 * (high - low)
    if room <= _SAME * max(abs(low), abs(high)):  # constant but for rounding
        room = 0.5 * abs(high) or 1.0
    return (
        max(min(low, float(scattered.min())), low - room) - 0.05 * room,
        min(max(high, float(scattered.max())), high + room) + 0.05 * room,
    )


def _sines(count: int) -> str:
    return "no sine" if count == 0 else "1 sine" if count == 1 else f"{count} sines"
