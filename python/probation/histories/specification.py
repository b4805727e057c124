"""``ramp:rate=0.005,strain=2`` to a history."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.histories.named import nearest

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.histories.named import NamedHistory


def parse_specification(text: str, known: Mapping[str, NamedHistory]) -> tuple[NamedHistory, dict[str, str]]:
    """Split ``name:key=value,key=value`` and find the name.

    Raises
    ------
    InputError
        If the name is unknown (suggesting the nearest), or a part is no ``key=value`` or is given twice.
    """
    name, _, rest = text.partition(":")
    if name not in known:
        raise InputError(f"--history: found the unknown name {name!r}; {nearest(name, known)}")
    values: dict[str, str] = {}
    for part in filter(None, rest.split(",")):
        key, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or not key or not value:
            raise InputError(f"history {name!r}: found {part!r}, expected parameter=value")
        if key in values:
            raise InputError(f"history {name!r}: found {key} twice, expected it once")
        values[key] = value
    return known[name], values


def describe(histories: Mapping[str, NamedHistory]) -> str:
    """All named histories with parameters, units and defaults, as text."""
    lines = []
    for history in histories.values():
        lines.append(f"{history.name}: {history.title}")
        for each in history.parameters:
            unit = "" if each.unit == "-" else f" {each.unit}"
            default = each.default if isinstance(each.default, str) else f"{each.default:g}"
            choices = f" ({', '.join(each.choices)})" if each.choices else ""
            lines.append(f"    {each.name + '=' + default + unit:<24}{each.meaning}{choices}")
    return "\n".join(lines)
