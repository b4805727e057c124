"""A table, for the terminal and for a page alike."""

from __future__ import annotations

from dataclasses import dataclass, replace
from textwrap import wrap
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class Table:
    """Headings and rows of text.

    Attributes
    ----------
    headings : tuple of str
        With units: "largest error [MPa]".
    rows : tuple of tuple of str
    caption : str
    left : int
        How many columns from the left hold words and are set left; the others hold numbers.
    """

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""
    left: int = 1

    def wrapped(self, widths: Mapping[str, int]) -> Table:
        """The table with long cells broken into lines, which become rows.

        Parameters
        ----------
        widths : dict of str to int
            Letters in a line, by heading; other columns stay as they are. A cell may also hold line ends of its own.
        """
        return replace(self, rows=tuple(line for row in self.rows for line in self._lines(row, widths)))

    def _lines(self, row: tuple[str, ...], widths: Mapping[str, int]) -> list[tuple[str, ...]]:
        cells = []
        for cell, heading in zip(row, self.headings, strict=True):
            width = widths.get(heading)
            cells.append(
                [part for line in cell.split("\n") for part in (wrap(line, width) if width else [line]) or [""]]
            )
        deepest = max(len(cell) for cell in cells)
        return [tuple(cell[at] if at < len(cell) else "" for cell in cells) for at in range(deepest)]

    def text(self, indent: str = "  ") -> str:
        """The table as aligned lines, the caption first."""
        lines = [self.headings, *self.rows]
        widths = [max(len(line[at]) for line in lines) for at in range(len(self.headings))]
        set_lines = [
            indent
            + "  ".join(
                cell.ljust(width) if at < self.left else cell.rjust(width)
                for at, (cell, width) in enumerate(zip(line, widths, strict=True))
            ).rstrip()
            for line in lines
        ]
        rule = indent + "  ".join("─" * width for width in widths)
        caption = [self.caption] if self.caption else []
        return "\n".join([*caption, set_lines[0], rule, *set_lines[1:]])
