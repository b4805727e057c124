"""A result as a card in a notebook: what it is, the verdict, one or two small tables, and its curves."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation._text import printable_lines
from probation.report.style import SERIES, css_variables

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.report.table import Table

Mood = Literal["good", "bad", "neutral"]

WIDTH, HEIGHT = 300, 150
"""Of the drawing, in CSS pixels."""

MOST_POINTS = 240
"""Of one curve: as many as can be seen at that width."""

MOST_CURVES = 12
"""More of them cannot be distinguished."""

_DARK = (
    'html[data-theme="dark"] .probation-card, body[data-theme="dark"] .probation-card, '
    'body[data-jp-theme-light="false"] .probation-card, body.vscode-dark .probation-card'
)

_STYLE = f"""
.probation-card {{ {css_variables(dark=False)} }}
{_DARK} {{ {css_variables(dark=True)} }}
.probation-card {{ color: var(--ink); font: 13px/1.45 system-ui, sans-serif; border: 1px solid var(--grid);
  border-left: 4px solid var(--muted); border-radius: 6px; padding: 10px 14px; max-width: 860px; margin: 4px 0;
  overflow-x: auto; }}
.probation-card.good {{ border-left-color: var(--good); }}
.probation-card.bad {{ border-left-color: var(--bad); }}
.probation-card .kind {{ color: var(--muted); margin: 0 0 2px; }}
.probation-card .kind b {{ color: var(--ink); }}
.probation-card .verdict {{ font-size: 15px; margin: 0 0 8px; }}
.probation-card .parts {{ display: flex; flex-wrap: wrap; gap: 8px 22px; align-items: flex-start; }}
.probation-card table {{ border-collapse: collapse; margin: 0 0 6px; font-size: 12.5px; }}
.probation-card caption {{ text-align: left; color: var(--muted); padding: 0 0 2px; }}
.probation-card th, .probation-card td {{ padding: 2px 10px 2px 0; border: 0; border-bottom: 1px solid var(--grid);
  text-align: right; vertical-align: top; background: none; white-space: pre-line; }}
.probation-card th {{ color: var(--muted); font-weight: normal; }}
.probation-card .left {{ text-align: left; }}
.probation-card ul {{ margin: 4px 0 0; padding-left: 18px; color: var(--muted); }}
.probation-card pre {{ font-size: 12px; line-height: 1.35; color: var(--ink); background: none; overflow-x: auto; }}
.probation-card summary {{ color: var(--muted); cursor: pointer; }}
.probation-card svg text {{ fill: var(--muted); font: 10px system-ui, sans-serif; }}
"""


@dataclass(frozen=True)
class Drawing:
    """Curves in a small frame with the ends of its axes.

    Attributes
    ----------
    curves : tuple of (x, y, colour)
        Shapes (n,); the colour by its name in `style.COLOURS`.
    legend : tuple of (label, colour)
    x_label, y_label : str
        With units.
    """

    curves: tuple[tuple[FloatArray, FloatArray, str], ...]
    legend: tuple[tuple[str, str], ...] = ()
    x_label: str = "true strain [–]"
    y_label: str = "true stress [MPa]"

    def svg(self) -> str:
        """As an element of a page."""
        left, top, right, bottom = 8, 16, WIDTH - 8, HEIGHT - 18
        x_low, x_high = _extent(curve[0] for curve in self.curves)
        y_low, y_high = _extent(curve[1] for curve in self.curves)
        lines = []
        for x, y, colour in self.curves:
            at = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST_POINTS)).astype(int))
            across = left + (x[at] - x_low) / (x_high - x_low) * (right - left)
            down = bottom - (y[at] - y_low) / (y_high - y_low) * (bottom - top)
            width = 3.2 if colour == "data" else 1.4  # a model that is right hides no measurement
            points = " ".join(f"{a:.1f},{d:.1f}" for a, d in zip(across, down, strict=True))
            lines.append(f'<polyline points="{points}" fill="none" stroke="var(--{colour})" stroke-width="{width}"/>')
        return (
            f'<svg width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
            f'aria-label="{_safe(self.y_label)} over {_safe(self.x_label)}">'
            f'<path d="M{left} {top}V{bottom}H{right}" fill="none" stroke="var(--grid)"/>{"".join(lines)}'
            f"{self._legend(right)}"
            f'<text x="{left}" y="10">{_safe(self.y_label)} {y_low:.3g} … {y_high:.3g}</text>'
            f'<text x="{left}" y="{HEIGHT - 5}">{x_low:.3g}</text>'
            f'<text x="{WIDTH // 2}" y="{HEIGHT - 5}" text-anchor="middle">{_safe(self.x_label)}</text>'
            f'<text x="{right}" y="{HEIGHT - 5}" text-anchor="end">{x_high:.3g}</text></svg>'
        )

    def _legend(self, right: int) -> str:
        labels = "".join(
            f'<tspan dx="8" style="fill:var(--{colour})">{_safe(label)}</tspan>' for label, colour in self.legend
        )
        return f'<text x="{right}" y="10" text-anchor="end">{labels}</text>' if labels else ""


@dataclass(frozen=True)
class Card:
    """What a notebook shows of a result. Every text may come from a file and is escaped here.

    Attributes
    ----------
    kind : str
        What it is: "Fit".
    title : str
        Of what: the campaign.
    verdict : str
        One sentence, read first.
    mood : {"good", "bad", "neutral"}
        How its edge is coloured.
    tables : tuple of Table
    drawing : Drawing or None
    notes : tuple of str
        Warnings, and what else is to be known.
    details : str
        Text that unfolds.
    """

    kind: str
    title: str
    verdict: str
    mood: Mood = "neutral"
    tables: tuple[Table, ...] = ()
    drawing: Drawing | None = None
    notes: tuple[str, ...] = ()
    details: str = ""

    def html(self) -> str:
        """The card as one element with its own style: nothing fetched, no script."""
        shown = [_table(table) for table in self.tables if table.rows]
        if self.drawing is not None and self.drawing.curves:
            shown.append(f"<div>{self.drawing.svg()}</div>")
        notes = "".join(f"<li>{_safe(note)}</li>" for note in self.notes)
        unfolds = f"<details><summary>all of it</summary><pre>{_safe(self.details)}</pre></details>"
        return (
            f'<div class="probation-card {self.mood}"><style>{_STYLE}</style>'
            f'<p class="kind"><b>{_safe(self.kind)}</b> {_safe(self.title)}</p>'
            f'<p class="verdict">{_safe(self.verdict)}</p>'
            f'<div class="parts">{"".join(shown)}</div>'
            f"{f'<ul>{notes}</ul>' if notes else ''}{unfolds if self.details else ''}</div>"
        )


def colours(count: int) -> tuple[str, ...]:
    """Names of the colours of so many curves."""
    return tuple(SERIES[at % len(SERIES)] for at in range(count))


def shortened(lines: Sequence[str], most: int, what: str) -> tuple[str, ...]:
    """The first lines, and how many more there are."""
    left = len(lines) - most
    return tuple(lines) if left <= 0 else (*lines[:most], f"… and {left} more {what}{'s' if left > 1 else ''}")


def _table(table: Table) -> str:
    def cells(row: Sequence[str], tag: str) -> str:
        kinds = ["left" if at < table.left else "number" for at in range(len(row))]
        return "".join(f'<{tag} class="{kind}">{_safe(cell)}</{tag}>' for kind, cell in zip(kinds, row, strict=True))

    rows = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in table.rows)
    caption = f"<caption>{_safe(table.caption)}</caption>" if table.caption else ""
    return f"<table>{caption}<thead><tr>{cells(table.headings, 'th')}</tr></thead><tbody>{rows}</tbody></table>"


def _safe(text: str) -> str:
    return escape(printable_lines(str(text)))


def _extent(all_values: Iterable[FloatArray]) -> tuple[float, float]:
    parts = list(all_values)
    low, high = min(float(np.min(part)) for part in parts), max(float(np.max(part)) for part in parts)
    return (low, high) if high > low else (low - 0.5, high + 0.5)
