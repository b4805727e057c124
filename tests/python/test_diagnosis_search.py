"""What a search must never do: leave more with a further effect, or lead with what a part of it beats."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from bench import waiting

import probation
from campaigns.few_records import damage, few_records, offset
from probation.diagnosis import diagnose
from probation.diagnosis.beginnings import first_of_each
from probation.diagnosis.causes import causes_of
from probation.diagnosis.hypothesis import Hypothesis
from probation.diagnosis.refitting import Refitting
from probation.diagnosis.search import Search
from probation.effects.cause import Cause
from probation.effects.registry import effect, effects
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.candidate import Extended, WhitenedColumns, cause_key
from probation.inference.refit import MOST_STEPS, refit
from probation.inference.remembering import RememberingModel
from probation.inference.screen import screen
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.span import span_of
from probation.records.record import Noise
from probation.settings.search import SEARCH

NOISE, SAMPLES = 0.04, 120
CONSIDERED = ("damage", "structural_softening", "force_offset", "strain_offset")


def campaign(seed):
    """Three ramps of a material that loses section, in a rig whose strain starts late in one of them."""
    random = np.random.default_rng(seed)
    law = probation.Law(unrelaxed_modulus=random.uniform(500.0, 2000.0), tau_max=30.0, hardening_modulus=2.0)
    loss, late, offset = random.uniform(0.2, 0.5), random.uniform(0.005, 0.02), random.uniform(0.5, 2.0)
    records = []
    for name, rate in (("slow", 1e-3), ("middle", 5e-3), ("fast", 2e-2)):
        time = np.linspace(0.0, 0.4 / rate, SAMPLES)
        strain = rate * time
        stress = law.stress(time, strain, "exact") * (1.0 - loss * strain**2) + NOISE * random.standard_normal(SAMPLES)
        if name == "fast":
            strain, stress = strain + late, stress + offset
        records.append(probation.Record(id=name, time=time, true_strain=strain, true_stress=stress))
    alike = probation.Specimens(scatter="none")
    return probation.Campaign(name="search", records=tuple(records), specimens=alike)


def searched(seed):
    """A search that has been run, and what it found."""
    chosen = effects(CONSIDERED)
    made = campaign(seed)
    base = base_fit(made, plain_fit(made, "sa3", None)).screened(chosen)
    search = Search(base, chosen)
    found = search.run()
    return search, found


def keys(found):
    return frozenset(cause_key(each) for each in found.causes)


def two_effects():
    """Damage in all records, an offset of the force in one."""

    def both(name, time, strain, stress):
        return offset(0.8, "middle")(name, time, strain, damage(0.05)(name, time, strain, stress))

    return few_records(both)


def specimens_that_differ(seed=0, loss=0.3, late=2.0):
    """The same two, in six specimens that differ by 2 % in E_u and by 3 % in tau_max and G, two at each rate."""
    random, records = np.random.default_rng(seed), []
    for rate, copy in itertools.product((1e-3, 5e-3, 2e-2), "ab"):
        e_u, tau, g = 1.0 + np.array([0.02, 0.03, 0.03]) * random.standard_normal(3)
        law = probation.Law(unrelaxed_modulus=1500.0 * e_u, tau_max=30.0 * tau, hardening_modulus=2.0 * g)
        time = np.linspace(0.0, 0.4 / rate, SAMPLES)
        strain, name = rate * time, f"{rate:g}{copy}"
        lost = law.stress(time, strain, "exact") * (1.0 - loss * strain**2)
        stress = offset(late, "0.005b")(name, time, strain, lost)
        stress = stress + NOISE * random.standard_normal(SAMPLES)
        records.append(
            probation.Record(id=name, time=time, true_strain=strain, true_stress=stress, noise=Noise(strain=0.0))
        )
    return probation.Campaign(name="differ", records=tuple(records))


@pytest.mark.parametrize("made", [two_effects, specimens_that_differ])
def test_nothing_less_beats_what_leads_in_the_end(made, monkeypatch):
    """Of a whole diagnosis with the full catalogue, as `causes_of` hands it on.

    Refitted on the same base fit: every part of the leader from its own values, and every single cause from the start
    that the search has for it.
    """
    handed_on = []

    def kept(*given, **options):
        handed_on.append(causes_of(*given, **options))
        return handed_on[-1]

    monkeypatch.setattr(diagnose, "causes_of", kept)
    answer = diagnose.diagnose(made(), design=False)
    assert answer.best.effects == ("damage", "force_offset")
    [causes] = handed_on
    assert causes.base.scatter.any == (made is specimens_that_differ)

    least = {}
    for each in causes.found:
        least[keys(each)] = min(least.get(keys(each), np.inf), each.refit.chi_square)
    for part, whole in itertools.permutations(least, 2):
        if part < whole:
            assert least[whole] <= least[part] + 2.0 * SEARCH.settled

    search = Search(causes.base, causes.considered)
    leader, model = causes.nearest, causes.nearest.refit.model
    base, values = model.split(leader.refit.parameters)
    jobs = []
    for size in range(1, len(values)):
        for part in itertools.combinations(values, size):
            smaller = model.with_causes(cause for cause, _ in part)
            jobs.append((smaller, smaller.parameters(base, *(own for _, own in part))))
    before = causes.base.refit
    for each in first_of_each(search.candidates()):
        jobs.append((causes.base.model.with_causes([each.cause]), np.concatenate([before.parameters, each.values])))
    judged = []
    for smaller, start in jobs:
        try:
            fit = search.refitting.refit(smaller, start, MOST_STEPS)
            found = Hypothesis(fit, search.refitting.evidence(fit))
        except UNSOLVABLE:
            continue
        judged.append(found.as_reached(search.found[0]).evidence.log_evidence)
    assert len(judged) > 100
    assert max(judged) < leader.evidence.log_evidence


@pytest.mark.parametrize("seed", [0, 1, 4])
def test_no_effect_that_is_added_leaves_more_and_no_part_of_the_leader_beats_it(seed):
    search, found = searched(seed)
    least = {}
    for each in found:
        least[keys(each)] = min(least.get(keys(each), np.inf), each.refit.chi_square)
    for part, whole in itertools.permutations(least, 2):
        if part < whole:
            assert least[whole] <= least[part] + 2.0 * SEARCH.settled

    leader = search.ranked()[0]
    assert len(leader.causes) > 1
    base, values = leader.refit.model.split(leader.refit.parameters)
    for size in range(1, len(values)):
        for part in itertools.combinations(values, size):
            model = leader.refit.model.with_causes(cause for cause, _ in part)
            start = model.parameters(base, *(own for _, own in part))
            again = refit(search.base.problem.with_model(model), start)
            (judged,) = search._judged([again])
            assert judged.evidence.log_evidence <= leader.evidence.log_evidence


def test_the_same_effect_in_another_record_is_not_the_end_of_the_search():
    """Offsets of the force of their own in two of four ramps, and a material that loses section: all three are told."""
    random = np.random.default_rng(5)
    law = probation.Law(unrelaxed_modulus=1500.0, tau_max=30.0, hardening_modulus=2.0)
    offsets, records = {"b": 3.0, "d": -2.0}, []
    for name, rate in (("a", 1e-3), ("b", 3e-3), ("c", 1e-2), ("d", 2e-2)):
        time = np.linspace(0.0, 0.4 / rate, SAMPLES)
        stress = law.stress(time, rate * time, "exact") * (1.0 - 0.1 * (rate * time) ** 2) + offsets.get(name, 0.0)
        stress = stress + NOISE * random.standard_normal(SAMPLES)
        records.append(probation.Record(id=name, time=time, true_strain=rate * time, true_stress=stress))
    made = probation.Campaign(name="two", records=tuple(records), specimens=probation.Specimens(scatter="none"))
    chosen = effects(("damage", "force_offset"))
    base = base_fit(made, plain_fit(made, "sa3", None)).screened(chosen)
    search = Search(base, chosen)
    search.run()
    leader = search.ranked()[0]
    assert leader.effects == ("damage", "force_offset")
    assert {cause.records for cause in leader.causes} == {None, ("b",), ("d",)}


@pytest.mark.parametrize("seed", range(3))
def test_what_is_as_good_as_the_first_effect_by_itself_is_tried_with_the_second(seed):
    """A twin of damage, under another name: without the offset there is nothing to choose, nor is there with it."""
    chosen = (*effects(CONSIDERED), replace(effect("damage"), name="twin"))
    made = campaign(seed)
    base = base_fit(made, plain_fit(made, "sa3", None)).screened(chosen)
    search = Search(base, chosen)
    search.run()
    standing = {each.effects: each.evidence.log_evidence for each in search.ranked()}
    assert {"damage", "twin"} & {*search.ranked()[0].effects}
    assert standing[("damage", "force_offset")] == pytest.approx(standing[("force_offset", "twin")], abs=2.0)


@pytest.mark.parametrize("seed", range(3))
def test_the_best_of_every_number_of_effects_is_judged_again(seed):
    """However far behind: what a second effect gains may be an error of the first one's form, and not count."""
    search, _ = searched(seed)
    first, second = search.ranked(2)[0], search.ranked(1)[0]
    assert first.evidence.log_evidence > second.evidence.log_evidence + SEARCH.hopeless
    again = search._near_the_best_of_as_many(SEARCH.hopeless)
    assert {first.effects, second.effects} <= {each.effects for each in again}


def test_many_forms_of_one_effect_leave_room_for_the_others_that_are_judged_again(monkeypatch):
    """Of every single effect in the race the best form comes first, however few hypotheses are judged again."""
    search, _ = searched(0)
    alone = search.ranked(1)
    forms_of_the_best = [each for each in search.found[1:] if each.effects == alone[0].effects]
    search.found += forms_of_the_best * SEARCH.reconsidered
    monkeypatch.setattr("probation.diagnosis.search.SEARCH", replace(SEARCH, reconsidered=1, slack=1e6))
    again = [each.effects for each in search._near_the_best_of_as_many(SEARCH.hopeless) if len(each.effects) == 1]
    assert len(alone) > 1
    assert again == [each.effects for each in alone]


def test_a_linearised_gain_that_no_refit_reaches_keeps_no_effect_out(monkeypatch):
    """An offset of the force looks millions of log units better than it turns out to be."""
    chosen, made = effects(CONSIDERED), campaign(2)
    base = base_fit(made, plain_fit(made, "sa3", None)).screened(chosen)
    candidates = Search.candidates

    def boasting(self):
        for each in candidates(self):
            yield replace(each, gain=1e8) if each.cause.effect.name == "force_offset" else each

    monkeypatch.setattr(Search, "candidates", lambda search: list(boasting(search)))
    with Search(base, chosen) as search:
        search._singles()
        assert ("damage",) not in {hypothesis.effects for hypothesis in search.found}
        search._passed_over()
        assert ("damage",) in {hypothesis.effects for hypothesis in search.found}


def test_specimens_do_not_hold_what_a_strong_gap_leaves():
    """Their deviations cost little beside a gap of forty times the noise; a refit must not end where they hold it."""
    made = waiting.campaign(*waiting.DIAGNOSED["strong gap"])
    base = base_fit(made, plain_fit(made))
    assert base.scatter.any
    cause = Cause(effect("damage"), effect("damage").forms[0])
    model = base.model.with_causes([cause])
    start = model.parameters(base.parameters, (0.3, *cause.form.typical[1:]))

    def left(parameters):
        return np.sqrt(np.mean(model.residual(parameters) ** 2))

    anywhere = refit(base.problem.with_model(model), start)
    assert left(anywhere.parameters) > 3.0 * left(start)
    [found] = Search(base, effects(("damage",)), 1)._solved([(model, start)], MOST_STEPS)
    assert left(found.parameters) < 1.3 * left(start)


@pytest.mark.parametrize("seed", range(3))
def test_a_right_effect_is_reached_though_specimens_differ(seed):
    """A loss of 0.4 at a strain of 1, as the square of the strain; specimens alike would bear it out much worse."""
    made, [considered] = specimens_that_differ(seed, loss=0.4, late=0.0), effects(("damage",))
    base = base_fit(made, plain_fit(made, "sa3", None))
    model = base.model.with_causes([Cause(considered, considered.form("growing"), None)])
    refitting = Refitting(base, [considered], 1)
    found = refitting.refit(model, model.parameters(base.parameters, (0.1, 1.0)), 40)
    refitting.close()
    count = len(base.whitened)
    assert found.chi_square < count + 3.0 * np.sqrt(2.0 * count) < 0.1 * base.refit.chi_square
    assert found.parameters[-2:] == pytest.approx([0.42, 2.05], rel=0.1)


def test_variants_of_a_form_are_for_the_search_and_not_for_the_test_for_a_gap():
    """More directions would be found in more noise."""
    chosen = effects(["damage", "force_drift"])
    made = campaign(0)
    base = base_fit(made, plain_fit(made, "sa3", None)).screened(chosen)
    variants = {form.name for each in chosen for form in each.forms if form.variant}
    assert variants == {"beyond_a_strain", "by_stress", "by_work", "logarithmic", "settling"}
    assert variants.isdisjoint(column.cause.form.name for column in base.signals)
    sought = {candidate.cause.form.name for candidate in Search(base, chosen).candidates()}
    assert sought == {form.name for each in chosen for form in each.forms}


@pytest.mark.parametrize("shared", [False, True])
def test_candidates_record_by_record_are_those_of_the_columns(shared):
    """Where records are of one specimen, too: then what is white in one of them is not so jointly with the others."""
    campaign = specimens_that_differ()
    if shared:
        records = [replace(record, specimen_id=record.id[-1]) for record in campaign.records]
        campaign = replace(campaign, records=tuple(records))
    base = base_fit(campaign, plain_fit(campaign))
    assert bool(base.whitener.shared[0].shape[1]) == shared
    span = span_of(base.refit.jacobian)
    residual = base.model.residual(base.parameters)
    columns = screen(base.model, base.parameters, effects(), residual=residual)
    expected = WhitenedColumns.of(columns, base.whitener, len(residual)).candidates(base.refit.residual, span)
    refit = base.refit
    extended = Extended(base.model, base.parameters, effects(), base.whitener, refit.residual, refit.jacobian)
    [found] = Refitting(base, effects(), 1).candidates([extended])
    assert len(found) == len(expected) > 300
    found.sort(key=_place)
    expected.sort(key=_place)
    largest = max(each.gain for each in expected)
    for one, other in zip(found, expected, strict=True):
        assert cause_key(one.cause) == cause_key(other.cause)
        assert one.gain == pytest.approx(other.gain, rel=1e-6, abs=1e-6 * largest)
        assert one.values == pytest.approx(other.values, rel=1e-6, abs=1e-9)


def _place(candidate):
    return *map(str, cause_key(candidate.cause)), candidate.values[1:], candidate.gain


def test_a_refit_with_another_noise_solves_nothing_again(monkeypatch):
    campaign = two_effects()
    base = base_fit(campaign, plain_fit(campaign))
    plain = base.model.with_causes([Cause(effect("damage"), effect("damage").forms[0])])
    start = plain.parameters(base.parameters, (0.1, *plain.causes[0].form.typical[1:]))
    model = RememberingModel(plain)
    ended = refit(base.problem.with_model(model), start)
    noises = [noise.scaled(2.0) for noise in base.whitener.noises]
    expected = refit(base.problem.with_noises(noises).with_model(plain), ended.parameters, most_steps=0)
    monkeypatch.setattr(model.law, "sensitivity", None)
    monkeypatch.setattr(model.law, "stress", None)
    again = refit(base.problem.with_noises(noises).with_model(model), ended.parameters, most_steps=0)
    np.testing.assert_array_equal(again.residual, expected.residual)
    np.testing.assert_array_equal(again.jacobian, expected.jacobian)
    assert again.chi_square == pytest.approx(ended.chi_square / 4.0, rel=1e-9)
