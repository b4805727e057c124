"""What is periodic in the strain is found, in one record or over all, and noise is not."""

from dataclasses import replace

import numpy as np
import pytest

from campaigns import linear_problem as problem
from probation.detection.noise_without_sharp import without_sharp
from probation.detection.strain_periodic import find_strain_periodic, likely_periods, strain_periodic_waves
from probation.noise.arma import Arma
from probation.noise.record_residual import RecordResidual
from probation.noise.whitening import Whitened

COUNT = 500


def whitened(residuals):
    """Records at constant grip speed: the strain is ln(1 + v t), not linear in time."""
    records, noises = [], []
    for index, each in enumerate(residuals):
        time = np.linspace(0.0, 100.0, len(each))
        strain = np.log1p((0.02 + 0.005 * index) * time)
        name = f"r{index}"
        records.append(RecordResidual(name, time, strain, np.gradient(strain, time), each, strain[:, None]))
        noises.append(problem.white(len(each), name))
    return Whitened.of(records, noises), [record.true_strain for record in records]


def noise(seed, records=5):
    rng = np.random.default_rng(seed)
    return [problem.SIGMA * rng.standard_normal(COUNT) for _ in range(records)]


def test_teeth_of_one_pitch_in_all_records_are_found_where_no_record_shows_them_alone():
    """A saw tooth of 0.07 strain, from tip to tip 0.8 of the noise's standard deviation."""
    residuals = noise(0)
    _, strains = whitened(residuals)
    teeth = [0.8 * problem.SIGMA * ((strain / 0.07) % 1.0 - 0.5) for strain in strains]
    found = find_strain_periodic(whitened([a + b for a, b in zip(residuals, teeth, strict=True)])[0])
    best = found[0]
    assert best.record is None
    assert best.p_value < 1e-3
    assert abs(best.period - 0.07) < 0.003
    assert min(each.p_value for each in found if each.record) > 100.0 * best.p_value


def test_teeth_that_a_noise_model_holds_for_rough_noise_are_found_by_their_comb():
    """Noise of a red spectrum, as a fit to teeth of a tenth of the strain would say, leaves a spike for each tooth."""
    records, noises = [], []
    for index, rough in enumerate(noise(3, 3)):
        time = np.linspace(0.0, 100.0, COUNT)
        teeth = 5.0 * problem.SIGMA * ((time / 10.0) % 1.0 - 0.5)
        name = f"r{index}"
        strain = time / 100.0
        records.append(RecordResidual(name, time, strain, np.full(COUNT, 0.01), rough + teeth, strain[:, None]))
        noises.append(replace(problem.white(COUNT, name), arma=Arma(0.95, -0.5, 1.4 * problem.SIGMA)))
    seen = Whitened.of(records, noises)
    best = find_strain_periodic(seen)[0]
    assert best.record is None
    assert best.p_value < 1e-10
    assert best.period == pytest.approx(0.1, rel=0.02)
    waves, _ = strain_periodic_waves(seen)
    assert np.sum(waves**2) == pytest.approx(1.0)
    told = seen.whiten([(record.residual - rough)[:, None] for record, rough in zip(records, noise(3, 3), strict=True)])
    rest = told[:, 0] - waves @ np.linalg.lstsq(waves, told[:, 0], rcond=None)[0]
    assert np.sum(rest**2) < 0.2 * np.sum(told**2)


def test_of_periods_that_are_all_certain_the_most_powerful_is_found():
    """Teeth of a hundred times the noise: many periods have a p-value of 0, the longest among them."""
    residuals = noise(5)
    _, strains = whitened(residuals)
    teeth = [100.0 * problem.SIGMA * ((strain / 0.07) % 1.0 - 0.5) for strain in strains]
    best = find_strain_periodic(whitened([a + b for a, b in zip(residuals, teeth, strict=True)])[0])[0]
    assert best.p_value == 0.0
    assert best.period == pytest.approx(0.07, abs=0.003)


def test_noise_offers_no_waves_of_a_ripple():
    waves, log_share = strain_periodic_waves(whitened(noise(1))[0])
    assert waves.shape == (5 * COUNT, 0)
    assert log_share == 0.0


@pytest.mark.parametrize("size", [0.5, 2.0])
def test_the_choice_of_a_period_costs_what_laplace_says_of_a_flat_prior(size):
    """The likelihood of one sine, amplitude and phase fitted, integrated over its period by sums.

    Within half a unit: the strongest samples are cut, so that a strong wave's power is told low.
    """
    rng = np.random.default_rng(5)
    place = np.linspace(0.0, 1.0, COUNT)
    values = problem.SIGMA * (rng.standard_normal(COUNT) + size * np.sin(2.0 * np.pi * 20.3 * place))
    rate = np.full(COUNT, 0.01)
    record = RecordResidual("r", 100.0 * place, place, rate, values, np.ones((COUNT, 1)))
    best = find_strain_periodic(Whitened.of([record], [problem.white(COUNT, "r")]))[0]
    frequency = np.linspace(17.0, 23.0, 6001)
    waves = np.exp(-2j * np.pi * np.outer(frequency, place))
    power = np.abs(waves @ (values / problem.SIGMA)) ** 2 / COUNT
    integral = np.sum(np.exp(power - power.max())) * (frequency[1] - frequency[0])
    assert best.log_share == pytest.approx(np.log(integral / best.tried), abs=0.5)


def test_a_ripple_of_one_record_is_found_there():
    residuals = noise(1)
    _, strains = whitened(residuals)
    residuals[2] += 0.5 * problem.SIGMA * np.sin(2.0 * np.pi * strains[2] / 0.05)
    best = next(each for each in find_strain_periodic(whitened(residuals)[0]) if each.record)
    assert best.record == "r2"
    assert best.p_value < 1e-4
    assert abs(best.period - 0.05) < 0.002


def test_noise_makes_few_ripples():
    """40 campaigns of noise: the smallest p-value, an upper bound for each, is below 5 % in six or fewer (p = 0.01)."""
    least = [find_strain_periodic(whitened(noise(seed + 10))[0])[0].p_value for seed in range(40)]
    assert np.sum(np.array(least) < 0.05) <= 6


def test_a_specimen_that_is_not_strained_keeps_its_noise_beside_two_that_share_a_wave():
    """What is taken out where it shows: nothing of a record that is held, which has no periods in the strain."""
    seen, strains = whitened(noise(4, 3))
    records = list(seen.records)
    for index in (0, 1):
        wave = 5.0 * problem.SIGMA * np.sin(2.0 * np.pi * np.expm1(strains[index]) / 0.1)
        records[index] = replace(records[index], residual=records[index].residual + wave)
    held = np.full(COUNT, strains[2][0])
    records[2] = replace(records[2], true_strain=held, strain_rate=np.zeros(COUNT), tangent=np.ones((COUNT, 1)))
    left = without_sharp(records)
    np.testing.assert_array_equal(left.records[2].residual, records[2].residual)
    for index in range(3):
        assert left.noises[index].deviation.mean() == pytest.approx(problem.SIGMA, rel=0.15)


def test_records_without_strain_have_none():
    time = np.linspace(0.0, 1.0, COUNT)
    still = RecordResidual("r", time, np.zeros(COUNT), np.zeros(COUNT), noise(0, 1)[0], np.ones((COUNT, 1)))
    assert find_strain_periodic(Whitened.of([still], [problem.white(COUNT, "r")])) == ()


def test_the_likeliest_period_is_that_of_teeth_out_of_step_below_a_slow_gap():
    """Two records whose teeth begin elsewhere, a gap of ten times their size that bends once, and as much noise."""
    rng = np.random.default_rng(2)
    strains = [np.linspace(0.0, end, COUNT) for end in (1.0, 0.8)]
    values = [
        ((strain - first) / 0.055) % 1.0 + 10.0 * np.cos(3.0 * strain) + 0.3 * rng.standard_normal(COUNT)
        for strain, first in zip(strains, (0.01, 0.04), strict=True)
    ]
    assert likely_periods(strains, values)[0] == pytest.approx(0.055, rel=0.01)


def test_without_strain_no_period_is_likely():
    assert likely_periods([np.zeros(COUNT)], [np.ones(COUNT)]) == []
