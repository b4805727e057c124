"""Relaxation times fall with stress."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification, PowerActivation, StressActivation

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView

REFERENCE_STRESS = 20.0
"""Stress at which the amplitude is meant [MPa]: the yield stress of polyolefins, roughly."""

_AMPLITUDE = EffectParameter(
    name="flow_gain_at_20MPa",
    unit="",
    lower=0.0,
    upper=10.0,
    scale=0.3,
    reason="an activation stress kT/V* of about 15 MPa (V* of 0.3 nm^3); 10 is 2.6 MPa",
)
_POWER = EffectParameter(
    name="stress_exponent",
    unit="",
    lower=1.0,
    upper=8.0,
    centre=2.0,
    scale=0.4,
    log=True,
    starts=(2.0, 4.0),
    reason="2 is Eyring's beginning; 3 to 6 fit creep of polyolefins",
)
_NETWORK = EffectParameter(
    name="network_hardening_MPa",
    unit="MPa",
    lower=0.0,
    upper=20.0,
    centre=2.0,
    scale=2.0,
    starts=(2.0,),
    reason="G, some MPa in polyethylene",
)


def _eyring(view: RecordView, values: Values) -> Modification | None:
    """tau_max (s / s0) / sinh(s / s0) with a = (20 MPa / s0)^2 / 6, linear in a at first."""
    if values[0] <= 0.0:
        return None
    return Modification(feedbacks=(StressActivation(REFERENCE_STRESS / float(np.sqrt(6.0 * values[0]))),))


def _power(view: RecordView, values: Values) -> Modification | None:
    """tau_max over 1 + a (|s| / 20 MPa)^m."""
    if values[0] <= 0.0:
        return None
    activation = REFERENCE_STRESS * float(np.exp(-np.log(values[0]) / values[1]))
    return Modification(feedbacks=(PowerActivation(activation, values[1]),))


def _beyond_the_network(view: RecordView, values: Values) -> Modification:
    """tau_max over 1 + a (|s - h e_HT| / 20 MPa)^m: the stress that drives flow is less by the network's.

    s is the recorded true stress, smoothed.
    """
    gain, exponent, hardening = values
    driving = np.abs(view.smooth_true_data - hardening * view.haward_thackray_strain) / REFERENCE_STRESS
    return Modification(relaxation_time_factor=1.0 / (1.0 + gain * driving**exponent))


EFFECT = Effect(
    name="stress_activated_flow",
    title="stress-activated flow",
    physics=(
        "Stress lowers the barriers to flow, so that all relaxation times fall where the stress is high.\n"
        "Amplitude: first-order gain of the rate of flow at 20 MPa; s0 = 20 MPa / sqrt(6 a) in Eyring's sinh; "
        "beyond the network, of the stress that it does not carry."
    ),
    source=(
        "Eyring 1936, J. Chem. Phys. 4, 283; Klompen et al. 2005, Macromolecules 38, 6997; Norton 1929; "
        "Fotheringham & Cherry 1978, J. Mater. Sci. 13, 951 (beyond the network)"
    ),
    shows_in="records whose stress covers a wide range: large strains, several rates, dwells",
    kind="material",
    coordinate="stress",
    forms=(
        Form("eyring", (_AMPLITUDE,), modification=_eyring),
        Form("power", (_AMPLITUDE, _POWER), modification=_power),
        Form(
            "beyond_the_network",
            (_AMPLITUDE, _POWER, _NETWORK),
            modification=_beyond_the_network,
            variant=True,
        ),
    ),
)
