"""Synthetic data of the paper's experiments, against what section 5 of docs/law.md says they must return."""

import numpy as np
import pytest
from scipy.optimize import least_squares

import probation
from probation.histories.necking import NECKING_SETS, NeckingHistory
from probation.law.companion import EXPONENTIAL_AS_PRINTED
from probation.published.experiments import (
    GRIP_LAWS,
    experiment,
    experiment_1,
    experiment_2,
    experiment_3,
    twin_campaign,
)

RATES = {"P1": (2.5e-3, 1.70e-2, 3.0e-3), "P2": (1.7e-3, 1.70e-2, 2.5e-3), "P3": (2.4e-3, 1.70e-2, 3.0e-3)}


@pytest.mark.parametrize("name", NECKING_SETS)
def test_the_closed_form_rate_is_the_derivative_of_a1(name):
    """Central differences of (A-1) away from t = 0, where t^c has no second derivative."""
    history = NECKING_SETS[name]
    time = np.linspace(5.0, history.duration, 200)
    h = 1e-3
    difference = (history.true_strain(time + h) - history.true_strain(time - h)) / (2 * h)
    np.testing.assert_allclose(history.strain_rate(time), difference, rtol=1e-8)


@pytest.mark.parametrize("name", NECKING_SETS)
def test_the_neck_starts_peaks_and_ends_at_the_rates_of_the_table(name):
    history = NECKING_SETS[name]
    rate = history.strain_rate(np.linspace(0.0, history.duration, 20001))
    start, peak, end = RATES[name]
    assert rate[0] == pytest.approx(start, rel=0.03)
    assert rate.max() == pytest.approx(peak, rel=0.005)
    assert rate[-1] == pytest.approx(end, rel=0.01)
    assert history.true_strain([history.duration])[0] == pytest.approx(1.8, abs=0.002)


def test_a_necking_history_that_cannot_be_is_refused():
    with pytest.raises(probation.InputError, match="c between 0 and 1"):
        NeckingHistory(a=-0.03, b=0.4, c=1.2, d=100.0, duration=100.0)


@pytest.mark.parametrize("number", [1, 2, 3])
def test_the_response_is_that_of_cvode_to_the_noise_free_digit(number):
    """CVODE shares nothing with the exact scheme that makes the synthetic data."""
    twin = experiment(number, noise=0.0)
    stress = twin.truth.stress(
        probation.StrainHistory(twin.time, twin.true_strain, strain_rate=twin.strain_rate, jumps=None), scheme="cvode"
    )
    np.testing.assert_allclose(twin.true_stress, stress, atol=2e-6)


@pytest.mark.parametrize("number", [1, 2, 3])
def test_the_noise_is_white_of_the_stated_size_and_follows_the_seed(number):
    clean, noisy, again = experiment(number, noise=0.0), experiment(number, 5), experiment(number, 5)
    noise = noisy.true_stress - clean.true_stress
    assert np.std(noise) == pytest.approx(0.04, rel=0.06)
    assert abs(np.corrcoef(noise[1:], noise[:-1])[0, 1]) < 0.08
    assert (noisy.true_stress == again.true_stress).all()
    assert len(noisy.time) == 1501


@pytest.mark.parametrize(
    ("number", "alpha", "hardening_modulus"),
    [(2, 0.924, 1.765), (3, 0.855, 1.867)],
    ids=["experiment-2", "experiment-3"],
)
def test_with_eq_12_the_twins_return_the_papers_alpha_and_g_which_were_not_put_in(number, alpha, hardening_modulus):
    twin = experiment(number)

    def fit_residual(parameters):
        law = probation.Law(
            unrelaxed_modulus=3220.0,
            alpha=parameters[0],
            hardening_modulus=parameters[1],
            companion=EXPONENTIAL_AS_PRINTED,
        )
        return law.stress(twin.time, twin.true_strain, "sa3") - twin.true_stress

    found = least_squares(fit_residual, [1.0, 1.7]).x
    assert found[0] == pytest.approx(alpha, abs=0.005)
    assert found[1] == pytest.approx(hardening_modulus, abs=0.01)


@pytest.mark.parametrize(("number", "largest", "g"), [(2, 10.1, 1.56), (3, 8.8, 1.64)])
def test_the_direct_prediction_with_eq_11_errs_as_in_the_paper(number, largest, g):
    twin = experiment(number, noise=0.0)
    law = probation.Law(unrelaxed_modulus=3220.0, hardening_modulus=g, companion=GRIP_LAWS[number].companion)
    error = np.abs(law.stress(twin.time, twin.true_strain, "sa3") - twin.true_stress)
    assert error.max() == pytest.approx(largest, abs=0.3)
    assert error.argmax() == len(error) - 1


def test_the_vibration_shows_in_strain_and_stress_alike():
    """bE2 on the recorded strain leaves the noise; the idealised ramp leaves the vibration."""
    twin = experiment_1(vibration=True)
    law = twin.truth
    on_record = law.stress(twin.time, twin.true_strain) - twin.true_stress
    idealised = probation.ramp_stress(law, 0.005, twin.time) - twin.true_stress
    assert np.std(on_record[50:]) == pytest.approx(0.04, rel=0.1)
    assert np.std(idealised) > 0.2
    vibration = twin.true_strain - 0.005 * twin.time
    assert np.corrcoef(idealised[50:], vibration[50:])[0, 1] < -0.9
    h = 1e-9
    assert (twin.true_strain[0], twin.strain_rate[0] * h < 1) == (0.0, True)


def test_strain_noise_is_in_the_record_only():
    quiet, noisy = experiment_3(), experiment_3(strain_noise=1e-3)
    assert (quiet.true_stress == noisy.true_stress).all()
    assert np.std(quiet.true_strain - noisy.true_strain) == pytest.approx(1e-3, rel=0.06)


def test_other_parameters_of_a1_can_be_chosen():
    assert experiment_2(necking="P1").time[-1] == pytest.approx(4 * 201.3)
    with pytest.raises(probation.InputError, match="expected one of P1, P2, P3"):
        experiment_3(necking="P4")


def test_a_campaign_of_twins_saves_and_loads(tmp_path):
    campaign = twin_campaign((2,), held_out=(3,), name="grips")
    assert [record.id for record in campaign.identify] == ["experiment-2"]
    assert [record.id for record in campaign.held_out] == ["experiment-3"]
    loaded = probation.Campaign.load(campaign.save(tmp_path / "grips"))
    assert loaded.law == campaign.law
    assert (loaded.records[1].true_stress == campaign.records[1].true_stress).all()


def test_a_campaign_of_the_ramp_has_no_companion_relation():
    assert twin_campaign((1,)).law.companion is None
