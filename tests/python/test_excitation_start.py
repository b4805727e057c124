"""A machine that takes a few samples to get going, and strains that the extensometer averages."""

import numpy as np
import pytest
from scipy.signal import bilinear, lfilter
from scipy.stats import chi2

import probation
from probation import Record, excite
from probation.smoothing.averaging import Averaging, averaging_of, weighted_median
from probation.smoothing.excitation import excite_each

SAMPLES, LENGTH, NOISE = 420, 0.5, 1.5e-4
FINER = 10


def started(rate, *, samples=SAMPLES):
    """Time and strain of a specimen in a servo-hydraulic loop: a valve and a position loop of a sample and a half."""
    step = LENGTH / rate / (samples - 1)
    time = np.arange((samples - 1) * FINER + 1) * step / FINER
    gain = 1.0 / (1.5 * step)
    b, a = bilinear([gain], [0.5 * step, 1.0, gain], fs=FINER / step)
    strain = lfilter(b, a, rate * time)
    return time[::FINER], strain[::FINER]


def record(time, strain, stress=None, name="a"):
    return Record(name, time, strain, np.zeros_like(time) if stress is None else stress)


def test_a_start_that_takes_some_samples_is_not_smoothed_away():
    """The start departs from a straight line by 2e-3 at most, within four samples."""
    time, strain = started(2e-3)
    errors, told = [], []
    for seed in range(8):
        found = excite(record(time, strain + NOISE * np.random.default_rng(seed).standard_normal(SAMPLES)))
        errors.append((found.true_strain - strain)[:6])
        told.append(found.strain_se[:6])
    assert abs(np.mean(errors, axis=0)).max() < NOISE
    ratio = np.array(errors) / np.array(told)
    assert np.sqrt(np.mean(ratio**2)) < 1.5


def test_a_start_that_is_sharp_costs_nothing():
    time = np.linspace(0.0, 100.0, SAMPLES)
    strain = 5e-3 * time
    found = excite(record(time, strain + 1e-5 * np.random.default_rng(0).standard_normal(SAMPLES)))
    assert abs(found.true_strain - strain).max() < 1.2e-5
    assert found.rate == pytest.approx(5e-3, rel=3e-3)


def evenly(since, lasts):
    """Part of the speed that a drive has which accelerates evenly."""
    return np.clip(since / lasts, 0.0, 1.0)


def in_half_a_wave(since, lasts):
    """The same of one that begins and ends its acceleration gently."""
    return 0.5 - 0.5 * np.cos(np.pi * evenly(since, lasts))


def overshooting(since, lasts):
    """The same of a loop of second order, damped by six tenths."""
    damped = 0.8 * since * 4.0 / lasts
    return 1.0 - np.exp(-0.6 * since * 4.0 / lasts) * (np.cos(damped) + 0.75 * np.sin(damped))


def lagging(since, lasts):
    """The same of a loop of first order."""
    return -np.expm1(-4.0 * since / lasts)


@pytest.mark.parametrize("drive", [evenly, in_half_a_wave, overshooting, lagging])
def test_no_drive_starts_further_from_the_smoothed_strain_than_is_said_of_it(drive):
    """Within 1 to 20 samples, in noise of a thirtieth to twice a sample's strain.

    By Mahalanobis' distance of the first thirty samples, and sample by sample of the first three. First-order lags
    alone leave nine in ten of the first three drives beyond a p-value of 1e-3.
    """
    random, beyond, first = np.random.default_rng(1), [], []
    for _ in range(40):
        since = np.arange((SAMPLES - 1) * FINER + 1) / FINER
        speed = drive(since, random.uniform(1.0, 20.0))
        travelled = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]))]) / FINER
        truth = 1e-3 * travelled[::FINER]
        noise = 1e-3 * np.exp(random.uniform(np.log(0.03), np.log(2.0)))
        found = excite(record(np.arange(SAMPLES) * 0.5, truth + noise * random.standard_normal(SAMPLES)))
        errors = found.errors().strain[:30] * found.strain_noise * np.sqrt(found.noise_inflation)
        size, along = np.linalg.eigh(errors @ errors.T)
        known = size > 1e-4 * size.max()
        off = (along.T @ (found.true_strain - truth)[:30])[known]
        beyond.append(chi2.sf(float(np.sum(off**2 / size[known])), np.count_nonzero(known)) < 1e-3)
        first.append((found.true_strain - truth)[:3] / found.strain_se[:3])
    assert np.mean(beyond) <= 0.13
    assert np.sqrt(np.mean(np.square(first), axis=0)) == pytest.approx(0.9, abs=0.3)
    assert abs(np.mean(first, axis=0)).max() < 0.5


def averaged(window, count, seed):
    """Noise of single pictures, of standard deviation 1, averaged over so many of them."""
    pictures = np.random.default_rng(seed).standard_normal(count + window - 1)
    return np.convolve(pictures, np.full(window, 1.0 / window), mode="valid")


@pytest.mark.parametrize("window", [1, 3, 5, 9])
def test_averages_of_pictures_are_told_from_white_noise(window):
    """White noise averaged over w pictures has w times the variance of white noise in slow averages."""
    time = np.linspace(0.0, 1.0, 900)
    curve = 0.5 * time + 0.05 * time**2
    told = [averaging_of(curve + NOISE * averaged(window, 900, seed)).inflation for seed in range(10)]
    assert np.median(told) == pytest.approx(window, rel=0.3)


def test_an_average_that_the_curve_of_one_record_hides_is_known_from_the_others():
    """A neck that passes within a tenth of the record bends as fast as the noise of nine pictures; a ramp does not.

    Alone it is followed, with the freedom of a hundred parameters and a fifth of the noise's inflation.
    """
    time = np.linspace(0.0, 100.0, 800)
    strains = {"neck": 0.5 * np.tanh((time - 50.0) / 8.0) + 1e-3 * time, "ramp": 5e-3 * time, "slow": 2e-3 * time}
    records = [
        record(time, strain + 0.2 * NOISE * averaged(9, 800, seed), name=name)
        for seed, (name, strain) in enumerate(strains.items())
    ]
    assert averaging_of(records[0].true_strain) is None
    alone, together = excite(records[0]), next(excite_each(records))
    assert alone.freedom > 80
    assert together.freedom < 60
    assert together.noise_inflation == pytest.approx(9.0, rel=0.35)
    errors = [np.sqrt(np.mean((found.true_strain - strains["neck"]) ** 2)) for found in (alone, together)]
    assert errors[1] < errors[0]
    assert next(excite_each(records[:1], further=records[1:])).freedom == together.freedom


def hunting(samples, seed):
    """A ramp whose machine gathers speed within 25 samples and then hunts by 2e-5, read with noise of 6e-6."""
    random = np.random.default_rng(seed)
    time = np.linspace(0.0, 100.0, samples)
    away = lfilter([1.0], [1.0, -1.6, 0.63], random.standard_normal(samples))
    late = 2.5 * (1.0 - np.exp(-((time / 5.0) ** 2)))
    truth = 5e-3 * (time - late) + 2e-5 * (away - away[0]) / np.std(away)
    return time, truth, truth + 6e-6 * random.standard_normal(samples)


def test_a_machine_that_hunts_makes_no_averaged_noise():
    """Second differences grow with the lag as those of averages do; fourth differences of neighbours do not."""
    told = [averaging_of(hunting(500, seed)[2]) for seed in range(20)]
    assert np.mean([one is None or one.inflation < 2.0 for one in told]) >= 0.9


@pytest.mark.parametrize("seed", [0, 1, 7, 15])
def test_a_machine_that_hunts_is_followed_from_its_start(seed):
    """Where the noise was taken for averaged, the curve was so stiff that it missed the start."""
    time, truth, strain = hunting(500, seed)
    found = excite(record(time, strain))
    assert np.sqrt(np.mean((found.true_strain - truth)[:40] ** 2)) < 1.5 * 6e-6


@pytest.mark.parametrize("window", range(2, 10))
def test_an_average_of_any_length_is_not_taken_for_white(window):
    ramp = 5e-3 * np.linspace(0.0, 100.0, 400)
    told = [averaging_of(ramp + NOISE * averaged(window, 400, seed)) for seed in range(20)]
    assert np.median([one.inflation for one in told if one is not None]) == pytest.approx(window, rel=0.35)


@pytest.mark.parametrize("count", range(13))
def test_of_a_few_samples_no_average_is_seen(count):
    assert averaging_of(np.random.default_rng(count).standard_normal(count)) is None


def test_what_one_record_of_many_shows_is_not_taken_for_the_extensometer():
    ramps = [5e-3 * np.linspace(0.0, 100.0, 600) + NOISE * averaged(1, 600, seed) for seed in range(4)]
    once = 5e-3 * np.linspace(0.0, 100.0, 600) + NOISE * averaged(9, 600, 5)
    assert averaging_of(once).inflation > 5.0
    assert Averaging.pooled([*ramps, once]).inflation == pytest.approx(1.0, abs=0.1)


def test_a_weighted_median_is_that_of_as_many_copies():
    assert weighted_median([3.0, 1.0, 2.0], [1.0, 1.0, 1.0]) == 2.0
    assert weighted_median([7.0, 1.0], [1.0, 5.0]) == pytest.approx(np.interp(0.5, [2.5 / 6, 5.5 / 6], [1.0, 7.0]))
    assert weighted_median([4.0], [2.0]) == 4.0


def test_averaged_noise_makes_no_jumps_of_the_rate():
    """With neighbours taken for independent there were jumps in 17 of 20 such ramps."""
    time = np.linspace(0.0, 100.0, 700)
    curve = 1.0 - np.exp(-time / 150.0)
    ramps = [record(time, curve + 8.0 * NOISE * averaged(5, 700, seed), name=f"{seed}") for seed in range(6)]
    assert [found.jumps for found in excite_each(ramps)] == [()] * 6


@pytest.mark.parametrize("seed", range(3))
def test_averaged_noise_is_not_followed(seed):
    """Of what is averaged over nine pictures the smoother leaves the size of a single picture's noise."""
    time, strain = started(2e-3, samples=800)
    found = excite(record(time, strain + NOISE * averaged(9, 800, seed)))
    assert found.freedom < 45
    assert found.strain_noise * np.sqrt(found.noise_inflation) == pytest.approx(NOISE, rel=0.35)


@pytest.mark.parametrize("seed", range(4))
def test_a_start_that_takes_some_samples_is_no_gap(seed):
    """E_u times what the start was smoothed by was an offset of the strain, ten times the noise of the stress."""
    random = np.random.default_rng(seed)
    material = probation.Law(unrelaxed_modulus=2000.0, tau_max=15.0, hardening_modulus=2.5)
    records = []
    for rate in (8e-4, 2e-3, 5e-3):
        time, strain = started(rate)
        stress = material.stress(time, strain, "sa2") + 0.05 * random.standard_normal(SAMPLES)
        measured = strain + NOISE * random.standard_normal(SAMPLES)
        records.append(record(time, measured, stress, f"{rate:g}"))
    alike = probation.Specimens(scatter="none")
    found = probation.fit(probation.Campaign(name="start", records=tuple(records), specimens=alike), "sa3")
    assert found.gap.test.p_value > 1e-4


@pytest.mark.parametrize("seed", range(3))
def test_a_wait_before_the_ramp_is_found_in_a_noisy_strain(seed):
    """Forty-five samples at rest, then a strain that leaves its noise of 2e-4 within two samples."""
    time = np.arange(320) * 0.05
    strain = 2.5e-3 * np.maximum(time - 2.25, 0.0)
    noisy = strain + 2e-4 * np.random.default_rng(seed).standard_normal(len(time))
    assert excite(record(time, noisy)).jumps == pytest.approx((45,), abs=6)


def followed(time, command, lag):
    """What a drive that lags by a time constant makes of a command, on ten instants a sample."""
    fine = np.linspace(time[0], time[-1], (len(time) - 1) * FINER + 1)
    b, a = bilinear([1.0], [lag, 1.0], fs=1.0 / (fine[1] - fine[0]))
    return lfilter(b, a, np.interp(fine, time, command))[::FINER]


def test_a_drive_that_takes_thirty_samples_to_get_going_makes_no_jump():
    """The logger is three times as fast at the start; the force bends as the strain does."""
    material = probation.Law(unrelaxed_modulus=600.0, tau_max=18.0, hardening_modulus=0.5)
    time = 1.8 * np.append(0.0, np.cumsum(1.0 - 0.65 * np.exp(-np.arange(299) / 12.0)))
    strain = 9e-4 * (time + 5.0 * np.expm1(-time / 5.0))
    stress = material.stress(time, strain, "exact")
    for seed in range(8):
        random = np.random.default_rng(seed)
        noisy = record(time, strain + 6e-5 * random.standard_normal(300), stress + 0.005 * random.standard_normal(300))
        assert excite(noisy).jumps == ()


def test_a_drive_that_lags_is_no_gap():
    """By eight samples, which is more than a few: of four campaigns two had a gap."""
    material = probation.Law(unrelaxed_modulus=2000.0, tau_max=15.0, hardening_modulus=2.5)
    alike = probation.Specimens(scatter="none")
    for seed in range(4):
        random, records = np.random.default_rng(seed), []
        for rate in (8e-4, 2e-3, 5e-3):
            time = np.linspace(0.0, LENGTH / rate, SAMPLES)
            strain = followed(time, rate * time, 8.0 * time[1])
            stress = material.stress(time, strain, "sa3") + 0.02 * random.standard_normal(SAMPLES)
            records.append(record(time, strain + 5e-5 * random.standard_normal(SAMPLES), stress, f"{rate:g}"))
        found = probation.fit(probation.Campaign(name="lag", records=tuple(records), specimens=alike), "sa3")
        assert not found.gap.exists, found.gap.test


@pytest.mark.parametrize("seed", range(4))
def test_a_jump_begins_where_the_command_changes_and_not_where_the_drive_has_followed(seed):
    """By five at sample 200, behind a drive of eight samples."""
    time = np.linspace(0.0, 300.0, 400)
    command = 5e-4 * time + 2e-3 * np.maximum(time - time[200], 0.0)
    noisy = followed(time, command, 8.0 * time[1]) + 3e-5 * np.random.default_rng(seed).standard_normal(400)
    assert excite(record(time, noisy)).jumps == pytest.approx((200,), abs=4)


@pytest.mark.parametrize("seed", range(4))
def test_one_jump_is_one_where_samples_lie_far_apart_before_it_and_close_together_after_it(seed):
    """Two speeds of a crosshead: no parabola follows the true strain over 16 samples of 120 s, a straight line does the
    nominal one. Two jumps in its place were a lag of the machine, and the strain swung by 0.06 between samples.
    """
    random = np.random.default_rng(seed)
    steps = np.append(120.0 * random.uniform(0.6, 1.5, 46), 35.0 * random.uniform(0.6, 1.5, 180))
    time = np.append(0.0, np.cumsum(steps))
    change = time[46] - 0.7 * steps[45]
    travel = 1.3e-4 * np.minimum(time, change) + 1.3e-5 * np.maximum(time - change, 0.0)
    strain = np.log1p(travel) + 5e-6 * random.standard_normal(len(time))
    driven = excite(record(time, strain))
    assert driven.jumps in ((45,), (46,))
    fine = driven.refined(8).true_strain
    assert np.all(np.diff(fine) > -1e-4)
