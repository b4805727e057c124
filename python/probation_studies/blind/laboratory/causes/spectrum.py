"""What changes the modes: their weights, slower ones in addition to them, their stress at the start."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.filters import maxwell_element
from probation_studies.blind.laboratory.material import TIME_RATIO, WEIGHT
from probation_studies.blind.laboratory.trial import Cause

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial


def _bent(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Slope 1/2 above a knee, 1/2 + a below it: sqrt(r) (1 + r_k / r)^(-a)."""
    weight = trial.weight * (1.0 + shape["knee"] / TIME_RATIO) ** -amplitude
    trial.weight = weight / weight.sum()


def _hump(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Some decades weigh more than equipartition gives them."""
    decade = np.log10(TIME_RATIO)
    hump = np.exp(-0.5 * ((decade - shape["decade"]) / shape["width_decades"]) ** 2)
    weight = trial.weight * np.exp(amplitude * hump)
    trial.weight = weight / weight.sum()


def _prony(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Three slow elements around one time, as a broadened relaxation has them."""
    for part, ratio in ((0.25, 1.0 / shape["spread"]), (0.5, 1.0), (0.25, shape["spread"])):
        trial.extra = trial.extra + maxwell_element(
            trial.elapsed, trial.strain, part * amplitude, ratio * shape["time_over_record"] * shape["record_s"]
        )


def _preload(trial: Trial, amplitude: float, shape: Shape) -> None:
    """A short stretch before the record, then a pause: what is left of it in each mode; a in all."""
    times = TIME_RATIO * float(np.exp(trial.law.log_time(np.array([trial.reference_rate]))[0]))
    ramp, pause = shape["ramp_s"] / times, shape["pause_s"] / times
    left = -np.expm1(-ramp) / ramp * np.exp(-pause)
    trial.overstress = trial.overstress + amplitude * left / float(WEIGHT @ left)


def _slow(random: Generator, setting: Setting) -> Shape:
    return {
        "time_over_record": 10.0 ** random.uniform(-1.0, 0.5),
        "record_s": setting.duration,
        "spread": random.uniform(1.5, 4.0),
    }


def _clamping(random: Generator, setting: Setting) -> Shape:
    return {
        "ramp_s": setting.longest_time * 10.0 ** random.uniform(-2.5, -1.0),
        "pause_s": setting.longest_time * 10.0 ** random.uniform(-3.0, -0.5),
    }


CAUSES = (
    Cause("spectrum_shape", 0.1, lambda r, s: {"knee": 10.0 ** r.uniform(-2.5, 0.0)}, change=_bent, signed=True),
    Cause(
        "spectrum_shape",
        0.3,
        lambda r, s: {"decade": r.uniform(-3.0, -0.5), "width_decades": r.uniform(0.7, 1.3)},
        change=_hump,
        signed=True,
    ),
    Cause("slow_process", 20.0, _slow, change=_prony, draws=5),
    Cause("prestress", 0.5, _clamping, change=_preload, signed=True, placements=("one", "all"), draws=4),
)
