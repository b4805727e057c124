"""True stress was made with constant volume, and the volume grew."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.visible_volume import section_measured, volume_changes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Placement
    from probation.effects.record_view import RecordView

_EVERYWHERE: tuple[Placement, ...] = ("all",)
"""The material's volume changes in every record that goes as far, not in one alone."""

_REASON = "volume strains of 0.1 to 0.3 at a strain of 1 are measured in polyethylene"


def _steady(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The section is e^(a e) times larger than assumed, and so the recorded true stress is too high by that."""
    return stress * np.exp(values[0] * view.true_strain)


def _from_onset(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same, from an onset strain on."""
    return stress * np.exp(values[0] * np.maximum(view.true_strain - values[1], 0.0))


def _opening(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Voids open over a range of strains about e_c and stay: the volume strain is a (1 - exp(-(e_m / e_c)^2)).

    e_m is the largest strain so far.
    """
    return np.asarray(stress * np.exp(-values[0] * np.expm1(-((view.largest_strain / values[1]) ** 2))))


def _levelling_off(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Voids open from an onset on, ever fewer, and stay: the volume strain is a (1 - exp(-(e_m - e_0) / w))."""
    beyond = np.maximum(view.largest_strain - values[1], 0.0)
    return np.asarray(stress * np.exp(-values[0] * np.expm1(-beyond / values[2])))


def _as_measured(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The true stress overlooks the part a of the measured volume strain."""
    return stress if view.volume_strain is None else stress * np.exp(values[0] * view.volume_strain)


def _not_all_measured(views: Sequence[RecordView]) -> bool:
    return not section_measured(views)


EFFECT = Effect(
    name="volume_change",
    title="change of volume",
    physics=(
        "Voids make the section larger than constant volume says: the true stress is overstated.\n"
        "Amplitude: volume strain per true strain, or in the end; where every record has its measured transverse "
        "strain, the part of the measured volume strain that the true stress overlooks."
    ),
    source=(
        "Farge et al. 2015, J. Polym. Sci. B 53, 1470; Bucknall & Clayton 1972; Weibull 1951, J. Appl. Mech. 18, 293 "
        "(one void after the other)"
    ),
    shows_in=(
        "records reaching large strains; it goes back on unloading, or voids stay; a measured transverse strain "
        "judges it"
    ),
    kind="rig",
    forms=(
        Form(
            "steady",
            (EffectParameter("volume_per_strain", "", 0.0, 1.0, 0.1, _REASON),),
            recorded_stress=_steady,
            placements=_EVERYWHERE,
            needs=_not_all_measured,
        ),
        Form(
            "from_onset",
            (
                EffectParameter("volume_per_strain", "", 0.0, 1.0, 0.1, _REASON),
                EffectParameter(
                    name="onset_strain",
                    unit="",
                    lower=0.0,
                    upper=1.5,
                    centre=0.15,
                    scale=0.3,
                    starts=(0.15, 0.6),
                    reason="cavitation begins at yield",
                ),
            ),
            recorded_stress=_from_onset,
            placements=_EVERYWHERE,
            needs=_not_all_measured,
        ),
        Form(
            "opening",
            (
                EffectParameter("volume_strain", "", 0.0, 1.0, 0.1, _REASON),
                EffectParameter(
                    name="opening_strain",
                    unit="",
                    lower=0.01,
                    upper=1.0,
                    centre=0.2,
                    scale=0.8,
                    log=True,
                    starts=(0.1, 0.3, 0.8),
                    reason="voids open around yield, one after the other",
                ),
            ),
            recorded_stress=_opening,
            placements=_EVERYWHERE,
            needs=_not_all_measured,
            variant=True,
        ),
        Form(
            "levelling_off",
            (
                EffectParameter("volume_strain", "", 0.0, 1.0, 0.1, _REASON),
                EffectParameter(
                    name="onset_strain",
                    unit="",
                    lower=0.0,
                    upper=1.5,
                    centre=0.1,
                    scale=0.2,
                    starts=(0.05, 0.3),
                    reason="cavitation begins at yield",
                ),
                EffectParameter(
                    name="levelling_strain",
                    unit="",
                    lower=0.02,
                    upper=3.0,
                    centre=0.3,
                    scale=0.8,
                    log=True,
                    reason="voids that are open grow no further once fibrils carry",
                ),
            ),
            recorded_stress=_levelling_off,
            placements=_EVERYWHERE,
            needs=_not_all_measured,
            variant=True,
        ),
        Form(
            "as_measured",
            (
                EffectParameter(
                    "overlooked_part",
                    "",
                    0.0,
                    1.5,
                    1.0,
                    "all of it where the section was taken from constant volume, nothing where it was measured",
                ),
            ),
            recorded_stress=_as_measured,
            placements=_EVERYWHERE,
            needs=volume_changes,
        ),
    ),
)
