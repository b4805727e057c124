"""What shifts the relaxation times: rate, stress, heat, age, the room."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq

from probation_studies.blind.laboratory.material import REFERENCE_TEMPERATURE, SOFTENING, Activation, Heating
from probation_studies.blind.laboratory.trial import Cause, on_steps

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial

_DIFFUSIVITY = 1.5e-7  # m^2/s, of polymers
_HARDENING_LOSS = 0.005  # 1/K


def _bounded(trial: Trial, amplitude: float, shape: Shape) -> None:
    """A power of the rate that levels off on both sides: w tanh(ln(r / r_ref) / w)."""
    width = shape["width"]
    trial.log_factor -= amplitude * width * np.tanh(trial.log_rate / width)


def _carreau(trial: Trial, amplitude: float, shape: Shape) -> None:
    """No shift below a critical rate, a power above it: (1 + (r / r_c)^2)^(-a / 2)."""
    trial.log_factor -= 0.5 * amplitude * np.log1p((trial.rate / shape["critical_rate_per_s"]) ** 2)


def _tobolsky(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Ln of the gain: a (sqrt(1 + (s / s_1)^2) - 1) over its value at 20 MPa."""
    at_20 = np.sqrt(1.0 + (20.0 / shape["stress_MPa"]) ** 2) - 1.0
    trial.activation = Activation(gain=amplitude / at_20, stress=shape["stress_MPa"])


def _ree_eyring(trial: Trial, amplitude: float, shape: Shape) -> None:
    """A share of flow units follows cosh(s / s_1) - 1, the others do not care; gain a at 20 MPa."""
    at_20 = np.cosh(20.0 / shape["stress_MPa"]) - 1.0
    trial.activation = Activation(share=amplitude / at_20, share_stress=shape["stress_MPa"])


def _slab(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Heat equation across the thickness with convection: the eigenmodes of a slab, beta tan beta = Biot number."""
    biot = shape["biot_number"]
    roots = [brentq(lambda b: b * np.sin(b) - biot * np.cos(b), k * np.pi, (k + 0.5) * np.pi) for k in range(3)]
    beta = np.array(roots)
    weight = 2.0 * biot**2 / (beta**2 * (beta**2 + biot**2 + biot))
    rate = _DIFFUSIVITY / (1e-3 * shape["half_thickness_mm"]) ** 2 * beta**2
    trial.heating = Heating(amplitude, tuple(rate), tuple(weight), shape["hardening_loss_per_K"])


def _age(trial: Trial, shape: Shape) -> FloatArray:
    """Lost around a strain, once: (1 + (e / e_s)^2)^(-m)."""
    return np.asarray((1.0 + (trial.largest / shape["strain"]) ** 2) ** -shape["sharpness"])


def _rejuvenation(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Age of the relaxation times."""
    trial.log_factor += amplitude * on_steps(_age(trial, shape))


def _stiff_rejuvenation(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Age of the modulus."""
    trial.modulus_factor *= np.exp(amplitude * on_steps(_age(trial, shape)))


def _warmed(trial: Trial, rise: FloatArray) -> None:
    """Arrhenius for the times, a straight fall for the network."""
    trial.log_factor -= on_steps(SOFTENING * rise / (1.0 + rise / REFERENCE_TEMPERATURE))
    trial.network_factor *= 1.0 - _HARDENING_LOSS * rise


def _room_within(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The heating of the room was switched on: a first-order approach that begins with the record."""
    part = trial.elapsed / trial.elapsed[-1] / shape["time_over_record"]
    _warmed(trial, amplitude * np.expm1(-part) / np.expm1(-1.0 / shape["time_over_record"]))


def _room_between(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Over the day: part of a sine from the first record to the last."""
    angle = 0.5 * np.pi * shape["part_of_quarter_day"]
    _warmed(trial, np.full_like(trial.time, amplitude * np.sin(angle * trial.place) / np.sin(angle)))


def _other_room(trial: Trial, amplitude: float, shape: Shape) -> None:
    """One record on another day, at the end a little nearer to the usual temperature."""
    _warmed(trial, amplitude * (1.0 - shape["recovery"] * trial.elapsed / trial.elapsed[-1]))


def _width(random: Generator, setting: Setting) -> Shape:
    return {"width": random.uniform(3.0, 7.0)}


def _critical(random: Generator, setting: Setting) -> Shape:
    return {"critical_rate_per_s": setting.slowest * (setting.fastest / setting.slowest) ** random.uniform(0.0, 0.5)}


def _plate(random: Generator, setting: Setting) -> Shape:
    return {
        "biot_number": 10.0 ** random.uniform(-1.5, 0.0),
        "half_thickness_mm": random.uniform(0.8, 2.5),
        "hardening_loss_per_K": random.uniform(0.0, 0.008),
    }


def _ageing(random: Generator, setting: Setting) -> Shape:
    return {"strain": 10.0 ** random.uniform(-1.7, -0.7), "sharpness": random.uniform(0.7, 2.0)}


_room = partial(Cause, "temperature_drift", 2.0, signed=True, temperatures=False, draws=2)

CAUSES = (
    Cause("rate_dependent_relaxation", 0.5, _width, change=_bounded, signed=True, draws=2),
    Cause("rate_dependent_relaxation", 0.5, _critical, change=_carreau, signed=True, draws=2),
    Cause("stress_activated_flow", 0.3, lambda r, s: {"stress_MPa": r.uniform(4.0, 20.0)}, change=_tobolsky, draws=2),
    Cause(
        "stress_activated_flow", 0.3, lambda r, s: {"stress_MPa": r.uniform(10.0, 30.0)}, change=_ree_eyring, draws=2
    ),
    Cause("self_heating", 0.3, _plate, change=_slab, temperatures=False),
    Cause("structural_softening", 0.5, _ageing, change=_rejuvenation),
    Cause("structural_softening", 0.3, _ageing, change=_stiff_rejuvenation),
    _room(
        lambda r, s: {"time_over_record": 10.0 ** r.uniform(-0.5, 0.7)}, change=_room_within, placements=("all", "one")
    ),
    _room(lambda r, s: {"part_of_quarter_day": r.uniform(0.2, 1.0)}, change=_room_between),
    _room(lambda r, s: {"recovery": r.uniform(0.0, 0.3)}, change=_other_room, placements=("one",)),
)
