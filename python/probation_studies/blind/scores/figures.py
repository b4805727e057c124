"""Scores as figures: how large a gap is found, whether probabilities mean what they say, what is taken for what."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np
from matplotlib.patches import Rectangle

from probation.report.figures import styled_figure
from probation.report.style import colour, series_colour
from probation_studies.blind.scores.confusion import RIGHT_PAIR

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

_SHADES = (0.15, 0.5)
"""Of a cell with one campaign of a row, and with all of them: numbers stand in it, on a dark page too."""

_AIMS = {"5": 0.90, "8": 0.99}


def power_figure(board: Mapping[str, object]) -> Figure:
    """Part of the gaps that is found, and of the causes that are named rightly, over the detectability."""
    detection = cast("Mapping[str, Mapping[str, object]]", board["detection"])
    groups = cast("Mapping[str, Mapping[str, object]]", board["by_detectability"])
    named = {name: cast("Mapping[str, object]", group["top1"]) for name, group in groups.items()}
    with styled_figure(7.2, 3.8) as figure:
        axes = figure.subplots()
        for at, (label, rates) in enumerate((("gap found", detection), ("cause named", named))):
            known = {name: rate for name, rate in rates.items() if rate["n"]}
            place = np.array([float(name) for name in known]) * 1.03 ** (2 * at - 1)
            value = np.array([cast("float", each["rate"]) for each in known.values()])
            ends = np.array([cast("list[float]", each["interval95"]) for each in known.values()]).reshape(-1, 2)
            reach = np.abs(ends.T - value)
            axes.errorbar(place, value, yerr=reach, fmt="o-", ms=4, lw=1.2, color=series_colour(at), label=label)
        if any("oracle_expected" in group and group["n"] for group in groups.values()):
            known_groups = {name: group for name, group in groups.items() if group["n"]}
            axes.plot(
                [float(name) for name in known_groups],
                [cast("float", group["oracle_expected"]) for group in known_groups.values()],
                ls="--",
                color=colour("muted"),
                label="cause named, oracle",
            )
        for name, aim in _AIMS.items():
            axes.plot(float(name), aim, marker="_", ms=14, mew=2, color=colour("bad"))
        axes.set(xscale="log", xlabel="detectability √λ [-]", ylabel="part of the campaigns [-]", ylim=(-0.03, 1.05))
        axes.set_xticks([3, 5, 8, 15, 40, 100], ["3", "5", "8", "15", "40", "100"])
        axes.minorticks_off()
        axes.legend(loc="lower right")
    return figure


def reliability_figure(board: Mapping[str, object]) -> Figure:
    """How often the best explanation is right over how probable it was said to be."""
    curve = cast("Mapping[str, object]", board["reliability"])
    bins = cast("list[Mapping[str, object]]", curve["bins"])
    with styled_figure(7.2, 3.8) as figure:
        axes = figure.subplots()
        axes.plot([0.0, 1.0], [0.0, 1.0], color=colour("muted"), lw=0.8)
        for each in bins:
            low, high = cast("list[float]", each["calibrated95"])
            place = cast("float", each["probability"])
            axes.plot([place, place], [low, high], color=colour("data"), alpha=0.3, lw=9, solid_capstyle="butt")
        right = [cast("Mapping[str, object]", each["right"]) for each in bins]
        said = np.array([cast("float", each["probability"]) for each in bins])
        value = np.array([cast("float", each["rate"]) for each in right])
        ends = np.array([cast("list[float]", each["interval95"]) for each in right]).reshape(-1, 2)
        reach = np.abs(ends.T - value)
        axes.errorbar(said, value, yerr=reach, fmt="o", ms=4, lw=1.2, color=series_colour(0))
        for x, y, each in zip(said, value, right, strict=True):
            axes.annotate(str(each["n"]), (x, y), xytext=(8, -3), textcoords="offset points")
        axes.set(xlabel="probability given to the best explanation [-]", ylabel="part that is right [-]")
        axes.set(xlim=(0.0, 1.06), ylim=(-0.03, 1.05))
    return figure


def confusion_figure(board: Mapping[str, object]) -> Figure:
    """How often each truth (rows) was given each answer (columns)."""
    matrix = cast("Mapping[str, object]", board["confusion_matrix"])
    rows, columns = cast("list[str]", matrix["truths"]), cast("list[str]", matrix["answers"])
    counts = np.array(cast("list[list[int]]", matrix["counts"])).reshape(len(rows), len(columns))
    with styled_figure(7.2, 2.0 + 0.215 * len(rows)) as figure:
        axes = figure.subplots()
        for (row, column), count in np.ndenumerate(counts):
            right = columns[column] == (RIGHT_PAIR if rows[row] == "several" else rows[row])
            if right:
                axes.add_patch(Rectangle((column - 0.5, row - 0.5), 1.0, 1.0, fill=False, ec=colour("muted"), lw=0.5))
            if not count:
                continue
            part = count / counts[row].sum()
            alpha = _SHADES[0] + (_SHADES[1] - _SHADES[0]) * part
            shade = colour("model" if right else "bad")
            axes.add_patch(Rectangle((column - 0.5, row - 0.5), 1.0, 1.0, facecolor=shade, alpha=alpha, lw=0))
            axes.text(column, row, str(count), ha="center", va="center", fontsize=6.5)
        axes.set_xticks(range(len(columns)), [_words(each) for each in columns], rotation=90, fontsize=7.5)
        axes.xaxis.tick_top()
        axes.xaxis.set_label_position("top")
        axes.set_yticks(range(len(rows)), [_words(each) for each in rows], fontsize=7.5)
        axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(len(rows) - 0.5, -0.5), ylabel="truth")
        axes.set_xlabel("answer", labelpad=8)
        axes.grid(visible=False)
        axes.tick_params(length=0)
        axes.spines[["left", "bottom"]].set_visible(False)
    return figure


def _words(label: str) -> str:
    return label.replace("_", " ")
