"""Identification: the minimum, what is known about it, and what is told."""

import json
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import Campaign, Law, Noise, Record, Weissenberg, fit
from probation.identify.covariance import covariance
from probation.inference.parameter import status_of
from probation.law.settings import CompanionSettings, LawSettings
from probation.published.experiments import experiment, twin_campaign

TRUTH = (3224.0, 5.207, 2.556)


def ramp_record(seed=0, samples=1001, noise=0.04, rate=0.005, name="ramp", truth=TRUTH, strain_noise=0.0):
    """Eq. (7) with white noise: no scheme made it."""
    random = np.random.default_rng(seed)
    time = np.linspace(0.0, 2.0 / rate, samples)
    law = Law(unrelaxed_modulus=truth[0], tau_max=truth[1], hardening_modulus=truth[2])
    stress = probation.ramp_stress(law, rate, time) + noise * random.normal(size=samples)
    strain = rate * time + strain_noise * random.normal(size=samples)
    return Record(name, time, strain, stress, control="strain-rate")


def values(answer):
    return np.array([parameter.value for parameter in answer.parameters.values()])


def errors(answer):
    return np.array([parameter.se for parameter in answer.parameters.values()])


@pytest.mark.parametrize("number", [1, 2, 3])
def test_each_twin_is_identified_within_three_standard_errors(number):
    """Experiment 1: 3224, 5.207, 2.556; experiments 2 and 3: alpha 1.11, 1.045, G 1.761, 1.85 (docs/law.md)."""
    answer = fit(twin_campaign((number,)))
    truth = experiment(number).truth
    for name, parameter in answer.parameters.items():
        if parameter.se is not None:
            assert abs(parameter.value - getattr(truth, name)) < 3.0 * parameter.se
            assert parameter.status == "identifiable"


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3"])
def test_noise_free_data_return_the_parameters(scheme):
    """Relative 2e-4: the scheme's own error, held down by substeps."""
    assert_allclose(values(fit(Campaign("x", (ramp_record(noise=1e-4),)), scheme)), TRUTH, rtol=2e-4)


def test_the_three_methods_find_one_minimum():
    campaign = Campaign("x", (ramp_record(samples=301),))
    found = [values(fit(campaign, method=method)) for method in ("least-squares", "variable-projection", "simplex")]
    assert_allclose(found[1], found[0], rtol=1e-6)
    assert_allclose(found[2], found[0], rtol=1e-5)


def test_standard_errors_are_those_of_physics_md():
    """4000 points, 0.04 MPa: E_u 0.047 %, tau_max 0.047 %, G 0.002 %, corr -0.998, the product 0.003 %."""
    answer = fit(Campaign("x", (ramp_record(samples=4000),)))
    relative = 100.0 * errors(answer) / values(answer)
    assert_allclose(relative[:2], 0.047, rtol=0.05)
    assert relative[2] == pytest.approx(0.002, abs=0.0005)
    assert answer.correlation[0, 1] == pytest.approx(-0.998, abs=0.001)
    assert 100.0 * answer.product.se / answer.product.value == pytest.approx(0.003, rel=0.1)


@pytest.mark.parametrize("scheme", ["be2", "sa3"])
def test_intervals_cover_the_truth_about_as_often_as_they_say(scheme):
    """60 draws at 95 %: between 51 and 60 hits has a chance of 99.6 % or more."""
    hits = np.zeros(3)
    for seed in range(60):
        answer = fit(Campaign("x", (ramp_record(seed, samples=400),)), scheme, method="variable-projection")
        for at, (parameter, truth) in enumerate(zip(answer.parameters.values(), TRUTH, strict=True)):
            low, high = parameter.interval95
            hits[at] += low <= truth <= high
    assert np.all(hits >= 51)


def test_bE2_takes_substeps_until_its_own_error_is_negligible():
    campaign = Campaign("x", (ramp_record(samples=401),))
    answer, paper = fit(campaign), fit(campaign, substeps=1)
    assert answer.substeps > 1
    assert max(abs(shift) for shift in answer.scheme_shift.values()) < 0.3
    assert paper.substeps == 1
    assert abs(paper.scheme_shift["unrelaxed_modulus"]) > 1.0
    assert "use sa3" in paper.summary()


@pytest.mark.parametrize("seed", range(4))
def test_a_coarse_record_is_not_led_astray_by_the_error_of_bE2(seed):
    """Ten samples, 44 s apart at tau_max = 5.2 s: bE2 alone fits them best with another law."""
    campaign = Campaign("x", (ramp_record(seed, samples=10),))
    by_be2, by_sa3 = fit(campaign), fit(campaign, "sa3")
    assert_allclose(values(by_be2), values(by_sa3), atol=errors(by_sa3).max(), rtol=0.0)


def test_records_share_their_parameters():
    """Two rates, one law with companion: alpha = 1, G = 1.8 back within three standard errors."""
    truth = Law(unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=Weissenberg(0.00464, 0.0367))
    records = []
    for seed, rate in enumerate((1e-3, 1e-2)):
        time = np.linspace(0.0, 1.5 / rate, 800)
        stress = probation.ramp_stress(truth, rate, time) + 0.04 * np.random.default_rng(seed).normal(size=800)
        records.append(Record(f"r{seed}", time, rate * time, stress, control="strain-rate"))
    settings = LawSettings(companion=CompanionSettings("weissenberg", {"slope": 0.00464, "intercept": 0.0367}))
    answer = fit(Campaign("x", tuple(records), settings))
    assert np.all(np.abs(values(answer) - truth.parameters) < 3.0 * errors(answer))
    assert set(answer.records) == {"r0", "r1"}


def test_a_held_parameter_is_not_identified():
    campaign = Campaign("x", (ramp_record(),), LawSettings(fixed={"unrelaxed_modulus_MPa": 3224.0}))
    answer = fit(campaign)
    assert answer.names == ("tau_max", "hardening_modulus")
    assert answer.parameters["unrelaxed_modulus"].value == 3224.0
    assert answer.to_dict()["fixed"] == {"unrelaxed_modulus_MPa": 3224.0}
    assert list(answer.to_dict()["parameters"]) == ["tau_max_s", "hardening_modulus_MPa"]
    assert "held" in answer.summary()


def test_hold_wins_over_the_campaign():
    campaign = Campaign("x", (ramp_record(),), LawSettings(fixed={"unrelaxed_modulus_MPa": 1.0}))
    assert fit(campaign, hold={"unrelaxed_modulus_MPa": 3224.0}).parameters["unrelaxed_modulus"].value == 3224.0


def test_a_bound_is_kept_and_told():
    answer = fit(Campaign("x", (ramp_record(),)), bounds={"tau_max_s": (0.1, 4.0)})
    assert answer.law.tau_max == pytest.approx(4.0, rel=1e-6)
    assert any("bound" in warning for warning in answer.warnings)


def nearly_elastic_campaign():
    """tau_max is 1e5 times as long as the record: the search ends at the upper edge of its range, 1e3 times."""
    time = np.linspace(0.0, 100.0, 200)
    law = Law(unrelaxed_modulus=3000.0, tau_max=1e7, hardening_modulus=2.5)
    noise = 0.05 * np.random.default_rng(1).normal(size=200)
    stress = law.stress(time, 0.005 * time, scheme="sa3") + noise
    return Campaign("x", (Record("a", time, 0.005 * time, stress, control="strain-rate"),))


@pytest.mark.parametrize("method", ["least-squares", "variable-projection", "simplex"])
def test_at_an_edge_of_the_search_nothing_is_claimed_of_what_the_edge_decides(method):
    """tau_max two decades further on moves G from 568 to 8 MPa and E_u by 0.7 %: E_u alone is known."""
    answer = fit(nearly_elastic_campaign(), method=method)
    status = {name: parameter.status for name, parameter in answer.parameters.items()}
    assert status["unrelaxed_modulus"] == "identifiable"
    assert status["tau_max"] == status["hardening_modulus"] == answer.product.status == "not_identifiable"
    told = json.loads(answer.to_json())["parameters"]["tau_max_s"]
    assert told["se"] is None
    assert told["interval95"] is None
    assert "All parameters" not in answer.verdict


@pytest.mark.parametrize("method", ["least-squares", "variable-projection", "simplex"])
def test_the_value_quoted_lies_in_the_range_quoted(method):
    answer = fit(nearly_elastic_campaign(), method=method)
    (warning,) = [each for each in answer.warnings if "edge of its range" in each]
    assert answer.law.tau_max <= 1e5 * (1.0 + 1e-9)
    assert "1e+05 of 0.000503 to 1e+05 s" in warning


@pytest.mark.parametrize("method", ["least-squares", "variable-projection", "simplex"])
def test_a_modulus_that_is_zero_is_zero_by_every_method_and_has_no_error(method):
    """A stress that falls with the strain: the best G is negative, which is not possible."""
    time = np.linspace(0.0, 1.0, 100)
    stress = 30.0 - 20.0 * time + 0.01 * np.random.default_rng(1).normal(size=100)
    answer = fit(Campaign("x", (Record("a", time, time, stress, control="strain-rate"),)), method=method)
    hardening = answer.parameters["hardening_modulus"]
    assert (hardening.value, hardening.se, hardening.status) == (0.0, None, "not_identifiable")
    assert "G ended at its bound, 0 MPa" in answer.warnings


def test_bounds_beyond_the_usual_range_are_searched():
    answer = fit(nearly_elastic_campaign(), bounds={"tau_max_s": (1e6, 1e9)})
    assert answer.law.tau_max == pytest.approx(1e7, rel=0.5)


def test_a_short_elastic_record_does_not_determine_the_law():
    """Up to 0.05 % strain the record is one straight line: one number cannot give three."""
    time = np.linspace(0.0, 0.1, 60)
    law = Law(unrelaxed_modulus=3224.0, tau_max=5000.0, hardening_modulus=2.5)
    stress = probation.ramp_stress(law, 0.005, time) + 0.04 * np.random.default_rng(3).normal(size=60)
    answer = fit(Campaign("x", (Record("a", time, 0.005 * time, stress, control="strain-rate"),)))
    assert [parameter.status for parameter in answer.parameters.values()].count("identifiable") <= 1
    assert answer.verdict.startswith("Not all parameters")


def test_noise_and_bias_are_distinguished():
    """A wave of 1 MPa (rms 0.71) over 0.04 MPa of noise: the bias is most of it."""
    record = ramp_record(samples=2001)
    wavy = Record("w", record.time, record.true_strain, record.true_stress + np.sin(record.time / 20.0))
    answer = fit(Campaign("x", (wavy,)))
    assert answer.noise_MPa == pytest.approx(0.04, rel=0.1)
    assert 0.3 < answer.bias_MPa < 0.71
    assert answer.autocorrelated
    assert "bias" in answer.verdict


def test_a_bias_widens_the_standard_errors():
    """docs/law.md: a wavy bias of 1 MPa shifts E_u by 6.6 %, far beyond the 0.05 % of sensor noise."""
    record = ramp_record(samples=2001)
    wavy = Record("w", record.time, record.true_strain, record.true_stress + np.sin(record.time / 20.0))
    answer = fit(Campaign("x", (wavy,)))
    assert answer.parameters["unrelaxed_modulus"].se > 0.01 * 3224.0


def test_a_noisy_strain_is_smoothed_and_the_differentiator_named():
    answer = fit(Campaign("x", (ramp_record(strain_noise=1e-4),)))
    assert "spline" in answer.records["ramp"].excitation.differentiator
    assert np.all(np.abs(values(answer) - TRUTH) < 4.0 * errors(answer))
    assert "backward" in fit(Campaign("x", (ramp_record(),))).records["ramp"].excitation.differentiator


def test_strain_noise_that_the_errors_leave_out_is_told():
    """At strain 2 the hardening carries it 279-fold: 1e-4 is 0.028 MPa beside 0.04 MPa of stress noise."""
    noisy, quiet = (Campaign("x", (ramp_record(strain_noise=noise),)) for noise in (1e-4, 1e-5))
    warned = fit(noisy, method="variable-projection", weighting="plain").warnings
    assert any("0.02" in warning and "that of G" in warning for warning in warned)
    assert not fit(quiet, method="variable-projection", weighting="plain").warnings
    assert not fit(noisy, method="variable-projection").warnings  # there they do


def test_noise_given_with_the_record_weighs_it():
    quiet, loud = ramp_record(0, noise=0.01), ramp_record(1, noise=1.0, name="loud")
    answer = fit(
        Campaign(
            "x",
            (
                quiet,
                Record(
                    "loud",
                    *[loud.samples[k] for k in ("time", "true_strain", "true_stress")],
                    noise=Noise(stress_MPa=1.0),
                ),
            ),
        )
    )
    alone = fit(Campaign("x", (quiet,)))
    assert_allclose(values(answer), values(alone), atol=1.0 * errors(alone).max())


def test_the_answer_has_the_form_of_the_contract():
    answer = json.loads(fit(Campaign("hdpe", (ramp_record(),))).to_json())
    assert answer["schema"] == "probation.fit/1"
    assert (answer["campaign"], answer["scheme"]) == ("hdpe", "be2")
    modulus = answer["parameters"]["unrelaxed_modulus_MPa"]
    assert set(modulus) >= {"value", "se", "interval95", "status"}
    assert len(modulus["interval95"]) == 2
    assert answer["correlation"]["names"] == ["unrelaxed_modulus_MPa", "tau_max_s", "hardening_modulus_MPa"]
    assert np.shape(answer["correlation"]["matrix"]) == (3, 3)
    assert set(answer["residual"]) == {"rms_MPa", "noise_MPa", "bias_MPa"}
    assert set(answer["records"]["ramp"]) >= {"rms_MPa", "max_MPa"}
    assert len(answer["data_sha256"]) == 64


def test_progress_reaches_the_end():
    seen = []
    fit(Campaign("x", (ramp_record(samples=200),)), progress=seen.append)
    assert seen[-1] == 1.0
    assert seen == sorted(seen)


def test_the_page_is_written(tmp_path):
    path = fit(Campaign("x", (ramp_record(samples=200),))).report(tmp_path / "fit.html")
    assert "What is left" in path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"scheme": "cvode"}, "sensitivities"),
        ({"scheme": "rk4"}, "scheme"),
        ({"method": "guess"}, "method"),
        ({"excitation": "fft"}, "excitation"),
        ({"substeps": 0}, "substeps"),
        ({"weighting": "guess"}, "weighting"),
        ({"intervals": "guess"}, "intervals"),
        ({"hold": {"alpha": 1.0}}, "alpha"),
        ({"bounds": {"tau_max": (1.0, 2.0)}}, "tau_max"),
        ({"bounds": {"tau_max_s": (2.0, 1.0)}}, "lower < upper"),
        (
            {"hold": {"unrelaxed_modulus_MPa": 1.0, "tau_max_s": 1.0, "hardening_modulus_MPa": 1.0}},
            "one left to identify",
        ),
    ],
)
def test_bad_options_are_named(options, said):
    with pytest.raises(probation.InputError, match=said):
        fit(Campaign("x", (ramp_record(samples=50),)), **options)


def test_a_direction_without_influence_is_not_determined():
    """Two equal columns: neither parameter alone, J^T J is singular."""
    column = np.linspace(1.0, 2.0, 50)
    known = covariance(np.column_stack([column, column]), np.random.default_rng(0).normal(size=50), [50], np.ones(2))
    assert known.standard_error(0) is None
    assert status_of(known.relative_error[0]) == "not_identifiable"


def test_white_residuals_give_the_textbook_covariance():
    """y = a x, s^2 / sum x^2."""
    x = np.linspace(0.0, 1.0, 2000)
    residual = np.random.default_rng(5).normal(size=2000)
    known = covariance(x[:, None], residual, [2000], np.ones(1))
    assert not known.correlated
    assert known.standard_error(0) == pytest.approx(np.sqrt(residual @ residual / 1999 / (x @ x)), rel=1e-9)


@pytest.mark.parametrize("factor", [1e-7, 1e3])
def test_a_modulus_outside_1_kpa_to_1_tpa_is_questioned(factor):
    """3224 MPa, read as 0.32 kPa or 3.2 TPa."""
    record = ramp_record(samples=101)
    slipped = replace(record, true_stress=factor * record.true_stress)
    told = [warning for warning in fit(Campaign("x", (slipped,))).warnings if "are the units of stress" in warning]
    assert len(told) == 1
    assert told[0].startswith(f"E_u = {3224.0 * factor:.1g}"[:7])
    assert not any("units" in warning for warning in fit(Campaign("x", (record,))).warnings)


def test_units_that_were_assumed_are_told_with_the_fit(tmp_path):
    """In the summary and in the JSON, by column and file."""
    record = ramp_record(samples=101)
    rows = zip(record.time.tolist(), record.true_strain.tolist(), record.true_stress.tolist(), strict=True)
    lines = ["time_s,true_strain,true_stress", *(",".join(map(repr, row)) for row in rows)]
    (tmp_path / "bare.csv").write_text("\n".join(lines), encoding="utf-8")
    answer = fit(Campaign.from_files([tmp_path / "bare.csv"]))
    told = "no unit is stated for column 'true_stress' of bare.csv: MPa assumed"
    assert f"warning: bare: {told}" in " ".join(answer.summary().split())
    assert any(told in warning for warning in json.loads(answer.to_json())["warnings"])


def test_intervals_hold_no_value_that_the_law_cannot_take():
    """400 samples of noise as large as the stress: a symmetric interval of tau_max would reach below zero."""
    answer = fit(Campaign("x", (ramp_record(samples=400, noise=30.0),)))
    tau = answer.parameters["tau_max"]
    assert tau.value - 1.97 * tau.se < 0.0
    assert tau.interval95[0] == 0.0


def test_the_product_is_withdrawn_with_a_modulus_that_is_zero():
    time = np.linspace(0.0, 1.0, 100)
    stress = probation.haward_thackray_strain(time) ** 2
    answer = fit(Campaign("x", (Record("a", time, time, stress, control="strain-rate"),)))
    assert answer.law.unrelaxed_modulus == 0.0
    assert (answer.product.se, answer.product.status) == (None, "not_identifiable")


def test_the_residual_is_not_said_to_be_a_sum_that_it_is_not():
    """Noise and bias add in squares, and an estimate of the noise may be above the rms of the residual."""
    answer = fit(Campaign("x", (ramp_record(),)))
    (line,) = [each for each in answer.summary().splitlines() if "fit residual" in each]
    assert "=" not in line
    assert "+" not in line
