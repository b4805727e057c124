"""Two campaigns held against each other: what changed, in which record, by how much."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import probation
from campaigns import measured
from probation import Campaign, InputError, Law, Record, Reference, Specimens, compare
from probation.cli import main
from probation.comparison.headline import headline, sized
from probation.comparison.measured_law import MeasuredLaw
from probation.comparison.result import ChangedParameter, ChangeExplanation, Comparison
from probation.effects.record_view import views_of
from probation.inference.calibration_check import CalibrationCheck
from probation_studies.blind.inject import Injection

GRID = {"slow": 0.002, "fast": 0.02}
ALIKE = {"specimens": Specimens("none")}
"""Virtual specimens are alike but for noise."""


def made_up(seed, *, lacks=True):
    """Two ramps to a strain of 0.6; the specimen's stress has a wave of 3 % that the law lacks; noise of 0.02 MPa."""
    rng = np.random.default_rng(seed)
    law = Law(unrelaxed_modulus=900.0, tau_max=8.0, hardening_modulus=3.0)
    records = []
    for name, rate in GRID.items():
        time = np.linspace(0.0, 0.6 / rate, 301)
        strain = rate * time
        wave = 1.0 + 0.03 * np.sin(9.0 * strain) if lacks else 1.0
        stress = law.stress(time, strain, scheme="sa3") * wave + 0.02 * rng.standard_normal(301)
        records.append(Record(name, time, strain, stress, control="strain-rate"))
    return Campaign("march", tuple(records), **ALIKE)


@pytest.fixture(scope="module")
def march():
    return Reference.of(made_up(1))


def test_nothing_has_changed_where_only_the_noise_is_another(march):
    """Eight drafts of the noise: the law's own error of 3 %, ten times the noise and more, is no change."""
    verdicts = [compare(made_up(seed), march, threads=1).verdict for seed in range(2, 10)]
    assert verdicts == ["nothing_changed"] * 8


def test_changes_that_were_not_fitted_have_no_sizes():
    """A stress 7 % larger, of specimens that may differ: a change of the material is in the answer set."""
    then, now = made_up(1, lacks=False), made_up(2, lacks=False)
    now = replace(now, records=tuple(replace(r, true_stress=1.07 * r.true_stress) for r in now.records))
    found = compare(replace(now, specimens=Specimens()), replace(then, specimens=Specimens()), threads=1)
    assert found.verdict == "nothing_changed"
    assert ("material_change",) in [each.effects for each in found.answer_set]
    assert [each.parameters for each in found.explanations] == [()] * len(found.explanations)


def _waving(seed):
    """The same with a wave of twice the noise, forty of it in every record, of a phase of its own."""
    campaign, phase = made_up(seed), np.random.default_rng(100 + seed).uniform(0.0, 2.0 * np.pi)
    records = [
        replace(r, true_stress=r.true_stress + 0.04 * np.sin(80.0 * np.pi * r.time / r.time[-1] + phase))
        for r in campaign.records
    ]
    return replace(campaign, records=tuple(records))


def test_a_wave_that_both_campaigns_have_is_no_change():
    """A frame's vibration has no phase: no test on lines is made."""
    assert compare(_waving(2), _waving(1), threads=1).verdict == "nothing_changed"


@pytest.mark.parametrize(
    ("fault", "size"),
    [
        ("force_offset", 0.1),
        ("force_drift", -0.2),
        ("force_gain", 0.02),
        ("force_strain_lag", 1.0),
        ("slack", 0.01),
        ("machine_compliance", 4e-4),
    ],
)
def test_a_fault_is_told_with_its_record_and_its_size(march, fault, size):
    later = made_up(20)
    done = Injection("fast" if fault == "force_strain_lag" else "slow", fault, size, seed=3)
    told = measured.told(compare(measured.injected(later, done), march, threads=1), later, done)
    assert told["held"]
    assert told["record"]
    assert told["covered"]


def test_the_level_of_a_change_is_that_of_the_calibration(march, monkeypatch):
    """A gain of 2 % is a change at any level but zero."""
    later = measured.injected(made_up(20), Injection("slow", "force_gain", 0.02, seed=3))
    assert compare(later, march, threads=1).verdict == "changed"
    monkeypatch.setattr(CalibrationCheck, "gap_level", lambda check, misfit_over_noise: 0.0)
    assert compare(later, march, threads=1).verdict == "nothing_changed"


LAW = Law(unrelaxed_modulus=2000.0, tau_max=6.0, hardening_modulus=2.5)


def of_a_rig(seed, *, slack=0.0, compliance=0.0, specimen_id=None, factor=1.0, grip=False):
    """Tests on a rig whose crosshead travels in vain first and whose frame gives way."""
    rng = np.random.default_rng(seed)
    records = []
    for name, rate in {"slow": 0.002, "fast": 0.01, **({"grip": 0.005} if grip else {})}.items():
        time = np.linspace(0.0, 0.35 / rate, 300)
        elongation = 0.42 * time / time[-1] if name == "grip" else np.expm1(rate * time)
        force = factor * LAW.stress(time, np.log1p(elongation), "exact") / (1.0 + elongation)
        early = np.linspace(0.0, 1.0, 60, endpoint=False)
        late = 0.21 * time[1] / elongation[1]
        time = np.concatenate([late * early, late + time])
        travel = np.concatenate([slack * early, slack + elongation + compliance * force])
        force = np.concatenate([0.0 * early, force])
        stress = force * (1.0 + travel) + 0.04 * rng.standard_normal(len(time))
        records.append(Record(name, time, np.log1p(travel), stress, specimen_id=specimen_id))
    return Campaign("rig", tuple(records), **({} if specimen_id else ALIKE))


@pytest.fixture(scope="module")
def sound():
    return Reference.of(of_a_rig(1))


def test_a_rig_that_shows_twice_the_strain_has_slack_and_a_positive_compliance():
    """Slack of a quarter of the travel, then the frame; the strain beyond the reference's was never the specimen's."""
    reference = Reference.of(of_a_rig(1, grip=True))
    found = compare(of_a_rig(2, slack=0.21, compliance=0.0061, grip=True), reference, threads=2)
    assert set(found.best.effects) == {"machine_compliance", "strain_offset"}, found.summary()
    sizes = {each.name: each.value for each in found.best.parameters}
    assert sizes["slack_strain"] == pytest.approx(0.21, rel=0.03)
    assert sizes["compliance_per_MPa"] == pytest.approx(0.0061, rel=0.03)


def stiff_at_first(seed, *, slack=0.0, compliance=0.0):
    """A polymer whose onset is rounder than the law has it, with slow noise and some of the strain."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0.0, 400.0, 400)
    elongation = 0.8 * time / time[-1]
    stress = LAW.stress(time, np.log1p(elongation), "exact") * (1.0 - np.exp(-elongation / 0.01))
    force = stress / (1.0 + elongation)
    early = np.arange(round(slack / elongation[1]))
    time = np.concatenate([early * time[1], len(early) * time[1] + time])
    travel = np.concatenate([early * elongation[1], slack + elongation + compliance * force])
    force = np.concatenate([0.0 * early, force])
    noise = np.zeros(len(time))
    for index, drawn in enumerate(0.026 * rng.standard_normal(len(time))):
        noise[index] = 0.9 * noise[index - 1] + drawn if index else 0.0
    travel[1:] += 1e-4 * rng.standard_normal(len(travel) - 1)
    stress = (force + noise) * (1.0 + travel)
    return Campaign("film", (Record("pull", time, np.log1p(travel), stress, control="displacement-rate"),), **ALIKE)


def test_a_test_begins_where_its_reference_began():
    """What a law leaves falls steeply there, and a force that acts back on the strain need not exist if it followed."""
    reference = Reference.of(stiff_at_first(1))
    law = MeasuredLaw(reference.law, {"pull": [reference.branches["pull"]]})
    view = views_of(stiff_at_first(1), scheme=reference.scheme)[0]
    moved = view.driven(view.true_strain + 1e-3)
    change = law.carried_over(moved) - law.carried_over(view)
    assert change[0] == 0.0
    assert change[1] < -0.1


@pytest.mark.parametrize(("effect", "fault"), [("machine_compliance", "compliance"), ("strain_offset", "slack")])
def test_a_gross_fault_of_the_travel_is_named_alone_though_the_law_is_too_stiff_at_the_onset(effect, fault):
    """A frame as soft as the onset, a slack of an eighth of the travel: ends of searches, and signs of slopes."""
    size = {"compliance": 2e-3, "slack": 0.1}[fault]
    found = compare(stiff_at_first(2, **{fault: size}), Reference.of(stiff_at_first(1)), threads=1)
    assert found.best.effects == (effect,), found.summary()
    assert found.best.probability > 0.85  # a toe that is taken up over the onset is much like a soft frame
    assert found.best.parameters[0].value == pytest.approx(size, rel=0.02)


def test_signs_that_physics_forbids_are_no_change(sound):
    """The reference's rig has the slack, not the one that is asked about."""
    found = compare(of_a_rig(2), Reference.of(of_a_rig(1, slack=0.02)), threads=1)
    assert found.verdict != "nothing_changed"
    lowest = {"slack_strain": 0.0, "compliance_per_MPa": 0.0}
    for each in found.explanations:
        for size in each.parameters:
            assert min(size.value, *size.interval95) >= lowest.get(size.name, -np.inf)


def test_a_spent_budget_gives_an_answer_and_says_what_was_not_tried(sound):
    found = compare(of_a_rig(2, slack=0.05), sound, threads=1, budget=1e-6)
    assert sum(each.probability for each in found.explanations) == pytest.approx(1.0)
    assert any("budget" in each.why for each in found.skipped)
    assert "the budget of 1e-06 s ended the search" in found.headline
    assert found.explanations[0].probability < 0.5
    assert json.loads(found.to_json())["skipped"]
    assert "left out" in found.summary()
    with pytest.raises(InputError, match="budget: found 0"):
        compare(of_a_rig(2), sound, budget=0.0)


@pytest.mark.parametrize(("probability", "said"), [(0.36, False), (0.82, True)])
def test_nothing_is_said_to_have_changed_only_with_an_even_chance(probability, said):
    """A gain of 6 % was "nothing changed (probability 36 %)"; as probable was a change of the material."""
    each = [
        SimpleNamespace(effects=(), probability=probability, records=(), parameters=()),
        SimpleNamespace(effects=("material_change",), probability=0.18, records=("a", "b"), parameters=()),
    ]
    told = headline(each, None, 2, "march")
    assert ("Nothing changed since march" in told) == said
    assert ("cannot be told: nothing did with 36 %, material change with 18 %." in told) != said


def test_other_specimens_may_differ_and_the_same_one_may_not():
    """3 % more force: the usual scatter of specimens, but on one specimen a gain of the force."""
    reference = Reference.of(of_a_rig(1, specimen_id="A1"))
    same = compare(of_a_rig(2, specimen_id="A1", factor=1.03), reference, threads=1)
    other = compare(of_a_rig(2, specimen_id="A2", factor=1.03), reference, threads=1)
    assert same.verdict == "changed"
    assert not same.scatter.any
    assert other.verdict == "nothing_changed"
    assert other.scatter.source == "assumed"
    assert "specimens differ" in other.summary()


def test_specimens_of_which_nothing_is_said_may_differ_unless_a_campaign_states_that_they_are_alike():
    later, before = of_a_rig(2, factor=1.03), of_a_rig(1)
    assert compare(later, before, threads=1).verdict == "changed"
    unsaid = [replace(each, specimens=Specimens()) for each in (later, before)]
    assert compare(*unsaid, threads=1).verdict == "nothing_changed"
    assert compare(unsaid[0], before, threads=1).verdict == "changed"


def rate_independent(seed, wave, *, gain=0.0):
    """A specimen whose stress follows its strain alone, which is seen where it runs ahead of the mean or lags."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0.0, 400.0, 401)
    strain = 1e-3 * (time + 6.0 * np.sin(wave * time))
    curve = 20.0 * (1.0 - np.exp(-strain / 0.01)) * (1.0 + 0.8 * strain)
    stress = (1.0 + gain) * curve + 0.03 * rng.standard_normal(401)
    return Campaign("film", (Record("pull", time, strain, stress, control="displacement-rate"),))


def test_another_course_of_the_rate_is_no_change_though_the_law_says_that_it_matters():
    """The law answers to a fifth of the rate by 5 MPa of 25, the material by nothing; 10 % of force are one."""
    reference = Reference.of(rate_independent(1, 0.02))
    assert compare(rate_independent(2, 0.03), reference, threads=1).verdict == "nothing_changed"
    found = compare(rate_independent(2, 0.03, gain=0.1), reference, threads=1)
    assert found.verdict == "changed"
    assert ("force_gain",) in [each.effects for each in found.answer_set], found.summary()


def test_a_gain_in_all_records_is_told_as_such_and_not_in_one(march):
    later = made_up(21)
    for name in GRID:
        later = measured.injected(later, Injection(name, "force_gain", 0.03))
    found = compare(later, march, threads=1)
    assert ("force_gain",) in [each.effects for each in found.answer_set]
    assert found.best.records == tuple(GRID)


def test_the_intervals_hold_the_truth_as_often_as_they_say(march):
    """24 offsets at independent noise; 95 % of them, so that fewer than 19 have a chance of 0.1 % (binomial)."""
    hits = 0
    rng = np.random.default_rng(5)
    for seed in range(24):
        later = made_up(100 + seed)
        done = Injection("slow", "force_offset", float(rng.uniform(0.08, 0.3)))
        found = compare(measured.injected(later, done), march, effects=["force_offset", "force_drift"], threads=1)
        hits += bool(measured.told(found, later, done)["covered"])
    assert hits >= 19


def test_probabilities_sum_to_one_and_the_answer_is_json(march):
    found = compare(made_up(2), march, threads=1)
    assert sum(each.probability for each in found.explanations) == pytest.approx(1.0)
    answer = json.loads(found.to_json())
    assert answer["schema"] == "probation.comparison/1"
    assert answer["verdict"] == "nothing_changed"
    assert "Nothing changed since march" in found.summary()
    assert len(found.plot().axes) == 2


def test_records_of_other_names_are_paired_by_hand(march):
    later = made_up(2)
    other = replace(later, records=tuple(replace(each, id=f"may-{each.id}") for each in later.records))
    with pytest.raises(InputError, match="found no record of march"):
        compare(other, march)
    found = compare(other, march, pairs={"may-fast": "fast"}, threads=1)
    assert found.pairs == {"may-fast": ("fast",)}
    with pytest.raises(InputError, match="found no record 'quick'"):
        compare(other, march, pairs={"may-fast": "quick"})
    with pytest.raises(InputError, match="found no change named 'ofset'"):
        compare(later, march, effects=["ofset"])


@pytest.mark.skipif(not measured.DATA.is_dir(), reason="the measured records are not beside the checkout")
@pytest.mark.parametrize("material", list(measured.SIZES))
def test_faults_put_into_measured_records_are_told(material):
    """Plain sizes; bench/measured_injections.py has all of them, and docs/measured-injections.md what it finds."""
    long = material in ("etfe", "vhb")
    campaign = measured.measured(material, 6 * measured.FILES[material][1] if long else None)
    reference = Reference.of(campaign)
    assert compare(campaign, reference, threads=1).verdict == "nothing_changed"
    rng = np.random.default_rng(7)
    faults = ("force_offset", "force_gain") if long else tuple(measured.SIZES[material])
    for fault in faults:
        done = measured.drawn(campaign, material, fault, 2, rng)
        told = measured.told(compare(measured.injected(campaign, done), reference, threads=1), campaign, done)
        assert told["named"], (done, told)
        assert told["covered"], (done, told)


@pytest.mark.skipif(not measured.DATA.is_dir(), reason="the measured records are not beside the checkout")
@pytest.mark.parametrize(("fault", "size"), [("machine_compliance", 2e-3), ("slack", 0.1)])
def test_a_gross_fault_of_the_travel_put_into_a_measured_film_is_named_alone(fault, size):
    campaign = measured.measured("etfe")
    done = Injection(campaign.records[0].id, fault, size, seed=1)
    found = compare(measured.injected(campaign, done), Reference.of(campaign), threads=1)
    told = measured.told(found, campaign, done)
    assert told["named"], found.summary()
    assert told["value"] == pytest.approx(size, rel=0.01)


def test_sizes_of_one_name_are_told_with_their_records():
    def size(name, value, *records):
        return ChangedParameter("machine_compliance", name, "", records, value, (value - 0.1, value + 0.1))

    both = size("power", 1.0, "slow", "fast")
    apart = size("compliance", 0.2, "slow"), size("compliance", 0.3, "fast")
    assert sized(ChangeExplanation(("machine_compliance",), ("slow", "fast"), 1.0, (*apart, both))) == [
        "compliance = 0.2 in slow (95 %: 0.1 to 0.3)",
        "compliance = 0.3 in fast (95 %: 0.2 to 0.4)",
        "power = 1 (95 %: 0.9 to 1.1)",
    ]


def test_compare_is_public():
    assert probation.compare is compare


def test_the_command_says_what_changed(tmp_path, capsys):
    later = measured.injected(made_up(22), Injection("slow", "force_offset", 0.2))
    made_up(1).save(tmp_path / "march")
    later.save(tmp_path / "may")
    answer = tmp_path / "change.json"
    page = tmp_path / "change.html"
    arguments = ["diagnose", str(tmp_path / "may"), "--against", str(tmp_path / "march"), "--json", str(answer)]
    assert main([*arguments, "--report", str(page)]) == 0
    assert "force offset in slow" in page.read_text(encoding="utf-8")
    assert "force offset in slow" in capsys.readouterr().out
    assert json.loads(answer.read_text())["changes"][0]["effects"] == ["force_offset"]
    assert main([*arguments, "--hold", "tau_max_s=5"]) == 2
    assert "--hold with --against" in capsys.readouterr().err
    assert main(["diagnose", str(tmp_path / "may"), "--pair", "a=b"]) == 2
    assert "--pair without --against" in capsys.readouterr().err


def test_a_comparison_comes_back_from_its_json_without_curves(march):
    done = compare(measured.injected(made_up(20), Injection("slow", "force_offset", 0.1, seed=3)), march, threads=1)
    again = Comparison.from_json(done.to_json())
    assert again.to_json() == done.to_json()
    assert again.summary() == done.summary()
    assert again.answer_set == done.answer_set
    with pytest.raises(InputError, match=r"found no curves, as it was read from JSON"):
        again.plot()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "the text: found no JSON"),
        ('{"schema": "probation.fit/1"}', "the text: found the schema 'probation.fit/1', expected what to_json writes"),
        ('{"schema": "probation.comparison/1"}', "the text: found no 'result', expected what to_json writes"),
        ('{"schema": "probation.comparison/1", "result": [1]}', "the text: found a tuple under 'result'"),
    ],
)
def test_what_is_no_comparison_is_refused(text, message):
    with pytest.raises(InputError, match=f"^{message}"):
        Comparison.from_json(text)


@pytest.mark.parametrize("dead", ["campaign", "reference"])
def test_a_record_whose_strain_never_moves_is_refused_by_its_name(dead):
    """It said that nothing changed."""
    sound = made_up(1)
    still = replace(sound.records[0], true_strain=np.zeros(len(sound.records[0])))
    faulty = replace(sound, records=(still, *sound.records[1:]))
    campaign, reference = (faulty, sound) if dead == "campaign" else (sound, faulty)
    with pytest.raises(InputError, match=f"record '{still.id}': found a true strain of 0 at every sample"):
        compare(campaign, reference)
