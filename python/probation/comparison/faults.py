"""What may have changed between two campaigns: faults of the rig that are new, and the material itself.

A fault of one sign (slack, compliance, hysteresis) that has gone is found by exchanging the campaigns.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation._complaint import suggestion
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.registry import effects
from probation.errors import InputError
from probation.law.modification import Modification
from probation.settings.comparison import COMPARISON

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation.effects.record_view import RecordView


def _other_material(view: RecordView, values: Values) -> Modification:
    """Other constants of the base law."""
    modulus, time, hardening = (np.full(1, np.exp(value)) for value in values)
    return Modification(unrelaxed_modulus_factor=modulus, relaxation_time_factor=time, hardening_factor=hardening)


def _logarithm(name: str) -> EffectParameter:
    return EffectParameter(
        f"ln_{name}_ratio", "", -1.0, 1.0, COMPARISON.batch_spread, "batches differ by some per cent, rarely by tens"
    )


MATERIAL = Effect(
    name="material_change",
    title="another material",
    physics=(
        "The constants of the base law are others: another batch, another age, another temperature of the room.\n"
        "Parameters: logarithm of each constant over the reference's."
    ),
    source="ISO 527-1, section 10 (number of test specimens)",
    shows_in="every record",
    kind="rig",  # its form is the law's own, and known as well as that of a fault of the rig
    forms=(
        Form(
            "constants",
            (_logarithm("unrelaxed_modulus"), _logarithm("relaxation_time"), _logarithm("hardening_modulus")),
            modification=_other_material,
            placements=("all",),
        ),
    ),
)


LEFT_OUT = ("temperature_drift", "volume_change", "neck_triaxiality", "slack_strip", "force_saturation")


def considered(names: Iterable[str] | None = None) -> tuple[Effect, ...]:
    """What a change is explained by: the catalogue's faults of the rig, and another material.

    Left out are waves, steps and plateaus, which a diagnosis finds in either campaign by itself; the growth of the
    volume, the triaxiality of a neck and a strip that goes slack, since both campaigns have these alike; and the
    temperature, which is another material to a comparison.

    Parameters
    ----------
    names : iterable of str, optional
        Only these.

    Raises
    ------
    InputError
        For a name that is none of them, suggesting the nearest.
    """
    rig = [effect for effect in effects() if effect.kind == "rig" and effect.name not in LEFT_OUT]
    smooth = [
        replace(effect, forms=tuple(form for form in effect.forms if form.sharp is None))
        for effect in rig
        if effect.forms[0].sharp is None
    ]
    known = {effect.name: effect for effect in (*smooth, MATERIAL)}
    if names is None:
        return tuple(known.values())
    for name in (chosen := list(names)):
        if name not in known:
            raise InputError(f"found no change named {name!r}; {suggestion(name, known)}")
    return tuple(known[name] for name in chosen)
