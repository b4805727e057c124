"""Are jumps of the strain rate found where they are, and nowhere else?"""

import numpy as np
import pytest

from probation._core import History
from reference import paper

find = History.find_rate_jumps
TIME = np.linspace(0.0, 60.0, 241)
RAMP = 0.005 * TIME


def test_a_reversal_is_found():
    assert find(TIME, np.where(TIME < 30.0, RAMP, 0.3 - RAMP)) == [120]


def test_every_reversal_of_a_saw_is_found():
    assert find(TIME, np.abs(TIME % 20.0 - 10.0) * 0.01) == [40, 80, 120, 160, 200]


def test_the_end_of_a_ramp_is_found():
    assert find(TIME, np.minimum(RAMP, 0.15)) == [120]


@pytest.mark.parametrize("shift", [0.1, 0.5, 0.9])
def test_a_jump_between_samples_is_flagged_at_both(shift):
    at = TIME[120] - shift * 0.25
    assert find(TIME, np.where(at > TIME, 0.005 * TIME, 0.01 * at - 0.005 * TIME)) == [119, 120]


def test_jumps_are_found_on_uneven_grids():
    time = np.sort(np.append(paper.uneven(200, 60.0), 30.0))
    assert find(time, np.minimum(0.005 * time, 0.15)) == [int(np.searchsorted(time, 30.0))]


@pytest.mark.parametrize(
    "strain",
    [
        paper.smooth_strain(TIME),
        0.01 * np.sin(0.5 * TIME),
        1e-4 * TIME**2,
        0.05 * np.sqrt(TIME),
        0.05 * TIME**0.7,
        0.05 * -np.expm1(-TIME / 2.0),
        np.zeros(241),
        np.full(241, 0.3),
    ],
    ids=["waves", "sine", "parabola", "root", "power", "exponential", "zero", "hold"],
)
def test_smooth_histories_have_none(strain):
    assert find(TIME, strain) == []


@pytest.mark.parametrize("every", [1, 10, 50, 100])
def test_the_papers_grip_driven_history_has_none(every):
    """(A-1) with the constants of P2, down to 16 samples."""
    time = np.linspace(0.0, 224.7, 1501)[1::every]
    assert find(time, 0.36637 * time / (time**0.7055 + 221.19 * np.exp(-0.03445 * time))) == []


@pytest.mark.parametrize("noise", [1e-7, 1e-6, 1e-5, 1e-4, 1e-3])
@pytest.mark.parametrize("seed", range(5))
def test_noise_has_none(noise, seed):
    rng = np.random.default_rng(seed)
    assert find(TIME, RAMP + noise * rng.standard_normal(241)) == []


def test_a_jump_in_noise_is_found():
    rng = np.random.default_rng(0)
    strain = np.minimum(RAMP, 0.15) + 1e-6 * rng.standard_normal(241)
    assert find(TIME, strain) == [120]


def test_too_few_samples_have_none():
    assert find(np.array([0.0, 1.0]), np.array([0.0, 1.0])) == []
