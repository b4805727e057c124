"""The recorded strain includes the frame's own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_COMPLIANCE = EffectParameter(
    name="compliance_per_MPa",
    unit="1/MPa",
    lower=0.0,
    upper=2e-3,
    scale=1e-4,
    reason="A_0 / (stiffness x gauge length): 24 mm^2, 1e4 N/mm, 30 mm give 8e-5",
)


REFERENCE_STRESS = 10.0
"""Nominal stress at which a frame that is not linear has the compliance of its amplitude [MPa]."""

_LINEAR = 2e-3
"""Part of the largest force below which gross contacts are linear, as clamped ones are."""

_POWER = EffectParameter(
    name="power_of_the_force",
    unit="",
    lower=0.2,
    upper=3.0,
    centre=1.0,
    scale=0.4,
    log=True,
    starts=(0.6, 1.6),
    reason="Hertz's contacts have 2/3, a linear frame 1; grips that slide have more",
)


def _crosshead(view: RecordView, values: Values) -> FloatArray:
    """The frame gives way by a F / A_0 per gauge length, which is engineering strain.

    A stress that was made with the recorded strain is converted with it: `Form.converts`, `inference/model.py`.
    """
    own = values[0] * view.nominal_data / np.exp(view.true_strain)
    return view.true_strain + np.log1p(-np.minimum(own, 0.9))


def _contact(view: RecordView, values: Values) -> FloatArray:
    """Small, so that it may go with the recorded force, which is smoothed: its noise is no strain."""
    return _closing(view, values, view.smooth_nominal_data, 1e-12)


def gross_contact(view: RecordView, values: Values) -> FloatArray:
    """The same under the force that the view has: a smooth one is too far from it where contacts take much.

    Below `_LINEAR` of the largest force they are linear: else none that is at rest would have a stiffness.
    """
    return _closing(
        view, values, view.nominal_data, _LINEAR * float(np.max(np.abs(view.data / view.sampled(view.stretch))))
    )


def _closing(view: RecordView, values: Values, stress: FloatArray, linear: float) -> FloatArray:
    """The frame gives way by a n (n / 10 MPa)^(b - 1), n the nominal stress: joints close (b < 1), grips yield."""
    own = values[0] * stress * (np.maximum(np.abs(stress), linear) / REFERENCE_STRESS) ** (values[1] - 1.0)
    return np.asarray(view.true_strain + np.log1p(-np.clip(own / np.exp(view.true_strain), -0.9, 0.9)))


def _true_strain(view: RecordView, values: Values) -> FloatArray:
    """For a true stress that was not made from this strain; the compliance is then a true strain per nominal stress.

    The values of the two forms differ by the stretch. Gross compliances: `effects/large_forms.py`.
    """
    return view.true_strain - values[0] * view.nominal_data


EFFECT = Effect(
    name="machine_compliance",
    title="compliance of the machine",
    physics=(
        "Frame, grips and load cell stretch too; where the crosshead gives the strain, theirs is counted in.\n"
        "Amplitude: strain per nominal stress F / A_0, which has the recorded force."
    ),
    source="ASTM D5656 / ISO 527-1 (compliance correction); Hertz 1881; Kalidindi et al. 1997 (frames that stiffen)",
    shows_in="stiff materials: the onset, rate jumps, reversals; dwells show it as creep of the specimen",
    kind="rig",
    coordinate="force",
    forms=(
        Form("crosshead", (_COMPLIANCE,), driving_strain=_crosshead),
        Form("true_strain", (_COMPLIANCE,), driving_strain=_true_strain, converts=False),
        Form("contact", (_COMPLIANCE, _POWER), driving_strain=_contact, variant=True),
    ),
)
