"""What is left of a gap and what it depends on: a table and a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.remainder_words import function_name
from probation.report.figures import styled_figure
from probation.report.page import Section, picture
from probation.report.style import colour
from probation.report.table import Table
from probation.wording import percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation.diagnosis.remainder import Remainder
    from probation.report.page import Picture

_WITHIN = 98.0
"""Percent of the points that the axis of the remainder shows."""


def remainder_table(left: Remainder) -> Table:
    """What the remainder is a function of, the most that explains first."""
    rows = tuple(
        (
            function_name(dependence),
            "a factor of the stress" if dependence.acts == "factor" else "a stress",
            percent(dependence.explained),
            dependence.judged_on,
        )
        for dependence in left.depends_on
    )
    headings = ("a function of", "which is", f"closes of {left.what}", "judged on … left out")
    return Table(headings, rows, f"{_capital(left.what)} depends on", left=2)


def remainder_figure(left: Remainder) -> Figure:
    """The remainder against the variable that explains most of it, and the function."""
    curve = left.curve
    assert curve is not None
    with styled_figure(5.3, 3.2) as figure:
        axes = figure.subplots()
        axes.axhline(0.0, color=colour("muted"), lw=0.6)
        groups = [
            ("strain growing or held", curve.inside & ~curve.unloading, "data", 1.0),
            ("strain falling", curve.inside & curve.unloading, "second", 1.0),
            ("elsewhere", ~curve.inside, "muted", 0.25),
        ]
        for label, chosen, shade, alpha in groups:
            if chosen.any():
                axes.plot(
                    curve.x[chosen], curve.y[chosen], ".", ms=4, mew=0, color=colour(shade), alpha=alpha, label=label
                )
        style = "o" if len(curve.function_x) < 10 else "-"
        axes.plot(curve.function_x, curve.function_y, style, color=colour("model"), lw=1.4, label="free function")
        low, high = np.percentile(curve.y, [100.0 - _WITHIN, _WITHIN])
        low, high = min(low, float(curve.function_y.min())), max(high, float(curve.function_y.max()))
        margin = 0.1 * max(high - low, 1e-12)
        axes.set(xlabel=curve.label, ylim=(low - margin, high + margin))
        axes.set_ylabel(f"measured less law [{curve.unit}{' of the stress' if curve.unit == '%' else ''}]")
        axes.legend(loc="best", fontsize=7.5)
    return figure


def remainder_section(left: Remainder) -> Section:
    """The section of a page."""
    parts: list[str | Table | Picture] = [left.description]
    if left.depends_on:
        parts.append(
            "A free function of each variable, alone and in each phase of a test, was fitted together with the law "
            "and judged where it was not fitted. It says on what the missing effect depends, not what the effect is."
        )
        parts.append(remainder_table(left))
        parts.append(
            picture(
                remainder_figure(left),
                f"{_capital(left.what)} against the variable that explains most of it; what refitted parameters of the "
                "law follow is taken off.",
            )
        )
    return Section(f"{_capital(left.what)}, and on what it depends", tuple(parts))


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
