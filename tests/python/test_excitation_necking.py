"""The paper's own procedure: (A-1), sines, the same for the rate, and the check by integration."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter

from probation import InputError, Record, excite
from probation.histories.necking import NECKING_SETS
from probation.report.excitation_figures import figure_s3, figure_s4, figure_s5, figure_s6, figure_s7, figure_s8
from probation.smoothing.differences import differences, differences_error, differences_transposed
from probation.smoothing.necking import fit_necking
from probation.smoothing.sines import fit_sines
from probation_studies.smoothing.known_histories import KNOWN_HISTORIES

P2 = NECKING_SETS["P2"]
TIME = np.linspace(0.0, P2.duration, 801)


def record(time, strain, control="displacement-rate"):
    return Record("grips", time, strain, np.zeros_like(time), control=control)


def waves(time):
    """0.01 and 0.003 of strain at 2.3 and 5.1 cycles per record."""
    turn = 2.0 * np.pi * time / P2.duration
    return 0.01 * np.sin(2.3 * turn + 0.4) + 0.003 * np.sin(5.1 * turn + 1.0)


@pytest.fixture(scope="module")
def wavy():
    """Experiment 3's strain with waves on it and noise 3e-4; the fit of it; its true rate."""
    strain = P2.true_strain(TIME) + waves(TIME) - waves(TIME[:1])
    noisy = strain + 3e-4 * np.random.default_rng(0).normal(size=len(TIME))
    return noisy, fit_necking(TIME, noisy), np.gradient(strain, TIME)


@pytest.mark.parametrize("slower", [1.0, 4.0])
def test_the_parameters_of_a1_come_back(slower):
    """Set P2 as experiment 3, and four times slower as experiment 2; noise 1e-4, 1501 samples as published."""
    history = P2.slowed(slower)
    time = TIME * slower
    fit = fit_necking(time, history.true_strain(time) + 1e-4 * np.random.default_rng(1).normal(size=len(time)))
    found = fit.strain.history
    for name in ("a", "b", "c", "d"):
        assert getattr(found, name) == pytest.approx(getattr(history, name), rel=5e-3)
    assert len(fit.strain.sines.frequencies) == 0
    assert_allclose(fit.strain_slope, history.strain_rate(time), rtol=2e-3)


def test_sines_take_what_a1_leaves(wavy):
    noisy, fit, _ = wavy
    assert fit.strain.first_residual.std() > 1e-3
    assert fit.strain.final_residual.std() == pytest.approx(3e-4, rel=0.1)
    assert np.abs(fit.strain.sines.frequencies * P2.duration - 5.1).min() < 0.1
    assert_allclose(fit.strain.final, noisy, atol=2e-3)


def test_the_derivative_of_the_strains_fit_beats_the_rates_own_fit(wavy):
    """The slow part of differences telescopes to the outermost samples."""
    _, fit, truth = wavy
    by_strain, by_rate = (np.abs(rate / truth - 1.0) for rate in (fit.strain_slope, fit.rate.final))
    assert np.quantile(by_strain, 0.95) < 0.02
    assert np.median(by_strain) < 0.3 * np.median(by_rate)


def test_the_integrated_rate_is_the_strain_again(wavy):
    noisy, fit, _ = wavy
    assert fit.differentiator == "three-point central difference"
    assert fit.integrated[0] == fit.strain.final[0]
    assert fit.largest_drift == np.abs(fit.integrated - noisy).max()
    assert fit.largest_drift < 0.05


def test_the_known_history_of_another_formula_is_what_its_rate_says():
    """Closed forms both: differences of the strain at 1e-3 of the spacing agree to 1e-5."""
    for name, (_, sample) in KNOWN_HISTORIES.items():
        known = sample(np.random.default_rng(3))
        inner = slice(2, -2)
        slope = np.gradient(known.true_strain, known.time)[inner]
        apart = np.abs(slope / known.strain_rate[inner] - 1.0)
        assert np.quantile(apart, 0.9) < 2e-3, name


@pytest.mark.parametrize("method", ["necking", "necking-as-printed"])
def test_gauss_newton_says_what_moving_one_sample_does(method):
    """Refitted after moving a sample by 1e-4; to 15 %, as the robust scale moves, too."""
    noisy = P2.true_strain(TIME) + 3e-4 * np.random.default_rng(0).normal(size=len(TIME))
    found = excite(record(TIME, noisy), method)
    for sample in (100, 400):
        moved = noisy.copy()
        moved[sample] += 1e-4
        other = excite(record(TIME, moved), method)
        for operator, change in (
            (found.strain_operator()[:, sample], (other.true_strain - found.true_strain) / 1e-4),
            (found.rate_operator()[:, sample], (other.rate - found.rate) / 1e-4),
        ):
            assert np.linalg.norm(change - operator) < 0.15 * np.linalg.norm(operator)


def test_gauss_newton_says_what_moving_one_sample_does_to_sines():
    """A projection on the sines and their derivatives by frequency."""
    turn = 2.0 * np.pi * TIME / TIME[-1]
    noisy = np.sin(3.3 * turn) + 0.4 * np.cos(7.7 * turn) + 0.1 * np.random.default_rng(5).normal(size=len(TIME))
    found = fit_sines(TIME, noisy)
    jacobian, _ = found.jacobian(TIME)
    moved = noisy.copy()
    moved[300] += 0.1
    column = jacobian @ np.linalg.pinv(jacobian)[:, 300]
    change = (fit_sines(TIME, moved)(TIME) - found(TIME)) / 0.1
    assert np.linalg.norm(change - column) < 0.1 * np.linalg.norm(column)


def test_errors_cover_where_the_formula_holds():
    """Four parameters and an offset, so whole curves are off together: 95 % on average over draws."""
    inside = []
    time = np.linspace(0.0, P2.duration, 151)
    for seed in range(5):
        strain = P2.true_strain(time) + 3e-4 * np.random.default_rng(seed).normal(size=151)
        found = excite(record(time, strain), "necking")
        inside.append(np.mean(np.abs(found.rate - P2.strain_rate(time)) < 1.96 * found.rate_se))
    assert np.mean(inside) > 0.8


def test_two_sines_are_found_where_they_are():
    turn = 2.0 * np.pi * TIME / TIME[-1]
    noise = 0.1 * np.random.default_rng(5).normal(size=len(TIME))
    found = fit_sines(TIME, np.sin(3.3 * turn) + 0.4 * np.cos(7.7 * turn) + noise)
    assert_allclose(np.sort(found.frequencies) * TIME[-1], [3.3, 7.7], atol=0.05)
    assert_allclose(found(TIME), np.sin(3.3 * turn) + 0.4 * np.cos(7.7 * turn), atol=0.05)
    slope = (found(TIME + 1e-4) - found(TIME - 1e-4)) / 2e-4
    assert_allclose(found.derivative(TIME), slope, atol=1e-6)


@pytest.mark.parametrize("correlation", [0.0, 0.6])
def test_noise_needs_no_sines(correlation):
    """White noise, and noise that is correlated over five samples: of eight draws, six at least get none."""
    counts = []
    for seed in range(8):
        white = np.random.default_rng(seed).normal(size=len(TIME))
        counts.append(len(fit_sines(TIME, lfilter([1.0], [1.0, -correlation], white)).frequencies))
    assert sum(count == 0 for count in counts) >= 6


def test_differences_are_what_their_matrix_says():
    time = np.sort(np.random.default_rng(0).uniform(0.0, 10.0, 40))
    matrix = differences(time, np.eye(40))
    assert_allclose(differences(time, time**2)[1:-1], 2.0 * time[1:-1], atol=1e-10)
    assert_allclose(differences_error(time), np.linalg.norm(matrix, axis=1))
    rows = np.random.default_rng(1).normal(size=(3, 40))
    assert_allclose(differences_transposed(time, rows), rows @ matrix, atol=1e-10)


@pytest.mark.parametrize(
    ("strain", "complaint"),
    [
        (0.005 * TIME, "strain rate that changes by a factor of"),
        (0.1 * np.sin(2.0 * np.pi * TIME / TIME[-1]), "comes back by 0.2"),
    ],
)
def test_records_that_do_not_neck_are_refused(strain, complaint):
    noisy = strain + 1e-5 * np.random.default_rng(0).normal(size=len(TIME))
    with pytest.raises(InputError, match=rf"record 'grips', excitation 'necking': found a .*{complaint}"):
        excite(record(TIME, noisy), "necking")


def test_jumps_and_few_samples_are_refused():
    time = np.linspace(0.0, 80.0, 801)
    jump = np.where(time < 40.0, 1e-3 * time, 0.04 + 1e-2 * (time - 40.0))
    with pytest.raises(InputError, match=r"jumps at 40 s.*use 'quintic-spline'"):
        excite(record(time, jump), "necking")
    with pytest.raises(InputError, match="found 20 samples, expected 40"):
        excite(record(TIME[::40][:20], P2.true_strain(TIME[::40][:20])), "necking")


def test_uneven_time_weighs_differences_by_their_noise():
    """Steps from 1 to 30: a rate fitted with equal weights would be off by tens of percent."""
    steps = np.exp(np.random.default_rng(0).normal(size=800))
    time = np.concatenate([[0.0], np.cumsum(steps) / steps.sum() * P2.duration])
    fit = fit_necking(time, P2.true_strain(time) + 1e-4 * np.random.default_rng(1).normal(size=801))
    assert np.median(np.abs(fit.rate.final / P2.strain_rate(time) - 1.0)) < 0.02
    assert np.quantile(np.abs(fit.strain_slope / P2.strain_rate(time) - 1.0), 0.95) < 0.003


@pytest.mark.parametrize("figure", [figure_s3, figure_s4, figure_s5, figure_s6, figure_s7, figure_s8])
def test_the_supplementary_figures_have_axes_with_units(figure, wavy):
    axes = figure(wavy[1]).axes
    assert axes[-1].get_xlabel() == "time [s]"
    assert all("[" in each.get_ylabel() for each in axes)
    assert all(each.lines for each in axes)
