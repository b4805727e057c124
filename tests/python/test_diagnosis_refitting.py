"""Refits and evidences of many sets of causes on one base fit, here and in copies of the process."""

import numpy as np
import pytest

from campaigns.few_records import damage, few_records
from probation.diagnosis.budget import Budget
from probation.diagnosis.refitting import Refitting
from probation.effects.cause import Cause
from probation.effects.registry import effect
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.refit import MOST_STEPS, Refit

EFFECTS = tuple(effect(name) for name in ("damage", "machine_compliance", "volume_change"))


@pytest.fixture(scope="module")
def base():
    campaign = few_records(damage(0.05))
    return base_fit(campaign, plain_fit(campaign))


@pytest.fixture(scope="module")
def jobs(base):
    models = [base.model.with_causes([Cause(each, form)]) for each in EFFECTS for form in each.forms]
    return [(model, np.append(base.parameters, model.start[model.base_count :])) for model in models]


def test_copies_find_what_one_process_finds_to_the_last_digit(base, jobs):
    found = []
    for threads in (1, 3):
        refitting = Refitting(base, EFFECTS, threads)
        begun = [fit for fit in refitting.refits(jobs, 2, Budget()) if isinstance(fit, Refit)]
        ended = refitting.refits([(fit.model, fit) for fit in begun], MOST_STEPS, Budget())
        weighed = refitting.evidences(ended, unknown=True)
        screened = [each for one in refitting.candidates(base.extended(EFFECTS)) for each in one]
        refitting.close()
        found.append(
            [(fit.parameters.tolist(), known.log_evidence_unknown) for fit, known in zip(ended, weighed, strict=True)]
            + [(each.values, each.gain) for each in screened]
        )
    assert len(ended) == len(jobs) < len(screened)
    assert found[0] == found[1]


def test_a_refit_goes_on_where_it_was_stopped(base, jobs):
    refitting = Refitting(base, EFFECTS, 1)
    (begun,) = refitting.refits(jobs[:1], 1, Budget())
    (ended,) = refitting.refits([(begun.model, begun)], MOST_STEPS, Budget())
    assert ended.chi_square < begun.chi_square < base.refit.chi_square


def test_once_the_budget_is_spent_nothing_is_refitted_but_one_where_there_is_nothing_yet(base, jobs):
    refitting, spent = Refitting(base, EFFECTS, 1), Budget(1e-9)
    assert set(refitting.refits(jobs, 1, spent)) == {spent.why}
    first, *others = refitting.refits(jobs, 1, spent, always_one=True)
    assert isinstance(first, Refit)
    assert set(others) == {spent.why}
