"""Tables that a telephone is too narrow for: there each row becomes a list of headings and cells."""

import re
from html import escape, unescape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from docutils import nodes
    from sphinx.application import Sphinx

_TABLE = re.compile(r"<table.*?</table>", re.DOTALL)
_ROW = re.compile(r"(<tr[^>]*>)(.*?)(</tr>)", re.DOTALL)
_CELL = re.compile(r"<(t[hd])([^>]*)>(.*?)</\1>", re.DOTALL)
_LONG = 28  # letters of a cell beyond which it is broken into lines
_TELEPHONE = 42  # letters side by side on a telephone; each column costs two more


def setup(app: "Sphinx") -> dict[str, bool]:
    """Mark such tables in every page."""
    app.connect("html-page-context", _mark)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _mark(app: "Sphinx", page: str, template: str, context: dict[str, object], tree: "nodes.document | None") -> None:
    if isinstance(body := context.get("body"), str):
        context["body"] = _TABLE.sub(lambda table: stacked(table[0]), body)


def stacked(table: str) -> str:
    """A table whose cells bear the heading of their column, in the class ``stacks``; as it is where it is narrow.

    Parameters
    ----------
    table : str
        HTML of the table, as docutils writes it.
    """
    rows = [[_text(cell) for _, _, cell in _CELL.findall(row)] for _, row, _ in _ROW.findall(table)]
    if not rows or len(rows[0]) < 2 or any(len(row) != len(rows[0]) for row in rows) or not _too_wide(*rows):
        return table
    head, ended, body = table.partition("</thead>")
    marked = _ROW.sub(lambda row: f"{row[1]}{_labelled(row[2], rows[0])}{row[3]}", body)
    return re.sub(r'^<table class="', '<table class="stacks ', head) + ended + marked


def _labelled(row: str, headings: list[str]) -> str:
    """Cells with headings; one with nothing in it has nothing at all, so that a style sheet can tell it."""
    names = iter(headings)

    def labelled(cell: re.Match[str]) -> str:
        inside = f"<div>{cell[3]}</div>" if _text(cell[3]) or "<img" in cell[3] else ""
        return f'<{cell[1]}{cell[2]} data-label="{escape(next(names))}">{inside}</{cell[1]}>'

    return _CELL.sub(labelled, row)


def _text(cell: str) -> str:
    return " ".join(unescape(re.sub(r"<[^>]*>", "", cell)).split())


def _too_wide(headings: list[str], *rows: list[str]) -> bool:
    letters = [
        max(max((len(word) for word in heading.split()), default=0), *(min(len(cell), _LONG) for cell in column), 0)
        for heading, *column in zip(headings, *rows, strict=True)
    ]
    return sum(letters) + 2 * len(letters) > _TELEPHONE
