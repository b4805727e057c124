"""Smoothers that need no formula: how close they come, and whether their errors say so."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter, savgol_filter

from probation import InputError, Record, excite
from probation.histories.necking import NECKING_SETS
from probation.smoothing.methods import DEFAULT, METHODS
from probation.smoothing.penalised_spline import smooth_quintic
from probation.smoothing.savitzky_golay import LocalCubics
from probation.smoothing.segments import find_jumps
from probation.smoothing.smoothed import inflation
from probation_studies.smoothing.comparison import AIM, compare

NECKING = NECKING_SETS["P2"]


def record(time, strain, **more):
    return Record("a", time, strain, np.zeros_like(time), **{"control": "displacement-rate", **more})


def noisy_necking(noise, seed, samples=401, correlation=0.0):
    """Time, measured strain with autoregressive noise, true rate."""
    time = np.linspace(0.0, NECKING.duration, samples)
    white = np.sqrt(1.0 - correlation**2) * np.random.default_rng(seed).normal(size=samples + 100)
    strain = NECKING.true_strain(time) + noise * lfilter([1.0], [1.0, -correlation], white)[100:]
    return time, strain, NECKING.strain_rate(time)


def test_the_default_meets_the_aim_at_a_jump_by_ten():
    """p95 <= 0.5 % at noise 2e-5; measured 0.015 %, so 0.1 % tells a regression. Differences err by a quarter."""
    found = compare(["jump"], [2e-5], ["raw", DEFAULT], draws=3)
    assert AIM == 0.005
    assert found.results["jump", 2e-5, DEFAULT].p95 < 0.001
    assert found.results["jump", 2e-5, "raw"].p95 > 0.1
    assert "met" in found.verdict


def test_without_segments_a_jump_spoils_its_surroundings():
    """One spline across a corner: 5 % of the samples are off by more than 1 %, with segments by 0.1 % at most."""
    time = np.linspace(0.0, 80.0, 1501)
    strain = np.where(time < 40.0, 1.7e-3 * time, 0.068 + 1.7e-2 * (time - 40.0))
    strain += 2e-5 * np.random.default_rng(0).normal(size=time.size)
    truth = np.where(time <= 40.0, 1.7e-3, 1.7e-2)
    whole = smooth_quintic(time, strain).strain_rate
    assert np.quantile(np.abs(whole / truth - 1.0), 0.95) > 0.01
    assert np.quantile(np.abs(excite(record(time, strain)).rate / truth - 1.0), 0.95) < 0.001


@pytest.mark.parametrize(("history", "worst"), [("necking", 0.006), ("gaps", 0.008), ("grip-jump", 0.006)])
def test_the_quintic_spline_is_closer_than_the_cubic_one(history, worst):
    """Noise 3e-4; measured over three draws 0.47, 0.74 and 0.47 % against 0.74, 0.96 and 0.93 %."""
    found = compare([history], [3e-4], ["quintic-spline", "spline"], draws=3, seed=1)
    quintic, cubic = (found.results[history, 3e-4, method].p95 for method in found.methods)
    assert quintic < worst
    assert quintic < 0.8 * cubic


@pytest.mark.parametrize(("noise", "correlation"), [(1e-4, 0.0), (1e-3, 0.0)])
def test_the_band_of_the_rate_holds_the_truth(noise, correlation):
    """95 % of the samples on average (Nychka 1988); from the noise alone, without the bias, 91 %."""
    inside, noise_alone = [], []
    for seed in range(15):
        time, strain, truth = noisy_necking(noise, seed)
        found = excite(record(time, strain), DEFAULT)
        off = np.abs(found.rate - truth)
        inside.append(np.mean(off < 1.96 * found.rate_se))
        noise_alone.append(np.mean(off < 1.96 * np.sqrt(np.diag(found.rate_covariance()))))
    assert 0.93 < np.mean(inside) < 0.99
    assert np.mean(noise_alone) < np.mean(inside) - 0.02


def test_correlated_noise_is_neither_followed_nor_underestimated():
    """AR(1) 0.5 has three times the power of white noise at low frequencies: errors grow by sqrt 3 or so."""
    white, correlated, inside, grown = [], [], [], []
    for seed in range(6):
        for correlation, errors in ((0.0, white), (0.5, correlated)):
            time, strain, truth = noisy_necking(3e-4, seed, 1201, correlation)
            found = excite(record(time, strain), DEFAULT)
            errors.append(np.quantile(np.abs(found.rate / truth - 1.0), 0.95))
        inside.append(np.mean(np.abs(found.rate - truth) < 1.96 * found.rate_se))
        grown.append(found.noise_inflation)
    assert np.mean(correlated) < 2.5 * np.mean(white)
    assert np.mean(inside) > 0.9
    assert 2.0 < np.mean(grown) < 3.5


def test_inflation_is_that_of_autoregressive_noise():
    """(1 + 0.5) / (1 - 0.5) = 3 for AR(1) 0.5; one for white noise."""
    white = np.random.default_rng(3).normal(size=20000)
    assert inflation(white) < 1.05
    assert inflation(lfilter([1.0], [1.0, -0.5], white)) == pytest.approx(3.0, rel=0.1)


@pytest.mark.parametrize("window", [7, 21, 101])
def test_local_cubics_are_scipys_savitzky_golay(window):
    time = np.linspace(0.0, 10.0, 101)
    strain = np.random.default_rng(0).normal(size=101)
    local = LocalCubics(time, strain, window)
    assert_allclose(local.strain, savgol_filter(strain, window, 3), atol=1e-12)
    assert_allclose(local.rate, savgol_filter(strain, window, 3, deriv=1, delta=0.1), atol=1e-10)
    assert local.freedom == pytest.approx(np.trace(local.operators().strain))


def test_local_cubics_reproduce_a_cubic_on_uneven_time():
    time = np.sort(np.random.default_rng(0).uniform(0.0, 10.0, 80))
    local = LocalCubics(time, time**3, 15)
    assert_allclose(local.strain, time**3, atol=1e-9)
    assert_allclose(local.rate, 3.0 * time**2, atol=1e-9)


@pytest.mark.parametrize("uneven", [False, True])
def test_savitzky_golays_operators_and_errors_agree(uneven):
    time, strain, _ = noisy_necking(1e-3, 0, 151)
    if uneven:
        time = time + 0.3 * time[1] * np.sin(np.arange(151.0))
    found = excite(record(time, strain), "savitzky-golay")
    operator = found.rate_operator()
    assert_allclose(operator @ strain, found.rate, atol=1e-12)
    assert_allclose(found.strain_operator() @ strain, found.true_strain, atol=1e-12)
    spread = found.strain_noise * np.sqrt(found.noise_inflation)
    assert_allclose(found.rate_se, spread * np.linalg.norm(operator, axis=1), rtol=1e-9)


def test_samples_that_are_dense_by_design_keep_their_fast_start():
    """Creep that fades in 2 s, logged ever more slowly over an hour: the first rates are known, too."""
    time = np.concatenate([[0.0], np.geomspace(0.02, 3600.0, 400)])
    strain = 0.01 * (1.0 - np.exp(-time / 2.0)) + 1e-6 * np.random.default_rng(0).normal(size=401)
    found = excite(record(time, strain, control="hold"), DEFAULT)
    start = time < 2.0
    truth = 0.005 * np.exp(-time / 2.0)
    assert np.quantile(np.abs(found.rate - truth)[start] / truth[start], 0.9) < 0.05


def test_a_hold_that_is_logged_ever_more_slowly_has_one_jump():
    """Ramp to 8 s, then 1000 s of hold whose noise is ten times larger for a while: the noise is no jump."""
    time = np.concatenate([np.arange(0.0, 60.0, 0.2), np.arange(60.0, 160.0, 0.5), np.arange(160.0, 1000.0, 5.0)])
    noise = np.where((time > 60.0) & (time < 160.0), 1e-4, 1e-5) * np.random.default_rng(4).normal(size=len(time))
    strain = 1e-3 * np.minimum(time, 8.0) + noise
    jumps = find_jumps(time, strain, 1e-5)
    assert [round(float(time[jump])) for jump in jumps] == [8]


@pytest.mark.parametrize("method", [method for method in METHODS if not method.startswith("necking")])
@pytest.mark.parametrize("samples", [10, 13, 30])
def test_short_and_constant_records_are_smoothed_too(method, samples):
    time = np.linspace(0.0, 9.0, samples)
    ramp = excite(record(time, 0.01 * time), method)
    assert_allclose(ramp.rate, 0.01, rtol=1e-6)
    assert_allclose(ramp.true_strain, 0.01 * time, atol=1e-9)
    still = excite(record(time, np.zeros(samples)), method)
    assert_allclose(still.rate, 0.0, atol=1e-12)
    assert np.isfinite(still.rate_se).all()


def test_a_fast_clean_history_gets_the_knots_that_it_needs():
    """Twenty cycles in 400 samples, noise 1e-9: 50 knots would leave 1e-3."""
    time = np.linspace(0.0, 20.0, 401)
    found = smooth_quintic(time, 0.01 * np.sin(2.0 * np.pi * time))
    assert_allclose(found.true_strain, 0.01 * np.sin(2.0 * np.pi * time), atol=2e-5)


def test_an_unknown_method_is_refused_with_the_known_ones():
    time = np.linspace(0.0, 9.0, 30)
    with pytest.raises(InputError, match=r"excitation is 'loess'.*quintic-spline.*savitzky-golay"):
        excite(record(time, 0.01 * time), "loess")


def cycles(samples_per_cycle, samples, amplitude=0.01, noise=1e-5):
    """A sine on a ramp, twenty samples a second."""
    time = 0.05 * np.arange(samples)
    wave = amplitude * np.sin(2.0 * np.pi * np.arange(samples) / samples_per_cycle)
    return time, 0.005 * time + wave + noise * np.random.default_rng(0).normal(size=samples)


def test_cycles_too_many_for_the_smoothers_knots_are_left_as_recorded():
    """200 cycles: what the spline leaves is the cycles, a dozen times what neighbouring samples scatter by."""
    time, strain = cycles(20, 4001)
    found = excite(record(time, strain, control="cyclic"))
    assert found.method == "raw"
    assert_allclose(found.true_strain, strain, rtol=0.0, atol=0.0)
    assert found.strain_rate is None
    assert found.operators is None


def test_cycles_that_the_smoother_follows_are_smoothed():
    time, strain = cycles(80, 801)
    found = excite(record(time, strain, control="cyclic"))
    assert found.method == DEFAULT
    assert np.max(np.abs(found.true_strain - strain)) < 1e-4
    assert found.strain_noise == pytest.approx(1e-5, rel=0.1)
