"""Histories for those who have no file: a name and a few numbers.

A new one is a `NamedHistory` in `kinds.py`.
"""

from __future__ import annotations

from probation.errors import InputError
from probation.histories.imposed import ImposedHistory
from probation.histories.kinds import KINDS
from probation.histories.named import NamedHistory, Parameter, Value, nearest

NAMED_HISTORIES: dict[str, NamedHistory] = {history.name: history for history in KINDS}

__all__ = [
    "NAMED_HISTORIES",
    "ImposedHistory",
    "NamedHistory",
    "Parameter",
    "history_from",
    "list_histories",
    "named_history",
]


def named_history(name: str, /, **parameters: Value) -> ImposedHistory:
    """A history by name.

    Parameters
    ----------
    name : str
        A key of `NAMED_HISTORIES`.
    parameters
        As the history of that name lists them; those left out take their defaults.

    Raises
    ------
    InputError
        For an unknown name or parameter (suggesting the nearest), or an impossible value.

    Examples
    --------
    >>> named_history("ramp", rate=0.01, strain=1.0).time[-1]
    100.0
    """
    if name not in NAMED_HISTORIES:
        raise InputError(f"found no history named {name!r}; {nearest(name, NAMED_HISTORIES)}")
    return NAMED_HISTORIES[name](parameters)


def history_from(specification: str) -> ImposedHistory:
    """A history from text such as ``ramp:rate=0.005,strain=2``.

    Raises
    ------
    InputError
        As in `named_history`, or if a part is no ``key=value`` or is given twice.
    """
    name, _, rest = specification.partition(":")
    if name not in NAMED_HISTORIES:
        raise InputError(f"--history: found the unknown name {name!r}; {nearest(name, NAMED_HISTORIES)}")
    values: dict[str, str] = {}
    for part in filter(None, rest.split(",")):
        key, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or not key or not value:
            raise InputError(f"history {name!r}: found {part!r}, expected parameter=value")
        if key in values:
            raise InputError(f"history {name!r}: found {key} twice, expected it once")
        values[key] = value
    return NAMED_HISTORIES[name](values)


def list_histories() -> str:
    """Names, parameters, units and defaults, as text."""
    lines = []
    for history in NAMED_HISTORIES.values():
        lines.append(f"{history.name}: {history.title}")
        for parameter in history.parameters:
            unit = "" if parameter.unit == "-" else f" {parameter.unit}"
            default = parameter.default if isinstance(parameter.default, str) else f"{parameter.default:g}"
            choices = f" ({', '.join(parameter.choices)})" if parameter.choices else ""
            lines.append(f"    {parameter.name + '=' + default + unit:<24}{parameter.meaning}{choices}")
    return "\n".join(lines)
