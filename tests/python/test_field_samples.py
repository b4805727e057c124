"""The pieces that a field's pixels go through before and beside the identification."""

import numpy as np
import pytest

import probation
from probation.field.between import between
from probation.field.errors import drawn_errors, neighbourhoods, rounds
from probation.field.example import specimen
from probation.field.example.superposition import superpose
from probation.field.noise import scatter
from probation.field.pixels import Pixels
from probation.field.samples import of_equal_samples, used_samples
from probation.field.smoothing import smoothed


def used(*missing, times=32):
    strain = np.zeros((1, times))
    strain[0, list(missing)] = np.nan
    return used_samples(strain, np.zeros((1, times)))[0]


def test_short_gaps_are_left_out_and_nothing_else():
    assert np.flatnonzero(~used(5, 6, 7, 20)).tolist() == [5, 6, 7, 20]


def test_a_long_gap_ends_the_record():
    """Four samples lack from 16 on: half of 32 remain, a whole number of sixteenths."""
    assert np.flatnonzero(used(16, 17, 18, 19)).tolist() == list(range(16))


def test_records_that_end_early_are_cut_to_sixteenths():
    """From 11 on there is nothing: 10 are five sixteenths of 32."""
    assert np.flatnonzero(used(*range(11, 32))).tolist() == list(range(10))


def test_a_lost_start_loses_the_record():
    assert not used(0).any()


def test_pixels_that_share_their_instants_come_together():
    mask = np.ones((4, 20), dtype=bool)
    mask[1, 5] = mask[3, 5] = False
    groups = sorted((pixels.tolist(), int(samples.sum())) for pixels, samples in of_equal_samples(mask))
    assert groups == [([0, 2], 20), ([1, 3], 19)]


@pytest.mark.parametrize("time", [np.arange(400.0), np.cumsum(1.0 + 0.5 * np.sin(np.arange(400.0)))])
def test_scatter_finds_the_noise_of_each_part_under_a_parabola(time):
    """Noise 1 in the first half, 3 in the second; no part sees the curve, up to the 5 % that parts of 25 leave."""
    level = np.where(np.arange(400) < 200, 1.0, 3.0)
    values = 1e-2 * time**2 + level * np.random.default_rng(1).standard_normal((1000, 400))
    found = scatter(time, values, np.zeros(1000, dtype=np.intp)).mean(axis=0)
    assert found[[20, 100, 150]] == pytest.approx(1.0, rel=0.05)
    assert found[[260, 390]] == pytest.approx(3.0, rel=0.05)


def test_scatter_grows_along_a_short_record_as_its_neighbours_do_and_is_as_large_as_its_own():
    """Noise that grows sixfold in 60 samples, of every second pixel twice as large; squares right within 10 %."""
    level = np.exp(np.linspace(0.0, np.log(6.0), 60)) * np.where(np.arange(400) % 2, 2.0, 1.0)[:, None]
    values = level * np.random.default_rng(3).standard_normal(level.shape)
    found = scatter(np.arange(60.0), values, np.zeros(400, dtype=np.intp))
    for odd in (0, 1):
        means = np.mean(found[odd::2] ** 2, axis=0).reshape(6, 10).mean(axis=1)
        assert means == pytest.approx((level[odd] ** 2).reshape(6, 10).mean(axis=1), rel=0.15)


def test_the_strain_between_samples_is_a_cubic_where_it_is_smooth_else_straight():
    """A cubic is its own spline; every third instant is a sample."""
    time = np.array([0.0, 1.0, 1.5, 3.0, 4.0])
    cubic = np.stack([time**3, 1.0 - time])
    fine, smooth = between(time, cubic, 3, smooth=True)
    assert fine[::3].tolist() == time.tolist()
    assert smooth == pytest.approx(np.stack([fine**3, 1.0 - fine]))
    straight = between(time, cubic, 3, smooth=False)[1]
    assert straight == pytest.approx(np.stack([np.interp(fine, time, row) for row in cubic]))


def test_smoothing_leaves_cubics_and_takes_out_noise():
    """Cubics have no fourth derivative. Noise that leaves k degrees of freedom of n leaves sqrt(k / n) of itself."""
    time = np.sort(np.random.default_rng(2).uniform(0.0, 10.0, 200))
    cubic = 0.1 + time - 0.2 * time**2 + 0.01 * time**3
    assert smoothed(time, cubic[None]) == pytest.approx(cubic[None], abs=1e-9)
    noisy = cubic + 1e-3 * np.random.default_rng(3).standard_normal((50, 200))
    assert np.std(smoothed(time, noisy) - cubic) < 1e-3 * np.sqrt(8 / 200)


def test_the_example_s_integration_obeys_eq_7():
    """A ramp at constant rate has a closed form."""
    rate, time = 5e-3, np.linspace(0.0, 200.0, 2001)
    law = probation.Law(unrelaxed_modulus=3000.0, tau_max=5.0, hardening_modulus=2.0)
    expected = probation.ramp_stress(law, rate, time)
    parameters = (np.array([each]) for each in (3000.0, 5.0, 2.0))
    assert superpose(0.1, rate * time[None], *parameters)[0] == pytest.approx(expected, abs=2e-4)


def test_the_example_s_specimen_necks_in_its_middle():
    """Strain 1.8 there, drawn monotonically everywhere, the rate rising 5 to 13 times as in the paper's Figure 1."""
    time = np.linspace(0.0, specimen.DURATION, 500)
    strain = specimen.true_strain(time, np.array([0.0, 6.0]), np.array([0.0, 0.0]))
    assert strain[:, 0].tolist() == [0.0, 0.0]
    assert strain[0, -1] == pytest.approx(1.8)
    assert strain[1, -1] < 0.4
    rate = np.diff(strain) / np.diff(time)
    assert (rate > 0.0).all()
    assert 5.0 < rate[0].max() / rate[0, 0] < 13.0


def test_drawn_errors_are_those_of_the_draws():
    """Draws twice as wide as the standard errors double these; the product's follow its own draws."""
    chance = np.random.default_rng(4)
    count, deviation = 1024, np.array([20.0, 0.1, 0.0])
    true = np.tile([3000.0, 5.0, 2.0], (count, 1))
    given = np.tile([10.0, 0.05, 0.0], (count, 1))
    status = np.zeros(count, dtype=np.int8)
    status[7] = 2
    first = Pixels(true, given, np.full(count, 0.3), status)
    again = Pixels(true + deviation * chance.standard_normal((count, 3)), given, np.full(count, 0.5), status * 0)
    near = neighbourhoods(np.ones((count, 20), dtype=bool), (32, 32))
    errors = drawn_errors(first, [(np.arange(count), again)], np.full(count, 0.1), near)
    good = np.arange(count) != 7
    assert np.isnan(errors.parameters[7]).all()
    assert errors.parameters[good].mean(axis=0) == pytest.approx(deviation, rel=0.05)
    relative = np.hypot(20.0 / 3000.0, 0.1 / 5.0)  # of the product of two that err by themselves
    assert errors.product[good].mean() == pytest.approx(15000.0 * relative, rel=0.05)
    assert errors.noise[good] == pytest.approx(0.4)  # 0.5^2 - 0.3^2 = 0.4^2


def test_a_record_with_few_like_it_near_by_is_drawn_more_often():
    """Of 8 x 16 pixels, one record ends half-way and is drawn 16 times; one pixel was refused and is not drawn."""
    used = np.ones((128, 32), dtype=bool)
    used[20, 16:] = False
    identified = np.arange(128) != 30
    near = neighbourhoods(used, (8, 16))
    assert sorted(np.unique(near, return_counts=True)[1].tolist()) == [1, 63, 64]
    drawn = list(rounds(identified, near))
    assert [len(pixels) for pixels in drawn] == [127] + 15 * [1]
    assert all(pixels.tolist() == [20] for pixels in drawn[1:])
