"""Deviations of specimens in the covariance of the records."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation.inference.scatter import replicates
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.noise.own_deviations import own_deviations
from probation.noise.record_residual import RecordResidual
from probation.noise.whitener import Whitener

COUNT = 12
RNG = np.random.default_rng(3)
COLUMNS = [RNG.normal(size=(COUNT, 2)) for _ in range(3)]


def noise(name, columns, specimen=None):
    none = np.zeros((COUNT, 0))
    return NoiseModel(
        name,
        Arma(innovation=0.5),
        np.ones(COUNT),
        "constant",
        0.5,
        0.5,
        0.0,
        none,
        0.0,
        0.0,
        (),
        "",
        specimen=columns,
        specimen_id=specimen,
    )


@pytest.mark.parametrize("ids", [(None, None, None), ("A", None, "A"), ("A", "A", "A"), ("a", "B", "B")])
def test_whitened_records_of_one_specimen_have_the_identity_for_covariance(ids):
    """0.25 I + F F^T, F stacked over the records of a specimen: L C L^T = I."""
    whitener = Whitener(
        tuple(noise(f"r{i}", own, which) for i, (own, which) in enumerate(zip(COLUMNS, ids, strict=True)))
    )
    covariance = 0.25 * np.eye(3 * COUNT)
    for which in {(i if name is None else name) for i, name in enumerate(ids)}:
        stacked = np.vstack([own * (which in (i, ids[i])) for i, own in enumerate(COLUMNS)])
        covariance += stacked @ stacked.T
    white = whitener.columns(whitener.columns(covariance).T)
    assert_allclose(white, np.eye(3 * COUNT), atol=1e-8)


def test_what_a_specimen_is_off_by_is_predicted_and_what_no_specimen_is_off_by_is_not():
    """F u is found again to within the noise's share; 20 F u only as far as 99 % of specimens go."""
    models = [noise(f"r{i}", 10.0 * own, "A" if i < 2 else None) for i, own in enumerate(COLUMNS)]
    true = [10.0 * own @ [1.0, -0.5] for own in COLUMNS]
    for part, expected in zip(own_deviations(true, models), true, strict=True):
        assert_allclose(part, expected, rtol=0.01, atol=0.05)
    far = own_deviations([20.0 * each for each in true], models)
    assert np.linalg.norm(far[0]) < 0.15 * np.linalg.norm(20.0 * true[0])


def record(name, rate, end=1.0, specimen=None, temperature=None):
    strain = np.linspace(0.0, end, 50)
    zero = np.zeros(50)
    return RecordResidual(
        name, strain / rate, strain, zero + rate, zero, np.zeros((50, 1)),
        specimen_id=specimen, temperature=temperature,
    )  # fmt: skip


def test_replicates_have_one_strain_history_though_one_may_break_earlier():
    records = [
        record("a", 1e-3),
        record("b", 1.01e-3),
        record("c", 1e-3, 0.7),
        record("d", 2e-3),
        record("e", 1e-3, 0.3),
    ]
    assert replicates(records) == [[0, 1, 2]]


def test_tests_at_other_temperatures_are_no_replicates():
    """A law that does not know the temperature would see specimens that differ by 20 %."""
    at = [record("a", 1e-3, temperature=23.0), record("b", 1e-3, temperature=31.0), record("c", 1e-3, temperature=24.0)]
    assert replicates(at) == [[0, 2]]
    assert replicates([at[0], record("d", 1e-3)]) == [[0, 1]]


def test_a_test_of_the_same_specimen_again_is_no_replicate():
    assert replicates([record("a", 1e-3, specimen="A"), record("b", 1e-3, specimen="A")]) == []
    assert replicates([record("a", 1e-3, specimen="A"), record("b", 1e-3)]) == [[0, 1]]
