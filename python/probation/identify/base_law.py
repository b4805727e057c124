"""The campaign's law before anything is identified."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.parameter import by_inside_name, outside_name
from probation.law.companion import from_settings
from probation.law.modal import Law
from probation.law.spectrum import spectrum_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.law.settings import LawSettings

START = {"unrelaxed_modulus": 1000.0, "tau_max": 1.0, "alpha": 1.0, "hardening_modulus": 1.0}
"""Placeholders: variable projection needs no start."""


def base_law(settings: LawSettings, hold: Mapping[str, float]) -> tuple[Law, tuple[str, ...]]:
    """The campaign's law, with placeholders for what is not held, and the names of what is."""
    companion = from_settings(settings.companion)
    names = ("unrelaxed_modulus", "tau_max" if companion is None else "alpha", "hardening_modulus")
    values = {name: START[name] for name in names}
    fixed = {**settings.fixed, **hold}
    values.update((name, float(value)) for name, value in by_inside_name(fixed, names, "hold").items())
    law = Law(
        unrelaxed_modulus=values["unrelaxed_modulus"],
        hardening_modulus=values["hardening_modulus"],
        tau_max=values.get("tau_max"),
        alpha=values.get("alpha"),
        decades=settings.decades,
        companion=companion,
        spectrum=spectrum_of(settings.modes, settings.decades, settings.accuracy),
    )
    return law, tuple(name for name in names if outside_name(name) in fixed)
