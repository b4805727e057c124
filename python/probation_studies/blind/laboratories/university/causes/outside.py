"""Causes that a catalogue does not usually hold.

- A modulus that falls with the strain reached. Yoshida, Uemori and Fujiwara 2002, Int. J. Plast. 18, 633:
  E (1 - a (1 - exp(-xi eps))), or linear up to saturation; only the unrelaxed part of the stress sees it.
- A second yield. Brooks, Duckett and Ward 1992, Polymer 33, 1872 (polyethylene): a hump in the stress at a strain of
  its own, here a bell or the derivative of a logistic.
- Cavitation. Pawlak and Galeski 2005, Macromolecules 38, 9688: part of the force is lost as cavities open at a strain,
  and comes back as they are drawn out: x exp(-x) beyond it, or a bell.
- Clocks of camera and load cell that run apart: the force is recorded at (1 + a) t (linear), or by the square of time
  while an oscillator warms up.
- Bias of sub-pixel interpolation. Schreier, Braasch and Sutton 2000, Opt. Eng. 39, 2915; Westerweel 1997, Meas. Sci.
  Technol. 8, 1379 (peak locking, a saw tooth): a strain error periodic in the elongation.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.university.causes.cause import Act, Cause, Form, Run, Setting, Shape

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import FloatArray


def _softer(run: Run, amplitude: float, shape: Shape, linear: bool) -> Act:
    x = 0.5 * (run.largest[1:] + run.largest[:-1]) / shape["strain"]
    lost = np.minimum(x, 1.0) if linear else -np.expm1(-x)
    return Act(course=lambda course: replace(course, modulus=course.modulus * (1.0 - amplitude * lost)))


def _saturation(random: Generator, setting: Setting) -> dict[str, float]:
    return {"strain": setting.strain * random.uniform(0.1, 0.5)}


MODULUS = Cause(
    "falling modulus",
    (
        Form("Yoshida et al. 2002", _saturation, lambda run, a, s: _softer(run, a, s, linear=False)),
        Form("linear to saturation", _saturation, lambda run, a, s: _softer(run, a, s, linear=True)),
    ),
    scale=0.05,
    largest=0.6,
)


def _at(random: Generator, setting: Setting) -> dict[str, float]:
    return {
        "strain": setting.strain * random.uniform(0.15, 0.6),
        "width": setting.strain * random.uniform(0.03, 0.12),
    }


def _hump(run: Run, amplitude: float, shape: Shape, logistic: bool) -> Act:
    x = (run.strain - shape["strain"]) / shape["width"]
    hump = 1.0 / np.cosh(np.clip(x, -30.0, 30.0)) ** 2 if logistic else np.exp(-0.5 * x**2)
    return Act(stress=lambda stress: stress * (1.0 + amplitude * hump))


SECOND_YIELD = Cause(
    "second yield",
    (
        Form("Brooks et al. 1992, bell", _at, lambda run, a, s: _hump(run, a, s, logistic=False)),
        Form("Brooks et al. 1992, logistic", _at, lambda run, a, s: _hump(run, a, s, logistic=True)),
    ),
    scale=0.02,
    largest=0.3,
)


def _opening(run: Run, amplitude: float, shape: Shape) -> Act:
    x = np.maximum(run.largest - shape["strain"], 0.0) / shape["width"]
    return Act(stress=lambda stress: stress * (1.0 - amplitude * x * np.exp(1.0 - x)))


CAVITATION = Cause(
    "cavitation",
    (
        Form("Pawlak and Galeski 2005, opening", _at, _opening),
        Form("Pawlak and Galeski 2005, bell", _at, lambda run, a, s: _hump(run, -a, s, logistic=False)),
    ),
    scale=0.02,
    largest=0.3,
)


def _clocks(run: Run, amplitude: float, power: float) -> Act:
    seen = run.time + amplitude * run.time * (run.time / run.time[-1]) ** (power - 1.0)
    return Act(recorded=lambda strain, force: (strain, np.interp(seen, run.time, force)))


CLOCKS = Cause(
    "clocks that run apart",
    (
        Form("linear", lambda random, setting: {}, lambda run, a, s: _clocks(run, a, 1.0)),
        Form("warming oscillator", lambda random, setting: {}, lambda run, a, s: _clocks(run, a, 2.0)),
    ),
    scale=2e-3,
    largest=0.1,
    rig=True,
    signed=True,
)


def _pixels(run: Run, amplitude: float, shape: Shape, saw: bool) -> Act:
    def recorded(strain: FloatArray, force: FloatArray) -> tuple[FloatArray, FloatArray]:
        x = np.expm1(strain) / shape["pixel"]
        if saw:
            wave = sum((-1.0) ** (k + 1) * np.sin(2.0 * np.pi * k * x) / k for k in (1, 2, 3))
        else:
            wave = np.sin(2.0 * np.pi * x)
        return strain + amplitude * np.asarray(wave), force

    return Act(recorded=recorded)


def _pixel(random: Generator, setting: Setting) -> dict[str, float]:
    return {"pixel": np.expm1(setting.strain) / random.uniform(5.0, 25.0)}


PIXELS = Cause(
    "sub-pixel bias",
    (
        Form("Schreier et al. 2000", _pixel, lambda run, a, s: _pixels(run, a, s, saw=False)),
        Form("Westerweel 1997", _pixel, lambda run, a, s: _pixels(run, a, s, saw=True)),
    ),
    scale=2e-4,
    largest=0.01,
    rig=True,
)

OUTSIDE = (MODULUS, SECOND_YIELD, CAVITATION, CLOCKS, PIXELS)
