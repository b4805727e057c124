"""What may have changed between two campaigns: faults of the rig, come or gone, and the material itself."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation._complaint import suggestion
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.large_faults import crosshead_slack
from probation.effects.registry import effects
from probation.effects.visible import visible
from probation.errors import InputError
from probation.law.modification import Modification
from probation.settings.comparison import COMPARISON

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

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
    kind="material",
    forms=(
        Form(
            "constants",
            (_logarithm("unrelaxed_modulus"), _logarithm("relaxation_time"), _logarithm("hardening_modulus")),
            modification=_other_material,
        ),
    ),
)


def _sized(form: Form, scale: float, *, bounded: bool = False) -> Form:
    """The same form with another prior of its amplitude, of either sign if `bounded`."""
    known = form.amplitude
    low, high = (-COMPARISON.widest * scale, COMPARISON.widest * scale) if bounded else (known.lower, known.upper)
    amplitude = replace(known, lower=low, upper=high, scale=min(scale, max(-low, high)), starts=())
    return replace(form, parameters=(amplitude, *form.parameters[1:]))


def _as_a_change(known: Effect, force: float, elongation: float, duration: float) -> Effect:
    """A fault of the rig as it may come, or go, between two campaigns of that largest nominal stress and elongation."""
    forms = {form.name: form for form in known.forms}
    if known.name == "machine_compliance":
        forms = {
            "crosshead": _sized(known.form("crosshead"), COMPARISON.travel_fault * elongation / force, bounded=True)
        }
    elif known.name == "force_drift":
        # Within one record both forms are the same.
        over_record = _sized(known.form("over_record"), COMPARISON.force_fault * force, bounded=True)
        in_time = _sized(known.form("in_time"), COMPARISON.force_fault * force / duration, bounded=True)
        forms = {"over_record": replace(over_record, placements=("one",)), "in_time": in_time}
    elif known.name in ("force_offset", "prestress"):
        forms = {name: _sized(form, COMPARISON.force_fault * force, bounded=True) for name, form in forms.items()}
    else:
        forms = {name: _sized(form, COMPARISON.wider_priors * form.amplitude.scale) for name, form in forms.items()}
    if known.name == "strain_offset":
        # What the crosshead travels in vain is an elongation, and so is not quite a constant true strain.
        forms["slack"] = replace(forms["slack"], driving_strain=crosshead_slack)
    return replace(known, forms=tuple(forms.values()))


def considered(views: Sequence[RecordView], names: Iterable[str] | None = None) -> tuple[Effect, ...]:
    """What a change is explained by: the catalogue's faults of the rig, and another material.

    Left out are waves, steps and plateaus, which a diagnosis finds in either campaign by itself; the growth of the
    volume, the triaxiality of a neck and a strip that goes slack, since both campaigns have these alike; and the
    temperature, which is another material to a comparison.

    Parameters
    ----------
    views : sequence of RecordView
        Of the records: faults are as large as these make them.
    names : iterable of str, optional
        Only these.

    Raises
    ------
    InputError
        For a name that is none of them, suggesting the nearest.
    """
    force = max(float(np.max(np.abs(view.data / view.sampled(view.stretch)))) for view in views)
    elongation = max(float(np.max(np.abs(np.expm1(view.true_strain)))) for view in views)
    duration = max(view.duration for view in views)
    left_out = {"temperature_drift", "volume_change", "neck_triaxiality", "slack_strip", "force_saturation"}
    rig = (each for each in visible(effects(), views) if each.kind == "rig" and each.name not in left_out)
    sized = [
        _as_a_change(each, force, elongation, duration)
        for each in rig
        if all(form.sharp is None for form in each.forms)
    ]
    known = {each.name: each for each in (*sized, MATERIAL)}
    if names is None:
        return tuple(known.values())
    for name in (chosen := list(names)):
        if name not in known:
            raise InputError(f"found no change named {name!r}; {suggestion(name, known)}")
    return tuple(known[name] for name in chosen)
