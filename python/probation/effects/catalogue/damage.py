"""Part of the section stops carrying load."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import running_integral
from probation.effects.catalogue.stress_activated_flow import REFERENCE_STRESS
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.record_view import largest_strain_of
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_NO_STRAIN = 1e-9
"""Strain over that of the middle [-] which stands for none: no area is lost there, and its power is finite."""

_LEAST_AREA = 0.02
"""Part of the area [-] that is left whatever was carried."""

_REASON = "voids and broken lamellae take some tenths of the section before failure"


def _saturating(view: RecordView, values: Values) -> Modification:
    """Area e^(-a (1 - e^(-e / e_c))), e the largest strain so far."""
    return Modification(load_bearing_area=np.exp(values[0] * np.expm1(-view.largest_strain / values[1])))


def _growing(view: RecordView, values: Values) -> Modification:
    """Area exp(-a e^n), e the largest strain so far."""
    return Modification(load_bearing_area=np.exp(-values[0] * view.largest_strain ** values[1]))


def _about_a_strain(view: RecordView, values: Values) -> Modification:
    """Area e^(-a h), h = e^m / (e^m + e_c^m) (Hill), e the largest strain so far."""
    part = np.maximum(view.largest_strain, 0.0) / values[1]
    return Modification(load_bearing_area=np.exp(-values[0] / (1.0 + np.maximum(part, _NO_STRAIN) ** -values[2])))


def _beyond_a_strain(view: RecordView, values: Values) -> Modification:
    """Area 1 - a (1 - e^(-(e - e_0) / w)) beyond a threshold e_0, e the largest strain so far (Mazars)."""
    beyond = np.maximum(view.largest_strain - values[1], 0.0)
    return Modification(load_bearing_area=1.0 + values[0] * np.expm1(-beyond / values[2]))


def _by_stress(view: RecordView, values: Values) -> Modification:
    """D' = a (|s| / (20 MPa (1 - D)))^n per strain beyond e_0 and the largest so far, s the recorded stress (Lemaitre).

    s / (1 - D) is what the area left carries. The area is the root of order n + 1 of 1 - (n + 1) a w, w the integral of
    (|s| / 20 MPa)^n.
    """
    loss, exponent, threshold = values
    power = (np.abs(view.smooth_true_data) / REFERENCE_STRESS) ** exponent
    done = running_integral(power, np.maximum(view.largest_strain, threshold))
    left = np.maximum(1.0 - (exponent + 1.0) * loss * done, _LEAST_AREA ** (exponent + 1.0))
    return Modification(load_bearing_area=left ** (1.0 / (exponent + 1.0)))


def _by_work(view: RecordView, values: Values) -> Modification:
    """Area e^(-a (1 - e^(-w / w_c))), w the work of the recorded stress per volume so far, where strain is new."""
    return Modification(load_bearing_area=np.exp(values[0] * np.expm1(-_work(view) / values[1])))


def _work(view: RecordView) -> FloatArray:
    """Of straining further than ever, shape (n,) [MPa]."""
    return running_integral(np.maximum(view.smooth_true_data, 0.0), view.largest_strain)


_LOSS = EffectParameter("area_loss", "", 0.0, 0.95, 0.2, _REASON)
_THRESHOLD = EffectParameter(
    name="threshold_strain",
    unit="",
    lower=0.001,
    upper=3.0,
    centre=0.2,
    scale=1.0,
    log=True,
    reason="nothing breaks before yield",
)
_GROWTH = EffectParameter(
    name="growth_strain",
    unit="",
    lower=0.01,
    upper=10.0,
    centre=0.3,
    scale=1.0,
    log=True,
    reason="from brittle beyond the threshold to steady growth (Lemaitre)",
)


def _thresholds(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Thresholds at 10 to 70 % of the largest true strain, with a growth over 30 % of it."""
    largest = largest_strain_of(views)
    return [(_THRESHOLD.inside(part * largest), _GROWTH.inside(0.3 * largest)) for part in (0.1, 0.3, 0.5, 0.7)]


_WORK = EffectParameter(
    name="saturation_work_MPa",
    unit="MPa",
    lower=0.05,
    upper=500.0,
    centre=10.0,
    scale=1.5,
    log=True,
    reason="work to yield is 1 MPa, to fibrils some tens",
)


def _works(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """A fifth of the largest work, and all of it."""
    largest = max(float(_work(view)[-1]) for view in views)
    return [(_WORK.inside(part * largest),) for part in (0.2, 1.0)]


EFFECT = Effect(
    name="damage",
    title="damage",
    physics=(
        "Voids and breakage take load-bearing area for good, the more the further the specimen has been strained.\n"
        "Amplitude: -ln of the area left, at large strain or after much work, or at a strain of 1 (growing); the area "
        "lost (beyond a strain); that per strain under 20 MPa (by stress)."
    ),
    source=(
        "Kachanov 1958; Lemaitre 1985, J. Eng. Mater. Technol. 107, 83; Simo & Ju 1987, Int. J. Solids Struct. 23, "
        "821 (by work); Mazars & Pijaudier-Cabot 1989, J. Eng. Mech. 115, 345; Detrez et al. 2011, Polymer 52, 1998"
    ),
    shows_in="records reaching large strains; unloading shows it best: it stays",
    kind="material",
    coordinate="largest_strain",
    forms=(
        Form(
            "saturating",
            (
                EffectParameter("log_area_loss", "", 0.0, 2.0, 0.2, _REASON),
                EffectParameter(
                    name="saturation_strain",
                    unit="",
                    lower=0.02,
                    upper=2.0,
                    centre=0.3,
                    scale=0.8,
                    log=True,
                    starts=(0.1, 0.5),
                    reason="cavitation follows yield and ends when fibrils are formed",
                ),
            ),
            modification=_saturating,
        ),
        Form(
            "growing",
            (
                EffectParameter("log_area_loss_at_strain_1", "", 0.0, 5.0, 0.2, _REASON),
                EffectParameter(
                    name="growth_exponent",
                    unit="",
                    lower=0.5,
                    upper=5.0,
                    centre=2.0,
                    scale=0.5,
                    log=True,
                    starts=(1.0, 2.5),
                    reason="between steady growth (1) and acceleration to failure",
                ),
            ),
            modification=_growing,
        ),
        Form(
            "about_a_strain",
            (
                EffectParameter("log_area_loss", "", 0.0, 2.0, 0.2, _REASON),
                EffectParameter(
                    name="middle_strain",
                    unit="",
                    lower=0.01,
                    upper=3.0,
                    centre=0.4,
                    scale=0.8,
                    log=True,
                    starts=(0.15, 0.5),
                    reason="voids open about a strain: at yield, where fibrils form, or before failure",
                ),
                EffectParameter(
                    name="abruptness",
                    unit="",
                    lower=1.5,
                    upper=12.0,
                    centre=4.0,
                    scale=0.5,
                    log=True,
                    starts=(4.0,),
                    reason="nine tenths of it within a factor of three to ten of the strain",
                ),
            ),
            modification=_about_a_strain,
        ),
        Form(
            "beyond_a_strain",
            (_LOSS, _THRESHOLD, _GROWTH),
            modification=_beyond_a_strain,
            starts=_thresholds,
            variant=True,
        ),
        Form(
            "by_work",
            (EffectParameter("log_area_loss", "", 0.0, 2.0, 0.2, _REASON), _WORK),
            modification=_by_work,
            starts=_works,
            variant=True,
        ),
        Form(
            "by_stress",
            (
                EffectParameter(
                    "area_loss_per_strain_at_20MPa", "", 0.0, 1.0, 0.003, "a tenth of the area per strain under 115 MPa"
                ),
                EffectParameter(
                    name="stress_exponent",
                    unit="",
                    lower=0.5,
                    upper=10.0,
                    centre=2.0,
                    scale=0.5,
                    log=True,
                    reason="2: the energy that is set free (Lemaitre)",
                ),
                replace(_THRESHOLD, centre=0.05, upper=1.0),
            ),
            modification=_by_stress,
            variant=True,
        ),
    ),
)
