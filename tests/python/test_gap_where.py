"""A gap is found where it was put."""

from dataclasses import replace

import numpy as np
import pytest

from campaigns import gap_noise
from probation.detection.lines_and_steps import find_lines, find_steps, running_median
from probation.detection.signatures import parameter_drift
from probation.detection.where import contribution_regions, locate
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.noise.whitening import Whitened
from probation.records.runs import runs

NAMES = ("unrelaxed_modulus", "tau_max", "hardening_modulus")
COUNT = 500


def campaign(seed, bias=None, kind="white", count=COUNT):
    blank = [np.zeros(count) for _ in range(6)]
    for index, values in (bias or {}).items():
        blank[index] = values
    return Whitened.of(gap_noise.records(kind, np.random.default_rng(seed), count, blank))


def overlap(first, second):
    """Intersection over union of two slices."""
    a, b = set(range(first.start, first.stop)), set(range(second.start, second.stop))
    return len(a & b) / len(a | b)


def bump(first, stop, size=0.2, count=COUNT):
    values = np.zeros(count)
    values[first:stop] = size * np.hanning(stop - first)
    return values


def test_a_bump_in_one_record_is_found_in_that_record_and_there():
    found = locate(campaign(0, {1: bump(200, 260)})).located
    assert found[0].record == "middle"
    assert overlap(found[0].samples, slice(203, 257)) > 0.6
    assert found[0].p_value < 1e-4
    assert found[0].share > 0.6
    assert sum(each.share for each in found) <= 1.0


def test_nothing_is_found_in_noise_and_familywise_p_values_hold_over_all_regions():
    """The smallest of a campaign is uniform: 8 campaigns, mean 0.5 +- 0.1 times three; two below 1 %: 0.3 %."""
    found = [locate(campaign(100 + seed, count=200), size=400) for seed in range(8)]
    assert sum(bool(each.located) for each in found) < 2
    assert 0.2 < np.mean([min(region.p_value for region in each.regions) for each in found]) < 0.8


def test_a_gap_in_the_dwell_is_said_to_be_in_the_dwell():
    values = np.zeros(COUNT)
    values[200:350] = 0.15
    found = locate(campaign(1, {5: values}))
    assert found.by("phase")[0].label == "dwell"
    assert min(found.record_p_value, key=found.record_p_value.get) == "dwell"


def test_a_gap_at_large_strain_is_said_to_be_there():
    bias = {i: 0.2 * (t.strain > 1.2) for i, t in enumerate(gap_noise.campaign(COUNT))}
    best = locate(campaign(2, bias)).by("strain")[0]
    assert best.label in ("true strain 1.2 to 1.5", "true strain 1.5 to 1.8")


def test_a_region_of_three_samples_is_looked_at():
    records = gap_noise.records("white", np.random.default_rng(3), COUNT)
    few = gap_noise.records("white", np.random.default_rng(4), 12)[0]
    found = locate(Whitened.of([*records[:2], replace(few, name="few")]))
    assert all(np.isfinite(region.statistic) for region in found.regions)
    assert any("few" in region.records for region in found.regions)


def test_records_of_very_different_noise_do_not_mask_each_other():
    """100 times the noise in one record; the bump of the other is found all the same."""
    records = gap_noise.records("white", np.random.default_rng(5), COUNT)
    loud = replace(records[0], residual=100 * records[0].residual, measured=None)
    quiet = replace(records[1], residual=records[1].residual - bump(200, 260), measured=None)
    found = locate(Whitened.of([loud, quiet, *records[2:]]))
    assert found.record_p_value["middle"] < 1e-4
    assert found.record_p_value["slow"] > 0.01


def test_a_periodic_gap_is_located_by_its_frequency():
    """0.04 Hz, 0.04 MPa: as large as the noise."""
    time = gap_noise.campaign(COUNT)[4].time
    line = find_lines(campaign(6, {4: 0.04 * np.sin(2 * np.pi * 0.04 * time)}))[0]
    assert line.record == "unloading"
    assert line.frequency_Hz == pytest.approx(0.04, abs=1 / 500)
    assert line.amplitude_MPa == pytest.approx(0.04, rel=0.25)
    assert line.p_value < 1e-6


@pytest.mark.parametrize("kind", ["white", "slow"])
def test_noise_has_no_lines_and_no_steps(kind):
    noises = [campaign(seed, None, kind) for seed in range(10)]
    least = [(find_lines(each)[0].p_value, find_steps(each, size=500)[0].p_value) for each in noises]
    assert np.sum(np.array(least) < 0.01, axis=0).max() <= 1


@pytest.mark.parametrize("seed", range(5))
def test_noise_that_a_moving_average_does_not_have_is_no_line(seed):
    """With theta of 0.97 next to nothing is expected at the highest frequency. White noise of an eighth of the rest
    stood out there by a thousand times: two of 16 nulls that were gaps were such lines, with p to 1e-48."""
    rng = np.random.default_rng(seed)
    records = gap_noise.records("white", rng, COUNT)
    made = Arma(-0.2, 0.97, 0.04)
    noises = [NoiseModel.stationary(each.name, made, len(each)) for each in records]
    noisy = [
        replace(each, residual=made.simulate(rng, len(each))[0] + 0.005 * rng.standard_normal(len(each)), measured=None)
        for each in records
    ]
    assert find_lines(Whitened.of(noisy, noises))[0].p_value > 0.01
    time, name = noisy[4].time, noisy[4].name
    wave = 0.04 * np.sin(2.0 * np.pi * 0.04 * time)
    line = find_lines(Whitened.of([*noisy[:4], replace(noisy[4], residual=noisy[4].residual + wave)], noises[:5]))[0]
    assert (line.record, round(line.frequency_Hz, 2)) == (name, 0.04)
    assert line.p_value < 1e-6


def test_short_bursts_of_noise_are_no_steps():
    """Six readings in a row, five times in each record, of seven times the noise: of 15 no more than chance makes.

    Of 120 six had p below 5 %, two below 0.5 %, none below 0.1 %.
    """
    least = []
    for seed in range(15):
        rng = np.random.default_rng(100 + seed)
        bursts = {}
        for index in range(6):
            bursts[index] = np.zeros(COUNT)
            for first in rng.integers(0, COUNT - 6, 5):
                bursts[index][first : first + 6] += 0.2 * rng.standard_normal()
        least.append(find_steps(campaign(seed, bursts), size=500)[0].p_value)
    assert min(least) > 1e-3
    assert np.sum(np.array(least) < 0.05) <= 2


def test_a_step_is_located_by_its_instant():
    """Up by 0.2 MPa at sample 306; model minus data: down."""
    step = find_steps(campaign(7, {2: 0.2 * (np.arange(COUNT) >= 306)}))[0]
    time = gap_noise.campaign(COUNT)[2].time
    assert step.record == "fast"
    assert step.time_s == pytest.approx(time[306], abs=3 * time[1])
    assert step.size_MPa == pytest.approx(-0.2, rel=0.3)
    assert step.p_value < 1e-3


@pytest.mark.parametrize("kind", ["white", "correlated"])
def test_a_slip_from_which_the_stress_recovers_is_seen(kind):
    """Eight times the noise at once, and less by a factor of e after every 15 samples."""
    since = np.arange(COUNT) - 306
    fading = np.where(since >= 0, 0.32 * np.exp(-np.maximum(since, 0) / 15.0), 0.0)
    step = find_steps(campaign(7, {2: fading}, kind))[0]
    assert step.record == "fast"
    assert step.p_value < 1e-3


def test_a_parameter_that_depends_on_rate_drifts_along_it():
    """G + c log10(rate), c = 0.01 MPa per decade: the slope comes out within three of its errors."""
    records = gap_noise.records("white", np.random.default_rng(8), COUNT)
    truth = 0.01
    moved = [
        replace(record, residual=record.residual - truth * record.tangent[:, 2] * rate, measured=None)
        for record, rate in zip(records, np.log10([1e-3, 5e-3, 2e-2, 3e-3, 2e-3, 3e-3]), strict=True)
    ]
    rates = {"log_rate": np.log10([1e-3, 5e-3, 2e-2, 3e-3, 2e-3, 3e-3]), "order": range(6)}
    found = parameter_drift(Whitened.of(moved), NAMES, rates)[2]
    assert found.slope["log_rate"] == pytest.approx(truth, rel=0.15)
    assert found.slope_p_value["log_rate"] < 1e-6
    assert found.heterogeneity_p_value < 1e-6


def test_parameters_that_hold_still_show_no_drift():
    """Three parameters, Q and two slopes each, 12 campaigns: p-values uniform."""
    values = []
    for seed in range(12):
        for drift in parameter_drift(campaign(20 + seed), NAMES):
            values += [drift.heterogeneity_p_value, *drift.slope_p_value.values()]
    assert np.mean(np.array(values) < 0.05) < 0.15
    assert 0.35 < np.mean(values) < 0.65


def test_where_an_effect_acts_is_not_smeared_by_the_refit():
    """Nine tenths of half a sine's energy lie within w of its middle, w + sin(2 w)/2 = 0.9 pi/2: w = 0.298 pi."""
    records = gap_noise.records("white", np.random.default_rng(10), COUNT)
    shape = np.zeros(COUNT)
    shape[100:200] = np.sin(np.pi * np.arange(100) / 100)
    contribution = [2.0 * shape, *[np.zeros(COUNT)] * 5]
    gradient = [shape[:, None], *[np.zeros((COUNT, 1))] * 5]
    (only,) = contribution_regions(records, contribution, gradient, np.array([[0.1]]), 1e-5)
    assert only.record == "slow"
    assert overlap(only.samples, slice(120, 180)) > 0.95
    assert only.share == pytest.approx(0.9, abs=0.01)


def test_runs_are_bridged_and_short_ones_dropped():
    inside = np.array([1, 1, 0, 1, 1, 0, 0, 0, 1], dtype=bool)
    assert runs(inside, bridge=1, least=2) == [slice(0, 5)]


RATES = np.log10([1e-3, 5e-3, 2e-2, 3e-3, 2e-3, 3e-3])


def drift_of_the_hardening_modulus(change):
    """Six records whose G differs by `change` [MPa], known to a few 1e-4 MPa."""
    records = gap_noise.records("white", np.random.default_rng(8), COUNT)
    moved = [
        replace(record, residual=record.residual - record.tangent[:, 2] * by, measured=None)
        for record, by in zip(records, change, strict=True)
    ]
    return parameter_drift(Whitened.of(moved), NAMES, {"log_rate": RATES, "order": range(6)})[2]


def test_a_parameter_that_follows_the_rate_does_so_beyond_the_scatter_between_records():
    drift = drift_of_the_hardening_modulus(0.01 * RATES)
    assert drift.scatter_p_value["log_rate"] < 1e-3
    assert drift.scatter_p_value["order"] > 0.1


def test_a_slope_by_chance_among_records_that_differ_at_random_is_no_slope():
    """Whatever the noise says: it is so small that every random difference has a slope along everything."""
    random = np.random.default_rng(2)
    drifts = [drift_of_the_hardening_modulus(0.01 * random.standard_normal(6)) for _ in range(30)]
    by_noise = [p < 1e-3 for drift in drifts for p in drift.slope_p_value.values()]
    by_scatter = [p < 0.01 for drift in drifts for p in drift.scatter_p_value.values()]
    assert np.mean(by_noise) > 0.5
    assert np.mean(by_scatter) < 0.07  # 1 % expected of 60


@pytest.mark.parametrize(("count", "window"), [(100, 10), (107, 10), (5, 10), (13, 6)])
def test_a_running_median_runs_from_block_to_block(count, window):
    """Blocks of about one length, `numpy.array_split`'s; their medians stand at their middles."""
    values = np.random.default_rng(count).standard_normal(count)
    blocks = np.array_split(np.arange(count), max(count // window, 1))
    middles, medians = zip(*((block.mean(), np.median(values[block])) for block in blocks), strict=True)
    expected = np.interp(np.arange(count), middles, medians)
    np.testing.assert_array_equal(running_median(values, window), expected)
