"""Whose parameters a fit's errors are of, where specimens differ."""

import pytest

from campaigns.replicates import LAW, replicates
from probation import fit
from probation.inference.parameter import outside_name as known_as

TRUTH = dict(zip(("unrelaxed_modulus", "alpha", "hardening_modulus"), LAW.parameters, strict=True))


@pytest.fixture(scope="module")
def replicated():
    return fit(replicates(5, samples=150), "sa3", method="variable-projection")


def test_replicates_widen_the_errors_to_those_of_the_material(replicated):
    """Nine specimens that scatter by 3 % tell the mean to about 1 %; their noise alone would tell it to 0.05 %."""
    assert replicated.errors_of == "material"
    for name, true in TRUTH.items():
        known = replicated.parameters[name]
        assert 0.004 < known.se / true < 0.05
        assert known.interval95[0] < true < known.interval95[1]
        assert replicated.covariance[known_as(name), known_as(name)] == pytest.approx(known.se**2)
    assert "specimens' differences" in replicated.verdict
    assert "of the material's mean: specimens differ by" in replicated.summary()


def test_an_assumed_scatter_widens_no_error():
    """One record: E_u of that specimen is known to its noise."""
    campaign = replicates(5, count=1, rates=(2e-3,), samples=150)
    assumed = fit(campaign, "sa3", method="variable-projection")
    assert assumed.gap.scatter.source == "assumed"
    assert assumed.errors_of == "specimens"
    assert assumed.parameters["unrelaxed_modulus"].se / assumed.law.unrelaxed_modulus < 0.005
    assert "of the specimens that were tested" in assumed.summary()
