"""An unknown effect is paid for by what it takes to describe it."""

import numpy as np
import pytest

from campaigns import linear_problem as problem
from probation.inference.discrepancy import Discrepancy
from probation.inference.evidence import evidence

COUNT, RECORDS = 200, 5
STRAIN = np.linspace(0.0, 1.0, COUNT)


def gain(added, seed=0):
    """Log evidence that an unknown effect beside the elastic bar earns, given what is added to each record [sigma]."""
    rng = np.random.default_rng(seed)
    stresses = [100.0 * STRAIN + problem.SIGMA * (rng.standard_normal(COUNT) + each) for each in added]
    base = problem.solved(problem.bar(), problem.views(stresses))
    found = evidence(base, base, Discrepancy.of(problem.whitened(base)))
    return found.log_evidence_unknown - found.log_evidence


def band(size, middle=0.5):
    """A hump in the strain."""
    return size * np.exp(-0.5 * ((STRAIN - middle) / 0.08) ** 2)


def test_noise_alone_speaks_against_it():
    gains = [gain(np.zeros((RECORDS, COUNT)), seed) for seed in range(12)]
    assert np.median(gains) < -0.5
    assert np.max(gains) < 2.0


def test_the_same_in_all_records_needs_less_than_another_in_each():
    """The same energy in every record: one hump at one strain, or each elsewhere."""
    alike = np.mean([gain([band(0.8)] * RECORDS, seed) for seed in range(4)])
    apart = np.mean([gain([band(0.8, at) for at in (0.2, 0.35, 0.5, 0.65, 0.8)], seed) for seed in range(4)])
    assert alike > apart + 5.0


def test_one_record_alone_is_enough():
    one = np.zeros((RECORDS, COUNT))
    one[2] = band(2.0)
    assert gain(one) > 10.0


@pytest.mark.parametrize("size", [1.0, 3.0])
def test_the_more_there_is_the_more_is_earned(size):
    assert gain([band(2.0 * size)] * RECORDS) > gain([band(size)] * RECORDS) + 5.0


def test_teeth_of_one_pitch_are_one_unknown_effect():
    """As much energy in teeth of a twentieth of the strain as in noise of the records' own earns; in the noise not."""
    teeth = 2.0 * ((20.0 * STRAIN) % 1.0 - 0.5)
    assert gain([teeth] * RECORDS) > 100.0
    rough = [np.random.default_rng(index).permutation(teeth) for index in range(RECORDS)]
    assert gain(rough) < 5.0


def test_a_wave_in_time_is_no_unknown_effect_that_is_periodic_in_the_strain():
    """At a constant rate it is periodic in both: the catalogue's wave has the say, also where it grows with stretch."""
    wave = 1.5 * np.sin(2.0 * np.pi * 20.0 * STRAIN)
    assert gain([wave, *np.zeros((RECORDS - 1, COUNT))]) < 5.0
    assert gain([wave * np.exp(STRAIN), *np.zeros((RECORDS - 1, COUNT))]) < 5.0
