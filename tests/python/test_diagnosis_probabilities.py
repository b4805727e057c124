"""Probabilities of explanations follow Bayes' rule, and an answer set holds what it promises."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from campaigns import linear_problem as problem
from probation.diagnosis.hypothesis import Hypothesis
from probation.diagnosis.probabilities import (
    Weighed,
    answer_set,
    effect_count,
    given_a_gap,
    given_no_gap,
    none_behind,
    probabilities_of,
    with_unseen,
    with_untried,
)
from probation.diagnosis.trust import OtherForms, Tempered, log_prior
from probation.effects.cause import Cause
from probation.inference.evidence import Evidence
from probation.inference.unknown import UNKNOWN
from probation.settings.evidence import EVIDENCE

VIEWS = problem.views([np.linspace(0.0, 100.0, 20)] * 3)
BASE = problem.solved(problem.bar(), VIEWS)
NAMES = [f"effect_{letter}" for letter in "abcdef"]


def made(name, kind="material", more_forms=()):
    return problem.effect(
        lambda view, values: values[0] * view.true_strain,
        problem.parameter("size", -1.0, 1.0, 1.0),
        name=name,
        kind=kind,
        more_forms=more_forms,
    )


def hypothesis(*causes, log_evidence=0.0, unknown=-np.inf):
    asked = BASE.problem.with_causes(causes)
    found = replace(BASE, problem=asked, parameters=asked.model.start)
    return Hypothesis(found, Evidence(log_evidence, 0.0, unknown, np.zeros((0, 0))))


def alone(name, **options):
    effect = made(name)
    return hypothesis(Cause(effect, effect.forms[0]), **options)


def every_place(effect, **options):
    """A rig's fault in all records and in each alone, in every form."""
    places = [None, *((view.id,) for view in VIEWS)]
    return [hypothesis(Cause(effect, form, place), **options) for form in effect.forms for place in places]


def test_probabilities_sum_to_one_and_come_in_order():
    rng = np.random.default_rng(0)
    found = [hypothesis(log_evidence=-3.0, unknown=-2.0)]
    found += [alone(name, log_evidence=rng.normal(), unknown=rng.normal()) for name in NAMES]
    weighed = probabilities_of(found, len(NAMES))
    chances = [each.probability for each in weighed]
    assert sum(chances) == pytest.approx(1.0, abs=1e-12)
    assert chances == sorted(chances, reverse=True)
    assert {(), ("unknown",)} <= {each.effects for each in weighed}


def weighed_as(parts):
    base = hypothesis()
    return [Weighed(effects, chance, base) for effects, chance in parts.items()]


def test_where_a_gap_is_declared_what_no_effect_loses_goes_to_all_others_as_they_stand():
    """At p = 0.001 no density of p-values speaks for "none" by more than 0.0188 to one, odds of 0.45 to 0.55 before."""
    found = given_a_gap(weighed_as({(): 0.9, ("a",): 0.05, ("unknown",): 0.03, ("b",): 0.02}), 0.001)
    chances = {each.effects: each.probability for each in found}
    assert found[0].effects == ("a",)
    assert chances[()] / (1.0 - chances[()]) == pytest.approx(0.018777 * 0.45 / 0.55, rel=1e-3)
    assert chances[("a",)] == pytest.approx(0.5 * (1.0 - chances[()]))
    assert chances[("unknown",)] / chances[("b",)] == pytest.approx(1.5)
    assert sum(chances.values()) == pytest.approx(1.0)


def test_explanations_that_lead_already_stay_as_they_are_where_a_gap_is_declared():
    before = weighed_as({("a",): 0.999, (): 0.001})
    assert given_a_gap(before, 0.001) == before


def test_a_gap_that_cannot_be_chance_leaves_nothing_for_no_effect():
    assert given_a_gap(weighed_as({(): 1.0 - 1e-6, ("a",): 1e-6}), 0.0)[-1].probability < 1e-9


def test_where_a_gap_is_declared_no_effect_does_not_lead():
    """However few explanations there are, and however many are refused by held-out records: something acts."""
    found = none_behind(weighed_as({(): 0.4, ("unknown",): 0.35, ("a",): 0.25}))
    assert [each.effects for each in found] == [("unknown",), (), ("a",)]
    assert [each.probability for each in found] == [0.4, 0.35, 0.25]
    behind = weighed_as({("a",): 0.5, (): 0.3, ("unknown",): 0.2})
    assert none_behind(behind) == behind


def test_where_no_gap_is_declared_the_p_value_speaks_by_the_ratio_of_its_densities():
    """p = 0.5: 0.5^0.8 / 0.2 = 2.87 for "none"; p = 0.01: 0.126."""
    before = weighed_as({(): 0.8, ("a",): 0.15, ("b",): 0.05})
    large = {each.effects: each.probability for each in given_no_gap(before, 0.5)}
    assert large[()] / large[("a",)] == pytest.approx(2.87 * 0.8 / 0.15, rel=2e-3)
    assert large[("a",)] / large[("b",)] == pytest.approx(3.0)
    small = {each.effects: each.probability for each in given_no_gap(weighed_as({(): 0.9, ("a",): 0.1}), 0.01)}
    assert small[()] / small[("a",)] == pytest.approx(0.126 * 9.0, rel=5e-3)


def test_no_explanation_leads_no_effect_where_no_gap_is_declared():
    found = given_no_gap(weighed_as({("a",): 0.7, (): 0.2, ("b",): 0.1}), 0.02)
    assert found[0].effects == ()
    assert found[0].probability == pytest.approx(found[1].probability)
    assert sum(each.probability for each in found) == pytest.approx(1.0)


def test_a_second_effect_that_was_not_tried_keeps_what_was_probable_of_it_beforehand():
    """Six effects, prior 0.33 of one, 0.12 of two: 0.12/15 over 0.33/6 for each pair, times what its freedom costs."""
    single = alone(NAMES[0])
    found = with_unseen(
        [Weighed((NAMES[0],), 0.9, single), Weighed(("unknown",), 0.1, hypothesis())], [made(name) for name in NAMES]
    )
    chances = {each.effects: each.probability for each in found}
    assert sum(chances.values()) == pytest.approx(1.0)
    for name in NAMES[1:]:
        assert chances[(NAMES[0], name)] / chances[(NAMES[0],)] == pytest.approx(
            EVIDENCE.unseen_second_effect * (0.12 / 15) / (0.33 / 6)
        )
    assert chances[(NAMES[0],)] / chances[("unknown",)] == pytest.approx(9.0)
    assert len(found) == 2 + 5


def test_pairs_that_were_tried_and_singles_of_little_probability_gain_none_unseen():
    base = hypothesis()
    tried = [
        Weighed((NAMES[0],), 0.6, base),
        Weighed((NAMES[0], NAMES[1]), 0.39, base),
        Weighed((NAMES[2],), 0.01, base),
    ]
    found = with_unseen(tried, [made(name) for name in NAMES[:3]])
    assert {each.effects for each in found} == {each.effects for each in tried} | {(NAMES[0], NAMES[2])}


def test_prior_probabilities_of_all_sets_sum_to_one():
    """None, unknown, each alone, pairs, triples, each beside an unknown one."""
    count = len(NAMES)
    sets = [names for size in range(4) for names in combinations(NAMES, size)]
    sets += [("unknown",), *((name, "unknown") for name in NAMES)]
    assert sum(np.exp(log_prior(names, count)) for names in sets) == pytest.approx(1.0, abs=1e-9)


def test_more_effects_are_less_probable_beforehand():
    count = len(NAMES)
    chain = [log_prior(tuple(NAMES[:size]), count) for size in range(4)]
    assert chain == sorted(chain, reverse=True)
    assert log_prior((NAMES[0], "unknown"), count) < log_prior((NAMES[0],), count)
    assert log_prior((*NAMES[:2], "unknown"), count) < log_prior((NAMES[0], "unknown"), count)


def test_with_equal_evidence_the_odds_are_those_beforehand():
    weighed = probabilities_of([hypothesis(), *(alone(name) for name in NAMES)], len(NAMES))
    chance = {each.effects: each.probability for each in weighed}
    for name in NAMES:
        expected = np.exp(log_prior((name,), len(NAMES)) - log_prior((), len(NAMES)))
        assert chance[(name,)] / chance[()] == pytest.approx(expected)


def test_odds_grow_with_the_ratio_of_evidences():
    """Two log units: e^2."""
    pair = probabilities_of([hypothesis(), alone(NAMES[0], log_evidence=2.0), alone(NAMES[1])], len(NAMES))
    chance = {each.effects: each.probability for each in pair}
    assert chance[(NAMES[0],)] / chance[(NAMES[1],)] == pytest.approx(np.exp(2.0))


@pytest.mark.parametrize("forms", [(), ("second",), ("second", "third")])
def test_forms_and_places_of_an_effect_count_as_one_cause(forms):
    """All equally good: as probable together as an effect of one form that sits in all records."""
    rig = made("rig_fault", kind="rig", more_forms=forms)
    weighed = probabilities_of([hypothesis(), alone(NAMES[0]), *every_place(rig)], len(NAMES))
    chance = {each.effects: each.probability for each in weighed}
    assert chance[("rig_fault",)] == pytest.approx(chance[(NAMES[0],)])


@pytest.mark.parametrize("records", [2, 3])
def test_an_effect_in_several_records_each_time_in_its_own_size_must_earn_its_place(records):
    """In some of three records instead of one: again each time, two numbers of records, and which of so many."""
    effect = made("effect_a", kind="rig")
    causes = [Cause(effect, effect.forms[0], (view.id,)) for view in VIEWS[:records]]
    other = alone("effect_b")
    once, often = (
        {each.effects: each.probability for each in probabilities_of([hypothesis(), made_of, other], 6)}
        for made_of in (hypothesis(causes[0]), hypothesis(*causes))
    )
    odds = [found[("effect_a",)] / found[("effect_b",)] for found in (once, often)]
    sets_of_so_many = {2: 3, 3: 1}[records]
    assert odds[1] / odds[0] == pytest.approx(
        EVIDENCE.again_in_another_record ** (records - 1) / 2 * 3 / sets_of_so_many
    )


OTHERS = OtherForms(
    fall_with_distance=0.75, unknown_power=0.02, two=0.1, three=0.01, unknown=1.0, unknown_with_known=0.004
)


def test_effects_with_no_more_evidence_than_none_have_no_probability_where_forms_are_others():
    """A heating of size 0 has less evidence than none, and a power of its distance would leave it some per cent."""
    log_evidence = {(): 0.0, ("a",): -22.0, ("b",): 8345.0, ("unknown",): -30.0}
    weights = dict(
        zip(log_evidence, OTHERS.log_weights(log_evidence, dict.fromkeys(log_evidence, 0.0), 30), strict=True)
    )
    assert weights["a",] == -np.inf
    assert np.isfinite([weights[names] for names in ((), ("b",), ("unknown",))]).all()


def test_evidence_to_a_power_says_less():
    """Ten log units to the power of 0.4 are four."""
    found = [hypothesis(), alone(NAMES[0], log_evidence=10.0), alone(NAMES[1])]
    chance = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), Tempered(0.4))}
    assert chance[(NAMES[0],)] / chance[(NAMES[1],)] == pytest.approx(np.exp(4.0))


@pytest.mark.parametrize(("behind", "ratio"), [(0.0, 1.0), (15.0, 16.0**-0.75), (255.0, 256.0**-0.75)])
def test_where_forms_are_others_odds_fall_with_a_power_of_the_distance(behind, ratio):
    """Fifteen log units: an eighth. 255: a 64th, where Bayes' rule with right forms leaves nothing."""
    found = [hypothesis(), alone(NAMES[0], log_evidence=300.0), alone(NAMES[1], log_evidence=300.0 - behind)]
    chance = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), OTHERS)}
    assert chance[(NAMES[1],)] / chance[(NAMES[0],)] == pytest.approx(ratio)
    assert sum(chance.values()) == pytest.approx(1.0)


def test_where_forms_are_others_more_effects_need_more_evidence():
    """Two that describe the records as well as one have a tenth of its odds; an unknown one with it fewer still."""
    first, second = (made(name) for name in NAMES[:2])
    pair = hypothesis(*(Cause(each, each.forms[0]) for each in (first, second)), log_evidence=300.0)
    found = [hypothesis(unknown=300.0), alone(NAMES[0], log_evidence=300.0, unknown=300.0), pair]
    chance = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), OTHERS)}
    single = chance[(NAMES[0],)]
    assert chance[tuple(NAMES[:2])] / single == pytest.approx(OTHERS.two)
    assert chance[("unknown",)] / single == pytest.approx(OTHERS.unknown)
    assert chance[(NAMES[0], "unknown")] / single == pytest.approx(OTHERS.unknown_with_known)
    assert chance[()] / single == pytest.approx(301.0**-0.75)


def test_where_forms_are_others_an_unknown_effect_falls_with_an_exponential_of_the_distance():
    """It has no form that could be wrong: fifty log units to the power of 0.02 are one."""
    found = [hypothesis(unknown=250.0), alone(NAMES[0], log_evidence=300.0, unknown=200.0)]
    chance = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), OTHERS)}
    single = chance[(NAMES[0],)]
    assert chance[("unknown",)] / single == pytest.approx(np.exp(-1.0) * OTHERS.unknown)
    assert chance[(NAMES[0], "unknown")] / single == pytest.approx(np.exp(-2.0) * OTHERS.unknown_with_known)


@pytest.mark.parametrize(("lead", "cut"), [(8.0, True), (3.0, False)])
def test_an_unknown_effect_does_not_lead_where_known_ones_have_plainly_more_evidence(lead, cut):
    """Two effects describe the records, the single one is far off: without the limit the unknown leads by its odds."""
    first, second = (made(name) for name in NAMES[:2])
    pair = hypothesis(*(Cause(each, each.forms[0]) for each in (first, second)), log_evidence=900.0)
    found = [hypothesis(unknown=900.0 - lead), alone(NAMES[0], log_evidence=300.0), pair]
    free = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), OTHERS)}
    limited = replace(OTHERS, most_unknown=0.2)
    chance = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), limited)}
    assert max(free, key=free.get) == ("unknown",)
    if not cut:
        assert chance == pytest.approx(free)
        return
    assert chance[("unknown",)] == pytest.approx(0.2 * (1.0 - chance[()]))
    assert sum(chance.values()) == pytest.approx(1.0)
    assert chance[tuple(NAMES[:2])] / chance[(NAMES[0],)] == pytest.approx(free[tuple(NAMES[:2])] / free[(NAMES[0],)])


@pytest.mark.parametrize("most", [0.2, 0.0])
def test_the_limit_of_an_unknown_holds_where_a_gap_is_declared(most):
    """ "None" has a quarter of the weight before the test takes it away."""
    pair = hypothesis(*(Cause(made(name), made(name).forms[0]) for name in NAMES[:2]), log_evidence=10.0)
    found = [hypothesis(unknown=5.0), *(alone(name, log_evidence=-5.0) for name in NAMES[:2]), pair]
    weighed = given_a_gap(probabilities_of(found, len(NAMES), replace(OTHERS, most_unknown=most)), 1e-6)
    chance = {each.effects: each.probability for each in weighed}
    assert chance[("unknown",)] == pytest.approx(most, abs=1e-4)
    assert weighed[0].effects != ("unknown",)


def test_three_effects_have_odds_of_their_own():
    causes = [Cause(made(name), made(name).forms[0]) for name in NAMES[:3]]
    found = [hypothesis(), alone(NAMES[3], log_evidence=40.0), hypothesis(*causes, log_evidence=40.0)]
    chance = {each.effects: each.probability for each in probabilities_of(found, len(NAMES), OTHERS)}
    assert chance[tuple(NAMES[:3])] / chance[(NAMES[3],)] == pytest.approx(OTHERS.three)


def test_where_forms_are_others_a_rare_effect_is_as_probable_as_any():
    rare = replace(made("rare"), odds=0.2)
    found = [hypothesis(), hypothesis(Cause(rare, rare.forms[0]), log_evidence=9.0), alone(NAMES[0], log_evidence=9.0)]
    chance = {each.effects: each.probability for each in probabilities_of(found, 2, OTHERS)}
    assert chance[("rare",)] == pytest.approx(chance[(NAMES[0],)])
    told = {each.effects: each.probability for each in probabilities_of(found, 2, Tempered())}
    assert told[("rare",)] == pytest.approx(0.2 * told[(NAMES[0],)])


def test_the_form_and_place_with_the_most_evidence_stands_for_an_effect():
    rig = made("rig_fault", kind="rig")
    best = hypothesis(Cause(rig, rig.forms[0], ("r2",)), log_evidence=5.0)
    weighed = probabilities_of([hypothesis(), *every_place(rig), best], len(NAMES))
    assert weighed[0].hypothesis.records == ("r2",)


def test_several_starts_that_end_in_one_place_are_counted_once():
    once = probabilities_of([hypothesis(), alone(NAMES[0], log_evidence=1.0)], len(NAMES))
    often = probabilities_of([hypothesis(), *(alone(NAMES[0], log_evidence=e) for e in (1.0, 1.0, -4.0))], len(NAMES))
    assert [each.probability for each in often] == pytest.approx([each.probability for each in once])


def test_an_effect_that_could_not_be_solved_has_no_say():
    weighed = probabilities_of([hypothesis(), alone(NAMES[0], log_evidence=-np.inf), alone(NAMES[1])], len(NAMES))
    assert all(np.isfinite(each.probability) for each in weighed)
    assert sum(each.probability for each in weighed if each.effects == (NAMES[0],)) == 0.0


def test_a_combination_bears_its_names_sorted():
    effects = [made(name) for name in ("effect_b", "effect_a")]
    pair = hypothesis(*(Cause(effect, effect.forms[0]) for effect in effects), unknown=0.0)
    names = {each.effects for each in probabilities_of([hypothesis(), pair], len(NAMES))}
    assert {("effect_a", "effect_b"), ("effect_a", "effect_b", "unknown")} <= names


def named(*chances):
    none = hypothesis()
    return [Weighed((name,), chance, none) for name, chance in zip("abcdef", chances, strict=False)]


def test_an_answer_set_is_the_shortest_list_that_holds_its_probability():
    assert EVIDENCE.credible_set == 0.95
    assert answer_set(named(0.6, 0.3, 0.08, 0.02), 0.95) == (("a",), ("b",), ("c",))
    assert answer_set(named(0.97, 0.03), 0.95) == (("a",),)
    assert answer_set(named(0.5, 0.5), 0.95) == (("a",), ("b",))


def test_answer_sets_hold_the_truth_as_often_as_they_promise():
    """Truths drawn from made-up probabilities: 95 % or, since sets are whole, more."""
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(2000):
        chances = np.sort(rng.dirichlet(np.full(6, 0.5)))[::-1]
        truth = "abcdef"[rng.choice(6, p=chances)]
        held += (truth,) in answer_set(named(*chances.tolist()), 0.95)
    assert held / 2000 >= 0.95 - 3.0 * np.sqrt(0.05 * 0.95 / 2000)


def test_a_rare_effect_needs_more_evidence_alone_and_unseen():
    usual, rare = made("usual"), replace(made("rare"), odds=0.2)
    found = [hypothesis(), *(hypothesis(Cause(each, each.forms[0])) for each in (usual, rare))]
    chances = {each.effects: each.probability for each in probabilities_of(found, 6)}
    assert chances[("rare",)] == pytest.approx(0.2 * chances[("usual",)])
    assert effect_count([usual, *[rare] * 5]) == 2
    beside = with_unseen([Weighed((NAMES[0],), 1.0, hypothesis())], [made(NAMES[0]), usual, rare])
    chances = {each.effects: each.probability for each in beside}
    assert chances[(NAMES[0], "rare")] == pytest.approx(0.2 * chances[(NAMES[0], "usual")])


def test_effects_that_were_not_tried_keep_their_share_of_the_prior_and_do_not_lead():
    effects = [*(made(name) for name in NAMES[:4]), replace(made(NAMES[4]), odds=0.5)]
    base, first, second = hypothesis(), alone(NAMES[0]), alone(NAMES[1])
    weighed = [Weighed((NAMES[0],), 0.9, first), Weighed((NAMES[1],), 0.08, second), Weighed((), 0.02, base)]
    assert with_untried(weighed, effects, (), base) == weighed
    found = with_untried(weighed, effects, NAMES[1:5], base)
    share = {each.effects: each.probability for each in found}
    each_one = 1.0 / (4.5 * (1.0 + EVIDENCE.unknown_effect / EVIDENCE.one_effect))
    tried = 1.0 - 3.5 * each_one
    assert share[(NAMES[0],)] == pytest.approx(0.9 * tried)
    assert share[(NAMES[1],)] == pytest.approx(0.08 * tried + each_one)
    assert share[(NAMES[2],)] == pytest.approx(each_one)
    assert share[(NAMES[4],)] == pytest.approx(0.5 * each_one)
    assert share[()] == pytest.approx(0.02 * tried)
    assert [each.hypothesis for each in found[:2]] == [first, second]
    even = with_untried([Weighed((), 0.6, base), Weighed((UNKNOWN,), 0.4, base)], effects, NAMES[:5], base)
    assert even[0].effects == ()
    assert sum(each.probability for each in even) == pytest.approx(1.0)
    assert [each.probability for each in even] == sorted((each.probability for each in even), reverse=True)
