"""`fit`, `certify` and `diagnose` say the same of the same records: whether there is a gap, and where."""

import json
from dataclasses import replace

import pytest

import probation
from campaigns.few_records import few_records, offset
from campaigns.measured import DATA
from probation.published.experiments import twin_campaign

OUTSIDE = DATA / "outside"


def free_twins(*fitted, held_out=()):
    campaign = twin_campaign(fitted, held_out=held_out)
    return replace(campaign, law=replace(campaign.law, fixed={}))


CAMPAIGNS = {
    "the paper's": lambda: free_twins(1, held_out=(2, 3)),
    "the paper's, all fitted": lambda: free_twins(1, 2, 3),
    "grip tests": lambda: free_twins(2, 3),
    "nothing wrong": few_records,
    "nothing wrong, two predicted": lambda: few_records(held_out=("fast", "unloading"), seed=3),
    "offset in a predicted record": lambda: few_records(offset(2.0, "middle"), held_out=("middle",)),
    "offset in a fitted record": lambda: few_records(offset(2.0, "middle"), held_out=("fast",)),
    "offset of a third of the noise": lambda: few_records(offset(0.02, "middle")),
}


def outside(name):
    if not OUTSIDE.is_dir():
        pytest.skip("the campaigns are not beside the checkout")
    return probation.Campaign.load(OUTSIDE / name)


@pytest.mark.parametrize(
    "campaign",
    [*CAMPAIGNS.values(), lambda: outside("null-noisy-strain"), lambda: outside("null-noisy-strain-jump")],
    ids=[*CAMPAIGNS, "outside, a null", "outside, a null with a jump"],
)
def test_three_commands_give_one_answer(campaign):
    campaign = campaign()
    fit = probation.fit(campaign)
    certificate = probation.certify(campaign, "sa2")
    diagnosis = probation.diagnose(campaign, effects=None, design=False)
    assert fit.gap.test.p_value == certificate.gap.test.p_value == diagnosis.gap.p_value
    assert dict(certificate.gap.held_out) == dict(diagnosis.held_out)
    assert certificate.gap.exists == (diagnosis.verdict != "no_gap")
    assert ("describes the records to within their noise" in fit.verdict) == (
        diagnosis.verdict in ("no_gap", "not_predicted")
    )
    if diagnosis.verdict == "no_gap":
        assert certificate.verdict == "intrinsic"
    elif certificate.verdict == "intrinsic":
        assert "there is a gap" in certificate.reason


def test_records_that_hardly_determine_the_law_show_no_gap_and_certify_nothing():
    levels = {"slow": 3.0, "fast": 0.04}
    campaign = few_records(names=("slow", "fast"), held_out=("fast",), noise=levels, count=60, seed=3)
    certificate = probation.certify(campaign, "sa2")
    assert probation.diagnose(campaign, design=False).verdict == "no_gap"
    assert certificate.verdict == "not_intrinsic"
    assert "though there is no gap" in certificate.reason
    assert certificate.headline.startswith("Whether the law is intrinsic is not known: ")
    assert not certificate.gap.exists


def test_the_gap_stands_in_the_answers_of_fits_and_certificates():
    campaign = few_records(offset(2.0, "middle"), held_out=("middle",))
    answer = json.loads(probation.certify(campaign, "sa2").to_json())["gap"]
    assert (answer["fitted"], answer["held_out"]) == (False, True)
    assert answer["size"]["record"] == "middle"
    low, high = answer["size"]["interval95_MPa"]
    assert low < answer["size"]["rms_MPa"] < high
    assert answer["held_out_gap"]["middle"]["p_value"] < 1e-6
    assert json.loads(probation.fit(campaign).to_json())["gap"]["fitted"] is False


def test_a_fit_says_at_which_level_a_gap_counts():
    """0.005 where specimens are alike; 1e-5 where they may differ, which was not calibrated."""
    campaign = few_records(count=400)
    levels = [
        json.loads(probation.fit(replace(campaign, specimens=probation.Specimens(scatter))).to_json())["gap"]["level"]
        for scatter in ("none", "estimate")
    ]
    assert levels == [0.005, 1e-5]


def test_without_the_test_a_fit_claims_nothing():
    """With bounds it is not the law that is tested."""
    fit = probation.fit(few_records(), bounds={"unrelaxed_modulus_MPa": (1000.0, 5000.0)})
    assert fit.gap is None
    assert "was not tested" in fit.verdict
