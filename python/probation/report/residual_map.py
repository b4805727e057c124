"""Where a simulation departs from the records: one strip per record, coloured by the error in units of the noise."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Rectangle

from probation.report.diagnosis_words import short_ids
from probation.report.figures import styled_figure
from probation.report.style import colour
from probation.wording import percent

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.detection.where import Located
    from probation.diagnosis.result import Diagnosis, RecordCurves

CELLS = 120
"""Parts of a record, each of one colour: the mean error within it."""

NOISE_MULTIPLES = (1.0, 3.0, 10.0, 30.0)
"""Multiples of the noise at which the colour deepens; below the first there is none."""

_ALPHAS = (0.2, 0.42, 0.68, 1.0)
_BEFORE, _AFTER = (-0.12, 0.3), (0.22, 0.12)  # top of a strip within its row, and how high it is
_WIDE_ENOUGH = 5.0  # percent of a record whose region has room for a number ...
_APART = 12.0  # ... and percent between two numbers, so that they do not touch on a telephone


def residual_map(diagnosis: Diagnosis) -> Figure:
    """Every record as a strip from its start to its end; regions that stand out are framed, with their share."""
    curves = list(diagnosis.curves.values())
    names = short_ids(diagnosis.curves)
    with styled_figure(7.2, 1.15 + 0.52 * len(curves)) as figure:
        axes, scale = figure.subplots(2, 1, height_ratios=(0.52 * len(curves), 0.22))
        for at, curve in enumerate(curves):
            _strip(axes, at, curve, curve.base, _BEFORE)
            if curve.explained is not None:
                _strip(axes, at, curve, curve.explained, _AFTER)
            end = "  held out" if curve.role != "identify" else ""
            axes.text(101.0, at, f"{curve.time[-1] - curve.time[0]:.4g} s{end}", va="center", fontsize=8)
        place = {curve.id: at for at, curve in enumerate(curves)}
        numbered: dict[str, list[float]] = {name: [] for name in diagnosis.curves}
        for region in diagnosis.located:
            _frame(axes, place[region.record], diagnosis.curves[region.record], region, numbered[region.record])
        axes.set_yticks(range(len(curves)), [fill(names[curve.id], 18) for curve in curves])
        axes.set(xlim=(0.0, 100.0), ylim=(len(curves) - 0.4, -0.6))
        axes.set(xlabel="part of the record's time [%]", ylabel="record")
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        _scale(scale)
    return figure


def levels_of(error: FloatArray, noise: FloatArray) -> list[int]:
    """Signed level of each part of a record: 0 within the noise, +4 or -4 beyond 30 times as much.

    Parameters
    ----------
    error : ndarray, shape (n,) [MPa]
        Model minus measured.
    noise : ndarray, shape (n,) [MPa]
    """
    ratio = error / np.maximum(noise, 1e-300)
    parts = np.array_split(ratio, min(CELLS, len(ratio)))
    means = np.array([float(part.mean()) for part in parts])
    return [int(level) for level in np.sign(means) * np.searchsorted(NOISE_MULTIPLES, np.abs(means), side="right")]


def _strip(axes: Axes, row: int, curves: RecordCurves, model: FloatArray, place: tuple[float, float]) -> None:
    levels = levels_of(model - curves.data, curves.noise)
    borders = [part[0] for part in np.array_split(np.arange(len(curves.time)), len(levels))]
    ends = _percent_of_time(curves, [*borders, len(curves.time) - 1])
    top, height = row + place[0], place[1]
    axes.add_patch(Rectangle((0.0, top), 100.0, height, facecolor=colour("data"), alpha=0.12, lw=0))
    first = 0
    for at in range(1, len(levels) + 1):
        if at < len(levels) and levels[at] == levels[first]:
            continue
        if levels[first]:
            shade, alpha = _shade(levels[first])
            part = Rectangle((ends[first], top), ends[at] - ends[first], height, facecolor=shade, alpha=alpha, lw=0)
            axes.add_patch(part)
        first = at


def _frame(axes: Axes, row: int, curves: RecordCurves, region: Located, numbered: list[float]) -> None:
    """A frame, and its share where there is room between those that are `numbered` already."""
    start, stop = _percent_of_time(curves, [region.samples.start, region.samples.stop - 1])
    top, height = row + _BEFORE[0] - 0.03, _BEFORE[1] + 0.06
    axes.add_patch(Rectangle((start, top), stop - start, height, fill=False, edgecolor=colour("ink"), lw=1.1))
    middle = (start + stop) / 2.0
    if stop - start > _WIDE_ENOUGH and all(abs(middle - other) > _APART for other in numbered):
        axes.text(middle, top - 0.03, percent(region.share), ha="center", va="bottom", fontsize=8)
        numbered.append(middle)


def _scale(axes: Axes) -> None:
    """The colours and what they mean, from "too low" to "too high"."""
    count = len(NOISE_MULTIPLES)
    for level in range(-count, count + 1):
        shade, alpha = _shade(level) if level else (colour("data"), 0.12)
        axes.add_patch(Rectangle((level - 0.5, 0.0), 1.0, 1.0, facecolor=shade, alpha=alpha, lw=0))
    places = [at + 0.5 for at in range(-count, count)]
    axes.set_xticks(places, [f"{level:g}" for level in (*reversed(NOISE_MULTIPLES), *NOISE_MULTIPLES)])
    axes.set(xlim=(-count - 0.5, count + 0.5), ylim=(0.0, 1.0), yticks=[])
    axes.text(-0.02, 0.5, "model too low", transform=axes.transAxes, ha="right", va="center", fontsize=8.5)
    axes.text(1.02, 0.5, "too high", transform=axes.transAxes, va="center", fontsize=8.5)
    axes.set_xlabel("|model − measured| / noise [–]")
    axes.grid(visible=False)
    axes.spines[["left", "bottom"]].set_visible(False)


def _shade(level: int) -> tuple[str, float]:
    return colour("model" if level < 0 else "second"), _ALPHAS[abs(level) - 1]


def _percent_of_time(curves: RecordCurves, at: list[int]) -> list[float]:
    time = curves.time
    return [float(percent) for percent in 100.0 * (time[at] - time[0]) / max(float(time[-1] - time[0]), 1e-300)]
