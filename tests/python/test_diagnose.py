"""Small campaigns whose truth is known, from records to the answer."""

import json
from dataclasses import replace

import numpy as np
import pytest

from campaigns.few_records import CORNERS, NOISE, damage, few_records, offset
from probation import InputError, Noise
from probation.comparison.compare import compare
from probation.diagnosis.diagnose import diagnose
from probation.law.settings import LawSettings

EFFECTS = ["force_offset", "damage", "machine_compliance", "slow_process"]
UNEVEN = {"slow": 0.02, "middle": 0.04, "fast": 0.4, "unloading": 0.1}


def diagnosed(campaign, effects=EFFECTS, **options):
    return diagnose(campaign, effects=effects, design=False, threads=1, **options)


def spiked(name, time, strain, stress):
    """One reading 3 MPa too high, in one record."""
    found = stress.copy()
    found[90] += 3.0 * (name == "middle")
    return found


def twisted(name, time, strain, stress):
    """A hump of the stress around a strain of 0.5 that nothing in the catalogue makes."""
    return stress + 1.5 * np.exp(-(((strain - 0.5) / 0.15) ** 2))


@pytest.fixture(scope="module")
def nothing():
    return diagnosed(few_records())


@pytest.fixture(scope="module")
def offset_in_middle():
    return diagnosed(few_records(offset(1.0, "middle")))


@pytest.fixture(scope="module")
def damaged():
    """With one record of another kind held out."""
    return diagnosed(few_records(damage(0.05), held_out=("unloading",)))


@pytest.fixture(scope="module")
def unexplained():
    return diagnosed(few_records(twisted, names=("slow", "middle", "fast")), effects=["force_offset", "damage"])


def test_what_reading_a_record_doubted_is_a_warning_of_a_diagnosis_and_of_a_comparison():
    campaign = few_records()
    doubted = replace(campaign.records[0], warnings=("strain in percent?",))
    campaign = replace(campaign, records=(doubted, *campaign.records[1:]))
    said = f"{doubted.id}: strain in percent?"
    assert said in diagnosed(campaign, effects=["force_offset"]).warnings
    compared = compare(campaign, few_records(seed=5), effects=["force_offset"], threads=1).warnings
    assert said in compared
    compared = compare(few_records(seed=5), campaign, effects=["force_offset"], threads=1).warnings
    assert any(said in warning for warning in compared)


def aged(names):
    """Stiffer by 4 % from test to test."""
    return lambda name, time, strain, stress: stress * (1.0 + 0.04 * names.index(name))


@pytest.mark.parametrize(("names", "said"), [(("slow", "middle", "fast"), True), (("middle", "slow", "fast"), False)])
def test_a_change_between_tests_in_the_order_of_their_rates_comes_with_a_warning(names, said):
    found = diagnosed(few_records(aged(names), names=names), effects=["change_between_tests"])
    warned = any("in the order of their rates" in warning for warning in found.warnings)
    assert [part.name for part in found.effects if part.named] == ["change_between_tests"]
    assert warned == said


def test_the_answer_does_not_depend_on_how_many_refits_are_made_at_once():
    campaign = few_records(damage(0.05), held_out=("unloading",))
    alone, together = (diagnose(campaign, effects=EFFECTS, threads=threads) for threads in (1, 3))
    assert together.to_json() == alone.to_json()


def assert_sound(found):
    """What holds of every answer."""
    chances = [each.probability for each in found.explanations]
    assert sum(chances) == pytest.approx(1.0, abs=1e-9)
    assert chances == sorted(chances, reverse=True)
    names = [each.effects for each in found.explanations]
    assert len(set(names)) == len(names)
    assert {(), ("unknown",)} <= set(names)
    assert all(each == tuple(sorted(each)) for each in names)
    assert found.answer_set[0] == found.best.effects
    assert sum(each.share for each in found.located) <= 1.0 + 1e-9
    shares = [each.share for each in found.located]
    assert shares == sorted(shares, reverse=True)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_where_nothing_is_wrong_no_effect_is_needed(seed, nothing):
    found = nothing if seed == 1 else diagnosed(few_records(seed=seed))
    assert_sound(found)
    assert found.verdict == "no_gap"
    assert found.best.effects == ()
    assert found.best.probability > 0.8
    assert found.located == ()
    assert found.shrink.identify.closure is None
    assert found.headline.startswith("No gap")


def test_the_noise_that_is_told_is_the_one_that_was_put_in(nothing, offset_in_middle, damaged):
    """White, 0.04 MPa, beside a gap of twenty times as much, too."""
    for found in (nothing, offset_in_middle, damaged):
        assert found.noise_MPa == pytest.approx(NOISE, rel=0.07)


def test_the_base_parameters_of_a_law_without_a_gap_are_those_it_was_made_with(nothing):
    """E_u 3220 MPa, tau_max 5.2 s, G 2 MPa, to four standard errors and 0.1 % of the scheme's own."""
    for each, truth in zip(nothing.base, (3220.0, 5.2, 2.0), strict=True):
        assert each.status == "identifiable"
        assert abs(each.value - truth) < 4.0 * each.se + 1e-3 * truth


def test_an_offset_of_one_records_force_is_named_with_that_record(offset_in_middle):
    found = offset_in_middle
    assert_sound(found)
    assert found.verdict == "explained"
    assert found.best.effects == ("force_offset",)
    assert found.best.records == ("middle",)
    assert found.best.probability > 0.8  # what is left goes to pairs whose second effect would not show
    (size,) = found.best.parameters
    assert abs(size.value - 1.0) < 4.0 * size.se
    assert {place.record for place in found.located} == {"middle"}
    assert "in middle explains" in found.headline


def test_an_effect_of_the_material_is_named_with_all_records_and_its_size(damaged):
    """Area e^(-0.05 e^2): the growing form's own, 0.05 and exponent 2."""
    assert_sound(damaged)
    assert damaged.verdict == "explained"
    assert damaged.best.effects == ("damage",)
    assert set(damaged.best.records) == {"slow", "middle", "fast"}
    size, exponent = damaged.best.parameters
    assert abs(size.value - 0.05) < 4.0 * size.se
    assert abs(exponent.value - 2.0) < 4.0 * exponent.se


def test_it_closes_the_gap_of_the_fitted_records_and_of_one_of_another_kind(damaged):
    assert damaged.shrink.identify.closure == pytest.approx(1.0, abs=0.01)
    assert damaged.shrink.held_out.closure == pytest.approx(1.0, abs=0.02)
    assert damaged.shrink.held_out.before_MPa > 10.0 * NOISE
    assert damaged.curves["unloading"].role == "held-out"
    assert "unloading" not in damaged.best.records


def test_a_right_explanation_foretells_records_left_out_and_leaves_nothing(damaged):
    checks = damaged.best.checks
    assert checks.left_out > 0.9
    assert checks.amplitude_p_value > 1e-3
    assert checks.remaining_p_value > 0.01


def test_on_one_ramp_damage_cannot_be_told_from_a_slow_loss_and_both_are_checked():
    """Strain and time are one there; whichever leads, the other stays in the answer set; an unknown may stand there."""
    found = diagnosed(few_records(damage(0.05), names=("middle",)), effects=["damage", "slow_process"])
    assert_sound(found)
    assert {("damage",), ("slow_process",)} <= set(found.answer_set) <= {("damage",), ("slow_process",), ("unknown",)}
    assert "cannot distinguish it from" in found.headline
    for each in found.explanations:
        assert (each.checks is not None) == (each.effects in found.answer_set and each.effects != ("unknown",))


def test_what_nothing_in_the_catalogue_explains_is_called_unexplained(unexplained):
    assert_sound(unexplained)
    assert unexplained.verdict == "unexplained"
    assert "unknown" in unexplained.best.effects
    assert "outside the catalogue" in unexplained.headline or "nothing that was tried" in unexplained.headline


def test_one_record_is_diagnosed_with_a_warning():
    found = diagnosed(few_records(offset(2.0, "middle"), names=("middle",)))
    assert_sound(found)
    assert found.verdict == "explained"
    assert ("force_offset",) in found.answer_set
    assert found.best.checks.left_out is None
    assert any("one record" in warning for warning in found.warnings)
    assert "part" in found.shrink.identify.how


def test_an_outlier_is_left_out_and_makes_no_gap():
    found = diagnosed(few_records(spiked))
    assert found.verdict == "no_gap"
    assert any("middle" in warning and "outlier" in warning for warning in found.warnings)
    assert found.rms_MPa == pytest.approx(NOISE, rel=0.07)
    assert found.shrink.identify.closure is None


@pytest.mark.parametrize("fault", [None, offset(1.0, "slow")])
def test_each_record_is_weighed_by_its_own_noise(fault):
    """Twenty times less in the record that has the fault than in the noisiest."""
    found = diagnosed(few_records(fault, noise=UNEVEN))
    assert_sound(found)
    for name, level in UNEVEN.items():
        assert np.median(found.curves[name].noise) == pytest.approx(level, rel=0.15)
    assert any("tenfold" in warning for warning in found.warnings)
    if fault is None:
        assert found.verdict == "no_gap"
    else:
        assert (found.verdict, found.best.effects, found.best.records) == ("explained", ("force_offset",), ("slow",))


def test_noise_that_is_larger_than_stated_is_told():
    """Of the one record of which it is; the larger one counts."""
    plain = few_records(None)
    stated = {"slow": NOISE, "middle": NOISE / 3.0}
    records = tuple(replace(each, noise=Noise(stated.get(each.id))) for each in plain.records)
    found = diagnosed(replace(plain, records=records))
    told = [warning for warning in found.warnings if "as stated" in warning]
    assert len(told) == 1
    assert told[0].startswith("middle: the noise of the stress is 0.0")
    assert told[0].endswith("as stated; the larger one counts")


def test_the_schemes_own_error_is_not_taken_for_an_effect():
    """Noise of 0.005 MPa; bE2 at the samples is off by 0.5 MPa at the knee, and a large gap hides that from the fit."""
    found = diagnosed(few_records(offset(5.0, "slow"), names=("slow", "middle", "fast"), noise=0.005))
    assert found.best.effects == ("force_offset",)
    assert found.best.records == ("slow",)
    assert found.shrink.identify.after_MPa < 0.007


def test_an_unknown_effect_is_refused_with_the_likeliest_one():
    with pytest.raises(InputError, match=r"force_ofset.*force_offset"):
        diagnosed(few_records(), effects=["force_ofset"])


def test_an_unknown_parameter_to_hold_is_refused():
    with pytest.raises(InputError, match="tau_max"):
        diagnosed(few_records(names=("middle",)), hold={"tau_maxx_s": 5.2})


def test_a_held_parameter_is_not_fitted():
    found = diagnosed(few_records(names=("slow", "fast")), hold={"hardening_modulus_MPa": 2.0})
    assert [each.name for each in found.base] == ["unrelaxed_modulus_MPa", "tau_max_s"]
    assert found.verdict == "no_gap"


def test_a_law_given_whole_is_diagnosed_with_nothing_fitted():
    given = {"unrelaxed_modulus_MPa": 3220.0, "tau_max_s": 5.2, "hardening_modulus_MPa": 2.0}
    campaign = replace(few_records(offset(0.5, "middle")), law=LawSettings(fixed=given))
    found = diagnose(campaign, effects=["force_offset"], design=False)
    assert found.base == ()
    assert found.best.effects == ("force_offset",)
    assert found.best.records == ("middle",)


def test_the_same_seed_gives_the_same_answer(offset_in_middle):
    again = diagnosed(few_records(offset(1.0, "middle")))
    assert again.to_json() == offset_in_middle.to_json()


def test_progress_rises_from_nothing_to_all():
    told = []
    diagnosed(few_records(names=("middle", "fast")), effects=["force_offset"], progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert 0.0 <= told[0] < 0.5


CONTRACT = {"schema", "campaign", "verdict", "headline", "base", "gap", "where", "causes"}
CONTRACT |= {"answer_set", "shrink", "next_test"}


@pytest.mark.parametrize("name", ["nothing", "offset_in_middle", "damaged", "unexplained"])
def test_the_answer_as_json_keeps_the_contract(name, request):
    found = request.getfixturevalue(name)
    answer = json.loads(found.to_json())
    assert set(answer) >= CONTRACT
    assert answer["schema"] == "probation.diagnosis/1"
    assert answer["campaign"] == "few records"
    assert answer["verdict"] in ("no_gap", "explained", "unexplained")
    assert set(answer["gap"]) >= {"rms_MPa", "noise_MPa", "p_value"}
    assert 0.0 <= answer["gap"]["p_value"] <= 1.0
    for parameter in answer["base"]["parameters"].values():
        assert set(parameter) == {"value", "se", "status"}
    for place in answer["where"]:
        assert set(place) >= {"record", "time_s", "true_strain", "rms_MPa", "share", "p_value"}
        assert place["record"] in CORNERS
        assert place["time_s"][0] <= place["time_s"][1]
    assert sum(cause["probability"] for cause in answer["causes"]) == pytest.approx(1.0, abs=1e-9)
    for cause in answer["causes"]:
        assert set(cause) >= {"effects", "records", "probability", "parameters"}
        assert all(set(each) >= {"value", "se"} for each in cause["parameters"].values())
    assert {(), ("unknown",)} <= {tuple(cause["effects"]) for cause in answer["causes"]}
    assert answer["answer_set"][0] == answer["causes"][0]["effects"]
    closure_keys = {"before_MPa", "after_MPa", "noise_MPa", "closure", "interval"}
    assert set(answer["shrink"]["identify"]) >= closure_keys
    assert (answer["shrink"]["held_out"] is None) == (name != "damaged")
