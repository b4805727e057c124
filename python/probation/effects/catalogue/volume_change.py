"""True stress was made with constant volume, and the volume grew."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_REASON = "volume strains of 0.1 to 0.3 at a strain of 1 are measured in polyethylene"


def _steady(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The section is e^(a e) times larger than assumed, and so the recorded true stress is too high by that."""
    return stress * np.exp(values[0] * view.true_strain)


def _from_onset(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same, from an onset strain on."""
    return stress * np.exp(values[0] * np.maximum(view.true_strain - values[1], 0.0))


EFFECT = Effect(
    name="volume_change",
    title="change of volume",
    physics=(
        "Voids make the section larger than constant volume says: the true stress is overstated.\n"
        "Amplitude: volume strain per true strain."
    ),
    source="Farge et al. 2015, J. Polym. Sci. B 53, 1470; Bucknall & Clayton 1972",
    shows_in="records reaching large strains; it goes back on unloading",
    kind="rig",
    forms=(
        Form(
            "steady",
            (EffectParameter("volume_per_strain", "", 0.0, 1.0, 0.1, _REASON),),
            recorded_stress=_steady,
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
        ),
    ),
)
