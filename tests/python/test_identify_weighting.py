"""Uncertainty that holds: strain noise, autocorrelated noise, the bias distinguished, the profile of the likelihood."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter
from scipy.special import stdtrit

import probation
from probation import Campaign, Law, Noise, Record
from probation.identify import errors_by_strain_noise as strain_noise_module
from probation.identify import weighting as weighting_module
from probation.identify.base import base_fit
from probation.identify.bias import bias_of
from probation.identify.fit import plain_fit
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.inference.strain_noise import StrainNoise
from probation.law.settings import LawSettings
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.noise.white_level import white_level
from probation.published.experiments import experiment_3
from probation.settings.certificate import CERTIFICATE
from probation.settings.noise import NOISE
from probation.smoothing.excitation import excite

fit = partial(probation.fit, gap=False)  # the gap has its own tests

LAW = Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)


def ramp_record(seed=0, samples=200, strain_noise=0.0, stress_noise=0.04, given=True, correlation=0.0, wave=0.0):
    """Eq. (7) of the true strain, noise on strain and stress."""
    random = np.random.default_rng(seed)
    time = np.linspace(0.0, 400.0, samples)
    white = random.normal(size=samples)
    noise = lfilter([np.sqrt(1.0 - correlation**2)], [1.0, -correlation], white)
    stress = probation.ramp_stress(LAW, 0.005, time) + stress_noise * noise
    strain = 0.005 * time + strain_noise * random.normal(size=samples)
    stress += wave * np.cos(2.0 * np.pi * (0.005 * time - 1.2) / 1.6)  # largest at a strain of 1.2, none at the start
    known = Noise(stress_noise, strain_noise) if given else Noise()
    return Record("ramp", time, strain, stress, control="strain-rate", noise=known)


def values(answer):
    return np.array([parameter.value for parameter in answer.parameters.values()])


def errors(answer):
    return np.array([parameter.se for parameter in answer.parameters.values()])


@pytest.mark.parametrize("directions", [0, 4, 60])
@pytest.mark.parametrize("correlation", [0.0, 0.6])
def test_whitening_is_the_inverse_root_of_the_covariance(directions, correlation):
    """Sigma = s^2 rho^|i - j| + C C^T, written out; the strain errors are C^T Sigma^-1 r."""
    random = np.random.default_rng(1)
    propagated = random.normal(size=(60, directions))
    arma = Arma(phi=correlation, innovation=0.3 * np.sqrt(1.0 - correlation**2))
    noise = NoiseModel.stationary("x", arma, 60).with_propagated(propagated)
    order = np.arange(60)
    sigma = (
        0.09 * (correlation ** np.abs(order[:, None] - order) if correlation else np.eye(60))
        + propagated @ propagated.T
    )
    root = noise.whiten(np.eye(60))
    assert_allclose(root.T @ root, np.linalg.inv(sigma), atol=1e-9)
    residual = random.normal(size=60)
    expected = propagated.T @ np.linalg.solve(sigma, residual)
    assert_allclose(noise.strain_errors(residual), expected, rtol=1e-8, atol=1e-9)
    assert noise.correlation == pytest.approx(correlation)
    assert noise.log_determinant == pytest.approx(np.linalg.slogdet(sigma)[1])


@pytest.mark.parametrize("directions", [0, 3, 50])
def test_the_level_of_stress_noise_beside_strain_noise_of_known_size_is_that_of_restricted_likelihood(directions):
    """A tenth of the criterion's own curvature: the search's step; and the truth within what 50 samples know."""
    random = np.random.default_rng(4)
    tangent, propagated = random.normal(size=(50, 2)), 0.5 * random.normal(size=(50, directions))
    residual = 0.3 * random.normal(size=50) + propagated @ random.normal(size=directions)

    def criterion(level):
        sigma = level**2 * np.eye(50) + propagated @ propagated.T
        inverse = np.linalg.inv(sigma)
        information = tangent.T @ inverse @ tangent
        left = inverse - inverse @ tangent @ np.linalg.solve(information, tangent.T @ inverse)
        return np.linalg.slogdet(sigma)[1] + np.linalg.slogdet(information)[1] + residual @ left @ residual

    found = white_level(residual, tangent, propagated, 0.5)
    assert criterion(found) <= min(criterion(0.97 * found), criterion(1.03 * found))
    assert 0.1 < found < 0.7


@pytest.mark.parametrize("method", ["raw", "spline"])
def test_propagated_noise_is_the_covariance_of_the_stress_that_strain_errors_make(method):
    """C C^T against sigma_x^2 D D^T, D by differences of solves, one error at a time, as the smoother leaves them."""
    record = ramp_record(strain_noise=1e-4, samples=100)
    excitation = excite(record, method)
    propagated = StrainNoise.of(excitation, "sa3").propagated(LAW)
    errors = excitation.errors() if excitation.errors else None
    columns = []
    for at in range(100 if errors is None else errors.strain.shape[1]):
        unit = np.zeros(100 if errors is None else errors.strain.shape[1])
        unit[at] = 1e-6
        sides = [
            LAW.stress(
                probation.StrainHistory(
                    record.time,
                    excitation.true_strain + sign * (unit if errors is None else errors.strain @ unit),
                    strain_rate=None if errors is None else excitation.strain_rate + sign * (errors.rate @ unit),
                    jumps=None,
                ),
                scheme="sa3",
            )
            for sign in (1.0, -1.0)
        ]
        columns.append((sides[0] - sides[1]) / 2e-6)
    expected = 1e-8 * np.array(columns).T @ np.array(columns)
    assert_allclose(propagated @ propagated.T, expected, atol=1e-4 * np.abs(expected).max())


@pytest.mark.parametrize("method", ["raw", "spline"])
def test_the_search_descends_along_the_gradient_of_the_cost_with_sigma_re_evaluated(method):
    """d/d theta of r^T Sigma(theta)^-1 r by central differences."""
    record = ramp_record(strain_noise=1e-3, samples=100)
    view = measured_view(record, excite(record, method), "sa3")
    problem = Problem.white(DnlrLaw(LAW), [view])
    problem = problem.with_noises(problem.whitener.noises, [StrainNoise.of(view.excitation, "sa3")])
    away = LAW.parameters * [0.95, 1.02, 1.01]
    residual, jacobian = problem.residual_and_jacobian(away)
    for index in range(3):
        sides = []
        for sign in (1.0, -1.0):
            moved = away.copy()
            moved[index] *= 1.0 + sign * 1e-4
            there = problem.residual(moved)
            sides.append(there @ there)
        slope = (sides[0] - sides[1]) / (2e-4 * away[index])
        assert 2.0 * residual @ jacobian[:, index] == pytest.approx(slope, rel=2e-3)


@pytest.mark.parametrize("weighting", ["auto", "strain-noise", "strain-noise-frozen"])
def test_without_strain_noise_every_weighting_is_plain_least_squares(weighting):
    campaign = Campaign("x", (ramp_record(),))
    plain, answer = fit(campaign, "sa3", weighting="plain"), fit(campaign, "sa3", weighting=weighting)
    assert answer.weighting == "plain"
    assert_allclose(values(answer), values(plain), rtol=1e-9)
    assert_allclose(errors(answer), errors(plain), rtol=1e-9)


@pytest.mark.parametrize("scheme", ["sa3", "be2"])
def test_strain_noise_that_is_not_smoothed_biases_all_but_the_re_evaluated_weighting(scheme):
    """3e-4 where a step is 1e-2 of strain: plain least squares and a frozen Sigma lose several per cent of E_u."""
    campaign = Campaign("x", (ramp_record(strain_noise=3e-4, samples=300),))
    plain, frozen, auto = (
        fit(campaign, scheme, method="variable-projection", excitation="raw", weighting=weighting)
        for weighting in ("plain", "strain-noise-frozen", "auto")
    )
    assert auto.weighting == "strain-noise"
    assert values(plain)[0] < 0.95 * LAW.unrelaxed_modulus
    assert values(frozen)[0] < 0.98 * LAW.unrelaxed_modulus
    assert np.all(np.abs(values(auto) - LAW.parameters) < 3.0 * errors(auto))
    assert "of the strain" in auto.summary()
    assert auto.to_dict()["records"]["ramp"]["strain_noise_weighed"] is True


def test_a_smoothed_strain_still_leaves_its_error_in_G_and_what_it_may_hide_in_E():
    """A straight line through n samples errs by 2 sigma_x / sqrt(n) at its end, a spline by more; G follows e_HT.

    A rate that wanders by less than the noise shows moves E, and more than the noise does.
    """
    campaign = Campaign("x", (ramp_record(strain_noise=1e-3),))
    plain, auto = fit(campaign, "sa3", weighting="plain"), fit(campaign, "sa3")
    assert auto.weighting == "strain-noise"
    assert auto.parameters["hardening_modulus"].se > 2.0 * plain.parameters["hardening_modulus"].se
    assert 1.5 < auto.parameters["unrelaxed_modulus"].se / plain.parameters["unrelaxed_modulus"].se < 6.0
    assert any("standard errors" in warning for warning in plain.warnings)
    assert not auto.warnings


def test_strain_noise_that_a_bias_hides_changes_nothing():
    campaign = Campaign("x", (ramp_record(strain_noise=1e-4, wave=1.5),))
    assert fit(campaign, "sa3").weighting == "plain"


def test_long_records_have_their_strain_noise_drawn_again(monkeypatch):
    """The same standard error of G as by the matrix, to the 20 % that 12 draws leave (three times that)."""
    campaign = Campaign("x", (ramp_record(strain_noise=1e-4),))
    whole = fit(campaign, "sa3")
    monkeypatch.setattr(weighting_module, "NOISE", replace(NOISE, most_with_strain_noise=100))
    monkeypatch.setattr(strain_noise_module, "CERTIFICATE", replace(CERTIFICATE, strain_draws=12))
    drawn = fit(campaign, "sa3")
    assert drawn.weighting == "plain, strain noise resampled"
    se = [answer.parameters["hardening_modulus"].se for answer in (drawn, whole)]
    assert se[0] == pytest.approx(se[1], rel=0.6)


def test_autocorrelated_noise_is_found_and_widens_the_errors():
    """AR(1) 0.5 triples the variance of what is slow: sqrt((1 + rho) / (1 - rho)) = 1.73 in the standard errors."""
    campaign = Campaign("x", (ramp_record(correlation=0.5, samples=1000),))
    plain, auto = fit(campaign, "sa3", weighting="plain"), fit(campaign, "sa3")
    assert auto.weighting == "autocorrelated"
    assert auto.records["ramp"].noise_correlation == pytest.approx(0.5, abs=0.1)
    ratio = (
        auto.parameters["hardening_modulus"].se
        / fit(Campaign("x", (ramp_record(samples=1000),)), "sa3").parameters["hardening_modulus"].se
    )
    assert ratio == pytest.approx(np.sqrt(3.0), rel=0.15)
    assert auto.autocorrelated
    assert not auto.newey_west
    assert auto.noise_MPa == pytest.approx(0.04, rel=0.15)
    assert "correlation of neighbours 0." in " ".join(auto.summary().split())
    assert_allclose(values(auto), values(plain), atol=2.0 * errors(auto).max())


def test_a_fit_and_a_diagnosis_see_the_same_noise():
    """One estimate: the correlation and the size, of the same record by both."""
    campaign = Campaign("x", (ramp_record(correlation=0.6, samples=600),))
    found = fit(campaign, "sa3").records["ramp"]
    (noise,) = base_fit(campaign, plain_fit(campaign)).whitened.noises
    assert found.noise_correlation == pytest.approx(noise.correlation, rel=1e-3)
    assert found.noise_correlation == pytest.approx(0.6, abs=0.1)


def test_noise_that_varies_along_a_record_weighs_its_samples():
    """Twelve times as large in the second half: E_u is known from the first one alone, and far better."""
    record = ramp_record(samples=600)
    burst = np.where(record.time > 200.0, 0.5, 0.0) * np.random.default_rng(3).normal(size=600)
    record = replace(record, true_stress=record.true_stress + burst, noise=Noise(), sha256="")
    plain, auto = (fit(Campaign("x", (record,)), "sa3", weighting=weighting) for weighting in ("plain", "auto"))
    assert auto.weighting == "varying"
    assert "varies along a record" in auto.summary()
    assert np.all(np.abs(values(auto) - LAW.parameters) < 3.5 * errors(auto))
    assert errors(auto)[0] < 0.4 * errors(plain)[0]


def test_on_short_records_the_strain_noise_keeps_its_size():
    """40 samples, whose stress is curved between them: its differences say nothing of its noise.

    Errors of G over standard errors have a root mean square of 1 within a fifth, 2.3 where both noises were scaled
    together.
    """
    distances = []
    for seed in range(40):
        answer = fit(
            Campaign("x", (ramp_record(seed, samples=40, strain_noise=1e-3, given=False),)),
            "sa3",
            method="variable-projection",
        )
        found = answer.parameters["hardening_modulus"]
        distances.append((found.value - LAW.hardening_modulus) / found.se)
    assert np.sqrt(np.mean(np.square(distances))) < 1.35


def test_white_noise_is_not_taken_as_autocorrelated():
    """1 % of white records are; of 20, three have a chance of 0.1 %."""
    found = [fit(Campaign("x", (ramp_record(seed),)), "sa3", method="variable-projection") for seed in range(20)]
    assert sum(answer.autocorrelated for answer in found) <= 2


def test_a_wave_is_a_bias_not_noise():
    answer = fit(Campaign("x", (ramp_record(wave=1.5, samples=1000),)), "sa3")
    assert (answer.weighting, answer.newey_west) == ("plain", True)


def test_the_bias_is_told_with_its_place_and_size():
    """A wave of 1.5 MPa, largest at a strain of 1.2; the fit takes a part of it into the parameters."""
    answer = fit(Campaign("x", (ramp_record(wave=1.5, samples=600),)), "sa3")
    bias = answer.records["ramp"].bias
    assert bias.significant
    assert bias.true_strain == pytest.approx(1.2, abs=0.1)
    assert 1.0 < bias.largest_MPa < 2.0
    assert "at a strain of 1." in answer.summary()
    assert answer.to_dict()["records"]["ramp"]["bias_max_MPa"] == bias.largest_MPa
    assert not fit(Campaign("x", (ramp_record(samples=600),)), "sa3").records["ramp"].bias.significant


def test_noise_alone_hardly_ever_looks_like_a_bias():
    time = np.linspace(0.0, 1.0, 400)
    found = [bias_of(np.random.default_rng(seed).normal(size=400), time, time, 1.0).significant for seed in range(200)]
    assert sum(found) <= 10


def test_the_profile_of_a_linear_problem_is_the_standard_error():
    """tau_max held, E_u and G are linear: value +- t se, t Student's at 97.5 %."""
    campaign = Campaign("x", (ramp_record(),))
    options = {"scheme": "sa3", "hold": {"tau_max_s": 5.207}}
    plain, profiled = fit(campaign, **options), fit(campaign, **options, intervals="profile")
    for name in ("unrelaxed_modulus", "hardening_modulus"):
        assert_allclose(
            profiled.parameters[name].interval95,
            plain.parameters[name].interval95,
            atol=1e-4 * plain.parameters[name].se,
        )
    assert profiled.to_dict()["intervals"] == "profile"


def test_at_the_ends_of_the_profile_the_cost_has_risen_by_the_quantile():
    """Few noisy samples, so that it bends: refits with the parameter held there have RSS / s^2 larger by t^2.

    E_u tau_max is what the record knows: 1 / tau_max is linear, and the interval of E_u is longer above.
    """
    record = ramp_record(samples=40, stress_noise=0.3)
    campaign = Campaign("x", (record,))
    answer = fit(campaign, "sa3", intervals="profile", weighting="plain")
    freedom = 40 - 3
    least = 40 * answer.rms_MPa**2
    quantile = stdtrit(freedom, 0.975)
    for name, outside in (("unrelaxed_modulus", "unrelaxed_modulus_MPa"), ("tau_max", "tau_max_s")):
        for end in answer.parameters[name].interval95:
            held = fit(campaign, "sa3", hold={outside: end}, weighting="plain")
            rise = (40 * held.rms_MPa**2 - least) / (least / freedom)
            assert np.sqrt(rise) == pytest.approx(quantile, rel=0.02)
    modulus = answer.parameters["unrelaxed_modulus"]
    assert modulus.interval95[1] - modulus.value > 1.02 * (modulus.value - modulus.interval95[0])


def test_the_profile_with_strain_noise_is_about_the_standard_error():
    campaign = Campaign("x", (ramp_record(strain_noise=3e-4, samples=100),))
    answer = fit(campaign, "sa3", excitation="raw", intervals="profile")
    parameter = answer.parameters["hardening_modulus"]
    reach = stdtrit(97, 0.975) * parameter.se
    assert_allclose(parameter.interval95, [parameter.value - reach, parameter.value + reach], atol=0.1 * parameter.se)


def test_the_page_shows_the_profile(tmp_path):
    path = fit(Campaign("x", (ramp_record(),)), "sa3", intervals="profile").report(tmp_path / "fit.html")
    assert "Profile likelihood" in path.read_text(encoding="utf-8")


def test_the_edge_of_the_search_is_told():
    """Experiment 3 without companion relation: the cost falls as tau_max goes to 0 at fixed E_u tau_max (Figure 3)."""
    record = experiment_3().record()
    answer = fit(Campaign("x", (record,), LawSettings()), "sa3", method="variable-projection")
    assert any("edge of its range" in warning for warning in answer.warnings)
