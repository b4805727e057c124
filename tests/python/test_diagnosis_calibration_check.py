"""Whether a diagnosis knows where its probabilities were calibrated."""

import json
import re
from types import SimpleNamespace

import pytest

import probation
from campaigns.few_records import damage, few_records
from probation.diagnosis.trust import OtherForms, Tempered, trust_in
from probation.inference import calibration_check
from probation.inference.calibration_check import CalibrationCheck, Extent
from probation.settings.calibrated import CALIBRATED
from probation.settings.detection import DETECTION
from probation.settings.evidence import EVIDENCE
from probation_studies.blind import laboratory


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A campaign of the split that probabilities are calibrated on."""
    return laboratory.make(43, 1, "calibrate", "single").write(tmp_path_factory.mktemp("calibrate") / "made")


def _diagnosed(campaign, **options):
    return probation.diagnose(campaign, threads=1, design=False, **options)


def test_a_campaign_of_the_calibration_lies_inside(folder):
    found = _diagnosed(probation.Campaign.load(folder))
    assert json.loads(found.to_json())["calibration"] == {"inside": True, "why": []}
    assert not any("calibrated" in warning for warning in found.warnings)


def test_forms_are_others_where_nothing_was_calibrated():
    assert trust_in(CalibrationCheck(inside=True)) == Tempered(EVIDENCE.evidence_power)
    outside = trust_in(CalibrationCheck(inside=False, why=("another law",)))
    assert isinstance(outside, OtherForms)
    assert outside.fall_with_distance == CALIBRATED.fall_with_distance < 1.0
    assert outside.three < outside.two < 1.0
    assert outside.unknown_with_known < outside.two


def test_a_small_gap_must_be_more_certain_where_nothing_was_calibrated():
    inside, outside = CalibrationCheck(inside=True), CalibrationCheck(inside=False, why=("another law",))
    assert inside.gap_level(1.1) == inside.gap_level(3.1) == outside.gap_level(3.1) == DETECTION.gap_level == 0.005
    assert outside.gap_level(1.1) == CALIBRATED.gap_level_outside == 1e-5


def test_a_fit_and_a_diagnosis_call_the_same_gap_uncertain():
    """Records of 80 samples, damage of a fraction of the noise: p is below 0.5 %, but not below 1e-5."""
    campaign = few_records(damage(0.004), names=("slow", "middle"), count=80)
    found = _diagnosed(campaign, effects=["damage", "force_gain", "volume_change"])
    fitted = probation.fit(campaign)
    assert CALIBRATED.gap_level_outside < found.gap.p_value < DETECTION.gap_level
    assert found.verdict == "no_gap"
    assert not fitted.gap.exists
    assert found.headline.startswith("No gap that is certain: ")
    assert "where 1e-05 is asked for: such noise was not among what was tried" in found.headline


def test_what_lies_outside_is_named_and_an_answer_is_no_surer(folder):
    """The same records, whose specimens may now differ; of so strong a gap both are as sure as an unknown lets them."""
    inside = _diagnosed(probation.Campaign.load(folder))
    text = folder / "campaign.toml"
    text.write_text(text.read_text().replace('scatter = "none"', 'scatter = "estimate"'))
    found = _diagnosed(probation.Campaign.load(folder))
    answer = json.loads(found.to_json())
    assert not answer["calibration"]["inside"]
    [why] = answer["calibration"]["why"]
    assert re.fullmatch(r"a scatter between specimens of 0\.0\d+, where 0 is covered", why)
    assert found.best.effects == inside.best.effects
    assert found.best.probability < inside.best.probability + 0.01
    assert len(found.answer_set) >= len(inside.answer_set)
    assert any("calibrated on other campaigns" in warning for warning in found.warnings)


def test_a_campaign_outside_says_so_though_there_is_no_gap():
    """Records of 150 samples."""
    found = _diagnosed(few_records(names=("slow", "middle", "fast")), effects=["damage"])
    assert found.verdict == "no_gap"
    answer = json.loads(found.to_json())
    [sentence] = [warning for warning in answer["warnings"] if "calibrated on other campaigns" in warning]
    assert all(why in sentence for why in answer["calibration"]["why"])
    assert "warning: the probabilities were calibrated on other campaigns" in found.summary()


def test_another_law_lies_outside(monkeypatch):
    extent = Extent(4, (300.0, 300.0), (0.001, 0.001), (0.0, 0.0), gap=2.0, scatter=0.0, law="another law")
    monkeypatch.setattr(calibration_check, "extent_of", lambda *_: extent)
    found = calibration_check.check_calibration(SimpleNamespace())
    assert found.why == ("another law, where the modal law is covered",)


def test_a_large_misfit_is_told_without_a_power_of_ten(monkeypatch):
    extent = Extent(
        records=4,
        samples=(300.0, 300.0),
        noise=(0.001, 0.001),
        strain_noise=(0.0, 0.0),
        gap=184.3,
        scatter=0.0,
        law=CALIBRATED.law,
    )
    monkeypatch.setattr(calibration_check, "extent_of", lambda *_: extent)
    told = calibration_check.check_calibration(SimpleNamespace()).why[-1]
    assert told == f"a misfit over the noise of 184, where 0 to {CALIBRATED.gap[1]:.2g} are covered"
