"""Isolability: what these tests could see and discriminate, against closed forms, simulation and refits."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.special import ndtr

import probation
from probation.answers import json_answer
from probation.design.discrimination import best_match, probability_of_the_right_one
from probation.design.effect_signals import signal, usual_size
from probation.design.isolability import isolability
from probation.design.planned_record import white_noise
from probation.effects.cause import cause
from probation.effects.effect import Effect, EffectParameter, Form
from probation.effects.record_view import views_of
from probation.effects.registry import effect, effects
from probation.errors import ConvergenceError
from probation.inference.callable_law import CallableLaw
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.records.record import Record

SAMPLES = 400
NOISE = 0.5


def ramp(name, rate, strain=0.1, samples=SAMPLES):
    time = np.linspace(0.0, strain / rate, samples)
    return Record(id=name, time=time, true_strain=rate * time, true_stress=np.zeros(samples))


def elastic_model(*records):
    """Stress = E strain, E = 1000 MPa."""

    def stress(time, true_strain, parameters, modification):
        return parameters[0] * true_strain

    law = CallableLaw(stress, names=("modulus_MPa",), starts=(1000.0,), lower=(0.0,), upper=(1e5,))
    return CampaignModel(law, views_of(probation.Campaign(name="bar", records=records)))


def made_up(name, shape, lower=-100.0, upper=100.0, scale=1.0, placements=("all",), **more):
    """An effect that adds a * shape(fraction of the record) to the recorded stress."""
    form = Form(
        "only",
        (EffectParameter("size_MPa", "MPa", lower, upper, scale, "made up"),),
        recorded_stress=lambda view, values, stress: stress + values[0] * shape(view.elapsed / view.duration),
        placements=placements,
        **more,
    )
    return Effect(name, name.replace("_", " "), "Made up.", "none", "here", "rig", (form,))


def wave(cycles, phase=0.0):
    return lambda fraction: np.sin(2.0 * np.pi * cycles * fraction + phase)


def analysed(effects, *records, noise=NOISE):
    model = elastic_model(*(records or (ramp("one", 0.001),)))
    return isolability(model, model.start, white_noise(model.views, noise), effects)


def test_the_same_signal_is_a_coin_toss():
    assert probability_of_the_right_one(7.0, 1.0) == pytest.approx(0.5)
    assert probability_of_the_right_one(0.0, 0.3) == pytest.approx(0.5)


@pytest.mark.parametrize(("degrees", "root_lambda"), [(90.0, 2.8), (30.0, 6.4), (10.0, 18.9)])
def test_the_lengths_that_tell_apart_19_times_of_20(degrees, root_lambda):
    """Section 5 of docs/diagnosis-method.md: at a right angle the formula is P(|N(l, 1)| > |N(0, 1)|)."""
    assert probability_of_the_right_one(root_lambda, np.cos(np.radians(degrees))) == pytest.approx(0.95, abs=0.004)
    if degrees == 90.0:
        t = np.linspace(-10.0, 14.0, 20001)
        density = np.exp(-0.5 * (t - root_lambda) ** 2) / np.sqrt(2.0 * np.pi)
        expected = np.trapezoid(density * (2.0 * ndtr(np.abs(t)) - 1.0), t)
        assert probability_of_the_right_one(root_lambda, 0.0) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("one_sided", [False, True])
@pytest.mark.parametrize("rival_one_sided", [False, True])
@pytest.mark.parametrize("degrees", [12.0, 70.0, 90.0, 150.0, 180.0])
def test_the_formula_counts_what_a_simulation_counts(one_sided, rival_one_sided, degrees):
    """z in the plane of both signals, 200 000 draws: the better fit wins, a draw counts half."""
    rng, root_lambda, angle = np.random.default_rng(3), 1.7, np.radians(degrees)
    z = rng.standard_normal((200_000, 2)) + np.array([root_lambda, 0.0])
    own, rival = z[:, 0], z @ [np.cos(angle), np.sin(angle)]
    own = np.maximum(own, 0.0) if one_sided else np.abs(own)
    rival = np.maximum(rival, 0.0) if rival_one_sided else np.abs(rival)
    same = np.isclose(own, rival, rtol=1e-9, atol=1e-12)
    counted = np.mean(np.where(same, 0.5, own > rival))
    found = probability_of_the_right_one(
        root_lambda, np.cos(angle), one_sided=one_sided, rival_one_sided=rival_one_sided
    )
    assert found == pytest.approx(counted, abs=4.0 * 0.5 / np.sqrt(200_000))


def test_a_rival_that_cannot_grow_or_turn_matches_less():
    """Signal 3 u; rivals: u to 2 at most (misses 1 of 3: cos^2 = 1 - 1/9), -u only (opposite), u free, 45 degrees."""
    products, sizes = np.array([3.0, -3.0, 3.0, 3.0]), np.array([1.0, 1.0, 1.0, np.sqrt(2.0)])
    lower, upper = np.array([-2.0, 0.0, -9.0, -9.0]), np.array([2.0, 9.0, 9.0, 9.0])
    expected = [np.sqrt(8.0) / 3.0, -1.0, 1.0, np.sqrt(0.5)]
    np.testing.assert_allclose(best_match(3.0, products, sizes, lower, upper), expected)


def test_an_offset_on_an_elastic_ramp_has_the_length_of_its_closed_form():
    """J = strain, even on [0, e]: an offset is taken up by 3/4, E moves by (3/2)/e; root lambda = sqrt(n)/2/sigma."""
    found = analysed([made_up("offset", np.ones_like, scale=2.0)], ramp("one", 0.001, samples=4001)).effects[0]
    assert found.absorbable == pytest.approx(0.75, rel=1e-3)
    assert found.detectability == pytest.approx(2.0 * np.sqrt(4001) / 2.0 / NOISE, rel=1e-3)
    assert found.biases[0].parameter == "modulus_MPa"
    assert found.biases[0].percent == pytest.approx(100.0 * 2.0 * 1.5 / 0.1 / 1000.0, rel=1e-3)
    assert found.seen_from == pytest.approx(5.0 / found.detectability * 2.0, rel=0.021)


def test_a_gain_hides_in_the_modulus_and_says_so():
    found = analysed([effect("force_gain"), effect("force_offset")]).effects[0]
    assert (found.status, found.seen_from) == ("absorbed", None)
    assert found.absorbable == pytest.approx(1.0)
    assert found.biases[0].percent == pytest.approx(2.0)
    assert "all of it is taken up" in found.sentence
    assert "modulus_MPa by +2 %" in found.sentence


def test_orthogonal_waves_are_discriminated_and_equal_ones_are_not():
    """Whole waves: orthogonal to each other, nearly so to the ramp; b is a over again at twice the unit."""
    effects = [
        made_up("a", wave(20)),
        made_up("b", lambda fraction: 2.0 * wave(20)(fraction)),
        made_up("c", wave(31)),
    ]
    found = analysed(effects)
    assert found.groups == (("a", "b"),)
    assert found.probability[0, 1] == pytest.approx(0.5, abs=1e-6)
    assert found.angle[0, 2] == pytest.approx(90.0, abs=1.0)
    assert [each.status for each in found.effects] == ["ambiguous", "ambiguous", "named"]
    assert found.headline.startswith("This record can name 1 of 3 effects; 2 would be seen but could be taken for")
    assert "could be taken for another (a for b; b for a)" in found.headline
    assert "could be taken for b (50 % right)" in found.effects[0].sentence
    assert found.effects[0].named_from is None
    np.testing.assert_allclose(np.diag(found.probability), 1.0)


def test_opposite_signs_are_discriminated():
    """The same wave, one up only, the other down only."""
    up, down = made_up("up", wave(20), lower=0.0), made_up("down", wave(20), upper=0.0)
    found = analysed([up, down])
    assert found.groups == ()
    assert found.cosine[0, 1] == pytest.approx(-1.0)
    assert found.effects[1].values == {"size_MPa": -1.0}
    assert usual_size(down.forms[0].amplitude) == -1.0


def test_of_a_signal_of_either_sign_half_can_be_taken_for_a_one_sided_rival():
    """The rival looks the same for one sign, the opposite for the other, where it is always discriminated."""
    found = analysed([made_up("either", wave(20)), made_up("up", wave(20), lower=0.0)])
    assert found.probability[0, 1] == pytest.approx(0.5 * (0.5 + 1.0), abs=1e-3)


def test_an_effect_at_30_degrees_is_named_from_the_length_6_4():
    """b = cos 30 a + sin 30 (orthogonal); named_from over seen_from is 6.4 / 5."""
    half = np.radians(30.0)
    found = analysed([made_up("a", wave(20)), made_up("b", wave(20, half))])
    assert found.angle[0, 1] == pytest.approx(30.0, abs=0.5)
    assert found.effects[0].named_from / found.effects[0].seen_from == pytest.approx(6.4 / 5.0, rel=0.02)


def test_too_small_an_effect_says_what_it_would_take():
    found = analysed([made_up("faint", wave(20), scale=0.01), made_up("fainter", wave(31), upper=0.02, lower=-0.02)])
    faint, fainter = found.effects
    assert (faint.status, fainter.status) == ("too_small", "too_small")
    assert faint.seen_from == pytest.approx(5.0 * NOISE / np.sqrt(SAMPLES / 2), rel=0.03)
    assert fainter.seen_from is None
    assert "at no size within its bounds" in fainter.sentence


def test_a_fault_of_one_record_is_looked_for_where_it_shows_best():
    found = analysed(
        [made_up("slip", wave(20), placements=("one",))], ramp("a", 0.001), ramp("b", 0.002), noise=[1.0, 0.2]
    )
    assert found.effects[0].records == ("b",)
    assert "in b, where it shows best" in found.effects[0].sentence


def test_what_the_law_cannot_follow_is_left_out_and_named():
    found = analysed([effect("damage"), effect("force_offset")])
    assert [name for name, _ in found.left_out] == ["damage"]
    assert found.names == ("force_offset",)
    with pytest.raises(probation.InputError, match="none that the law can follow"):
        analysed([effect("damage")])


def test_another_number_of_noises_is_refused():
    model = elastic_model(ramp("a", 0.001), ramp("b", 0.002))
    with pytest.raises(probation.InputError, match="noises: found 1, expected one for each of 2 records"):
        isolability(model, model.start, white_noise(model.views[:1], 1.0), effects())
    with pytest.raises(probation.InputError, match="deviation: found 3 numbers"):
        white_noise(model.views, [1.0, 1.0, 1.0])
    with pytest.raises(probation.InputError, match="expected a positive number"):
        white_noise(model.views, 0.0)


def fragile(limit, failure):
    """A wave that cannot be solved above a limit."""

    def recorded(view, values, stress):
        if abs(values[0]) > limit:
            raise failure
        return stress + values[0] * wave(20)(view.elapsed / view.duration)

    parameter = EffectParameter("size_MPa", "MPa", -100.0, 100.0, 1.0, "made up")
    form = Form("only", (parameter,), recorded_stress=recorded, placements=("all",))
    return Effect("fragile", "fragile", "Made up.", "none", "here", "rig", (form,))


def test_an_effect_that_cannot_be_solved_at_its_usual_size_is_taken_smaller_in_proportion():
    model = elastic_model(ramp("one", 0.001))
    effect = fragile(0.1, ConvergenceError("made up"))
    found = signal(model, model.start, cause(effect), (1.0,))
    np.testing.assert_allclose(found, wave(20)(np.linspace(0.0, 1.0, SAMPLES)), atol=1e-12)
    with pytest.raises(probation.InputError, match="fragile: found no solution"):
        signal(model, model.start, cause(fragile(1e-9, ConvergenceError("made up"))), (1.0,))


def test_the_stresses_of_the_records_are_not_looked_at():
    """Compliance hands the force back: the predicted one, whatever was measured."""
    measured, law = ramp("one", 0.01, 1.0), probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    noisy = replace(measured, true_stress=100.0 * np.random.default_rng(0).standard_normal(SAMPLES))
    lengths = []
    for record in (measured, noisy):
        model = CampaignModel(DnlrLaw(law), views_of(probation.Campaign(name="x", records=(record,))))
        found = isolability(
            model, model.start, white_noise(model.views, NOISE), effects(["machine_compliance", "damage"])
        )
        lengths.append([each.detectability for each in found.effects])
    np.testing.assert_allclose(*lengths)


def two_ramps():
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    records = (ramp("slow", 0.001, 1.5, 300), ramp("fast", 0.02, 1.8, 300))
    return CampaignModel(DnlrLaw(law), views_of(probation.Campaign(name="two", records=records)))


def test_the_whole_catalogue_is_judged_and_leaves_as_json():
    model = two_ramps()
    found = isolability(model, model.start, white_noise(model.views, 1.0), effects())
    assert {*found.names, *(name for name, _ in found.left_out)} == {effect.name for effect in effects()}
    assert sum(len(found.with_status(status)) for status in ("named", "ambiguous")) >= 10
    assert found.effects[found.names.index("force_gain")].status == "absorbed"
    grouped = [name for group in found.groups for name in group]
    assert len(grouped) == len(set(grouped))
    assert {each.name for each in found.with_status("ambiguous")} <= set(grouped)
    answer = json.loads(json_answer("probation.isolability/1", found.to_dict()))
    assert np.shape(answer["probability"]) == (len(found.names), len(found.names))
    assert answer["effects"][0]["sentence"].endswith(".")


def test_a_ramp_at_the_reference_rate_gives_rate_dependence_nothing_to_do():
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    records = (ramp("one", 0.005, 1.5, 300),)
    model = CampaignModel(DnlrLaw(law), views_of(probation.Campaign(name="one", records=records)))
    found = isolability(model, model.start, white_noise(model.views, 1.0), effects(["rate_dependent_hardening"]))
    assert found.effects[0].status == "without_signal"
    assert "does nothing in these records" in found.effects[0].sentence


def test_refits_of_simulated_data_are_right_as_often_as_predicted():
    """Force offset against a force that drifts along each record, on two ramps: 300 draws, both refitted."""
    model = two_ramps()
    sigma, draws = 2.0, 300
    pair = [effect("force_offset"), effect("force_drift")]
    pair[1] = replace(pair[1], forms=pair[1].forms[:1])
    found = isolability(model, model.start, white_noise(model.views, sigma), pair)
    right = model.with_causes([cause("force_offset")])
    wrong = model.with_causes([cause(pair[1])])
    size = 3.0 / found.effects[0].detectability * found.effects[0].values["offset_MPa"]
    truth = right.residual(right.parameters(model.start, (size,)))
    rng = np.random.default_rng(5)
    wins = 0
    for _ in range(draws):
        noise = sigma * rng.standard_normal(len(truth))
        costs = []
        for candidate in (right, wrong):
            start, scale = candidate.start, np.append(np.abs(model.start), 1.0)
            fit = least_squares(
                lambda p, m=candidate, data=truth + noise: m.residual(p) - data,
                start,
                jac=lambda p, m=candidate: m.jacobian(p),
                x_scale=scale,
                xtol=1e-6,
                ftol=1e-8,
            )
            costs.append(fit.cost)
        wins += costs[0] < costs[1]
    expected = probability_of_the_right_one(3.0, found.cosine[0, 1])
    assert wins / draws == pytest.approx(expected, abs=3.0 * np.sqrt(0.25 / draws))
    assert 0.6 < expected < 0.97


def test_a_rival_is_tried_between_its_starts():
    """The rival's wave may have any frequency; its only start is far from the truth, its prior's grid is not."""
    parameter = EffectParameter("size_MPa", "MPa", -100.0, 100.0, 1.0, "made up")
    cycles = EffectParameter("cycles", "", 1.0, 1e3, 1.0, "any", centre=20.0, log=True, starts=(3.0,))
    form = Form(
        "any",
        (parameter, cycles),
        recorded_stress=lambda view, v, stress: stress + v[0] * wave(v[1])(view.elapsed / view.duration),
        placements=("all",),
    )
    tunable = Effect("tunable", "tunable", "Made up.", "none", "here", "rig", (form,))
    found = analysed([made_up("a", wave(20)), tunable])
    assert found.angle[0, 1] == pytest.approx(0.0, abs=1e-3)
    assert found.angle[1, 0] == pytest.approx(90.0, abs=10.0)
    assert found.effects[1].values["cycles"] == 3.0


def test_an_effect_that_cannot_be_solved_or_is_there_already_is_left_out_with_the_reason():
    model = elastic_model(ramp("one", 0.001)).with_causes([cause("force_offset")])
    effects = [made_up("a", wave(20)), effect("force_offset"), fragile(1e-9, ConvergenceError("made up"))]
    found = isolability(model, model.start, white_noise(model.views, NOISE), effects)
    assert found.names == ("a",)
    assert [name for name, _ in found.left_out] == ["force_offset", "fragile"]
    assert found.left_out[0][1] == "it is in the model already"
    assert "found no solution of the law with size_MPa = 1" in found.left_out[1][1]
