"""The effects that a diagnosis knows: the catalogue's own and those a user registers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation._complaint import suggestion
from probation.effects.catalogue import load_effects
from probation.effects.effect import Effect
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable

_CATALOGUE: dict[str, Effect] = {effect.name: effect for effect in load_effects()}


def register(effect: Effect, *, replace: bool = False) -> Effect:
    """Add an effect to those that a diagnosis considers.

    Parameters
    ----------
    replace : bool
        Whether it may take the place of one of the same name.

    Raises
    ------
    InputError
        If it is no Effect, or the name is taken.
    """
    if not isinstance(effect, Effect):
        raise InputError(f"register: found {effect!r}, expected an Effect")
    if effect.name in _CATALOGUE and not replace:
        raise InputError(f"register: found {effect.name!r} in the catalogue already; say replace=True to replace it")
    _CATALOGUE[effect.name] = effect
    return effect


def unregister(name: str) -> None:
    """Take an effect out of those that a diagnosis considers; errors as in `effect`."""
    del _CATALOGUE[effect(name).name]


def effect(name: str) -> Effect:
    """The effect of that name.

    Raises
    ------
    InputError
        If there is none, suggesting the nearest.
    """
    if name not in _CATALOGUE:
        raise InputError(f"found no effect named {name!r}; {suggestion(name, _CATALOGUE)}")
    return _CATALOGUE[name]


def effects(names: Iterable[str] | None = None) -> tuple[Effect, ...]:
    """All effects in order of registration, or those named; errors as in `effect`."""
    return tuple(_CATALOGUE.values()) if names is None else tuple(effect(name) for name in names)
