"""How far a gap shrinks: the figure, and how often its interval holds the truth."""

from dataclasses import replace

import numpy as np
import pytest

from campaigns import linear_problem as problem
from probation.diagnosis.closure import Piece, closure_of
from probation.noise.arma import Arma

SIGMA = problem.SIGMA


def rng(seed=0):
    return np.random.default_rng(seed)


def piece(before, after, **noise):
    return Piece(before, after, replace(problem.white(len(before)), **noise))


def of_size(size, count=400):
    """Samples of alternating sign: mean square size^2 exactly."""
    return size * (-1.0) ** np.arange(count)


def test_closure_is_the_part_of_the_excess_over_the_noise_that_is_gone():
    """Mean squares 4, 0.75 and noise 0.25: 1 - (0.75 - 0.25)/(4 - 0.25) = 13/15."""
    found = closure_of([piece(of_size(2.0), of_size(np.sqrt(0.75)))], rng())
    assert (found.before_MPa, found.after_MPa, found.noise_MPa) == pytest.approx((2.0, np.sqrt(0.75), 0.5))
    assert found.closure == pytest.approx(13.0 / 15.0)


def test_closure_of_records_weighs_every_sample_alike():
    """400 samples of mean squares 4 -> 1 and 100 of 1 -> 0.25: before 3.4, after 0.85, noise 0.25."""
    pieces = [piece(of_size(2.0), of_size(1.0)), piece(of_size(1.0, 100), of_size(0.5, 100))]
    assert closure_of(pieces, rng()).closure == pytest.approx(1.0 - (0.85 - 0.25) / (3.4 - 0.25))


def test_samples_where_the_strain_jumps_do_not_decide_what_the_noise_is():
    """Eight of 400 samples with a noise of 40 times the others': their errors count by 1/1600 each."""
    propagated = np.zeros((400, 1))
    propagated[200:208] = 40.0 * SIGMA
    found = closure_of([piece(of_size(2.0 * SIGMA), of_size(SIGMA), propagated=propagated)], rng())
    assert found.noise_MPa == pytest.approx(SIGMA, rel=0.02)
    assert (found.before_MPa, found.after_MPa) == pytest.approx((2.0 * SIGMA, SIGMA))
    assert found.closure == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("seed", range(5))
def test_the_interval_of_one_record_holds_the_closure_where_a_part_of_it_is_noisier(seed):
    """Its parts count as they do in the whole record."""
    propagated = np.zeros((400, 1))
    propagated[330:390] = 60.0 * SIGMA
    noise = rng(seed).normal(size=400) * np.where(propagated[:, 0] > 0.0, 60.0 * SIGMA, SIGMA)
    found = closure_of([piece(of_size(3.0 * SIGMA) + noise, noise, propagated=propagated)], rng(seed))
    low, high = found.interval
    assert found.closure == pytest.approx(1.0, abs=0.1)
    assert low <= found.closure <= high
    assert low > 0.7
    assert high < 1.3


def test_closure_is_not_clipped():
    """An explanation that makes matters worse closes less than nothing; one that follows the noise, more than all."""
    assert closure_of([piece(of_size(1.0), of_size(2.0))], rng()).closure == pytest.approx(1.0 - 3.75 / 0.75)
    assert closure_of([piece(of_size(1.0), of_size(0.4))], rng()).closure > 1.0


@pytest.mark.parametrize(("errors", "known"), [(1.9, False), (2.1, True)])
def test_closure_is_withheld_within_two_standard_errors_of_the_noise(errors, known):
    """The mean square of n white samples scatters by sigma^2 sqrt(2/n)."""
    size = SIGMA * np.sqrt(1.0 + errors * np.sqrt(2.0 / 400))
    found = closure_of([piece(of_size(size), of_size(SIGMA))], rng())
    assert (found.closure is not None) == known
    assert (found.interval is not None) == known
    assert found.before_MPa == pytest.approx(size)


def test_a_level_that_is_not_well_known_makes_a_small_gap_no_gap():
    """The same mean squares; a tenth of uncertainty in the noise's variance is more than the excess."""
    size = SIGMA * np.sqrt(1.0 + 0.18)
    assert closure_of([piece(of_size(size), of_size(SIGMA))], rng()).closure is not None
    assert closure_of([piece(of_size(size), of_size(SIGMA), level_variance=0.01)], rng()).closure is None


def test_one_record_is_resampled_in_parts_and_six_as_wholes():
    def how(count):
        return closure_of([piece(of_size(2.0), of_size(0.6))] * count, rng()).how

    assert "part" in how(1)
    assert "from simulated noise" in how(3)
    assert "records resampled" in how(6)


def wave(count, periods, size):
    return size * np.sqrt(2.0) * np.sin(2.0 * np.pi * periods * (np.arange(count) + 0.5) / count)


def coverage(sizes, left=0.3, count=150, draws=300, phi=0.0):
    """How often the 90 % interval holds 1 - left^2: gaps of those sizes, of which a part is left, and noise."""
    truth = 1.0 - left**2
    arma = Arma(phi, 0.0, SIGMA * np.sqrt(1.0 - phi**2))
    generator = rng(5)
    held = known = 0
    for _ in range(draws):
        pieces = []
        for size in sizes:
            gap, noise = wave(count, 3, size), arma.simulate(generator, count, 1)[0]
            pieces.append(piece(gap + noise, left * gap + noise, arma=arma))
        found = closure_of(pieces, generator)
        if found.interval is not None:
            known += 1
            held += found.interval[0] <= truth <= found.interval[1]
    assert known > 0.9 * draws
    return held / known


NEAR = 3.5 * np.sqrt(0.9 * 0.1 / 300)


@pytest.mark.parametrize("sizes", [(0.6, 1.0, 1.4), (3.0, 5.0, 4.0)])
def test_with_few_records_the_interval_covers_as_often_as_it_says(sizes):
    assert coverage(sizes) == pytest.approx(0.9, abs=NEAR)


def test_with_correlated_noise_it_still_does():
    assert coverage([0.8, 1.2, 1.6], phi=0.7) == pytest.approx(0.9, abs=NEAR)


def test_with_eight_records_it_does_though_they_are_resampled():
    assert coverage(np.linspace(0.5, 2.0, 8)) == pytest.approx(0.9, abs=NEAR)


@pytest.mark.parametrize("size", [1.0, 4.0])
def test_with_one_record_it_does_though_its_parts_are_resampled(size):
    assert coverage([size], count=300) == pytest.approx(0.9, abs=NEAR)
