"""The virtual testing machine: what it records of one specimen before noise, causes included."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.modal import WEIGHTS, haward_thackray, solve
from probation_studies.blind.laboratories.test_house.trial import Run

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.test_house.causes import Change, Effect
    from probation_studies.blind.laboratories.test_house.modal import Feedback, FloatArray
    from probation_studies.blind.laboratories.test_house.trial import Test

_ROUNDS, _SETTLED = 200, 3e-8
"""Of the strain that a compliant frame leaves the specimen."""
_LEAST_FORCE = 1e-30  # MPa, for the slope of contacts


def observe(test: Test, effects: Sequence[Effect] = ()) -> tuple[FloatArray, FloatArray]:
    """Recorded true strain, and force over the stated section [MPa], at the samples.

    Parameters
    ----------
    test : Test
    effects : sequence of Effect
        Those that touch the test act in this order.
    """
    history = test.history
    changes = [change for each in effects for change in each.changes(test)]
    run = Run(test, test.law, history.strain)
    for each in changes:
        if each.law:
            run = replace(run, law=each.law(run))
        if each.travel:
            run = replace(run, strain=each.travel(run, run.strain))
    free, force = np.exp(run.strain), _pull(run, changes)
    for each in changes:
        if each.compliance:  # travel is the specimen's elongation and the frame's
            run, force = _given_way(run, changes, free, *each.compliance)
    recorded = history.strain
    for each in changes:
        if each.force:
            force = each.force(run, force)
        if each.late is not None:
            recorded = np.interp(run.time - each.late, run.time, recorded)
    return recorded[history.at], force[history.at]


def _given_way(
    run: Run, changes: Sequence[Change], free: FloatArray, amount: float, power: float
) -> tuple[Run, FloatArray]:
    """The run along what the frame leaves of the travel, and its force: Newton's method in every instant by itself.

    The slope of the force is taken for that of the unrelaxed specimen.
    """
    for _ in range(_ROUNDS):
        force = _pull(run, changes)
        left = free - amount * np.sign(force) * np.abs(force) ** power
        missing = np.log(np.maximum(left, 0.1 * free)) - run.strain
        if np.abs(missing).max() < _SETTLED:
            return run, force
        softer = amount * power * np.maximum(np.abs(force), _LEAST_FORCE) ** (power - 1.0) * run.law.modulus / free
        run = replace(run, strain=run.strain + missing / (1.0 + softer))
    raise RuntimeError(f"{run.test.name}: a compliant frame is not settled after {_ROUNDS} rounds")


def _pull(run: Run, changes: Sequence[Change]) -> FloatArray:
    """Force over the stated section [MPa]."""
    return np.asarray(_stress(run, changes) * np.exp(-run.strain) * run.test.section)


def _stress(run: Run, changes: Sequence[Change]) -> FloatArray:
    """The specimen's true stress [MPa]."""
    law, tau, weights = run.law, run.law.tau(run.rate), WEIGHTS
    relaxed = haward_thackray(run.strain)
    start: FloatArray | None = None
    feedbacks: list[Feedback] = []
    for each in changes:
        if each.log_tau:
            tau = tau * np.exp(each.log_tau(run))
        if each.weights is not None:
            weights = each.weights
        if each.relaxed:
            relaxed = each.relaxed(run, relaxed)
        if each.feedback:
            feedbacks.append(each.feedback(run))
    relaxed = law.hardening * relaxed
    for each in changes:
        if each.start is not None:
            start = weights * relaxed[0] + each.start

    def feedback(n: int, stress: float, step: float, rate: float) -> float:
        return float(np.prod([each(n, stress, step, rate) for each in feedbacks]))

    stress = solve(
        run.time,
        run.strain,
        tau,
        relaxed,
        law.modulus,
        weights=weights,
        start=start,
        feedback=feedback if feedbacks else None,
    )
    for each in changes:
        if each.stress:
            stress = each.stress(run, stress)
    return stress


def base_stress(test: Test, strain: FloatArray | None = None) -> FloatArray:
    """True stress of the law alone at the samples [MPa], along the history or along a strain that was recorded."""
    history, law = test.history, test.law
    along = history.strain if strain is None else strain
    time = history.fine if strain is None else history.time
    tau = law.tau(np.diff(along) / np.diff(time))
    stress = solve(time, along, tau, law.hardening * haward_thackray(along), law.modulus)
    return stress[history.at] if strain is None else stress
