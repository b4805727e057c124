"""Tests that could be done next: ranked, with their cost and how probably they settle the answer."""

import json

import pytest

from campaigns.few_records import damage, few_records
from probation import diagnose
from probation.settings.design import DESIGN


@pytest.fixture(scope="module")
def ambiguous():
    """A weak damage in two short records, which other effects describe as well."""
    campaign = few_records(damage(0.005), names=("slow", "middle"), count=80)
    return diagnose(campaign, effects=["damage", "force_gain", "volume_change", "machine_compliance"], threads=1)


def test_tests_are_ranked_with_cost_and_chance_and_the_first_is_the_next(ambiguous):
    assert ambiguous.verdict == "explained"
    assert ambiguous.next_tests
    assert ambiguous.next_test == ambiguous.next_tests[0]
    for each in ambiguous.next_tests:
        assert "specimen, " in each.cost
        assert 0.0 < each.probability_after <= 1.0
        assert len(each.separates) >= 2
    assert len({each.what for each in ambiguous.next_tests}) == len(ambiguous.next_tests)
    told = json.loads(ambiguous.to_json())
    assert told["next_tests"][0] == told["next_test"]
    assert {"what", "separates", "probability_after", "cost"} <= set(told["next_test"])


def test_tests_after_the_first_help(ambiguous):
    for each in ambiguous.next_tests[1:]:
        assert each.probability_after > each.probability_before


def test_without_a_gap_only_a_test_that_helps_is_proposed():
    """There is nothing to discriminate, unless a test makes the right answer plainly more probable."""
    found = diagnose(few_records(), effects=["damage", "force_gain", "machine_compliance"], threads=1)
    assert found.verdict == "no_gap"
    assert all(each.probability_after >= each.probability_before + DESIGN.least_help for each in found.next_tests)
    assert (found.next_test is None) == (not found.next_tests)
