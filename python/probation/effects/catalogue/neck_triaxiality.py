"""In a neck the mean axial stress is more than the flow stress."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Placement
    from probation.effects.record_view import RecordView

_ONSET = EffectParameter(
    name="neck_strain",
    unit="",
    lower=0.0,
    upper=1.0,
    centre=0.1,
    scale=0.1,
    starts=(0.05, 0.2),
    reason="a neck begins where the force is largest (Considere)",
)

_EVERYWHERE: tuple[Placement, ...] = ("all",)
"""Whether a section necks follows from the material (Considere): one record alone does not, where others go as far."""


def _bridgman(ratio: FloatArray) -> FloatArray:
    """(1 + 2 / q) ln(1 + q / 2): mean axial over flow stress at a ratio q of the neck's radius to its curvature's."""
    q = np.maximum(ratio, 1e-6)
    return np.where(ratio > 1e-6, (1.0 + 2.0 / q) * np.log1p(0.5 * q), 1.0 + 0.25 * ratio)


def _growing(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Stress times (1 + 2/q) ln(1 + q/2), q = a (e - e_n), e the largest strain so far."""
    return stress * _bridgman(values[0] * np.maximum(view.largest_strain - values[1], 0.0))


def _passing(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Stress times (1 + 2/q) ln(1 + q/2), q = a x e^(1 - x), x = (e - e_n) / w: the shoulder passes the section."""
    x = np.maximum(view.largest_strain - values[1], 0.0) / values[2]
    return stress * _bridgman(values[0] * x * np.exp(1.0 - x))


def _necks(views: Sequence[RecordView]) -> bool:
    """Whether the rate surges anywhere under grips at one speed, or a section was strained beyond yield.

    The rate of the true strain, or that of the elongation, which stays at one speed where nothing necks: in a section
    that is in the neck from yield on, the former grows little.

    A machine that keeps the strain rate does so in the section that is measured, and that one is in a neck where the
    specimen necks (G'Sell et al. 1992): its rate tells nothing of it.
    """
    for view in views:
        if view.control == "displacement-rate":
            if any(
                float(np.max(rate)) > EFFECTS.necking_rate_ratio * float(np.median(rate))
                for rate in (view.rate, view.rate * view.stretch)
            ):
                return True
        elif float(np.max(view.largest_strain)) > EFFECTS.necking_strain:
            return True
    return False


EFFECT = Effect(
    name="neck_triaxiality",
    title="triaxiality of a neck",
    physics=(
        "In a neck the lateral surface is curved, and the mean axial stress is above the stress that makes it flow.\n"
        "Amplitude: radius of the section over that of the neck's outline, per strain or where it is largest."
    ),
    source=(
        "Bridgman 1952, Studies in Large Plastic Flow and Fracture; Le Roy, Embury, Edwards & Ashby 1981, Acta Metall. "
        "29, 1509; G'Sell, Hiver, Dahoun & Souahi 1992, J. Mater. Sci. 27, 5031"
    ),
    shows_in="records of a section that necks",
    kind="rig",
    forms=(
        Form(
            "growing",
            (
                EffectParameter(
                    "radius_ratio_per_strain", "", 0.0, 3.0, 0.5, "1.1 in round bars of steel (Le Roy et al.)"
                ),
                _ONSET,
            ),
            recorded_stress=_growing,
            placements=_EVERYWHERE,
            needs=_necks,
        ),
        Form(
            "passing",
            (
                EffectParameter("largest_radius_ratio", "", 0.0, 3.0, 0.3, "some tenths in necks of polymers"),
                _ONSET,
                EffectParameter(
                    name="passing_strain",
                    unit="",
                    lower=0.03,
                    upper=1.5,
                    centre=0.25,
                    scale=0.6,
                    log=True,
                    starts=(0.15, 0.4),
                    reason="the shoulder passes within some tenths of strain",
                ),
            ),
            recorded_stress=_passing,
            placements=_EVERYWHERE,
            needs=_necks,
        ),
    ),
    odds=0.2,
)
