"""What a cell of a table holds: a number with either decimal mark, a time of day, or text."""

import re
from collections.abc import Sequence

_MANTISSA = r"(\d+([.,]\d*)?|[.,]\d+|\d{1,3}(\.\d{3})+,\d+|\d{1,3}(,\d{3})+\.\d+)"
_NUMBER = re.compile(rf"[+-]?{_MANTISSA}([eE][+-]?\d+)?|[+-]?(nan|inf|infinity)", re.IGNORECASE)
_GROUPED = {  # thousands set apart: certain only where the decimal mark follows
    ".": re.compile(r"[+-]?\d{1,3}(,\d{3})+\.\d+"),
    ",": re.compile(r"[+-]?\d{1,3}(\.\d{3})+,\d+"),
}
_WITH_COMMA = re.compile(r"^[^\S\n]*[+-]?(\d*|\d{1,3}(\.\d{3})+),\d+([eE][+-]?\d+)?[^\S\n]*$", re.MULTILINE)
_WITH_POINT = re.compile(r"^[^\S\n]*[+-]?(\d*|\d{1,3}(,\d{3})+)\.\d+([eE][+-]?\d+)?[^\S\n]*$", re.MULTILINE)
_TIME_OF_DAY = re.compile(r"(?:\d{4}-\d{2}-\d{2}[T ])?(\d{1,2}):([0-5]\d):([0-5]\d(?:[.,]\d+)?)")


def is_number(cell: str) -> bool:
    """Tell whether a cell is meant as a number, NaN and decimal commas included."""
    return _NUMBER.fullmatch(cell.strip()) is not None


def is_sample(cell: str) -> bool:
    """Tell whether a cell is meant as a number or as the time of day of a sample."""
    return is_number(cell) or seconds_of_day(cell) is not None


def decimal_mark(rows: Sequence[Sequence[str]]) -> str:
    """Find the decimal mark of the cells: the comma only where no cell uses the point."""
    cells = "\n".join("\n".join(row) for row in rows)
    return "," if _WITH_COMMA.search(cells) and not _WITH_POINT.search(cells) else "."


def with_point(text: str, decimal: str) -> str:
    """A number with a decimal point and without what sets thousands apart.

    >>> with_point("1.036,25", ","), with_point("1,036.25", "."), with_point("0,5", ",")
    ('1036.25', '1036.25', '0.5')
    """
    if _GROUPED[decimal].fullmatch(text):
        text = text.replace("." if decimal == "," else ",", "")
    return text.replace(",", ".") if decimal == "," else text


def seconds_of_day(cell: str) -> float | None:
    """The seconds since midnight of ``10:33:21.40``, with or without a date before it; None of anything else.

    >>> seconds_of_day("00:01:05,5"), seconds_of_day("2024-03-12 00:00:02"), seconds_of_day("12:30")
    (65.5, 2.0, None)
    """
    match = _TIME_OF_DAY.fullmatch(cell.strip())
    if match is None:
        return None
    return 3600.0 * int(match[1]) + 60.0 * int(match[2]) + float(match[3].replace(",", "."))
