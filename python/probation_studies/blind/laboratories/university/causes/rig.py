"""Causes in the rig: what it records of a test that itself is as it should be, or how it begins.

Strain is recorded as true strain, force over the initial section; true stress is force times exp(recorded strain).

- Compliance of frame and grips in the recorded travel. Huber 1968 / ASTM D3379 (linear): c F. Hertz 1882 (contacts that
  stiffen): c F^(2/3), with c so that both are alike at the flow stress.
- Slack, a toe at the start. Crosshead travel is added while the force is low: s (1 - exp(-F/F0)) (soft alignment), or
  the parabola s (1 - (1 - F/F0)^2) up to F0 (ASTM D638, annex: toe compensation).
- Zero of the strain missed: a constant; or one that settles while the camera warms up (Ma, Pang and Ma 2012, Meas. Sci.
  Technol. 23, 025403): a (1 - exp(-t/t_w)/2).
- Load cell: gain of one record's range (ISO 376), or with a cubic part (ISO 376's interpolation); offset that stays or
  that settles (OIML R 60, return to zero); drift linear in time, or logarithmic (creep of gauges and glue,
  ln(1 + t/t0), as in Guiu and Pratt 1964); lag of first order, or a delay of transport (filters and buses).
- Prestress of clamping. A strain before the record's zero that has relaxed for a while in the law's own modes, or that
  has reached the distribution of steady flow (p_j r_j).
- Slip in a grip: sudden, over a sample or two; or progressive, exponential towards its end.
- Hum of the mains, seen through sampling at another frequency: 50 Hz; or with the third harmonic of rectifiers.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.signal import lfilter

from probation_studies.blind.laboratories.university.causes.cause import Act, Cause, Form, Run, Setting, Shape
from probation_studies.blind.laboratories.university.modal_law import (
    RATIO,
    WEIGHT,
    haward_thackray,
)

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import Course, FloatArray


def _travel(added: FloatArray, strain: FloatArray) -> FloatArray:
    """True strain with elongation (over the gauge length) added."""
    return np.asarray(np.log(np.exp(strain) + added))


def _flow(random: Generator, setting: Setting) -> dict[str, float]:
    return {"flow_MPa": setting.flow_stress}


def _compliant(amplitude: float, shape: Shape, power: float) -> Act:
    flow = shape["flow_MPa"]

    def recorded(strain: FloatArray, force: FloatArray) -> tuple[FloatArray, FloatArray]:
        given = np.sign(force) * np.abs(force / flow) ** power
        return _travel(amplitude * flow * given, strain), force

    return Act(recorded=recorded)


COMPLIANCE = Cause(
    "compliance",
    (
        Form("linear", _flow, lambda run, a, s: _compliant(a, s, 1.0)),
        Form("Hertz 1882", _flow, lambda run, a, s: _compliant(a, s, 2.0 / 3.0)),
    ),
    scale=2e-5,
    largest=1.5e-3,
    rig=True,
)


def _toe(amplitude: float, shape: Shape, soft: bool) -> Act:
    def recorded(strain: FloatArray, force: FloatArray) -> tuple[FloatArray, FloatArray]:
        x = np.maximum.accumulate(np.maximum(force, 0.0)) / shape["force_MPa"]
        taken = -np.expm1(-x) if soft else 1.0 - (1.0 - np.minimum(x, 1.0)) ** 2
        return _travel(amplitude * taken, strain), force

    return Act(recorded=recorded)


def _toe_force(random: Generator, setting: Setting) -> dict[str, float]:
    return {"force_MPa": setting.flow_stress * random.uniform(0.05, 0.4)}


SLACK = Cause(
    "slack",
    (
        Form("exponential toe", _toe_force, lambda run, a, s: _toe(a, s, soft=True)),
        Form("ASTM D638, parabolic toe", _toe_force, lambda run, a, s: _toe(a, s, soft=False)),
    ),
    scale=1e-3,
    largest=0.1,
    rig=True,
)


def _warming(run: Run, amplitude: float, shape: Shape) -> Act:
    added = amplitude * (1.0 - 0.5 * np.exp(-run.time / shape["time_s"]))
    return Act(recorded=lambda strain, force: (strain + added, force))


ZERO = Cause(
    "missed zero of strain",
    (
        Form(
            "constant",
            lambda random, setting: {},
            lambda run, a, s: Act(recorded=lambda strain, force: (strain + a, force)),
        ),
        Form(
            "Ma, Pang and Ma 2012",
            lambda random, setting: {"time_s": setting.duration * random.uniform(0.1, 0.5)},
            _warming,
        ),
    ),
    scale=5e-3,
    largest=0.1,
    rig=True,
    signed=True,
)


def _on_force(added: FloatArray) -> Act:
    return Act(recorded=lambda strain, force: (strain, force + added))


GAIN = Cause(
    "gain of the load cell",
    (
        Form("ISO 376", _flow, lambda run, a, s: Act(recorded=lambda strain, force: (strain, force * (1.0 + a)))),
        Form(
            "ISO 376, cubic",
            _flow,
            lambda run, a, s: Act(
                recorded=lambda strain, force: (strain, force * (1.0 + a * (0.7 + 0.3 * (force / s["flow_MPa"]) ** 2)))
            ),
        ),
    ),
    scale=0.02,
    largest=0.4,
    rig=True,
    signed=True,
)

OFFSET = Cause(
    "offset of the load cell",
    (
        Form("constant", lambda random, setting: {}, lambda run, a, s: _on_force(np.full_like(run.time, a))),
        Form(
            "OIML R 60",
            lambda random, setting: {"time_s": setting.duration * random.uniform(0.2, 0.6)},
            lambda run, a, s: _on_force(a * (0.8 + 0.2 * np.exp(-run.time / s["time_s"]))),
        ),
    ),
    scale=0.5,
    largest=10.0,
    rig=True,
    signed=True,
)

DRIFT = Cause(
    "drift of the load cell",
    (
        Form("linear", lambda random, setting: {}, lambda run, a, s: _on_force(a * run.time / run.time[-1])),
        Form(
            "Guiu and Pratt 1964",
            lambda random, setting: {"part": random.uniform(0.02, 0.2)},
            lambda run, a, s: _on_force(a * np.log1p(run.time / run.time[-1] / s["part"]) / np.log1p(1.0 / s["part"])),
        ),
    ),
    scale=0.5,
    largest=10.0,
    rig=True,
    signed=True,
)


def _slow_cell(run: Run, amplitude: float, shape: Shape) -> Act:
    decay = np.exp(-run.step / max(amplitude, 1e-9))

    def recorded(strain: FloatArray, force: FloatArray) -> tuple[FloatArray, FloatArray]:
        # exact for a force that is linear within a step
        mean = amplitude / run.step * (1.0 - decay)
        driven = (1.0 - mean) * (force[1:] - force[0]) + (mean - decay) * (force[:-1] - force[0])
        return strain, force[0] + np.concatenate([[0.0], lfilter([1.0], [1.0, -decay], driven)])

    return Act(recorded=recorded)


def _late_cell(run: Run, amplitude: float, shape: Shape) -> Act:
    return Act(recorded=lambda strain, force: (strain, np.interp(run.time - amplitude, run.time, force)))


LAG = Cause(
    "lag of the load cell",
    (
        Form("first order", lambda random, setting: {}, _slow_cell),
        Form("delay of transport", lambda random, setting: {}, _late_cell),
    ),
    scale=0.05,
    largest=10.0,
    rig=True,
)


def _clamped(run: Run, amplitude: float, modal: FloatArray) -> Act:
    def course(before: Course) -> Course:
        more = haward_thackray(run.half_strain + amplitude) - haward_thackray(run.half_strain)
        relaxed = before.relaxed + run.material.hardening * more
        return replace(before, relaxed=relaxed, start=before.start + modal)

    return Act(course=course)


def _kept(run: Run, amplitude: float, shape: Shape) -> Act:
    return _clamped(run, amplitude, run.material.modulus * amplitude * WEIGHT * np.exp(-shape["waited"] / RATIO))


def _flowing(run: Run, amplitude: float, shape: Shape) -> Act:
    steady = WEIGHT * RATIO / np.sum(WEIGHT * RATIO)
    return _clamped(run, amplitude, run.material.modulus * amplitude * shape["part"] * steady)


PRESTRESS = Cause(
    "prestress of clamping",
    (
        Form(
            "relaxed in the law's modes",
            lambda random, setting: {"waited": 10.0 ** random.uniform(-1.5, 0.0)},
            _kept,
        ),
        Form("steady flow", lambda random, setting: {"part": random.uniform(0.2, 0.8)}, _flowing),
    ),
    scale=1e-3,
    largest=0.02,
    rig=True,
)


def _slipped(run: Run, amplitude: float, shape: Shape, progressive: bool) -> Act:
    start = shape["part"] * run.time[-1]
    if progressive:
        gone = -np.expm1(-np.maximum(run.time - start, 0.0) / (shape["spread"] * run.time[-1]))
    else:
        gone = np.clip((run.time - start) / (1.5 * run.sampling), 0.0, 1.0)
    return Act(recorded=lambda strain, force: (_travel(amplitude * gone, strain), force))


def _slip(random: Generator, setting: Setting) -> dict[str, float]:
    return {"part": random.uniform(0.1, 0.8), "spread": random.uniform(0.05, 0.2)}


SLIP = Cause(
    "slip in a grip",
    (
        Form("sudden", _slip, lambda run, a, s: _slipped(run, a, s, progressive=False)),
        Form("progressive", _slip, lambda run, a, s: _slipped(run, a, s, progressive=True)),
    ),
    scale=1e-3,
    largest=0.05,
    rig=True,
)


def _hum(run: Run, amplitude: float, shape: Shape, third: float) -> Act:
    """Of `frequency` in cycles per sample, as sampling folds it down."""
    angle = 2.0 * np.pi * shape["cycles_per_sample"] * run.time / run.sampling + shape["phase"]
    return _on_force(amplitude * (np.sin(angle) + third * np.sin(3.0 * angle)))


def _mains(random: Generator, setting: Setting) -> dict[str, float]:
    return {"cycles_per_sample": random.uniform(0.01, 0.12), "phase": random.uniform(0.0, 2.0 * np.pi)}


HUM = Cause(
    "hum of the mains",
    (
        Form("50 Hz, folded", _mains, lambda run, a, s: _hum(run, a, s, 0.0)),
        Form("50 and 150 Hz, folded", _mains, lambda run, a, s: _hum(run, a, s, 0.3)),
    ),
    scale=0.1,
    largest=5.0,
    rig=True,
)

CAUSES = (COMPLIANCE, SLACK, ZERO, GAIN, OFFSET, DRIFT, LAG, PRESTRESS, SLIP, HUM)
