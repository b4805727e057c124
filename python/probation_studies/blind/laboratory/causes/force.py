"""What the force channel makes of the stress."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.filters import low_pass
from probation_studies.blind.laboratory.trial import Cause

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial


def _offset(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """A zero that is off, and settles by a small part."""
    settling = np.expm1(-trial.elapsed / trial.elapsed[-1] / shape["settling_over_record"])
    return np.asarray(stress + amplitude * (1.0 + shape["settling"] * settling) * np.exp(trial.nominal))


def _drift(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """Electronics that warm up with one time constant, the same drift by the end of a record."""
    time = shape["time_over_record"] * trial.elapsed[-1]
    way = np.expm1(-trial.elapsed / time) / np.expm1(-trial.elapsed[-1] / time)
    return np.asarray(stress + amplitude * way * np.exp(trial.nominal))


def _gain(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """A factor, and a little curvature of the cell's characteristic."""
    force = stress * np.exp(-trial.nominal)
    return np.asarray(stress * (1.0 + amplitude * (1.0 + shape["curvature"] * force / np.max(np.abs(force)))))


def _slow_force(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """Two low passes in the force channel; their times add up to a."""
    force = stress * np.exp(-trial.nominal)
    for part in (shape["balance"], 1.0 - shape["balance"]):
        force = low_pass(trial.elapsed, force, part * abs(amplitude))
    return np.asarray(force * np.exp(trial.nominal))


def _slow_strain(trial: Trial, amplitude: float, shape: Shape) -> None:
    """A low pass of time a in the strain channel: the specimen is ahead of what is recorded by a times its rate."""
    trial.strain = trial.strain + amplitude * np.gradient(trial.nominal, trial.time)


def _soft_limit(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """An amplifier that bends into its limit L = (1.15 - a) times the largest force: s / (1 + |s / L|^p)^(1/p)."""
    if amplitude <= 0.0:
        return stress
    limit = (1.15 - amplitude) * shape["largest_MPa"]
    used = np.abs(stress * np.exp(-trial.nominal)) / limit
    return stress * np.exp(-np.logaddexp(0.0, shape["sharpness"] * np.log(used + 1e-300)) / shape["sharpness"])


def _wave(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """A fundamental with its second harmonic, in force."""
    angle = 2.0 * np.pi * shape["frequency_Hz"] * trial.elapsed + shape["phase_rad"]
    return stress + amplitude * (np.sin(angle) + shape["harmonic"] * np.sin(2.0 * angle)) * np.exp(trial.nominal)


def _vibration(random: Generator, setting: Setting) -> Shape:
    lowest, highest = 4.0 / setting.duration, 0.06 / setting.sample
    return {
        "frequency_Hz": lowest * (highest / lowest) ** random.uniform(),
        "phase_rad": random.uniform(0.0, 2.0 * np.pi),
        "harmonic": random.uniform(0.0, 0.3),
    }


def _limited(random: Generator, setting: Setting) -> Shape:
    return {"sharpness": random.uniform(40.0, 100.0), "largest_MPa": setting.largest_force}


CAUSES = (
    Cause(
        "force_offset",
        0.3,
        lambda r, s: {"settling": r.uniform(0.0, 0.15), "settling_over_record": r.uniform(0.1, 0.5)},
        record=_offset,
        signed=True,
        placements=("one", "all"),
        draws=2,
    ),
    Cause(
        "force_drift",
        0.3,
        lambda r, s: {"time_over_record": 10.0 ** r.uniform(-0.3, 0.7)},
        record=_drift,
        signed=True,
        placements=("one", "all"),
    ),
    Cause(
        "force_gain",
        0.02,
        lambda r, s: {"curvature": r.uniform(-0.1, 0.1)},
        record=_gain,
        signed=True,
        placements=("one",),
        draws=2,
    ),
    Cause(
        "force_strain_lag",
        0.3,
        lambda r, s: {"balance": r.uniform(0.0, 0.5)},
        record=_slow_force,
        placements=("one", "all"),
        draws=2,
    ),
    Cause("force_strain_lag", 0.3, lambda r, s: {}, strain=_slow_strain, placements=("one", "all"), draws=1),
    Cause("force_saturation", 0.25, _limited, record=_soft_limit, localised=True, draws=2),
    Cause("force_saturation", 0.25, _limited, record=_soft_limit, placements=("one",), localised=True, draws=1),
    Cause("periodic_disturbance", 0.2, _vibration, record=_wave, placements=("one",), draws=4),
)
