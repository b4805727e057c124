"""What is wrong at the rig: frame, grips, load cell, channels, clamping."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.causes.form import Change, Form, Shape
from probation_studies.blind.laboratories.test_house.draws import Even, LogEven, OneOf
from probation_studies.blind.laboratories.test_house.modal import RATIOS, WEIGHTS

if TYPE_CHECKING:
    from probation_studies.blind.laboratories.test_house.modal import FloatArray
    from probation_studies.blind.laboratories.test_house.trial import Run, Test


def _elastic_frame(a: float, q: Shape, test: Test) -> Change:
    """A spring in series: travel over the gauge length per MPa of the force over the section."""
    return Change(compliance=(a, 1.0))


def _contacts(a: float, q: Shape, test: Test) -> Change:
    """Contacts stiffen as they are pressed (Hertz 1882: approach as force^(2/3))."""
    return Change(compliance=(a, q["q"]))


def _slack(a: float, q: Shape, test: Test) -> Change:
    """The crosshead moves by the slack before the specimen is pulled."""
    return Change(travel=lambda run, strain: np.maximum(strain - a, 0.0))


def _toe(a: float, q: Shape, test: Test) -> Change:
    """The specimen straightens (the toe of ASTM D638): lost travel comes up as 1 - exp(-travel/reach)."""
    return Change(travel=lambda run, strain: strain + a * np.expm1(-np.maximum(strain, 0.0) / (q["reach"] * a)))


def _sudden_slip(a: float, q: Shape, test: Test) -> Change:
    """At once the grip lets go of a little of the travel."""
    return Change(travel=lambda run, strain: strain - a * 0.5 * (1.0 + np.tanh((run.part - q["when"]) / 0.002)))


def _creeping_slip(a: float, q: Shape, test: Test) -> Change:
    """The specimen creeps out of the grip from an instant on and is then held again."""

    def travel(run: Run, strain: FloatArray) -> FloatArray:
        y = np.maximum(run.part - q["when"], 0.0) / q["width"]
        return np.asarray(strain - a * (1.0 - np.exp(-y) * (1.0 + y)))

    return Change(travel=travel)


def _gain(a: float, q: Shape, test: Test) -> Change:
    """The load cell's factor is wrong in one test."""
    return Change(force=lambda run, force: force * (1.0 + q["sign"] * a))


def _section(a: float, q: Shape, test: Test) -> Change:
    """One specimen's section was measured wrongly: width and thickness by half of the amount each."""
    return Change(force=lambda run, force: force / (1.0 - 0.5 * q["sign"] * a) ** 2)


def _zero(a: float, q: Shape, test: Test) -> Change:
    """The cell was not set to zero before one test, or a grip's weight hangs at it in all [MPa]."""
    return Change(force=lambda run, force: force + q["sign"] * a)


def _drift(a: float, q: Shape, test: Test) -> Change:
    """The zero drifts steadily in one test, by the amount [MPa]."""
    return Change(force=lambda run, force: force + q["sign"] * a * run.part)


def _warm_up(a: float, q: Shape, test: Test) -> Change:
    """The bridge warms up behind the start, within a part of the longest test."""
    return Change(force=lambda run, force: force - q["sign"] * a * np.expm1(-run.time / (q["part"] * test.longest)))


def _late_strain(a: float, q: Shape, test: Test) -> Change:
    """The video extensometer computes; the amount is in sampling intervals of the fastest record."""
    return Change(late=a * test.shortest_interval)


def _filter(a: float, q: Shape, test: Test) -> Change:
    """The force amplifier's filter, of first order; exact along straight pieces."""

    def force(run: Run, before: FloatArray) -> FloatArray:
        late, step = a * test.shortest_interval, np.diff(run.time)
        kept, slope = np.exp(-step / late), np.diff(before) / step
        found = before.copy()
        for n in range(len(step)):
            steady = slope[n] * late
            found[n + 1] = before[n + 1] - steady + (found[n] - before[n] + steady) * kept[n]
        return found

    return Change(force=force)


def _preload(a: float, q: Shape, test: Test) -> Change:
    """Tightening the grips strained the specimen at once; then strain was set to zero, force was not [MPa]."""
    return Change(start=WEIGHTS * a)


def _rested(a: float, q: Shape, test: Test) -> Change:
    """As before, or pressed together, but it rested a part of tau_max: the fast modes have relaxed."""
    left = WEIGHTS * np.exp(-q["wait"] / RATIOS)
    return Change(start=q["sign"] * a * left / left.sum())


def _pump(a: float, q: Shape, test: Test) -> Change:
    """A hum of one frequency on the force of one record [MPa]."""
    return Change(force=lambda run, force: force + a * np.sin(2.0 * np.pi * q["cycles"] * run.part + q["phase"]))


def _screw(a: float, q: Shape, test: Test) -> Change:
    """The screw's pitch in all records: periodic in the travel, with a second harmonic [MPa]."""

    def force(run: Run, before: FloatArray) -> FloatArray:
        angle = 2.0 * np.pi * np.expm1(test.history.strain) / q["pitch"] + q["phase"]
        return np.asarray(before + a * (np.sin(angle) + q["second"] * np.sin(2.0 * angle + 1.0)))

    return Change(force=force)


_SIGN = {"sign": OneOf((1.0, -1.0))}
_PHASE = Even(0, 6.28)

RIG = (
    Form("machine_compliance", "linear", _elastic_frame, 1e-6, 2e-4),
    Form("machine_compliance", "contacts", _contacts, 1e-5, 2e-3, {"q": Even(0.55, 0.8)}),
    Form("strain_offset", "slack", _slack, 1e-4, 0.02, scope="either"),
    Form("strain_offset", "toe", _toe, 1e-4, 0.02, {"reach": LogEven(1.05, 4.0)}, scope="either"),
    Form("grip_slip", "sudden", _sudden_slip, 2e-4, 0.03, {"when": Even(0.2, 0.8)}, scope="one"),
    Form(
        "grip_slip", "creeping", _creeping_slip, 4e-4, 0.03, {"when": Even(0.2, 0.7), "width": Even(0.008, 0.03)},
        scope="one",
    ),
    Form("force_gain", "cell", _gain, 0.002, 0.15, _SIGN, scope="one"),
    Form("force_gain", "section", _section, 0.002, 0.15, _SIGN, scope="one"),
    Form("force_offset", "tare", _zero, 0.02, 2.5, _SIGN, scope="one"),
    Form("force_offset", "grips_weight", _zero, 0.02, 2.5, _SIGN),
    Form("force_drift", "linear", _drift, 0.02, 1.5, _SIGN, scope="one"),
    Form("force_drift", "warm_up", _warm_up, 0.02, 1.5, {"part": Even(0.15, 0.6), **_SIGN}, scope="either"),
    Form("force_strain_lag", "late_strain", _late_strain, 0.2, 50.0),
    Form("force_strain_lag", "filter", _filter, 0.2, 50.0),
    Form("prestress", "preload", _preload, 0.02, 4.0, scope="either"),
    Form(
        "prestress", "rested", _rested, 0.02, 4.0, {"wait": LogEven(0.003, 0.1), "sign": OneOf((1.0, 1.0, -1.0))},
        scope="either",
    ),
    Form("periodic_disturbance", "pump", _pump, 0.01, 1.0, {"cycles": Even(8, 50), "phase": _PHASE}, scope="one"),
    Form(
        "periodic_disturbance", "screw", _screw, 0.01, 1.0,
        {"pitch": Even(0.015, 0.06), "phase": _PHASE, "second": Even(0.0, 0.35)},
    ),
)  # fmt: skip
"""Of the rig and of what is read there."""
