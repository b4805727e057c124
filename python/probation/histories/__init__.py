"""Histories for those who have no file: a name and a few numbers.

A new one is a `NamedHistory` in the module of its kind and one line in `NAMED_HISTORIES`.
"""

from __future__ import annotations

from probation.errors import InputError
from probation.histories import cycles, grips, holds, ramps
from probation.histories.imposed import ImposedHistory
from probation.histories.named import NamedHistory, Parameter, Value, nearest
from probation.histories.specification import describe, parse_specification

NAMED_HISTORIES: dict[str, NamedHistory] = {
    history.name: history
    for history in (
        ramps.RAMP,
        ramps.RATE_JUMP,
        holds.RELAXATION,
        cycles.LOAD_UNLOAD,
        cycles.CYCLIC,
        grips.NECKING,
        holds.CREEP,
    )
}

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
    """A history from text such as ``ramp:rate=0.005,strain=2``; errors as in `named_history`."""
    history, values = parse_specification(specification, NAMED_HISTORIES)
    return history(values)


def list_histories() -> str:
    """Names, parameters, units and defaults, as text."""
    return describe(NAMED_HISTORIES)
