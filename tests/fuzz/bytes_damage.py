"""Damage below the format: cut, flipped, lost, doubled and foreign bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from random import Random

_FOREIGN = (
    b"\x00",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\x1f\x8b",
    b"PK\x03\x04",
    b"\x80",
    b"\r",
    b"\n\n",
    b"\x1a",
    b"\xed\xa0\x80",
)


def damaged(data: bytes, chance: Random, *, headers_too: bool = True) -> bytes:
    """One damage. Without `headers_too` the first 16 bytes stay, which say what kind of file it is."""
    low = 0 if headers_too or len(data) < 32 else 16
    if len(data) <= low:
        return data
    at = chance.randrange(low, len(data))
    until = min(len(data), at + chance.choice((1, 2, 10, 100, 1000)))
    match chance.choice(("cut", "flip", "flip", "byte", "lose", "double", "foreign", "zeros", "swap")):
        case "cut":
            return data[:at]
        case "flip":
            return data[:at] + bytes([data[at] ^ (1 << chance.randrange(8))]) + data[at + 1 :]
        case "byte":
            return data[:at] + bytes([chance.randrange(256)]) + data[at + 1 :]
        case "lose":
            return data[:at] + data[until:]
        case "double":
            return data[:until] + data[at:until] + data[until:]
        case "foreign":
            return data[:at] + chance.choice(_FOREIGN) + data[at:]
        case "zeros":
            return data[:at] + bytes(until - at) + data[until:]
    other = chance.randrange(low, len(data))
    first, second = sorted((at, other))
    return data[:first] + data[second:] + data[first:second]
