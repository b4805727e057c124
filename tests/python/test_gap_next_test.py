"""The next test: what can be planned, what explanations predict of it, and whether it finds the right one as often."""

import json
from contextlib import suppress

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.special import ndtr

import probation
from probation.answers import json_answer
from probation.design.next_test import next_test
from probation.design.planned_record import planned_noise, planned_view, white_noise
from probation.design.planned_tests import Laboratory, planned_tests
from probation.design.predicted import RivalExplanation, RivalPrediction, Weighing, outcome, predictions
from probation.effects.cause import Cause, cause
from probation.effects.effect import Effect, EffectParameter, Form
from probation.effects.record_view import views_of
from probation.effects.registry import effects
from probation.inference.callable_law import CallableLaw
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.unsolvable import UNSOLVABLE
from probation.law.companion import WEISSENBERG_AS_PRINTED
from probation.records.record import Record
from probation.settings.design import DESIGN

LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
SAMPLES = 200


def ramp(name, rate, strain, samples=SAMPLES):
    time = np.linspace(0.0, strain / rate, samples)
    return Record(id=name, time=time, true_strain=rate * time, true_stress=np.zeros(samples))


def two_ramps(law=None):
    records = (ramp("slow", 0.001, 1.2), ramp("fast", 0.01, 1.2))
    views = views_of(probation.Campaign(name="two", records=records))
    return CampaignModel(law or DnlrLaw(LAW), views)


def elastic_bar(*records):
    """Stress = 1000 MPa strain."""
    law = CallableLaw(
        lambda time, true_strain, parameters, modification: parameters[0] * true_strain,
        names=("modulus_MPa",),
        starts=(1000.0,),
        lower=(0.0,),
        upper=(1e5,),
    )
    return CampaignModel(law, views_of(probation.Campaign(name="bar", records=records)))


def made_up(name, shape, scale=100.0):
    """An effect of a rig that adds a * shape(elapsed over duration) to the stress."""
    form = Form(
        "only",
        (EffectParameter("size_MPa", "MPa", -1e3, 1e3, scale, "made up"),),
        recorded_stress=lambda view, values, stress: stress + values[0] * shape(view.elapsed / view.duration),
    )
    return Effect(name, name, "Made up.", "none", "here", "rig", (form,))


def measured(model, truth, values, sigma, seed=1):
    """The model on data that a cause made, with noise."""
    made = model.with_causes([truth])
    stress = made.predict(made.parameters(model.start, values))
    noise = np.random.default_rng(seed)
    return model.on(
        [view.with_data(stress[view.id] + sigma * noise.standard_normal(len(view.data))) for view in model.views]
    )


def fitted(model, cause, sigma, start):
    """Parameters and cost (half chi squared) of a model with one cause, by scipy."""
    extended = model.with_causes([cause])
    scale = np.append(np.abs(model.start), cause.form.typical)
    found = least_squares(
        lambda p: extended.residual(p) / sigma,
        start,
        jac=lambda p: extended.jacobian(p) / sigma,
        x_scale=scale,
        xtol=1e-7,
        ftol=1e-9,
    )
    return extended, found


# ---- what can be planned


def test_planned_tests_stay_within_what_a_laboratory_does():
    """A decade beyond the rates used, no further than the strains used, two days, and every history is one."""
    model = two_ramps()
    lab = Laboratory.of(model, model.start)
    tests = planned_tests(lab)
    assert {test.name for test in tests} == {
        "zero_load_hold",
        "repeat",
        "slower_ramp",
        "faster_ramp",
        "rate_jump_up",
        "rate_jump_down",
        "dwell",
        "unload_reload",
        "dead_weight",
        "double_gauge_length",
    }
    for test in tests:
        assert np.all(np.diff(test.time) > 0.0)
        assert test.duration <= DESIGN.longest_test
        assert np.max(test.true_strain) <= 1.2 + 1e-12
        assert 190 <= len(test.time) <= 210
        if test.name not in ("zero_load_hold", "dead_weight"):
            rate = np.abs(np.diff(test.true_strain) / np.diff(test.time))
            assert 0.99e-4 <= np.median(rate[rate > 0.0]) <= 1.01e-1
        assert f"{len(test.time)} samples" in test.what


def test_a_rate_jump_jumps_where_it_says():
    model = two_ramps()
    test = next(t for t in planned_tests(Laboratory.of(model, model.start)) if t.name == "rate_jump_up")
    rate = np.diff(test.true_strain) / np.diff(test.time)
    assert len(test.jumps) == 1
    np.testing.assert_allclose(rate[: test.jumps[0]], 0.001, rtol=1e-9)
    np.testing.assert_allclose(rate[test.jumps[0] :], 0.01, rtol=1e-9)
    assert test.what.startswith("Stretch at 0.001 /s to a true strain of 0.6, then at 0.01 /s to 1.2")


def test_unloading_turns_where_the_load_is_gone():
    """The stress at the turn is a small part of the one at which unloading began."""
    model = two_ramps()
    lab = Laboratory.of(model, model.start)
    for test in (t for t in planned_tests(lab) if t.name == "unload_reload"):
        stress = LAW.stress(test.time, test.true_strain, scheme="exact")
        down, up = test.jumps
        assert abs(stress[up]) < 0.1 * stress[down]


def test_a_dead_weight_hangs_with_a_constant_force():
    """The stress that the law gives along the planned strain, over the section there is, by another scheme."""
    model = two_ramps()
    test = next(t for t in planned_tests(Laboratory.of(model, model.start)) if t.name == "dead_weight")
    force = LAW.stress(test.time, test.true_strain, scheme="exact") * np.exp(-test.true_strain)
    hanging = force[len(force) // 4 :]
    np.testing.assert_allclose(hanging, np.median(hanging), rtol=0.02)
    assert f"dead weight of {np.median(hanging):.2g} MPa" in test.what


@pytest.mark.parametrize("effect", effects(), ids=lambda each: each.name)
def test_every_effect_can_be_predicted_in_every_planned_test(effect):
    """A test that is yet to be done has neither a record nor noise of its strain."""
    model = two_ramps()
    for test in planned_tests(Laboratory.of(model, model.start)):
        view = planned_view("next", test.time, test.true_strain, test.jumps, model.views)
        for form in effect.forms:
            placed = None if "all" in effect.placements(form) else ("next",)
            with suppress(*UNSOLVABLE):  # an effect may be too large for the test
                alone = CampaignModel(DnlrLaw(LAW), (view,), [Cause(effect, form, placed)])
                stress = alone.predict(alone.parameters(alone.start[:3], form.typical))["next"]
                assert np.isfinite(stress).all(), (test.name, form.name)


def test_nothing_is_planned_from_records_without_strain():
    time = np.linspace(0.0, 10.0, 50)
    still = Record(id="still", time=time, true_strain=np.zeros(50), true_stress=np.zeros(50))
    model = elastic_bar(still)
    with pytest.raises(probation.InputError, match="no record that is stretched"):
        Laboratory.of(model, model.start)


def test_force_noise_grows_in_a_planned_test_as_it_does_in_the_records():
    """Noise of 0.1 MPa in force: 0.1 e^strain in true stress, whatever the strains of the records."""
    model = elastic_bar(ramp("one", 0.01, 1.2))
    stretch = model.views[0].stretch
    rms = np.sqrt(np.mean(stretch**2))
    (white,) = white_noise(model.views, 0.1 * rms)
    force = type(white)(**{**vars(white), "profile": stretch / rms, "growth": "force"})
    view = planned_view("next", np.linspace(0.0, 1.0, 11), np.linspace(0.0, 0.5, 11), (), model.views)
    noise = planned_noise(view, [force], model.views)
    np.testing.assert_allclose(noise.deviation, 0.1 * np.exp(np.linspace(0.0, 0.5, 11)), rtol=1e-9)


# ---- how often it finds the right one, in closed form


def way(owner, mean, spread=0.0, weight=1.0):
    """Four samples; everything happens along the first."""
    mean, spread = np.array([mean, 0.0, 0.0, 0.0]), np.array([[spread], [0.0], [0.0], [0.0]])
    return RivalPrediction(owner, weight, mean, spread)


def right(ways, prior, group=None):
    return outcome(ways, np.array(prior), group or list(range(len(prior))), draws=20_000, seed=0)


def test_two_points_apart_are_found_as_a_normal_distribution_says():
    """Equal chances, distance d: Phi(d/2); both uncertain by s along it: Phi(d/2/sqrt(1 + s^2))."""
    assert right([way(0, 0.0), way(1, 3.0)], [0.5, 0.5]).probability == pytest.approx(ndtr(1.5), abs=0.005)
    found = right([way(0, 0.0, 2.0), way(1, 3.0, 2.0)], [0.5, 0.5])
    assert found.probability == pytest.approx(ndtr(1.5 / np.sqrt(5.0)), abs=0.005)
    assert found.pairwise[0, 1] == pytest.approx(ndtr(1.5 / np.sqrt(5.0)), abs=0.01)


def test_a_test_that_says_nothing_leaves_the_chances_as_they_are():
    found = right([way(0, 1.0), way(1, 1.0)], [0.7, 0.3])
    assert found.probability == pytest.approx(0.7)
    assert found.information == pytest.approx(0.0, abs=1e-9)


def test_one_more_record_tells_little_of_what_is_far_apart_already():
    """900 log units, of which odds keep a power, are no other at 950: a repeat does not tell what forms may hide."""
    ways, prior = [way(0, 0.0), way(1, 10.0)], np.array([0.7, 0.3])
    in_full = outcome(ways, prior, [0, 1], draws=4000, seed=0)
    assert in_full.probability > 0.999
    weighing = Weighing(np.array([900.0, 0.0]), lambda distance: -0.9 * np.log1p(distance))
    found = outcome(ways, prior, [0, 1], draws=4000, seed=0, weighing=weighing)
    assert found.probability == pytest.approx(0.7, abs=0.02)


def test_where_evidence_counts_to_a_power_two_points_are_as_near_as_through_more_noise():
    """A power of 1/4 of two normal densities is that of twice the standard deviation."""
    ways, prior = [way(0, 0.0), way(1, 3.0)], np.array([0.5, 0.5])
    weighing = Weighing(np.zeros(2), lambda distance: -0.25 * distance)
    found = outcome(ways, prior, [0, 1], draws=20_000, seed=0, weighing=weighing)
    x = np.random.default_rng(1).standard_normal(200_000)
    expected = np.mean(np.maximum(*(1.0 / (1.0 + np.exp(sign * 0.25 * (3.0 * x - 4.5))) for sign in (1.0, -1.0))))
    assert found.probability == pytest.approx(expected, abs=0.005)


def test_explanations_with_the_same_effects_are_one_answer():
    found = right([way(0, 0.0), way(1, 0.0), way(2, 50.0)], [0.3, 0.3, 0.4], [0, 0, 1])
    assert found.probability == pytest.approx(1.0)
    assert found.information == pytest.approx(-0.6 * np.log2(0.6) - 0.4 * np.log2(0.4), abs=1e-6)


def test_a_fault_that_comes_back_in_half_of_the_cases_is_found_in_three_of_four():
    """Material (1/2) and returning fault (1/4) look the same, and material is the guess; gone (1/4) is found."""
    ways = [way(0, 0.0), way(1, 0.0, weight=0.5), way(1, 50.0, weight=0.5)]
    assert right(ways, [0.5, 0.5]).probability == pytest.approx(0.75)


def test_a_fault_of_one_record_may_come_back_and_a_slip_may_not():
    model = two_ramps()
    noises = white_noise(model.views, 0.5)
    lab = Laboratory.of(model, model.start)
    test = next(t for t in planned_tests(lab) if t.repeats == "fast")
    explained = []
    for acting, values in (
        (cause("force_offset", None, "fast"), (2.0,)),
        (cause("grip_slip", None, "fast"), (0.01, 0.5, 0.0)),
        (cause("force_offset"), (2.0,)),
    ):
        extended = model.with_causes([acting])
        explained.append(
            RivalExplanation.of(extended, extended.parameters(model.start, values), 1.0, (acting.effect.name,), noises)
        )
    ways = predictions(test, model, model.start, explained, noises)
    assert [(each.owner, each.weight) for each in ways] == [(0, 0.5), (0, 0.5), (1, 1.0), (2, 1.0)]
    base = model.predict(model.start)["fast"] / 0.5
    offset = 2.0 / 0.5 * np.exp(test.true_strain)
    for each, expected in zip(ways, (base, base + offset, base, base + offset), strict=True):
        np.testing.assert_allclose(each.mean, expected, atol=1e-6)


def test_twice_the_gauge_length_halves_what_the_frame_adds():
    """Small compliances answer linearly: half the departure from the base law that a test of usual length shows."""
    model = two_ramps()
    noises = white_noise(model.views, 1.0)
    test = next(t for t in planned_tests(Laboratory.of(model, model.start)) if t.name == "double_gauge_length")
    usual = type(test)(**{**vars(test), "gauge_length": 1.0})
    extended = model.with_causes([cause("machine_compliance", "true_strain")])
    none = RivalExplanation.of(model, model.start, 1.0, (), noises)
    frame = RivalExplanation.of(
        extended, extended.parameters(model.start, (1e-8,)), 1.0, ("machine_compliance",), noises
    )
    at = {each: predictions(each, model, model.start, [none, frame], noises) for each in (test, usual)}
    long, short = (at[each][1].mean - at[each][0].mean for each in (test, usual))
    np.testing.assert_allclose(long, 0.5 * short, atol=1e-3 * np.max(np.abs(short)))


def test_what_records_leave_open_of_a_parameter_is_what_least_squares_leaves():
    """Elastic bar: variance of the modulus sigma^2 / sum strain^2; a prior of 1 on an amplitude no record tells of."""
    model = elastic_bar(ramp("one", 0.01, 0.1))
    noises = white_noise(model.views, 0.5)
    silent = made_up("silent", np.zeros_like, scale=1.0)
    extended = model.with_causes([cause(silent)])
    known = RivalExplanation.of(extended, extended.start, 1.0, ("silent",), noises)
    covariance = known.root @ known.root.T
    strain = model.views[0].true_strain
    np.testing.assert_allclose(np.diag(covariance), [0.25 / np.sum(strain**2), 1.0], rtol=1e-9)


# ---- the whole


def test_fewer_than_two_answers_need_no_test():
    model = two_ramps()
    noises = white_noise(model.views, 0.5)
    once = (model, model.start, 0.6, ())
    assert next_test(model, [once], noises=noises) is None
    assert next_test(model, [once, once], noises=noises) is None


def test_bad_input_is_named():
    model = two_ramps()
    noises = white_noise(model.views, 0.5)
    other = model.with_causes([cause("force_offset")])
    pair = [(model, model.start, 1.0, ()), (other, other.start, 0.0, ("force_offset",))]
    with pytest.raises(probation.InputError, match="noises: found 1, expected one for each of 2 records"):
        next_test(model, pair, noises=noises[:1])
    with pytest.raises(probation.InputError, match="probabilities"):
        next_test(model, pair, noises=noises)


SIGMA = 0.4


@pytest.fixture(scope="module")
def drift_or_hardening():
    """Two ramps with a drift in time: the drift, or a hardening that falls with the rate, explain them about alike."""
    causes = [cause("force_drift", "in_time"), cause("rate_dependent_hardening", "path")]
    model = measured(two_ramps(), causes[0], (2.5e-4,), SIGMA)
    fits = [fitted(model, cause, SIGMA, np.append(model.start, 0.0)) for cause in causes]
    costs = np.array([found.cost for _, found in fits])
    chances = np.exp(costs.min() - costs) / np.sum(np.exp(costs.min() - costs))
    explanations = [
        (extended, found.x, float(chance), (extended.causes[0].effect.name,))
        for (extended, found), chance in zip(fits, chances, strict=True)
    ]
    return model, explanations, next_test(model, explanations, noises=white_noise(model.views, SIGMA))


def test_drift_of_the_force_and_hardening_are_discriminated_without_a_specimen(drift_or_hardening):
    """The zero-load hold shows the drift alone, and takes no specimen."""
    _, explanations, found = drift_or_hardening
    assert max(chance for *_, chance, _ in explanations) < 0.95
    assert found.probability_before == pytest.approx(max(chance for *_, chance, _ in explanations))
    assert found.test.name == "zero_load_hold"
    assert found.probability_after > 0.95
    assert sorted(found.separates) == [["force_drift"], ["rate_dependent_hardening"]]
    assert found.what.startswith("Before the next test record the force while the specimen hangs free of load")
    assert "rate-dependent hardening" in found.what  # its title, not its name
    answer = json.loads(json_answer("probation.next_test/1", found.to_dict()))
    assert set(answer) >= {"what", "separates", "probability_after"}
    assert len(answer["ranking"]) == len(found.ranking)


@pytest.mark.parametrize("name", ["faster_ramp", "zero_load_hold"])
def test_simulated_tests_find_the_right_one_as_often_as_predicted(drift_or_hardening, name):
    """A truth drawn from what the records leave open, the test simulated at three times the noise for an uncertain
    outcome, both refitted by scipy to old and new records; the smaller cost, with its Occam factor, wins.
    """
    model, explanations, _ = drift_or_hardening
    rng, draws = np.random.default_rng(11), 150
    noises = white_noise(model.views, SIGMA)
    known = [RivalExplanation.of(*each, noises) for each in explanations]
    test = next(t for t in planned_tests(Laboratory.of(model, model.start)) if t.name == name)
    rough = 3.0
    ways = [each.through(rough) for each in predictions(test, model, model.start, known, noises)]
    prior = np.array([each.probability for each in known])
    expected = outcome(ways, prior, [0, 1], draws=4000, seed=0).probability
    new = planned_view("next", test.time, test.true_strain, test.jumps, model.views)
    deviation = np.append(np.full(len(model.data), SIGMA), np.full(len(new.data), rough * SIGMA))
    wins = 0
    for _ in range(draws):
        truth = known[int(rng.random() > prior[0])]
        parameters = truth.parameters + truth.root @ rng.standard_normal(len(truth.parameters))
        stress = truth.model.on([new]).predict(parameters)["next"]
        both = [*model.views, new.with_data(stress + rough * SIGMA * rng.standard_normal(len(stress)))]
        scores = []
        for each in known:
            extended = each.model.on(both)
            scale = np.append(np.abs(model.start), each.model.causes[0].form.typical)
            found = least_squares(
                lambda p, m=extended: m.residual(p) / deviation,
                each.parameters,
                jac=lambda p, m=extended: m.jacobian(p) / deviation[:, None],
                x_scale=scale,
                ftol=1e-7,
            )
            information = np.linalg.slogdet((found.jac * scale).T @ (found.jac * scale))[1]
            before = np.linalg.slogdet(each.root / scale[:, None])[1]
            scores.append(-found.cost - 0.5 * information - before)
        wins += known[int(np.argmax(scores))] is truth
    assert 0.55 < expected < 0.985
    assert wins / draws == pytest.approx(expected, abs=3.0 * np.sqrt(expected * (1.0 - expected) / draws))


def test_the_engine_s_rate_dependent_law_is_planned_for_too():
    law = probation.Law(unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=WEISSENBERG_AS_PRINTED)
    model = two_ramps(DnlrLaw(law))
    first, second = (model.with_causes([cause(name)]) for name in ("damage", "delayed_hardening"))
    found = next_test(
        model,
        [
            (first, first.parameters(model.start, (0.05, 0.1)), 0.5, ("damage",)),
            (second, second.parameters(model.start, (0.5,)), 0.5, ("delayed_hardening",)),
        ],
        noises=white_noise(model.views, 5.0),
    )
    assert found is not None
    assert 0.5 <= found.probability_after <= 1.0
    assert found.ranking[0].test is found.test


def elastic_choice(sigma, shapes):
    """Two made-up effects of 1 MPa on an elastic bar, equally probable, and no effect at all with a tenth."""
    model = elastic_bar(ramp("one", 0.01, 0.1))
    explanations = [(model, model.start, 0.1, ())]
    for name, shape in zip("ab", shapes, strict=True):
        extended = model.with_causes([cause(made_up(name, shape))])
        explanations.append((extended, extended.parameters(model.start, (1.0,)), 0.45, (name,)))
    return next_test(model, explanations, noises=white_noise(model.views, sigma))


def test_effects_that_look_the_same_everywhere_are_not_helped_and_the_sentence_says_so():
    found = elastic_choice(1e3, (np.ones_like, np.ones_like))
    assert found.probability_before == pytest.approx(0.45)
    assert found.probability_after == pytest.approx(0.45, abs=0.01)
    assert found.what.startswith("None of the tests considered helps to discriminate between")


def test_no_effect_can_be_one_of_the_answers():
    found = elastic_choice(0.01, (np.ones_like, lambda fraction: fraction**3))
    assert found.separates == [[], ["a"], ["b"]]
    assert "it discriminates between no effect, a and b; the answer is then right with more than 99 %" in found.what


def test_a_weak_test_is_not_said_to_tell_apart():
    found = elastic_choice(10.0, (np.ones_like, lambda fraction: -np.ones_like(fraction)))
    assert 0.47 < found.probability_after < 0.9
    assert "it helps most between a and b" in found.what
