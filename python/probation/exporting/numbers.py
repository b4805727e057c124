"""Numbers as the fields of a card hold them."""

from __future__ import annotations

from probation.errors import InputError


def within(value: float, width: int) -> str:
    """The most precise text of a number that has no more than `width` characters and a decimal point.

    Raises
    ------
    InputError
        If no text of that width holds it.
    """
    texts = [text for digits in range(17, 0, -1) for text in _texts(value, digits) if len(text) <= width]
    if not texts:
        raise InputError(f"number: found {value!r}, expected one that fits into {width} characters")
    return min(texts, key=lambda text: (abs(float(text) - value), len(text)))


def field(value: float, width: int) -> str:
    """That text, to the right of its columns, one of which stays blank."""
    return within(value, width - 1).rjust(width)


def _texts(value: float, digits: int) -> list[str]:
    plain = f"{value:.{digits}g}"
    if "e" not in plain:
        return [plain if "." in plain else f"{plain}."]
    mantissa, _, exponent = plain.partition("e")
    mantissa = mantissa if "." in mantissa else f"{mantissa}."
    return [f"{mantissa}E{int(exponent)}"]
