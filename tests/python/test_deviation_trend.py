"""Specimens' deviations that are in an order."""

from dataclasses import replace

import numpy as np
import pytest

import probation
from probation.inference.deviation_trend import trend_of
from probation.records.record import Noise, Record

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)
ORDER = {"order": np.arange(6.0)}


def test_a_deviation_that_grows_from_test_to_test_is_told_with_its_permutations():
    """Of 720 orders two, this one and its reverse, have as large a correlation."""
    found = trend_of(np.arange(6.0)[:, None] ** 1.1, ["tau_max_s"], ORDER)
    assert (found.deviation, found.variable) == ("tau_max_s", "order")
    assert found.p_value == pytest.approx(2.0 / 720.0)
    assert found.correlation == pytest.approx(np.corrcoef(np.arange(6.0), np.arange(6.0) ** 1.1)[0, 1])
    assert trend_of(-(np.arange(6.0)[:, None] ** 1.1), ["tau_max_s"], ORDER).correlation < -0.99


def test_variables_that_order_the_specimens_alike_are_told_together():
    rising = np.arange(6.0)
    found = trend_of(
        np.stack([rising + 0.3 * (-1.0) ** rising, 1e-3 * rising], axis=1), ["hardening_modulus_MPa", "area"],
        {"order": rising, "strain_rate": rising**1.05, "temperature": np.array([1.0, 0.0, 1.0, 0.0, 1.0, 0.0])},
    )  # fmt: skip
    assert (found.deviation, {found.variable, *found.others}) == ("hardening_modulus_MPa", {"order", "strain_rate"})
    assert found.text.endswith("these tests do not tell which")


def test_chance_makes_a_trend_as_often_as_its_level_says():
    """Of 400 campaigns of six specimens, five deviations, three variables: 2 % of 400 are 8, at most 16 with 99.5 %."""
    random, hits = np.random.default_rng(7), 0
    for _ in range(400):
        variables = {name: random.standard_normal(6) for name in ("order", "strain_rate", "temperature")}
        hits += trend_of(random.standard_normal((6, 5)), list("abcde"), variables) is not None
    assert hits <= 16


@pytest.mark.parametrize("values", [np.zeros((6, 2)), np.ones((6, 1))], ids=["none", "alike"])
def test_specimens_that_do_not_differ_have_no_trend(values):
    assert trend_of(values, ["a", "b"], ORDER) is None
    assert trend_of(np.arange(6.0)[:, None], ["a"], {"order": np.ones(6)}) is None


def six_tests(relaxation_time):
    """Six rates in no order; the relaxation time of the i-th test is so many times the law's."""
    made, strain = [], np.linspace(0.0, 0.6, 721)
    for index, rate in enumerate((6e-3, 1e-3, 3e-3, 8e-3, 2e-3, 5e-3)):
        time = strain / rate
        law = replace(LAW, tau_max=LAW.tau_max * relaxation_time(index))
        stress = law.stress(time, strain)[::8] + 0.04 * np.random.default_rng(index).standard_normal(91)
        made.append(Record(f"at-{rate:g}", time[::8], strain[::8], stress, noise=Noise(0.04, 0.0)))
    return probation.Campaign("six", tuple(made), specimens=probation.Specimens())


def test_what_changes_from_test_to_test_is_no_gap_where_specimens_may_differ_but_is_told():
    """Each test relaxes by 1 % faster than the last one: within what is assumed of specimens, but in their order."""
    found = probation.diagnose(six_tests(lambda index: 1.0 - 0.01 * index), design=False)
    assert found.verdict == "no_gap"
    assert (found.trend.deviation, found.trend.variable) == ("tau_max_s", "order")
    assert "but τ_max falls with the order of the tests (p = 0.0028)" in found.headline
    assert probation.Diagnosis.from_json(found.to_json()).trend == found.trend
    assert found.to_dict()["trend"]["variable"] == "order"
    assert "τ_max falls with the order of the tests" in probation.fit(six_tests(lambda i: 1.0 - 0.01 * i)).verdict


def test_specimens_that_differ_in_no_order_have_no_trend():
    sizes = (0.01, -0.03, 0.02, 0.0, 0.03, -0.02)
    found = probation.diagnose(six_tests(lambda index: 1.0 + sizes[index]), design=False)
    assert (found.verdict, found.gap_if_alike, found.trend) == ("no_gap", True, None)
    assert " but " not in found.headline
