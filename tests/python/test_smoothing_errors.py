"""What is unknown of a smoothed strain: noise, and a machine that wanders by less than the noise shows."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation.records.record import Noise, Record
from probation.smoothing.excitation import excite
from probation.smoothing.penalised_spline import smooth_quintic

SLOW = 16
"""Legendre polynomials that slow errors are told in."""


def slow_errors(samples: int, noise: float, wander: float, seed: int) -> float:
    """Mean square of the slow errors of a smoothed ramp, over what the smoother says of them.

    The rate is 1 + wander (three sines of 1 to 6 cycles); whatever covariance is right makes this 1 on average.
    """
    random = np.random.default_rng(seed)
    time = np.linspace(0.0, 60.0, samples)
    phase = 2.0 * np.pi * (random.uniform(1.0, 6.0, 3) * time[:, None] / time[-1] + random.uniform(size=3))
    cycles = np.gradient(phase, time, axis=0)
    strain = 0.01 * (time + (wander * random.normal(size=3) * np.sin(phase) / cycles).sum(axis=1))
    found = smooth_quintic(time, strain + noise * random.normal(size=samples))
    slow = np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, samples), SLOW - 1))[0]
    root = slow.T @ found.errors().strain
    off = slow.T @ (found.true_strain - strain)
    return float(off @ np.linalg.solve(root @ root.T, off)) / (SLOW * found.noise**2 * found.inflation)


@pytest.mark.parametrize(("samples", "noise"), [(200, 1e-4), (200, 1e-3), (700, 1e-4), (700, 1e-3)])
def test_a_rate_that_wanders_by_less_than_the_noise_is_allowed_for(samples, noise):
    """Cross-validation smooths it away; the noise that the smoother lets through explains none of it."""
    found = [slow_errors(samples, noise, 2e-3, seed) for seed in range(40)]
    assert np.median(found) < 1.5
    assert np.mean(found) < 3.0


def test_a_rate_that_does_not_wander_costs_less_than_a_third_of_the_noise_in_each_error():
    time = np.linspace(0.0, 60.0, 400)
    found = [
        smooth_quintic(time, 0.01 * time + 1e-4 * np.random.default_rng(seed).normal(size=400)) for seed in range(20)
    ]
    slow = np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, 400), SLOW - 1))[0]
    sizes = [np.linalg.norm(slow.T @ each.errors().strain, axis=1) for each in found]
    assert_allclose(np.median(sizes, axis=0)[:2], 1.0, atol=0.1)
    assert np.median(sizes, axis=0)[8:].max() < 0.33


def test_errors_of_segments_are_independent_and_the_sample_at_a_jump_is_its_own():
    time = np.arange(0.0, 160.0, 0.4)
    strain = np.where(time < 83.14, 2e-2 * time, 2e-2 * 83.14 + 2e-3 * (time - 83.14))
    noisy = strain + 1e-4 * np.random.default_rng(3).normal(size=time.size)
    found = excite(Record("x", time, noisy, np.zeros_like(time), control="strain-rate", noise=Noise(0.01, 1e-4)))
    (jump,) = found.jumps
    errors = found.errors().strain
    covariance = errors @ errors.T
    assert not covariance[:jump, jump + 1 :].any()
    assert_allclose(found.refined(4).errors().strain[::4], errors, atol=1e-14)
