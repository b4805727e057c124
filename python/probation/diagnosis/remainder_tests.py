"""Tests that would settle on what a remainder depends (docs/diagnosis-method.md, section 12)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.design.next_test import judged
from probation.design.planned_record import planned_view
from probation.design.planned_tests import Laboratory, ProposedTest, planned_tests, repeats
from probation.design.predicted import RivalPrediction
from probation.diagnosis.next import as_answer
from probation.diagnosis.variables import every_phase
from probation.inference.unsolvable import UNSOLVABLE
from probation.parallel import in_parallel
from probation.settings.remainder import REMAINDER

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.design.next_test import RankedTest
    from probation.diagnosis.free_function import FreeFunction
    from probation.diagnosis.remainder import Remainder
    from probation.diagnosis.result import NextTest
    from probation.effects.record_view import RecordView
    from probation.inference.base_fit import BaseFit

CHANGE_WITH_A_REPEAT = ("order",)
"""Variables that differ in the repeat of a record: all others are the same in a repeat."""

NOT_PLANNED = ("specimen",)
"""Variables of which a planned test has no value."""


def remainder_tests(base: BaseFit, left: Remainder, *, threads: int, seed: int) -> tuple[NextTest, ...]:
    """Tests that discriminate the variables on which a remainder may depend, the most worth first.

    Each free function predicts each test, with what the records leave open of its coefficients and with the error that
    it has on records left out; the odds between variables are those of what they explain to what they leave.

    Parameters
    ----------
    base : BaseFit
    left : Remainder
    threads, seed : int
    """
    rivals = [rival for rival in left.functions if rival.dependence.variable not in NOT_PLANNED][
        : REMAINDER.planned_variables
    ]
    if len(rivals) < 2:
        return ()
    odds = np.array(
        [rival.dependence.explained / (1.0 - rival.dependence.explained + REMAINDER.doubt) for rival in rivals]
    )
    prior = odds / odds.sum()
    error = rivals[0].error_MPa
    answers = [[rival.dependence.variable] for rival in rivals]
    names = [rival.dependence.title for rival in rivals]

    def work(planned: tuple[ProposedTest, RecordView]) -> RankedTest | None:
        test, view = planned
        try:
            ways = [_predicted(rival, owner, view, error) for owner, rival in enumerate(rivals)]
        except UNSOLVABLE:
            return None
        group = list(range(len(rivals)))
        return judged(test, ways, prior, group, answers, names, float(prior.max()), seed=seed)

    planned = _planned(base, rivals)
    visiting = [(test, view) for test, view in planned if _visits(view, rivals[0])] or planned
    tests = [ranked for ranked in in_parallel(work, visiting, threads) if ranked is not None]
    if not tests:
        return ()
    return as_answer(sorted(tests, key=lambda ranked: -ranked.worth), float(prior.max()))


def _visits(view: RecordView, leading: FreeFunction) -> bool:
    """Whether a test enters the phase in which the leading function acts."""
    when = leading.term.when
    return when is None or int(every_phase((view,), leading.least)[when].sum()) > REMAINDER.least_in_phase * len(
        view.data
    )


def _predicted(rival: FreeFunction, owner: int, view: RecordView, error: float) -> RivalPrediction:
    stress, spread = rival.on(view)
    some = np.unique(np.linspace(0, len(stress) - 1, REMAINDER.planned_instants).astype(int))
    return RivalPrediction(owner, 1.0, stress[some] / error, spread[some] / error)


def _planned(base: BaseFit, rivals: Sequence[FreeFunction]) -> list[tuple[ProposedTest, RecordView]]:
    """Tests of the same laboratory, at the last temperature, and one at another where that may matter."""
    views = base.model.views
    known = {rival.dependence.variable for rival in rivals}
    usual = None if views[-1].temperature is None else float(np.mean(views[-1].temperature))
    tests = [
        (test, _at(planned_view(test.name, test.time, test.true_strain, test.jumps, views), usual))
        for test in planned_tests(Laboratory.of(base.model, base.parameters))
        if test.repeats is None or known & {*CHANGE_WITH_A_REPEAT}
    ]
    if usual is None or "temperature" not in known:
        return tests
    again = next(iter(repeats(Laboratory.of(base.model, base.parameters))))
    for change in (REMAINDER.planned_warming, -REMAINDER.planned_warming):
        what = f"{again.what}, at {usual + change:.0f} °C"
        test = replace(again, name="other_temperature", what=what, repeats=None)
        view = planned_view(test.name, test.time, test.true_strain, test.jumps, views)
        tests.append((test, _at(view, usual + change)))
    return tests


def _at(view: RecordView, temperature: float | None) -> RecordView:
    return view if temperature is None else replace(view, temperature=np.full(len(view.data), temperature))
