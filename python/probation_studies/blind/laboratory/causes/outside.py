"""What no name of the catalogue stood for when this laboratory was written; some have got one since."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.trial import Cause, on_steps

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial
_TURN = 1e-3


def _mullins(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The network is softer below the largest strain so far, and whole again beyond it."""
    below = (trial.largest - trial.strain) / shape["strain"]
    trial.network_factor *= 1.0 - amplitude * np.tanh(np.maximum(below, 0.0))


def _yield_band(trial: Trial, amplitude: float, shape: Shape) -> None:
    """A band of localised strain passes through the gauge length: a dip and a bump of the mean stress."""
    x = (trial.strain - shape["strain"]) / shape["width"]
    trial.extra = trial.extra + amplitude * (x + shape["skew"]) * np.exp(-0.5 * x**2)


def _bauschinger(trial: Trial, amplitude: float, shape: Shape) -> None:
    """After a reversal the times are shorter, until the strain has moved on by some hundredths."""
    turned = _since_reversal(trial.strain)
    trial.log_factor -= amplitude * on_steps(np.exp(-turned / shape["strain"]))


def _since_reversal(strain: FloatArray) -> FloatArray:
    """Way from the last turning point, infinite before the first; less than `_TURN` is none."""
    way = np.full(len(strain), np.inf)
    direction, extreme, turning = 1.0, float(strain[0]), np.inf
    for m, now in enumerate(strain.tolist()):
        if direction * (now - extreme) > 0.0:
            extreme = now
        elif direction * (extreme - now) > _TURN:
            direction, turning, extreme = -direction, extreme, now
        way[m] = abs(now - turning)
    return way


def _since(trial: Trial, shape: Shape) -> FloatArray:
    """Time since the shape's instant in units of its length."""
    return np.asarray((trial.elapsed / trial.elapsed[-1] - shape["instant_of_record"]) / shape["length_of_record"])


def _open_door(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The room cools for a while and recovers."""
    x = _since(trial, shape)
    dip = np.where(x > 0.0, x * np.exp(1.0 - np.maximum(x, 0.0)), 0.0)
    trial.log_factor += 0.1 * amplitude * on_steps(dip)


def _wavy_strain(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The extensometer's scale is wavy: recorded and true strain differ by a sine of the strain."""
    wave = np.sin(2.0 * np.pi * trial.nominal / shape["period_strain"] + shape["phase_rad"])
    trial.strain = trial.strain + amplitude * (wave - np.sin(shape["phase_rad"]))


def _moisture(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Water taken up between the tests softens the glass: E_u falls from test to test, neither tau nor G does."""
    trial.modulus_factor *= 1.0 - amplitude * trial.place ** shape["power"]


def _serrations(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """Stick and slip of a neck: a saw tooth whose pitch is a strain and which grows."""
    pitch = trial.nominal / shape["pitch_strain"]
    tooth = (pitch - np.floor(pitch)) - 0.5
    grown = np.clip((trial.nominal - shape["onset_strain"]) / 0.3, 0.0, 1.0)
    return stress + amplitude * tooth * grown * np.exp(trial.nominal)


def _cell_hysteresis(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """The load cell reads more on the way down, for a force it has seen."""
    force = stress * np.exp(-trial.nominal)
    largest = np.maximum.accumulate(force)
    below = np.maximum(largest - force, 0.0) / np.max(force)
    return stress + amplitude * force * np.tanh(below / shape["width"]) * np.exp(trial.nominal)


def _crystals(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Crystals grow under strain and carry a stress of their own from an onset on."""
    width = 0.05
    beyond = width * np.logaddexp(0.0, (trial.largest - shape["onset_strain"]) / width)
    level = width * np.logaddexp(0.0, -shape["onset_strain"] / width)
    trial.extra = trial.extra + amplitude * (beyond - level) ** shape["power"]


def _blade_slip(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The extensometer's blade creeps forth and springs back: recorded strain that comes and goes."""
    x = _since(trial, shape)
    trial.strain = trial.strain - amplitude * np.exp(-(x**2))


def _somewhere(random: Generator, setting: Setting) -> Shape:
    return {"instant_of_record": random.uniform(0.1, 0.8), "length_of_record": random.uniform(0.03, 0.12)}


def _waves(random: Generator, setting: Setting) -> Shape:
    return {
        "period_strain": setting.end_strain / random.uniform(2.0, 6.0),
        "phase_rad": random.uniform(0.0, 2.0 * np.pi),
    }


def _band(random: Generator, setting: Setting) -> Shape:
    strain = random.uniform(0.15, 0.6) * setting.end_strain
    return {"strain": strain, "width": random.uniform(0.1, 0.3) * strain, "skew": random.uniform(-1.0, 1.0)}


def _pitch(random: Generator, setting: Setting) -> Shape:
    return {
        "pitch_strain": setting.end_strain / random.uniform(6.0, 25.0),
        "onset_strain": random.uniform(0.0, 0.4) * setting.end_strain,
    }


def _growth(random: Generator, setting: Setting) -> Shape:
    return {"onset_strain": random.uniform(0.3, 0.7) * setting.end_strain, "power": random.uniform(1.0, 2.0)}


_outside = partial(Cause, outside=True)
_local = partial(_outside, localised=True)
_reversed = partial(_local, needs_unloading=True, draws=2)

CAUSES = (
    _reversed(
        "mullins_softening",
        0.1,
        lambda r, s: {"strain": r.uniform(0.02, 0.08)},
        change=_mullins,
        known_as="mullins_softening",
    ),
    _local("yield_band", 1.0, _band, change=_yield_band),
    _reversed(
        "bauschinger",
        1.0,
        lambda r, s: {"strain": r.uniform(0.01, 0.05)},
        change=_bauschinger,
        known_as="back_stress",
    ),
    _local("open_door", 3.0, _somewhere, change=_open_door, placements=("one",), temperatures=False, draws=2),
    _outside("wavy_strain_scale", 0.002, _waves, strain=_wavy_strain, placements=("all", "one")),
    _outside(
        "moisture",
        0.1,
        lambda r, s: {"power": r.uniform(0.5, 2.0)},
        change=_moisture,
        draws=2,
        known_as="change_between_tests",
    ),
    _outside("serrations", 1.0, _pitch, record=_serrations, placements=("all", "one"), known_as="serrated_flow"),
    _reversed(
        "cell_hysteresis",
        0.03,
        lambda r, s: {"width": r.uniform(0.05, 0.3)},
        record=_cell_hysteresis,
        known_as="cell_hysteresis",
    ),
    _outside("strain_crystallisation", 5.0, _growth, change=_crystals, known_as="strain_induced_crystallisation"),
    _local("blade_slip", 0.005, _somewhere, strain=_blade_slip, placements=("one",), draws=2),
)
