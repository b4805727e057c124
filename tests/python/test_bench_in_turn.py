"""Answers weighed anew by the evidence that they state, and settings that are tuned on other laboratories."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bench import laboratories
from bench.in_turn import START, Answered, Judged, found_on, level_of, stratum_row, tables
from bench.laboratories import said
from bench.reweighed import gap_in

import probation
from campaigns.made_up_truth import made_up_truth
from probation.diagnosis.trust import Tempered, trust_in
from probation.inference.calibration_check import CalibrationCheck
from probation.records.record import Noise, Record
from probation_studies.blind.scores.answer import read_answer
from probation_studies.blind.scores.case import Case

TRUTH = ("force_gain",)


def planted():
    """Three ramps, the last one read 6 % too high."""
    law = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)
    records = []
    for seed, (rate, gain) in enumerate(((2e-3, 1.0), (6e-3, 1.0), (2e-2, 1.06))):
        time = np.linspace(0.0, 0.6 / rate, 300)
        stress = gain * law.stress(time, rate * time) + 0.05 * np.random.default_rng(seed).standard_normal(300)
        records.append(Record(f"r{seed}", time, rate * time, stress, noise=Noise(strain=0.0)))
    return probation.Campaign("gain", records, specimens=probation.Specimens("none"))


@pytest.fixture(scope="module")
def gap():
    diagnosis = json.loads(probation.diagnose(planted(), design=False).to_json())
    truth = made_up_truth(TRUTH)
    return gap_in("university", Case("gain", truth, read_answer(diagnosis, "gain")), diagnosis)


def test_weighed_by_the_settings_in_force_an_answer_is_what_it_states(gap):
    stated = gap.stated(gap.weighed(trust_in(CalibrationCheck(gap.inside))))
    assert stated == pytest.approx(gap.case.answer.probability, abs=1e-9)


def test_log_evidence_is_relative_to_the_base_law_and_null_for_what_was_not_fitted(gap):
    assert gap.log_evidence[()] == 0.0
    assert gap.log_evidence[TRUTH] == max(gap.log_evidence.values())
    assert gap.log_evidence[TRUTH] > 50.0
    assert len(gap.log_evidence) < len(gap.case.answer.probability)


def test_evidence_to_a_lower_power_says_less(gap):
    told = [dict(Judged.of(gap, Tempered(power)).ranked)[TRUTH] for power in (1.0, 0.2, 0.02)]
    assert told == sorted(told, reverse=True)
    assert Judged.of(gap, Tempered()).right


def test_how_sure_and_how_right_is_of_declared_gaps_alone(gap):
    """Of a right one, a wrong one, one that was not declared, and a null that was."""
    case = replace(gap.case, truth={**gap.case.truth, "seed": 7})
    sure = replace(case.answer, probability={TRUTH: 0.75, (): 0.25})
    wrong = replace(case.answer, probability={("damage",): 0.5, TRUTH: 0.3})
    cases = [replace(case, answer=each) for each in (sure, wrong, replace(sure, gap=False))]
    null = replace(case, truth={**case.truth, "stratum": "none", "causes": [], "explanation": []})
    told = said(Path("university"), [*cases, replace(null, answer=wrong)])
    assert told[:4] == ["university", "7", "2", "0.62"]
    assert told[4].startswith("50 % of 2")


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["scores.json"], "--said: found scores.json, expected sealed folders"),
        (["folder", "--by-strength"], "--said: found --by-strength, too; expected one of the two"),
    ],
)
def test_how_sure_is_asked_of_folders_by_itself(monkeypatch, capsys, tmp_path, options, complaint):
    (tmp_path / "folder").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", ["laboratories", *options, "--said"])
    with pytest.raises(SystemExit):
        laboratories.main()
    assert complaint in capsys.readouterr().err


class Before:
    def __init__(self, before):
        self.before = before


def test_a_conformal_level_holds_as_many_as_it_says():
    draws = np.random.default_rng(0).uniform(size=(4000, 60))
    held = [row[-1] < level_of([Before(each) for each in row[:-1]]) for row in draws]
    assert np.mean(held) == pytest.approx(0.95, abs=0.02)
    assert level_of([Before(0.5)] * 10) == 1.0
    assert level_of([*[Before(0.5)] * 30, *[Before(1.0)] * 10]) == pytest.approx(0.5)  # ten are in no explanation


def test_a_set_holds_what_takes_it_over_its_level(gap):
    """The truth with 0.99 is the whole set of 95 %; one that is not listed is held by none."""
    certain = Judged(gap, [(TRUTH, 0.99), (("damage",), 0.01)], {TRUTH: 0.99, ("damage",): 0.01})
    lost = replace(certain, ranked=[(("damage",), 1.0)], stated={("damage",): 1.0})
    assert (certain.before, certain.size(0.98), lost.before) == (0.0, 1, 1.0)
    assert (certain.case.covered, lost.case.covered) == (True, False)
    found = stratum_row("lab", "100 or more", [certain, lost], 1.0)
    assert found[2].startswith("50 % of 2")
    assert [found[at].partition(" (")[0] for at in (3, 6)] == ["100 % of 1", "100 % of 1"]


def drawn(rng, gap, fall, count=300):
    """Gaps of ten rivals each, 0 to 500 log units behind, the true one drawn by (1 + D)^-fall."""
    found = []
    for _ in range(count):
        behind = np.append(0.0, 500.0 * rng.uniform(size=9) ** 3)
        names = [(f"effect_{letter}",) for letter in "abcdefghij"]
        chance = (1.0 + behind) ** -fall
        true = names[rng.choice(10, p=chance / chance.sum())]
        evidence = {(): 0.0} | dict(zip(names, 600.0 - behind, strict=True))
        answer = replace(gap.case.answer, parameters={})
        case = replace(gap.case, truth={**gap.case.truth, "explanation": [*true]}, answer=answer)
        found.append(replace(gap, case=case, log_evidence=evidence))
    return found


@pytest.mark.parametrize("fall", [0.4, 0.8])
def test_the_weights_that_made_the_truths_are_found(gap, fall):
    """300 gaps: the fall to its standard error, a tenth; odds that nothing was told of stay where they are."""
    found = found_on(drawn(np.random.default_rng(1), gap, fall))
    assert found.fall_with_distance == pytest.approx(fall, abs=0.1)
    assert found.two == pytest.approx(START.two, rel=1e-3)


def test_every_laboratory_is_scored_by_what_the_others_tell(gap):
    rng = np.random.default_rng(2)
    laboratories = []
    for name, fall in (("a", 0.3), ("b", 0.9)):
        gaps = [replace(each, laboratory=name) for each in drawn(rng, gap, fall, 60)]
        laboratories.append(Answered(name, [each.case for each in gaps], gaps))
    scores, strata = tables(laboratories)
    assert [line[0] for line in scores] == ["a", "a", "b", "b", "all", "all"]
    assert [line[1].split(" ")[0] for line in scores] == ["in", "of"] * 3
    assert scores[-1][2] == "120"
    falls = [float(line[1].split(" a ")[1].split(",")[0]) for line in scores[1:4:2]]
    assert falls[0] > falls[1]  # of the other one
    every = ["less than 1000", "100 % of 60 (94 to 100)"]
    assert [line[:3] for line in strata] == [["a", *every], ["b", *every]]
