"""The probation test on specimens that differ."""

from campaigns.replicates import replicates
from probation import certify


def test_a_parameter_that_differs_by_the_specimens_scatter_keeps_its_value():
    """Six specimens at two rates; each alone knows E_u to 1 %, and they scatter by 2 to 4 %."""
    campaign = replicates(3, count=3, rates=(2e-3, 5e-4), samples=120)
    assert certify(campaign, "sa3").verdict == "intrinsic"


def test_the_same_differences_are_none_of_the_specimens_where_they_are_alike():
    campaign = replicates(3, count=3, rates=(2e-3, 5e-4), samples=120, specimens="none")
    found = certify(campaign, "sa3")
    assert not all(each.passes for each in found.parameters.values())
    assert all(each.se_specimen == 0.0 for judged in found.parameters.values() for each in judged.by_record.values())
