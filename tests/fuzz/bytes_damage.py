"""Damage below the format: cut, flipped, lost, doubled and foreign bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

_FOREIGN = (
    b"\x00", b"\xff\xfe", b"\xef\xbb\xbf", b"\x1f\x8b", b"PK\x03\x04", b"\x80", b"\r", b"\n\n", b"\x1a",
    b"\xed\xa0\x80",
)  # fmt: skip


def damaged(data: bytes, chance: Random) -> bytes:
    """One damage, somewhere."""
    if not data:
        return data
    at = chance.randrange(len(data))
    until = min(len(data), at + chance.choice((1, 2, 10, 100, 1000)))
    return chance.choice(_DAMAGES)(data, at, until, chance)


_DAMAGES: tuple[Callable[[bytes, int, int, Random], bytes], ...] = (
    lambda data, at, _, __: data[:at],
    lambda data, at, _, chance: data[:at] + bytes([data[at] ^ (1 << chance.randrange(8))]) + data[at + 1 :],
    lambda data, at, _, chance: data[:at] + bytes([data[at] ^ (1 << chance.randrange(8))]) + data[at + 1 :],
    lambda data, at, _, chance: data[:at] + bytes([chance.randrange(256)]) + data[at + 1 :],
    lambda data, at, until, _: data[:at] + data[until:],
    lambda data, at, until, _: data[:until] + data[at:until] + data[until:],
    lambda data, at, _, chance: data[:at] + chance.choice(_FOREIGN) + data[at:],
    lambda data, at, until, _: data[:at] + bytes(until - at) + data[until:],
    lambda data, at, until, _: data[:at] + data[until:] + data[at:until],
)
"""Cut, a flipped bit (twice as often), another byte, bytes lost, doubled, foreign, zeroed, moved to the end."""
