"""No hypothesis ends a diagnosis: what cannot be solved is left out and listed with the reason."""

import json
from dataclasses import replace

import numpy as np
import pytest

from campaigns.few_records import damage, few_records, offset
from probation import ConvergenceError, InputError, diagnose
from probation.cli import main
from probation.design.planned_tests import Laboratory, repeats
from probation.design.predicted import RivalExplanation, predictions
from probation.effects.cause import Cause
from probation.effects.effect import Effect, EffectParameter, Form
from probation.effects.registry import effect, register, unregister
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit

SIZE = EffectParameter("size", "", -1.0, 1.0, 0.1, "of a test")
FEEDBACK = "the feedback's stress did not converge at t = 0.1 s"
NEGATIVE = "the companion relation gives tau_max = -3700 s at a strain rate of 1e-07 1/s"


def broken(error, *, beyond=0.0):
    """An effect of the material that cannot be solved where its amplitude is larger than `beyond`."""

    def recorded_stress(view, values, stress):
        if abs(values[0]) > beyond:
            raise error
        return stress * (1.0 + values[0] * view.true_strain**2)

    return Effect(
        "broken",
        "an effect that cannot be solved",
        "Physics.\nNone.",
        "a test",
        "all",
        "material",
        (Form("only", (SIZE,), recorded_stress=recorded_stress),),
    )


@pytest.fixture
def registered():
    def add(one):
        register(one)
        return one

    yield add
    unregister("broken")


def diagnosed(campaign, *effects, **options):
    return diagnose(campaign, effects=["broken", *effects], threads=2, **options)


@pytest.mark.parametrize(
    "error",
    [ConvergenceError(FEEDBACK), InputError(NEGATIVE), ZeroDivisionError("float division by zero")],
    ids=["feedback", "companion", "arithmetic"],
)
@pytest.mark.parametrize("beyond", [0.0, 1e-3], ids=["from the start", "on the way"])
def test_a_hypothesis_that_cannot_be_solved_is_listed_and_the_others_are_judged(registered, error, beyond):
    registered(broken(error, beyond=beyond))
    found = diagnosed(few_records(damage(0.05)), "damage", design=False)
    assert found.best.effects == ("damage",)
    (alone,) = found.skipped
    assert (alone.effects, alone.count) == (("broken",), 1)
    assert alone.why.endswith(str(error))
    assert json.loads(found.to_json())["skipped"] == [{"effects": ["broken"], "why": alone.why, "count": 1}]
    assert alone.why in " ".join(found.summary().split())


def test_without_a_gap_it_is_listed_too(registered):
    registered(broken(ConvergenceError(FEEDBACK)))
    found = diagnosed(few_records(names=("slow", "fast")), "damage", design=True)
    assert found.verdict == "no_gap"
    assert [each.effects for each in found.skipped] == [("broken",)]


def test_an_effect_whose_own_functions_fail_is_listed(registered):
    one = broken(ConvergenceError(FEEDBACK))

    def modification(view, values):
        raise ConvergenceError(FEEDBACK)

    registered(replace(one, forms=(replace(one.forms[0], modification=modification, recorded_stress=None),)))
    found = diagnosed(few_records(damage(0.05), names=("slow", "fast")), "damage", design=True)
    assert found.best.effects == ("damage",)
    assert ("broken",) in [each.effects for each in found.skipped]
    assert dict(found.isolability.left_out)["broken"] == FEEDBACK


def test_where_every_hypothesis_is_solved_nothing_is_listed():
    assert diagnose(few_records(damage(0.05)), effects=["damage"], design=False).skipped == ()


def test_a_held_out_record_that_the_best_explanation_cannot_predict_is_named(registered):
    """It keeps the base law's prediction."""
    known = effect("damage")

    def only_fitted(view, values):
        if view.id == "fast":
            raise ConvergenceError(FEEDBACK)
        return known.form("growing").modification(view, values)

    registered(replace(known, name="broken", forms=(replace(known.form("growing"), modification=only_fitted),)))
    found = diagnosed(few_records(damage(0.05), held_out=("fast",)), design=False)
    assert found.best.effects == ("broken",)
    (left_out,) = found.skipped
    assert left_out.effects == ()
    assert "fast" in left_out.why
    assert FEEDBACK in left_out.why
    assert found.shrink.records["fast"].after_MPa == found.shrink.records["fast"].before_MPa


def test_a_budget_gives_the_best_answer_so_far_and_says_what_was_not_tried():
    """1 ms is gone with the base fit: of many causes only the most promising one is refitted."""
    names = ["damage", "machine_compliance", "slow_process", "volume_change"]
    found = diagnose(few_records(damage(0.05)), effects=names, threads=1, budget=1e-3)
    assert found.best.effects == ("damage",)
    assert found.headline.startswith("Of what was tried, damage explains the gap")
    assert found.headline.endswith(
        "the budget of 0.001 s ended the search: 4 of 4 effects were not refitted to the end."
    )
    assert found.best.probability < 0.5
    assert {(name,) for name in names} <= {*found.answer_set} & {each.effects for each in found.skipped}
    untried = [each for each in found.skipped if "not tried within the budget of 0.001 s" in each.why]
    assert untried
    assert any(set(each.effects) <= {*names} and each.effects for each in untried)
    assert any("what these tests can discriminate" in each.why for each in untried)
    assert found.isolability is None
    assert found.next_test is None


def test_a_budget_that_suffices_leaves_nothing_out():
    found = diagnose(few_records(damage(0.05)), effects=["damage"], threads=1, budget=600.0, design=False)
    assert found.skipped == ()
    assert found.to_dict() == diagnose(few_records(damage(0.05)), effects=["damage"], design=False).to_dict()


@pytest.mark.parametrize("budget", [0.0, -1.0, float("nan"), float("inf")])
def test_a_budget_is_a_positive_number_of_seconds(budget):
    with pytest.raises(InputError, match=r"budget: found .*, expected a positive number of seconds"):
        diagnose(few_records(names=("slow",)), budget=budget)


@pytest.mark.parametrize("text", ["0", "-3", "soon", "nan"])
def test_the_command_refuses_a_budget_that_is_no_time(text, capsys):
    assert main(["diagnose", "nowhere", f"--budget={text}"]) == 2
    assert "--budget" in capsys.readouterr().err


def test_a_fault_with_a_size_each_in_two_records_comes_back_once_in_a_planned_test():
    """It ended a diagnosis with "a cause is given twice for the same records"."""
    campaign = few_records(offset(1.0, "slow", "fast"), names=("slow", "fast"))
    base = base_fit(campaign, plain_fit(campaign))
    known = effect("force_offset")
    causes = [Cause(known, known.forms[0], (name,)) for name in ("slow", "fast")]
    model = base.model.with_causes(causes)
    parameters = model.parameters(base.parameters, (1.0,), (2.0,))
    explanation = RivalExplanation.of(model, parameters, 1.0, ("force_offset",), base.whitened.noises)
    test = repeats(Laboratory.of(base.model, base.parameters))[0]
    ways = predictions(test, base.model, base.parameters, [explanation], base.whitened.noises)
    assert [way.weight for way in ways] == [0.5, 0.5]
    assert not np.allclose(ways[0].mean, ways[1].mean)
