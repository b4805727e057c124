"""A table, for the terminal and for a page alike."""

from __future__ import annotations

import re
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING

from probation.wording import WIDTH, within_width

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


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

    def text(self, indent: str = "  ", width: int = WIDTH) -> str:
        """The table as aligned lines of at most so many letters, the caption first.

        What is too wide has its headings broken, then its cells of words; what is still too wide goes on below, under
        the first columns again.
        """
        room = width - len(indent)
        if self._wide(self._natural()) <= room:
            return self._set(self._natural(), indent, width)
        least = self._least()
        if self._wide(least) <= room:
            widths, full = least, self._natural()
            while self._wide(widths) < room and (growing := [at for at in range(len(full)) if widths[at] < full[at]]):
                widths[min(growing, key=widths.__getitem__)] += 1
            return self._set(widths, indent, width)
        named = max(1, min(self.left, 2)) if sum(least[:2]) < room // 2 else 1
        fitting = named + 1
        while fitting < len(least) and self._wide(least[: fitting + 1]) <= room:
            fitting += 1
        if fitting >= len(least):  # two columns that are too wide even so: nothing is left to break
            return self._set(least, indent, width)
        first = self._columns(range(fitting), self.caption)
        rest = self._columns([*range(named), *range(fitting, len(least))], "")
        return f"{first.text(indent, width)}\n\n{rest.text(indent, width)}"

    def _columns(self, kept: Sequence[int], caption: str) -> Table:
        left = sum(at < self.left for at in kept)
        rows = tuple(tuple(row[at] for at in kept) for row in self.rows)
        return Table(tuple(self.headings[at] for at in kept), rows, caption, left)

    def _wide(self, widths: Sequence[int]) -> int:
        return sum(widths) + 2 * (len(widths) - 1)

    def _natural(self) -> list[int]:
        return [max(_longest(cell.split("\n")) for cell in column) for column in self._by_column()]

    def _least(self) -> list[int]:
        """What each column needs at least: its longest word, or a number with what belongs to it; a name is broken."""
        least = []
        for at, (heading, *cells) in enumerate(self._by_column()):
            words = at < self.left or _longest(cells) > _NUMBER
            needed = [part for cell in cells for part in re.split(r"[ \n]" if words else r"\n", cell)]
            least.append(min(max(_longest(re.split(r"[ \n]", heading)), _longest(needed)), _NAME))
        return least

    def _by_column(self) -> list[tuple[str, ...]]:
        return list(zip(self.headings, *self.rows, strict=True))

    def _set(self, widths: Sequence[int], indent: str, width: int) -> str:
        headings = self._broken(self.headings, widths, below=True)
        rows = [line for row in self.rows for line in self._broken(row, widths)]
        lines = [
            indent
            + "  ".join(
                cell.ljust(wide) if at < self.left else cell.rjust(wide)
                for at, (cell, wide) in enumerate(zip(line, widths, strict=True))
            ).rstrip()
            for line in (*headings, *rows)
        ]
        lines.insert(len(headings), indent + "  ".join("─" * wide for wide in widths))
        caption = [within_width(self.caption, width)] if self.caption else []
        return "\n".join([*caption, *lines])

    def _broken(self, row: tuple[str, ...], widths: Sequence[int], *, below: bool = False) -> list[tuple[str, ...]]:
        """A row as lines; the cells begin in the first of them, or end in the last."""
        cells = [
            [part for line in cell.split("\n") for part in (wrap(line, wide) if len(line) > wide else [line])]
            for cell, wide in zip(row, widths, strict=True)
        ]
        deepest = max(len(cell) for cell in cells)
        padded = [
            [""] * (deepest - len(cell)) + cell if below else cell + [""] * (deepest - len(cell)) for cell in cells
        ]
        return list(zip(*padded, strict=True))


_NUMBER = 24
"""Letters beyond which a cell of numbers is broken like words ..."""

_NAME = 26
"""... and beyond which a word is broken."""


def _longest(parts: Iterable[str]) -> int:
    return max(map(len, parts), default=0)
