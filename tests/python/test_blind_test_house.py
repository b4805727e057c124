"""The commercial testing house: its solver, its errors, its causes, its secrecy."""

import json
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

import probation
from probation.effects.registry import effects
from probation_studies.blind.laboratories import test_house as house
from probation_studies.blind.laboratories.test_house.causes import CAUSES, FORMS, RIVALS
from probation_studies.blind.laboratories.test_house.causes.form import Effect
from probation_studies.blind.laboratories.test_house.handover import take_records
from probation_studies.blind.laboratories.test_house.machine import base_stress, observe
from probation_studies.blind.laboratories.test_house.make import form_of
from probation_studies.blind.laboratories.test_house.metric import Metric
from probation_studies.blind.laboratories.test_house.modal import (
    RATIOS,
    WEIGHTS,
    Law,
    haward_thackray,
    response_to_strain_error,
    solve,
)
from probation_studies.blind.laboratories.test_house.oracle import consult
from probation_studies.blind.laboratories.test_house.plan import draw_plan
from probation_studies.blind.laboratories.test_house.planting import RESOLVABLE, Placed

PLAIN = Law(2000.0, 1.0, 2.0, None, 5.0)
WITH_COMPANION = Law(3000.0, 1.1, 1.8, (0.00464, 0.0367))


def _solve(law, time, strain, **more):
    tau = law.tau(np.diff(strain) / np.diff(time))
    return solve(time, strain, tau, law.hardening * haward_thackray(strain), law.modulus, **more)


def _engine(law):
    given = {"unrelaxed_modulus": law.modulus, "hardening_modulus": law.hardening}
    if law.companion is None:
        return probation.Law(tau_max=law.alpha * law.seconds, **given)
    return probation.Law(alpha=law.alpha, companion=probation.Weissenberg(*law.companion), **given)


def test_a_ramp_without_network_is_exact_however_long_the_steps():
    """E p r tau rate (1 - exp(-t/(r tau))) of every mode; with p s_0 exp(-t/(r tau)) where it starts at s_0."""
    time, rate, tau = np.array([0.0, 0.3, 7.0, 100.0]), 0.004, 5.0 * RATIOS[:, None]
    decay = np.exp(-time / tau)
    loaded = (2000.0 * rate * WEIGHTS[:, None] * tau * (1.0 - decay)).sum(axis=0)
    started = (3.0 * WEIGHTS[:, None] * decay).sum(axis=0)
    law = replace(PLAIN, hardening=0.0)
    assert np.allclose(_solve(law, time, rate * time), loaded, rtol=1e-12)
    assert np.allclose(_solve(law, time, rate * time, start=3.0 * WEIGHTS), loaded + started, rtol=1e-12)


def test_a_feedback_that_changes_nothing_gives_the_same():
    time = np.linspace(0.0, 60.0, 301)
    found = _solve(PLAIN, time, 0.006 * time, feedback=lambda n, stress, step, rate: 1.0)
    assert np.allclose(found, _solve(PLAIN, time, 0.006 * time), rtol=1e-12)


@pytest.mark.parametrize("law", [PLAIN, WITH_COMPANION], ids=["plain", "companion"])
def test_its_solver_agrees_with_the_engine(law):
    """To 1e-4 of the largest stress, at a speed that rises and falls by a third."""
    time = np.linspace(0.0, 100.0, 2001)
    strain = 0.006 * (time + 4.0 * np.sin(time / 12.0))
    expected = _engine(law).stress(time, strain, scheme="exact")
    assert np.max(np.abs(_solve(law, time, strain) - expected)) < 1e-4 * np.max(np.abs(expected))


def test_the_response_to_strain_errors_is_the_solvers_derivative():
    """Central differences with tau_max as it is, by every tenth sample."""
    time = np.linspace(0.0, 60.0, 61)
    strain, tau = 0.005 * time + 0.01 * np.sin(time / 9.0), WITH_COMPANION.tau(np.full(60, 0.005))
    matrix = response_to_strain_error(time, strain, tau, 3000.0, 1.8)
    for k in range(0, 61, 10):
        up, down = (
            solve(time, path, tau, 1.8 * haward_thackray(path), 3000.0)
            for path in (strain + each * np.eye(61)[k] for each in (1e-5, -1e-5))
        )
        assert np.allclose((up - down) / 2e-5, matrix[:, k], rtol=1e-6, atol=1e-3)


@pytest.fixture(scope="module")
def everything():
    """The shortest three tests of a series in which every cause can show."""
    needs = frozenset({"large", "rates", "unloading", "fast", "order"})
    plan = draw_plan(np.random.default_rng(3), needs, alike=True, strain_noise=1e-5)
    tests = [replace(test, temperature=28.0) for test in plan.coarse if test.history.kind in ("ramp", "unloading")]
    return tests[:3]


@pytest.mark.parametrize("form", [*FORMS.values(), *RIVALS], ids=lambda form: f"{form.cause}-{form.name}")
def test_every_form_changes_something_that_grows_with_its_amount_and_nothing_is_kept(form, everything):
    sizes = []
    for amount in (form.low, form.low, form.usual.amount):
        size = 0.0
        for test in everything:
            strain, force = observe(test, [replace(form.usual, amount=amount)])
            plain = observe(test)
            assert np.all(np.isfinite(force))
            size += np.linalg.norm(force - plain[1]) + 1000.0 * np.linalg.norm(strain - plain[0])
        sizes.append(size)
    assert 0.0 < sizes[0] == sizes[1] < sizes[2]


def test_a_wrong_section_of_two_per_cent_is_seen_in_its_record_alone(everything):
    """Width and thickness by 1 % each: 1/0.99 squared."""
    effect = Effect(FORMS["force_gain", "section"], 0.02, {"sign": 1.0}, everything[0].name)
    ratio = [observe(test, [effect])[1][1:] / observe(test)[1][1:] for test in everything]
    assert np.allclose(ratio[0], 0.99**-2, rtol=1e-12)
    assert all(np.array_equal(each, np.ones(len(each))) for each in ratio[1:])


@pytest.mark.parametrize(
    ("form", "amount", "shape"),
    [
        pytest.param("linear", 1e-5, {}, id="a stiff frame"),
        pytest.param("linear", 2e-3, {}, id="a frame six times as soft as the specimen"),
        pytest.param("contacts", 1.7e-3, {"q": 0.717}, id="soft contacts"),
    ],
)
def test_a_frame_takes_the_travel_that_it_should(everything, form, amount, shape):
    """The specimen's elongation and the frame's are the travel: along the former the law gives the force."""
    test = everything[0]
    force = observe(test, [Effect(FORMS["machine_compliance", form], amount, shape)])[1]
    given_way = amount * np.sign(force) * np.abs(force) ** shape.get("q", 1.0)
    specimen = np.log(np.exp(test.history.strain[test.history.at]) - given_way)
    expected = base_stress(test, specimen) * np.exp(-specimen)
    late = len(force) // 20  # sampling shows at the start
    assert np.max(np.abs(force - expected)[late:]) < 2e-3 * np.max(force)
    assert np.all(np.diff(force)[:late] > 0.0)


def test_contacts_settle_where_the_travel_begins_with_next_to_nothing(everything):
    test = everything[0]
    strain = test.history.strain.copy()
    strain[1] = 1e-9 * strain[-1]
    begun = replace(test, history=replace(test.history, strain=strain))
    force = observe(begun, [Effect(FORMS["machine_compliance", "contacts"], 2e-3, {"q": 0.7})])[1]
    assert np.all(np.isfinite(force))


def test_its_causes_are_of_the_catalogue_in_two_forms_each():
    assert set(CAUSES) < {each.name for each in effects()}
    assert {each.cause for each in RIVALS} < {each.name for each in effects()} - set(CAUSES)
    assert set(Counter(cause for cause, _ in FORMS).values()) == {2}
    assert len(FORMS) == 48


def test_48_indices_hold_each_form_once_and_each_half_of_them_each_cause():
    forms = [form_of([1, 2, 3], index) for index in range(96)]
    for block in (forms[:48], forms[48:]):
        assert {(each.cause, each.name) for each in block} == set(FORMS)
        assert {each.cause for each in block[:24]} == {each.cause for each in block[24:]} == set(CAUSES)
    assert forms[:48] != forms[48:]


@pytest.mark.parametrize(
    ("seed", "companion", "force_channel"),
    [(21, False, True), (31, False, False), (35, True, True), (23, True, False)],
)
def test_what_a_null_leaves_of_the_engine_is_white_of_variance_one(seed, companion, force_channel):
    """The engine along the recorded strain, whitened by all errors; within six standard errors.

    A companion relation would take the noise of the strain for its rate, so that there is none of it there.
    """
    strain_noise = 1e-8 if companion else 1e-4
    plan = draw_plan(np.random.default_rng(seed), frozenset(), alike=True, strain_noise=strain_noise)
    assert (plan.law.companion is not None, plan.errors.force_channel) == (companion, force_channel)
    assert plan.errors.correlation > 0.2
    left = {}
    for record in take_records(np.random.default_rng(5), plan, []):
        time, one, other = record.columns.values()
        strain = np.log1p(one / 30.0) if force_channel else one
        stress = other / 40.0 * np.exp(strain) if force_channel else other
        left[record.test.name] = stress - _engine(plan.law).stress(time, strain, scheme="exact")
    white = Metric(plan.coarse, plan.errors, None).whitened(left)
    assert abs(white @ white / len(white) - 1.0) < 6.0 * np.sqrt(2.0 / len(white))
    assert abs(white[1:] @ white[:-1] / len(white)) < 6.0 / np.sqrt(len(white))


QUICK = {"none": 5, "replicates": 0, "single": 57, "pair": 1}
"""Indices of small campaigns."""


@pytest.fixture(scope="module")
def campaigns():
    return {name: house.make(77, QUICK[name], stratum=name) for name in house.STRATA}


@pytest.mark.parametrize("stratum", house.STRATA)
def test_a_campaign_of_each_stratum_is_made_and_read_and_says_nothing(stratum, campaigns, tmp_path):
    made = campaigns[stratum]
    truth = json.loads(made.truth.to_json())
    read = probation.Campaign.load(made.write(tmp_path / made.name))
    assert truth["schema"] == "probation.blind.truth/1"
    assert (truth["stratum"], truth["laboratory"]) == (stratum, "test_house")
    assert [record.id for record in read.records] == list(truth["records"])
    for record, taken in zip(read.records, made.records, strict=True):
        strain = taken.test.history.strain[taken.test.history.at]
        assert truth["records"][record.id]["samples"] == len(record.time)
        assert np.max(np.abs(record.true_strain - strain)) < 0.05
        assert 5.0 < np.max(record.true_stress) < 400.0
    assert truth["explanation"] == sorted(each["effect"] for each in truth["causes"])
    assert len(truth["causes"]) == {"single": 1, "pair": 2}.get(stratum, 0)
    assert sum(truth["oracle"]["posterior"].values()) == pytest.approx(1.0, abs=0.05)
    assert truth["oracle"]["resolvable"] == (truth["oracle"]["right"] >= 0.95)
    for cause in truth["causes"]:
        assert RESOLVABLE <= cause["left_by_best_other"] <= cause["detectability"] <= 1500.0
        assert cause["records"] == list(truth["records"]) or not cause["everywhere"]
        for window in cause["windows"]:
            assert 0.0 <= window["time_s"][0] < window["time_s"][1] <= truth["records"][window["record"]]["duration_s"]
    said = (tmp_path / made.name / "campaign.toml").read_text().lower()
    assert not any(word in said for word in ("stratum", "truth", "seed", *CAUSES, *(name for _, name in FORMS)))
    assert ('scatter = "none"' in said) == (truth["scatter"] is None)
    assert (truth["scatter"] is not None) == (stratum == "replicates") or stratum in ("single", "pair")


def test_a_campaign_is_the_same_for_the_same_arguments(campaigns):
    again = house.make(77, QUICK["none"], stratum="none")
    assert again.truth.to_json() == campaigns["none"].truth.to_json()
    assert [each.csv() for each in again.records] == [each.csv() for each in campaigns["none"].records]
    assert house.make(77, QUICK["none"], "calibrate", "none").truth.to_json() != again.truth.to_json()


def test_a_negative_seed_is_refused():
    with pytest.raises(probation.InputError, match="seed, index: found -1, 0"):
        house.make(-1, 0)


def test_the_oracle_names_what_is_plain_and_not_what_is_alike():
    """Signals at right angles, of 40: right in nearly all repeats. Of cosine 0.9999: in about half of them."""
    one, other = FORMS["force_gain", "cell"], FORMS["damage", "weibull"]
    for cosine, low, high in ((0.0, 0.97, 1.0), (0.9999, 0.3, 0.75)):
        signals = np.array([[1.0, 0.0], [cosine, np.sqrt(1.0 - cosine**2)]])
        candidates = [Placed(form, None, 1.0, 7.0 * signal) for form, signal in zip((one, other), signals, strict=True)]
        found = consult(np.random.default_rng(1), candidates, 40.0 * signals[0], np.zeros(2), (one.cause,))
        assert low <= found.right <= high
        assert found.resolvable == (cosine == 0.0)
        assert (one.cause,) in found.answer_set
    apart = [Placed(form, None, 1.0, signal) for form, signal in zip((one, other), np.eye(2), strict=True)]
    nothing = consult(np.random.default_rng(1), apart, np.zeros(2), np.zeros(2), ())
    assert nothing.right == 1.0
    assert nothing.answer_set == ((),)
    both = consult(np.random.default_rng(1), apart, np.array([40.0, 40.0]), np.zeros(2), ("damage", "force_gain"))
    assert both.right == 1.0
