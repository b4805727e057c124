"""What changes the section that carries the load: damage, voids."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.trial import Cause

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial


def _logistic(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Lost part of the section: a logistic curve of the largest strain so far, from nothing to a."""

    def lost(strain: FloatArray) -> FloatArray:
        return np.asarray(1.0 / (1.0 + np.exp(-(strain - shape["middle_strain"]) / shape["width"])))

    none = float(lost(np.zeros(1))[0])
    trial.area *= 1.0 - amplitude * (lost(trial.largest) - none) / (1.0 - none)


def _weibull(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Fibres of Weibull strength break: 1 - e^(-(e / e_0)^m) of the part a."""
    trial.area *= 1.0 + amplitude * np.expm1(-((trial.largest / shape["strain"]) ** shape["modulus"]))


def _cavitation(trial: Trial, amplitude: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """The volume grows smoothly from around an onset: a w ln(1 + e^((e - e_0) / w)), nothing at the start."""
    width = shape["width"]

    def grown(strain: FloatArray) -> FloatArray:
        return np.asarray(width * np.logaddexp(0.0, (strain - shape["onset_strain"]) / width))

    return stress * np.exp(amplitude * (grown(trial.nominal) - grown(np.zeros(1))))


def _breaking(random: Generator, setting: Setting) -> Shape:
    middle = setting.end_strain * random.uniform(0.15, 0.7)
    return {"middle_strain": middle, "width": middle * random.uniform(0.2, 0.4)}


def _strength(random: Generator, setting: Setting) -> Shape:
    return {"strain": setting.end_strain * random.uniform(0.3, 1.2), "modulus": random.uniform(1.2, 2.5)}


def _onset(random: Generator, setting: Setting) -> Shape:
    return {"onset_strain": random.uniform(0.0, 0.5) * setting.end_strain, "width": random.uniform(0.03, 0.15)}


CAUSES = (
    Cause("damage", 0.15, _breaking, change=_logistic),
    Cause("damage", 0.15, _strength, change=_weibull, draws=2),
    Cause("volume_change", 0.1, _onset, record=_cavitation, placements=("all",), draws=5),
)
