"""Crystals form in the stretched network."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.record_view import largest_strain_of
from probation.law.modification import Modification
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_ONSET = EffectParameter(
    name="onset_strain",
    unit="",
    lower=0.03,
    upper=2.5,
    centre=0.6,
    scale=0.7,
    log=True,
    reason="at stretches of 2 to 4 in natural rubber and polyesters, 1.6 in fibrillating polymers, 1.1 in polyethylene",
)
_GROWTH = EffectParameter(
    name="growth_strain",
    unit="",
    lower=0.05,
    upper=3.0,
    centre=0.5,
    scale=0.6,
    log=True,
    reason="crystallinity levels off within some tenths of strain",
)


def _beyond(view: RecordView, onset: float) -> FloatArray:
    """Largest strain so far beyond the onset, shape (n,): what has formed melts only well below."""
    return np.maximum(view.largest_strain - onset, 0.0)


def _filler(view: RecordView, values: Values) -> Modification:
    """G times 1 + 2.5 x + 14.1 x^2, x = a (1 - e^(-(e - e_c) / g)), e the largest strain so far.

    Crystals are spheres of the volume fraction x in a rubber: 2.5 is Einstein's (1911), of
    single spheres, 14.1 is that of pairs (Guth 1945).
    """
    part = -values[0] * np.expm1(-_beyond(view, values[1]) / values[2])
    return Modification(hardening_factor=1.0 + 2.5 * part + 14.1 * part**2)


def _carried(view: RecordView, values: Values) -> Modification:
    """A relaxed stress a (e - e_c), e the largest strain so far: crystals carry it."""
    return Modification(added_relaxed_stress=values[0] * _beyond(view, values[1]))


def _onsets(views: Sequence[RecordView]) -> list[float]:
    """Onsets at 35 and 65 % of the largest true strain: before and after the middle."""
    largest = largest_strain_of(views)
    return [_ONSET.inside(part * largest) for part in (0.35, 0.65)]


def _starts_of_filler(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """It grows over as much strain as it began at."""
    return [(onset, _GROWTH.inside(onset)) for onset in _onsets(views)]


def _starts_of_carried(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    return [(onset,) for onset in _onsets(views)]


def _stretched(views: Sequence[RecordView]) -> bool:
    return largest_strain_of(views) > EFFECTS.crystallising_strain


EFFECT = Effect(
    name="strain_induced_crystallisation",
    title="strain-induced crystallisation",
    physics=(
        "From a strain on, stretched chains crystallise: crystals stiffen the network and stay on unloading.\n"
        "Amplitude: crystallinity at large strain, or stress per strain beyond the onset."
    ),
    source=(
        "Flory 1947, J. Chem. Phys. 15, 397; Guth 1945, J. Appl. Phys. 16, 20; Toki et al. 2003, Polymer 44, 6003; "
        "Guilie, Le & Le Tallec 2015, Int. J. Solids Struct. 72, 189"
    ),
    shows_in="records reaching large strains, and their unloading",
    kind="material",
    coordinate="largest_strain",
    forms=(
        Form(
            "filler",
            (
                EffectParameter("crystallinity", "", 0.0, 0.6, 0.1, "10 to 20 % form in natural rubber"),
                _ONSET,
                _GROWTH,
            ),
            modification=_filler,
            starts=_starts_of_filler,
            needs=_stretched,
        ),
        Form(
            "carried",
            (
                EffectParameter(
                    "crystal_hardening_MPa", "MPa", 0.0, 200.0, 5.0, "a good part of a network's own stress"
                ),
                _ONSET,
            ),
            modification=_carried,
            starts=_starts_of_carried,
            needs=_stretched,
        ),
    ),
    odds=0.2,
)
