"""A table, for the terminal and for a page alike."""

from __future__ import annotations

from dataclasses import dataclass


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
