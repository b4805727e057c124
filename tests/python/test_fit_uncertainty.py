"""What a fit says of its own uncertainty: covariance by names, likelihood, bands along other histories, draws."""

import sys
import types
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import norm

import probation
from campaigns.few_records import LAW, few_records
from probation import Fit, InputError
from probation.identify.posterior import Posterior
from probation.law.schemes import scheme_of

TIME = np.linspace(0.0, 260.0, 120)
STRAIN = np.interp(TIME, [0.0, 200.0, 260.0], [0.0, 1.0, 0.8])


@cache
def white():
    return probation.fit(few_records(names=("slow", "middle")))


@cache
def undetermined():
    """G alone is identified well on a slow ramp at large strain; E_u and tau_max not where nothing relaxes."""
    return probation.fit(few_records(names=("slow",)), hold={"tau_max_s": 5.2})


def test_the_covariance_is_labelled_and_agrees_with_errors_and_correlation():
    fit = white()
    errors = np.array([fit.parameters[name].se for name in fit.names])
    assert fit.covariance.names == ("unrelaxed_modulus_MPa", "tau_max_s", "hardening_modulus_MPa")
    assert np.asarray(fit.covariance) == pytest.approx(fit.correlation * np.outer(errors, errors))
    assert fit.covariance["tau_max_s", "tau_max_s"] == pytest.approx(errors[1] ** 2)
    assert fit.covariance.to_dataframe().loc["tau_max_s", "hardening_modulus_MPa"] == fit.covariance.matrix[1, 2]
    assert fit.covariance.to_xarray().sel(parameter="tau_max_s").shape == (3,)
    with pytest.raises(InputError, match="found no 'tau_max', expected one of unrelaxed_modulus_MPa"):
        _ = fit.covariance["tau_max", "tau_max_s"]


def test_a_held_parameter_is_not_in_the_covariance():
    assert undetermined().covariance.names == ("unrelaxed_modulus_MPa", "hardening_modulus_MPa")


def test_the_likelihood_of_white_noise_is_that_of_independent_normal_samples():
    """Each record's standard deviation at its most probable value, the root mean square of its residual."""
    fit = white()
    expected = sum(norm.logpdf(each.fit_residual, scale=each.rms_MPa).sum() for each in fit.records.values())
    assert fit.weighting == "plain"
    assert fit.log_likelihood == pytest.approx(expected, rel=1e-9)
    assert fit.aic == pytest.approx(2.0 * (3 + 2) - 2.0 * expected)
    assert fit.bic == pytest.approx((3 + 2) * np.log(300) - 2.0 * expected)


def test_the_criteria_prefer_the_law_that_made_the_records():
    wrong = probation.fit(few_records(names=("slow", "middle")), hold={"hardening_modulus_MPa": 2.2})
    assert white().aic < wrong.aic
    assert white().bic < wrong.bic


def autocorrelated(random, count, correlation, deviation):
    independent = random.standard_normal(count + 200) * deviation * np.sqrt(1.0 - correlation**2)
    return lfilter([1.0], [1.0, -correlation], independent)[200:]


@pytest.mark.parametrize(("correlation", "least"), [(0.0, 0.90), (0.6, 0.90), (0.9, 0.80)])
def test_bands_hold_what_they_promise_under_autocorrelated_noise(correlation, least):
    """15 campaigns of two records; at 0.9 they hold 16 independent samples, from which errors are hard to know."""
    truth = LAW.stress(TIME, STRAIN, scheme="exact")
    confident, measured = [], []
    for seed in range(15):
        random = np.random.default_rng(seed)

        def noisy(name, time, strain, stress, random=random):
            return stress + autocorrelated(random, len(stress), correlation, 0.3)

        band = probation.fit(few_records(noisy, names=("middle", "fast"), noise=0.0)).predict(TIME, STRAIN)
        new = truth + autocorrelated(random, len(TIME), correlation, 0.3)
        confident.append(np.mean((band.confidence[0] <= truth) & (truth <= band.confidence[1])))
        measured.append(np.mean((band.prediction[0] <= new) & (new <= band.prediction[1])))
    assert least <= np.mean(confident)
    assert 0.91 <= np.mean(measured) <= 0.99


def test_autocorrelated_noise_widens_the_confidence_band():
    """By less than sqrt((1 + 0.6)/(1 - 0.6)) = 2: of white noise, too, slow noise that nobody sees is allowed for."""

    def noisy(correlation):
        random = np.random.default_rng(3)
        return lambda name, time, strain, stress: stress + autocorrelated(random, len(stress), correlation, 0.3)

    plain, wide = (
        probation.fit(few_records(noisy(rho), names=("middle", "fast"), noise=0.0)).predict(TIME, STRAIN)
        for rho in (0.0, 0.6)
    )
    ratio = np.median(wide.standard_error[1:] / plain.standard_error[1:])
    assert 1.2 < ratio < 2.7


def test_a_band_can_be_asked_for_at_another_level_and_drawn():
    narrow, wide = white().predict(TIME, STRAIN, level=0.5), white().predict(probation.StrainHistory(TIME, STRAIN))
    assert np.all(narrow.confidence[1][1:] < wide.confidence[1][1:])
    assert np.all(wide.prediction[0] <= wide.confidence[0])
    assert wide.plot().axes[0].get_legend_handles_labels()[1] == [
        "95 % of measured samples",
        "95 % confidence of the law's stress",
        "predicted",
    ]
    assert list(wide.to_dataframe().columns)[:3] == ["time_s", "true_strain", "true_stress_MPa"]
    assert wide.to_xarray()["true_stress_MPa"].dims == ("time_s",)
    with pytest.raises(InputError, match="level is 95; expected a probability between 0 and 1"):
        white().predict(TIME, STRAIN, level=95)


def test_a_fit_read_from_json_predicts_and_samples_as_before():
    again = Fit.from_json(white().to_json())
    assert again.predict(TIME, STRAIN).prediction == pytest.approx(white().predict(TIME, STRAIN).prediction)
    assert np.array_equal(again.sample(5).values, white().sample(5).values)
    assert again.aic == white().aic


def test_where_a_parameter_is_not_determined_the_band_is_infinite_and_sampling_is_refused():
    """At rest nothing tells E_u and tau_max apart beyond their product, and the search ends at its range."""
    slow = few_records(lambda name, time, strain, stress: 4.0 * strain, names=("slow",))
    fit = probation.fit(slow)
    assert not np.all(np.isfinite(np.asarray(fit.covariance)))
    assert np.isinf(fit.predict(TIME, STRAIN).standard_error[5:]).all()
    for ask in (fit.sample, lambda: fit.plot("corner")):
        with pytest.raises(InputError, match=r"found .*standard error"):
            ask()


def test_draws_have_the_mean_and_the_covariance_of_the_fit():
    fit = white()
    draws = fit.sample(20_000, seed=1)
    assert draws.values.mean(axis=0) == pytest.approx([getattr(fit.law, name) for name in fit.names], rel=1e-3)
    assert np.cov(draws.values.T) == pytest.approx(np.asarray(fit.covariance), rel=0.1)
    assert np.array_equal(fit.sample(3).values, fit.sample(3).values)
    assert draws.to_dataframe()["tau_max_s"].to_numpy() == pytest.approx(draws["tau_max_s"])
    assert repr(draws) == "<20000 draws of unrelaxed_modulus_MPa, tau_max_s, hardening_modulus_MPa>"
    with pytest.raises(InputError, match="n is 0; expected at least 1"):
        fit.sample(0)


def test_the_posterior_has_its_peak_and_its_curvature_where_the_fit_has_them():
    """With white noise its second derivatives are the inverse of the covariance."""
    fit = white()
    scheme = scheme_of(fit.scheme, fit.start)
    posterior = Posterior.of(
        fit.law, fit.names, fit.records.values(), fit.weighting, scheme=scheme, substeps=fit.substeps
    )
    centre = np.array([getattr(fit.law, name) for name in fit.names])
    errors = np.sqrt(np.diag(np.asarray(fit.covariance)))
    peak = posterior(centre)
    curvature = np.zeros((3, 3))
    for row in range(3):
        for column in range(3):
            steps = 0.1 * errors[row] * np.eye(3)[row], 0.1 * errors[column] * np.eye(3)[column]
            corners = [posterior(centre + a * steps[0] + b * steps[1]) for a in (1, -1) for b in (1, -1)]
            curvature[row, column] = (corners[0] - corners[1] - corners[2] + corners[3]) / 0.04
            assert max(corners) <= peak + 1e-3
    expected = np.linalg.inv(fit.correlation)
    assert -curvature == pytest.approx(expected, rel=0.1, abs=0.1 * np.abs(expected).max())
    assert posterior(-centre) == -np.inf


class Ensemble:
    """As emcee's sampler is called: it stays where it started, and keeps every state."""

    def __init__(self, walkers, free, posterior):
        self.shape, self.chain = (walkers, free), []
        self.posterior = posterior

    def run_mcmc(self, start, steps, **options):
        assert np.shape(start) == self.shape
        assert np.isfinite([self.posterior(each) for each in start]).all()
        self.chain = [start] * steps
        return start

    def reset(self):
        self.chain = []

    def get_chain(self, *, flat, thin):
        return np.concatenate(self.chain[::thin])


def test_emcee_walks_from_the_laplace_approximation(monkeypatch):
    monkeypatch.setitem(sys.modules, "emcee", types.SimpleNamespace(EnsembleSampler=Ensemble))
    draws = white().sample(40, method="emcee")
    assert draws.values.shape == (40, 3)
    assert draws.values[:16] == pytest.approx(white().sample(16).values)
    with pytest.raises(InputError, match="method is 'nuts'; expected one of laplace, emcee"):
        white().sample(40, method="nuts")


def test_emcee_refuses_strain_noise_that_it_does_not_know(monkeypatch):
    monkeypatch.setitem(sys.modules, "emcee", types.SimpleNamespace(EnsembleSampler=Ensemble))
    records = {name: replace(each, strain_noise_weighed=True) for name, each in white().records.items()}
    with pytest.raises(InputError, match=r"found strain noise weighed in 'slow'.*use method = 'laplace'"):
        replace(white(), records=records).sample(10, method="emcee")


@pytest.mark.parametrize(
    "module",
    [
        types.SimpleNamespace(from_dict=lambda posterior=None: posterior),  # before 1.0
        types.SimpleNamespace(from_dict=lambda data: data["posterior"]),
    ],
)
def test_draws_go_to_arviz_in_one_chain(monkeypatch, module):
    monkeypatch.setitem(sys.modules, "arviz", module)
    posterior = white().sample(7).to_arviz()
    assert posterior["tau_max_s"].shape == (1, 7)


@pytest.mark.parametrize(
    ("package", "ask"),
    [
        ("arviz", lambda: white().sample(2).to_arviz()),
        ("emcee", lambda: white().sample(2, method="emcee")),
        ("pandas", lambda: white().sample(2).to_dataframe()),
        ("xarray", lambda: white().predict(TIME, STRAIN).to_xarray()),
    ],
)
def test_a_package_that_is_not_installed_is_named_in_one_line(monkeypatch, package, ask):

    def absent(name):
        raise ModuleNotFoundError(name)

    monkeypatch.setattr("probation.results.extras.import_module", absent)
    with pytest.raises(InputError, match=rf"found no package {package}, expected it; pip install probation"):
        ask()


def test_the_corner_plot_has_a_panel_a_pair():
    figure = white().plot("corner")
    assert sum(axes.get_visible() for axes in figure.axes) == 6
    with pytest.raises(InputError, match="kind"):
        white().plot("scatter")
