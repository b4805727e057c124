"""What is periodic in the strain is found, in one record or over all, and noise is not."""

import numpy as np

from campaigns import linear_problem as problem
from probation.gap.record_residual import RecordResidual
from probation.gap.ripples import find_ripples
from probation.gap.whitening import Whitened

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
    found = find_ripples(whitened([a + b for a, b in zip(residuals, teeth, strict=True)])[0])
    best = found[0]
    assert best.record is None
    assert best.p_value < 1e-3
    assert abs(best.period_strain - 0.07) < 0.003
    assert min(each.p_value for each in found if each.record) > 100.0 * best.p_value


def test_a_ripple_of_one_record_is_found_there():
    residuals = noise(1)
    _, strains = whitened(residuals)
    residuals[2] += 0.5 * problem.SIGMA * np.sin(2.0 * np.pi * strains[2] / 0.05)
    best = next(each for each in find_ripples(whitened(residuals)[0]) if each.record)
    assert best.record == "r2"
    assert best.p_value < 1e-4
    assert abs(best.period_strain - 0.05) < 0.002


def test_noise_makes_few_ripples():
    """40 campaigns of noise: the smallest p-value, an upper bound for each, is below 5 % in six or fewer (p = 0.01)."""
    least = [find_ripples(whitened(noise(seed + 10))[0])[0].p_value for seed in range(40)]
    assert np.sum(np.array(least) < 0.05) <= 6


def test_records_without_strain_have_none():
    time = np.linspace(0.0, 1.0, COUNT)
    still = RecordResidual("r", time, np.zeros(COUNT), np.zeros(COUNT), noise(0, 1)[0], np.ones((COUNT, 1)))
    assert find_ripples(Whitened.of([still], [problem.white(COUNT, "r")])) == ()
