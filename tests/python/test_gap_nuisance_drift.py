"""Slow noise is let be, except for what does as an effect does."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from campaigns import linear_problem as problem
from probation.noise.drift import with_drift
from probation.noise.nuisance_drift import nuisance_drift
from probation.noise.record_residual import RecordResidual
from probation.noise.smooth_basis import waves
from probation.noise.whitening import Whitened
from probation.settings.noise import NOISE

COUNT, SIZE, WAVES = 400, 20.0, 10


@pytest.fixture
def whitened():
    """One record of white noise, with a drift of SIZE at the first half period that is like no effect."""
    time = np.linspace(0.0, 1.0, COUNT)
    record = RecordResidual("r", time, time, np.ones(COUNT), np.zeros(COUNT), np.zeros((COUNT, 1)))
    return Whitened.of([record], [with_drift(problem.white(COUNT, "r"), 0.0, nuisance=SIZE)])


BASIS = waves(COUNT, WAVES)
VARIANCES = SIZE / np.maximum(np.arange(WAVES), 1)


def test_without_signals_it_is_the_drift_along_the_waves(whitened):
    """Cosine waves are orthonormal and the drift's own: diag(c / k)."""
    assert_allclose(nuisance_drift(whitened, [BASIS]), np.diag(VARIANCES), rtol=1e-9, atol=1e-9)


def test_a_drift_has_little_along_a_signal_and_all_across_it(whitened):
    """A signal along wave 3: its noise, drift included, has variance 1 + c/3, and a drift may have ALIKE of that along
    it, so that 1 / (3/c + 1 / (ALIKE^2 (1 + c/3))) is left by Bayes' rule; the other waves keep theirs."""
    found = nuisance_drift(whitened, [BASIS], 7.0 * BASIS[:, [3]])
    left = VARIANCES.copy()
    left[3] = 1.0 / (1.0 / VARIANCES[3] + 1.0 / (NOISE.nuisance_drift_size**2 * (1.0 + VARIANCES[3])))
    assert_allclose(found, np.diag(left), rtol=1e-9, atol=1e-9)


def test_one_signal_given_many_times_is_known_once(whitened):
    many = np.repeat(BASIS[:, [2]], 6, axis=1) * np.arange(1.0, 7.0)
    assert_allclose(
        nuisance_drift(whitened, [BASIS], many), nuisance_drift(whitened, [BASIS], BASIS[:, [2]]), atol=1e-9
    )


def test_signals_that_the_base_law_takes_up_say_nothing(whitened):
    """The span of a refit takes the signal out altogether."""
    records = [RecordResidual("r", *[np.linspace(0.0, 1.0, COUNT)] * 2, np.ones(COUNT), np.zeros(COUNT), BASIS[:, [3]])]
    taken = Whitened.of(records, whitened.noises)
    assert_allclose(nuisance_drift(taken, [BASIS], BASIS[:, [3]]), np.diag(VARIANCES), rtol=1e-9, atol=1e-9)
