"""The paper reproduced: what the synthetic data return beside what the paper prints (docs/law.md and the tables)."""

import json
import re

import numpy as np
import pytest

import probation
from probation.certificate.hardening import regress_hardening
from probation.law.companion import EXPONENTIAL_AS_PRINTED, WEISSENBERG_AS_PRINTED
from probation.law.settings import LawSettings
from probation.published.experiments import necking_history
from probation.records.campaign import Campaign
from probation.records.record import Record
from probation_studies.paper.constant_time import cost_over_time, onset
from probation_studies.paper.direct_prediction import direct_prediction
from probation_studies.paper.exhibit import Exhibit, Settings, compare
from probation_studies.paper.exhibits import EXHIBITS, named_exhibits
from probation_studies.paper.grip_tests import OPTIONS, identified, identify, twin
from probation_studies.paper.hardening_modulus import expected_from_table_2
from probation_studies.paper.reproduction import Reproduction, reproduce
from probation_studies.paper.wavy_bias import RISES, ProfiledFit, bias_study, middle

NOISE = 0.04  # MPa, of the synthetic data
DRAWS, BIASES = 30, 100


@pytest.fixture(scope="module")
def paper():
    """Every exhibit, with few draws."""
    return reproduce(draws=DRAWS)


# What docs/law.md requires of synthetic record P2


@pytest.mark.parametrize(("number", "alpha"), [(2, 0.924), (3, 0.855)])
def test_alpha_with_12_comes_out_without_having_been_put_in(number, alpha):
    assert identified(number, 0)[3].law.alpha == pytest.approx(alpha, abs=0.005)


@pytest.mark.parametrize(("number", "hardening"), [(2, 1.765), (3, 1.867)])
def test_g_with_12_comes_out_without_having_been_put_in(number, hardening):
    assert identified(number, 0)[3].law.hardening_modulus == pytest.approx(hardening, abs=0.01)


@pytest.mark.parametrize(("number", "slope"), [(2, 1.565), (3, 1.660)])
def test_the_slope_over_the_haward_thackray_strain_is_that_of_figure_s1(number, slope):
    test = twin(number, 0)
    assert regress_hardening(test.true_strain, test.true_stress).hardening_modulus == pytest.approx(slope, abs=0.01)


@pytest.mark.parametrize(("number", "largest"), [(2, 10.1), (3, 8.8)])
def test_the_direct_prediction_with_11_errs_most_at_the_end_of_the_hardening(number, largest):
    """E_u 3220, α 1, the paper's G of 1.56 and 1.64 MPa."""
    found = direct_prediction(number, WEISSENBERG_AS_PRINTED)
    assert found.largest == pytest.approx(largest, abs=0.3)
    assert found.where == pytest.approx(1.8, abs=0.02)


@pytest.mark.parametrize("number", [2, 3])
def test_the_direct_prediction_with_12_stays_within_the_papers_10_mpa(number):
    assert direct_prediction(number, EXPONENTIAL_AS_PRINTED).largest < 10.0


@pytest.mark.parametrize("number", [2, 3])
def test_the_companion_relation_takes_the_rms_from_several_mpa_to_the_noise(number):
    without = cost_over_time(number)
    assert 6.0 < without.rms[without.best] < 7.5
    assert identified(number, 0)[2].rms_MPa == pytest.approx(NOISE, rel=0.05)


@pytest.mark.parametrize("number", [2, 3])
def test_the_command_fit_finds_the_same_failure_without_the_companion(number):
    """By another path: probation.fit searches τ_max itself, by bE2."""
    found = probation.fit(Campaign(name="no companion", records=(twin(number, 0).record(),), law=LawSettings()))
    assert found.law.unrelaxed_modulus > 20000.0
    assert 6.0 < found.rms_MPa < 7.5


# Figure 3


@pytest.mark.parametrize("number", [2, 3])
def test_without_the_companion_e_u_is_beyond_20_gpa_and_the_onset_below_7_mpa(number):
    found = cost_over_time(number)
    assert found.unrelaxed_modulus[found.best] > 20000.0
    assert onset(found.law(found.best), necking_history(number)) < 7.0


@pytest.mark.parametrize("number", [2, 3])
def test_the_cost_is_flat_towards_short_times_at_a_fixed_product(number):
    """From 20 GPa up the rms changes by less than half a per cent, with E_u free or with E_u τ_max kept."""
    found = cost_over_time(number)
    flat = found.unrelaxed_modulus > 20000.0
    assert flat.sum() > 5
    assert np.ptp(found.rms[flat]) < 0.005 * found.rms.min()
    assert np.ptp(found.rms_fixed_product[flat]) < 0.005 * found.rms.min()
    assert found.rms[-1] > 1.3 * found.rms.min()


@pytest.mark.parametrize("number", [2, 3])
def test_the_onset_is_the_viscous_stress_of_the_starting_rate(number):
    """As τ_max → 0 it is E_u Σ p_j τ_j ε̇(0), with Σ p_j τ_j = 0.382 τ_max at 50 modes (docs/law.md)."""
    found = cost_over_time(number)
    law, history = found.law(0), necking_history(number)
    expected = 0.382 * law.unrelaxed_modulus * law.tau_max * history.strain_rate([0.0])[0]
    assert onset(law, history) == pytest.approx(expected, rel=0.01)


# The bias of the paper's size


def test_the_profiled_fit_is_the_fit_of_the_command():
    """On one biased synthetic record; probation.fit works by Levenberg-Marquardt and adapts its steps."""
    test = twin(3, 0)
    biased = test.true_stress + 1.5 * np.sin(2.0 * np.pi * test.true_strain / 0.9)
    record = Record(id="biased", time=test.time, true_strain=test.true_strain, true_stress=biased)
    quick = ProfiledFit(test)(biased)
    law = probation.fit(Campaign(name="biased", records=(record,), law=OPTIONS[4])).law
    assert quick.alpha == pytest.approx(law.alpha, rel=2e-3)
    assert quick.unrelaxed_modulus == pytest.approx(law.unrelaxed_modulus, rel=3e-3)
    assert quick.hardening_modulus == pytest.approx(law.hardening_modulus, rel=1e-4)


@pytest.mark.parametrize(("number", "shift", "largest"), [(2, 0.065, 2.5), (3, 0.36, 3.4)])
def test_a_wavy_bias_of_the_papers_size_moves_e_u_as_far_as_identification_4_did(number, shift, largest):
    study = bias_study(number, 0, BIASES)
    low, high = middle(study.unrelaxed_modulus_4 / 3220.0 - 1.0)
    assert low < 0.0 < shift < high
    assert np.abs(study.example_residuals[2]).max() == pytest.approx(largest, rel=0.01)


@pytest.mark.parametrize(("number", "cost"), [(2, 1155.0), (3, 2100.0)])
def test_the_costs_of_the_paper_are_those_of_such_a_bias(number, cost):
    low, high = middle(bias_study(number, 0, BIASES).cost_2)
    assert low < cost < high


def test_such_a_bias_moves_e_u_against_alpha_and_hardly_their_product():
    study = bias_study(3, 0, BIASES)
    assert np.corrcoef(np.log(study.unrelaxed_modulus_4), np.log(study.alpha_4))[0, 1] < -0.9
    assert np.std(np.log(study.unrelaxed_modulus_4 * study.alpha_4)) < 0.25 * np.std(np.log(study.alpha_4))


def test_the_later_a_bias_sets_in_the_less_it_moves_e_u():
    """E_u acts on the stress below a strain of 0.1 only."""
    spreads = [np.std(np.log(bias_study(3, 0, BIASES, rise).unrelaxed_modulus_4)) for rise in RISES]
    assert spreads[0] > 1.2 * spreads[1] > 1.5 * spreads[2]


def test_the_study_follows_its_seed():
    assert (bias_study(2, 0, 3).cost_4 == bias_study.__wrapped__(2, 0, 3).cost_4).all()
    assert (bias_study(2, 0, 3).cost_4 != bias_study(2, 1, 3).cost_4).all()


# G


def test_the_regression_finds_the_slope_of_a_straight_line():
    strain = np.linspace(0.0, 1.5, 200)
    stress = 30.0 + 1.7 * probation.haward_thackray_strain(strain)
    found = regress_hardening(strain, stress)
    assert found.hardening_modulus == pytest.approx(1.7)
    assert found.intercept == pytest.approx(30.0)
    assert found.curvature < 1e-9


def test_a_record_that_ends_before_the_hardening_is_refused():
    with pytest.raises(probation.InputError, match=r"true_strain: found 0 samples above 0\.4"):
        regress_hardening(np.linspace(0.0, 0.3, 50), np.ones(50))


def test_g_does_not_pass_on_the_papers_own_numbers(paper):
    answer = paper.exhibits["hardening-modulus"].answer
    assert answer["hardening_modulus_MPa"] == {"experiment-1": 2.556, "experiment-2": 1.761, "experiment-3": 1.85}
    assert answer["passes"] is False


@pytest.mark.parametrize(("number", "found"), [(2, 1.761), (3, 1.85)])
def test_no_dependence_on_the_current_rate_explains_the_smaller_g(number, found):
    """Table 2 has 1.85 to 2.46 MPa at the rates of these tests; their average is a tenth above what was found."""
    expected = expected_from_table_2(number)
    assert 1.85 < expected < 2.46
    assert expected > 1.1 * found


# Verdicts


def test_a_number_within_two_per_cent_is_reproduced_and_one_that_was_put_in_is_only_recovered():
    assert compare("G", 1.64, 1.66).verdict == "reproduced"
    assert compare("G", 1.64, 1.66, put_in=True).verdict == "recovered"
    assert compare("G", 1.64, 1.68, put_in=True).verdict == "differs"
    assert compare("error", 10.0, 4.0, relation="≤").verdict == "reproduced"
    assert compare("error", 10.0, 10.3, relation="≤").verdict == "differs"


def test_a_difference_that_nobody_explains_is_said_to_be_unexplained():
    exhibit = Exhibit("Table 9", "", "", (compare("G", 1.0, 2.0), compare("E", 1.0, 3.0, because="of the twin")))
    found = Reproduction({"table-9": exhibit}, Settings())
    assert "2 differ, 1 of them unexplained" in found.verdict
    assert [each.quantity for each in found.unexplained] == ["G"]
    assert exhibit.reasons() == ("G differs, and we do not know why.", "E differs: because of the twin.")


def test_every_difference_on_the_page_is_explained(paper):
    assert paper.unexplained == ()
    assert paper.count("differs") > 0


def test_the_verdict_counts_what_the_exhibits_hold(paper):
    counts = [
        sum(each.verdict == name for each in paper.comparisons) for name in ("reproduced", "recovered", "differs")
    ]
    assert sum(counts) == len(paper.comparisons)
    assert [int(number) for number in re.findall(r"\d+", paper.verdict)] == [sum(counts), *counts]


def test_parameters_of_identification_3_are_reproduced_and_none_of_identification_2_counts_as_such(paper):
    for table in ("table-3", "table-4"):
        verdicts = {each.quantity: each.verdict for each in paper.exhibits[table].comparisons}
        assert verdicts["α, identification 3"] == verdicts["G, identification 3"] == "reproduced"
        assert verdicts["α, identification 2"] == verdicts["G, identification 2"] == "recovered"


# Experiment 1, and the command


def test_the_closed_form_is_no_other_identification_and_a_late_start_makes_it_one(paper):
    """Table 1's -3.5 % in E_u and +3.6 % in τ_max: one delay gives both."""
    exhibit = paper.exhibits["table-1"]
    verdicts = {each.quantity: each for each in exhibit.comparisons}
    assert verdicts["E_u, identification 1"].ours == pytest.approx(3224.0, rel=0.005)
    assert "+3.6 % in τ_max" in verdicts["E_u, identification 1"].because
    assert 0.05 < exhibit.answer["late_start_s"] < 0.2


def test_the_high_frequencies_of_the_residual_are_the_strain_error(paper):
    answer = paper.exhibits["figure-2"].answer
    assert abs(answer["correlation"]) > 0.8
    assert answer["explained"] > 0.9
    assert answer["at_true_strain"] == pytest.approx(1.2, abs=0.1)


def test_two_steps_leave_the_noise_and_the_fitted_strain_knows_its_rate(paper):
    """The record is made with noise of 5e-4 and slow waves that (A-1) does not have."""
    answer = paper.exhibits["figures-s3-s8"].answer
    assert answer["first_rms"] > 3 * 5e-4
    assert answer["final_rms"] == pytest.approx(5e-4, rel=0.06)
    assert answer["rate_error_p95"]["derivative_of_strain"] < 0.01


# The page


def test_the_page_holds_every_exhibit_in_less_than_three_megabytes_and_fetches_nothing(paper, tmp_path):
    page = paper.report(tmp_path / "paper.html").read_text(encoding="utf-8")
    assert len(page.encode()) < 3_000_000
    for exhibit in paper.exhibits.values():
        assert f"<h2>{exhibit.title}</h2>".replace("&", "&amp;") in page
        for drawing in exhibit.drawings:
            assert drawing.figure.axes
    assert page.count("<figure") == sum(len(each.drawings) for each in paper.exhibits.values())
    assert not re.search(r"(src|href)=\"http", page)
    assert paper.verdict.replace("'", "&#39;") in page


def test_stems_and_captions_are_unique(paper):
    drawings = [drawing for exhibit in paper.exhibits.values() for drawing in exhibit.drawings]
    assert len({drawing.stem for drawing in drawings}) == len(drawings)
    assert len({drawing.caption for drawing in drawings}) == len(drawings)


def test_every_axis_is_labelled(paper):
    for exhibit in paper.exhibits.values():
        for drawing in exhibit.drawings:
            for axes in drawing.figure.axes:
                shared_x = axes.get_shared_x_axes().get_siblings(axes)
                shared_y = axes.get_shared_y_axes().get_siblings(axes)
                assert any(each.get_xlabel() for each in shared_x), drawing.stem
                assert any(each.get_ylabel() for each in shared_y), drawing.stem


def test_the_json_holds_every_number_and_where_it_came_from(paper):
    answer = json.loads(paper.to_json())
    assert answer["schema"] == "probation.paper/1"
    assert answer["seed"] == 0
    assert answer["version"]
    assert len(answer["data_sha256"]) == 64
    assert list(answer["exhibits"]) == [entry.name for entry in EXHIBITS]
    third = answer["exhibits"]["table-3"]["identifications"]["3"]
    assert third["parameters"]["alpha"]["value"] == pytest.approx(0.924, abs=0.005)


def test_names_are_unique_and_an_unknown_one_is_answered_with_the_nearest():
    assert len({entry.name for entry in EXHIBITS}) == len(EXHIBITS)
    with pytest.raises(probation.InputError, match="did you mean 'table-3'"):
        named_exhibits(["tabel-3"])


def test_the_sets_of_a1_agree_on_what_does_not_hang_on_the_history():
    """α and G with (12) are the same with P1 and P3: Tables 3 and 4 do not hang on the choice of P2."""
    chosen = identified(3, 0)[3].law
    for name in ("P1", "P3"):
        other = identify(twin(3, 0, name), 3).law
        assert other.alpha == pytest.approx(chosen.alpha, rel=0.005)
        assert other.hardening_modulus == pytest.approx(chosen.hardening_modulus, rel=0.005)
