"""Noise that rises as 1/f is extrapolated from where it shows, and little else is taken for it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.fft import idct

from campaigns import linear_problem as problem
from probation.noise.drift import estimate_drift, like_an_effect, with_drift
from probation.noise.record_residual import RecordResidual
from probation.noise.whitening import Whitened
from probation.settings.noise import NOISE

COUNT = 1000


def residual(rng, drift=0.0, bias=None, count=COUNT):
    """White noise whose power by half periods k is 1 + drift/k, and a bias by its cosine waves, in units of sigma."""
    order = np.maximum(np.arange(count), 1)
    waves = rng.standard_normal(count) * np.sqrt(1.0 + drift / order)
    if bias is not None:
        waves = waves + bias * np.where(np.arange(count) % 2 == 0, 1.0, -1.0) / order**2.0
    return problem.SIGMA * idct(waves, type=2, norm="ortho")


def whitened(residuals):
    records, noises = [], []
    for index, each in enumerate(residuals):
        time = np.linspace(0.0, 1.0, len(each))
        name = f"r{index}"
        records.append(RecordResidual(name, time, time, np.ones(len(each)), each, np.ones((len(each), 1))))
        noises.append(problem.white(len(each), name))
    return Whitened.of(records, noises)


def estimates(seeds, records=5, **options):
    return [
        estimate_drift(whitened([residual(np.random.default_rng((seed, r)), **options) for r in range(records)]))
        for seed in range(seeds)
    ]


@pytest.mark.parametrize("drift", [10.0, 20.0, 50.0])
def test_the_drift_of_simulated_noise_is_found(drift):
    """The median of a dozen campaigns; a single one to within a factor of four."""
    found = estimates(12, drift=drift)
    assert np.median(found) == pytest.approx(drift, rel=0.4)
    assert np.all((np.array(found) > drift / 4.0) & (np.array(found) < 4.0 * drift))


def test_white_noise_is_given_little_more_than_the_least_drift():
    """What c/k adds at the lowest order looked at, 8, is lost in the noise for c of some units."""
    found = estimates(12)
    assert np.all(np.array(found) >= NOISE.least_drift)
    assert np.median(found) < 4.0
    assert np.max(found) < 10.0


def test_more_records_tell_a_drift_more_closely():
    few, many = (np.std(np.log(estimates(12, records=records, drift=20.0))) for records in (1, 10))
    assert many < 0.7 * few


@pytest.mark.parametrize("bias", [100.0, 1000.0, 10_000.0])
def test_a_smooth_bias_is_not_taken_for_a_drift(bias):
    """Its power falls as k^-4 and is up to 10^8 times the noise's at the first half period."""
    assert np.median(estimates(12, bias=bias)) < 7.0
    assert np.max(estimates(12, bias=bias)) < 12.0


def test_a_sharp_fault_of_one_record_does_not_speak_for_the_others():
    """A step of twenty standard deviations: by itself its power falls as k^-2."""
    alike, apart = [], []
    for seed in range(8):
        series = [residual(np.random.default_rng((seed, r))) for r in range(5)]
        step = 20.0 * problem.SIGMA * (np.arange(COUNT) > 400)
        alike.append(estimate_drift(whitened(series)))
        apart.append(estimate_drift(whitened([*series[:4], series[4] + step])))
    assert np.median(apart) < np.median(alike) + 2.0


def test_too_few_samples_say_nothing():
    """The floor, and what a flat opinion up to the usual size adds: far below what a real drift is found at."""
    assert estimate_drift(whitened([residual(np.random.default_rng(0), count=40)])) >= NOISE.least_drift
    short = whitened([residual(np.random.default_rng(1), drift=100.0, count=40)])
    assert estimate_drift(short) == estimate_drift(whitened([residual(np.random.default_rng(0), count=40)]))


def test_whitening_with_a_drift_is_the_inverse_root_of_its_covariance():
    """sigma^2 (I + W diag(c/k) W^T), W cosine waves, the zeroth as the first; W C W^T = I."""
    count, drift = 120, 30.0
    noise = with_drift(problem.white(count), drift)
    kept = noise.drift.shape[1]
    waves = idct(np.eye(count), type=2, norm="ortho", axis=0)[:, :kept]
    order = np.maximum(np.arange(kept), 1)
    covariance = problem.SIGMA**2 * (np.eye(count) + (waves * drift / order) @ waves.T)
    whitener = noise.whiten(np.eye(count))
    assert kept > 20
    assert_allclose(whitener @ covariance @ whitener.T, np.eye(count), atol=1e-9)


def test_samples_close_in_time_drift_together():
    """Half of the samples within a hundredth of the record: their drift is one number, the others' are many."""
    time = np.concatenate([np.linspace(0.0, 0.01, 100, endpoint=False), np.linspace(0.01, 1.0, 100)])
    by_time, by_sample = (with_drift(problem.white(200), 30.0, time=each).drift for each in (time, None))
    own = np.linalg.svd(by_time[:100], compute_uv=False)
    assert own[1] < 0.1 * own[0]
    assert np.linalg.svd(by_sample[:100], compute_uv=False)[1] > 0.3 * own[0]
    assert_allclose(with_drift(problem.white(200), 30.0, time=np.linspace(5.0, 7.0, 200)).drift, by_sample, atol=1e-12)


def test_drawn_noise_with_a_drift_is_white_once_whitened():
    noise = with_drift(problem.white(150), 30.0)
    drawn = noise.simulate(np.random.default_rng(0), 4000)
    white = noise.whiten(drawn.T)
    assert_allclose(np.cov(white), np.eye(150), atol=0.12)
    # Its mean over the record scatters by 1 + 30 white variances: the zeroth wave's.
    assert np.var(drawn.mean(axis=1)) * 150 / problem.SIGMA**2 == pytest.approx(31.0, rel=0.1)


def test_a_drift_that_is_let_be_does_not_count_as_measured_noise():
    noise = with_drift(problem.white(150), 30.0)
    assert_allclose(noise.deviation, problem.SIGMA)
    assert_allclose(
        noise.scaled(2.0).simulate(np.random.default_rng(0))[0], 2.0 * noise.simulate(np.random.default_rng(0))[0]
    )


def test_the_more_drifts_the_more_of_it_may_go_along_with_an_effect_up_to_a_bound():
    """A form known to a fifth of its variance leaves a fifth of a drift along an effect's direction."""
    assert like_an_effect(5.0) == pytest.approx(0.2 * 5.0)
    found = [like_an_effect(drift) for drift in (0.0, 1.0, 3.0, 8.0, 100.0, 1e6)]
    assert found == sorted(found)
    assert found[0] > 0.0
    assert found[-1] < 4.0
