"""Solvers that a diagnosis is seen beside: what they answer, and that they are held to the same checks."""

import json

import numpy as np
import pytest

from campaigns.few_records import few_records, offset
from probation.cli import main
from probation.errors import InputError
from probation_studies.blind.layout import Layout
from probation_studies.blind.score import score_split
from probation_studies.blind.scores.answer import read_answer
from probation_studies.blind.seal import seal_truth
from probation_studies.blind.solve import solve_split
from probation_studies.blind.solvers import BASELINES, solver_named
from probation_studies.blind.solvers.survey import answer, survey


def _written(folder, campaign):
    """The campaign as files; the law is that of `few_records`."""
    folder.mkdir(parents=True)
    lines = [f'name = "{folder.name}"']
    for record in campaign.records:
        columns = np.column_stack([record.time, record.true_strain, record.true_stress])
        header = "time_s,true_strain,true_stress_MPa"
        np.savetxt(folder / f"{record.id}.csv", columns, delimiter=",", header=header, comments="", fmt="%.12g")
        lines += ["[[record]]", f'id = "{record.id}"', f'file = "{record.id}.csv"', f'control = "{record.control}"']
    (folder / "campaign.toml").write_text("\n".join(lines) + "\n")
    return folder


NAMES = ("slow", "middle", "fast")


@pytest.fixture(scope="module")
def campaigns(tmp_path_factory):
    folder = tmp_path_factory.mktemp("split")
    faults = {"develop-0000": None, "develop-0001": offset(1.0, "middle")}
    layout = Layout(folder)
    seals = {}
    for name, fault in faults.items():
        _written(layout.campaigns / name, few_records(fault, names=NAMES))
        seals[name] = "0" * 64
    (folder / "seals.json").write_text(json.dumps({"split": "develop", "seals": seals}))
    solve_split(folder, None, baselines=BASELINES, processes=1)
    return layout


@pytest.mark.parametrize("name", BASELINES)
def test_a_baseline_says_none_of_a_null_and_names_a_plain_fault_and_its_record(campaigns, name):
    found = []
    for path in sorted(campaigns.baseline(name).answers.glob("*.json")):
        content = json.loads(path.read_text())
        found.append(read_answer(content["diagnosis"], str(path)))
    assert found[1].gap
    assert found[1].top == ("force_offset",)
    assert found[1].records["force_offset",] == {"middle"}
    if name != "bic-argmin":  # which asks no gap test, and pays for no search: one in many noises looks like something
        assert (found[0].gap, found[0].top) == (False, ())


def test_probabilities_are_in_proportion_to_the_weights(campaigns):
    """ln 6, ln 3, ln 1: 0.6, 0.3, 0.1; 0.95 needs all three. Of one effect the best place counts."""
    found = survey(campaigns.campaigns / "develop-0000")
    damage = [("damage", 0.5, ("fast",)), ("damage", np.log(3.0), ("slow",)), ("damage", 0.1, None)]
    said = answer(found, [("prestress", 0.0, None), *damage, ("", np.log(6.0), None)])
    assert [each["probability"] for each in said["causes"]] == pytest.approx([0.6, 0.3, 0.1, 0.0])
    assert said["causes"][1]["records"] == ["slow"]
    assert said["answer_set"] == [[], ["damage"], ["prestress"]]
    assert answer(found, [("", 10.0, None), ("damage", 0.0, None)])["answer_set"] == [[]]


def _sealed(folder, tmp_path):
    """A split of the first of these campaigns, with a truth that is made up."""
    layout = Layout(tmp_path / "split")
    seals = {}
    layout.truths.mkdir(parents=True)
    layout.campaigns.mkdir()
    for path in sorted(folder.iterdir())[:1]:
        (layout.campaigns / path.name).symlink_to(path)
        truth = {"stratum": "none", "explanation": [], "causes": [], "seed": 1, "detectability": 0.0, "base": {}}
        oracle = {"right": 1.0, "resolvable": True, "posterior": {"": 1.0}}
        sealed = seal_truth(json.dumps({**truth, "oracle": oracle, "records": {}}))
        sealed.write(layout.truths / f"{path.name}.json")
        seals[path.name] = sealed.seal
    (layout.folder / "seals.json").write_text(json.dumps({"split": "develop", "seals": seals}))
    return layout


def _nothing(folder):
    causes = [{"effects": [], "records": [], "probability": 1.0}]
    return {"verdict": "no_gap", "causes": causes, "answer_set": [[]]}


def test_baselines_are_picked_up_by_the_score_if_they_were_there_before_the_opening(campaigns, tmp_path):
    layout = _sealed(campaigns.campaigns, tmp_path)
    solve_split(layout.folder, _nothing, processes=1)
    solve_split(layout.folder, _nothing, answers=layout.baseline("early").answers, processes=1)
    assert {"answers", "early", "oracle"} <= set(score_split(layout.folder).content["scores"])
    solve_split(layout.folder, _nothing, answers=layout.baseline("late").answers, processes=1)
    with pytest.raises(InputError, match=r"baselines/late: found an answer .* not there when the truths were opened"):
        score_split(layout.folder)
    assert "late" in score_split(layout.folder, after_opening=True).content["scores"]


def test_a_baselines_answer_to_other_data_is_refused(campaigns, tmp_path):
    layout = _sealed(campaigns.campaigns, tmp_path)
    solve_split(layout.folder, _nothing, processes=1)
    solve_split(layout.folder, _nothing, answers=layout.baseline("other").answers, processes=1)
    path = layout.baseline("other").answers / "develop-0000.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"campaign_sha256": "0"}))
    with pytest.raises(InputError, match=r"baselines/other/develop-0000\.json: found an answer to other data"):
        score_split(layout.folder)


def test_one_run_answers_by_the_main_solver_and_by_all_baselines(campaigns, tmp_path, capsys):
    layout = _sealed(campaigns.campaigns, tmp_path)
    solve = ["blind", "solve", str(layout.folder), "--processes", "1"]
    assert main([*solve, "--solver", "no-gap", "--baselines"]) == 0
    assert "4 answered now, 0 before, 0 failed" in capsys.readouterr().out
    assert layout.baselines == sorted(BASELINES)
    assert main([*solve, "--solver", "score-screen"]) == 0
    assert "0 answered now, 1 before" in capsys.readouterr().out


def test_an_unknown_solver_is_told_the_names_there_are():
    with pytest.raises(InputError, match=r"solver: found 'oracle', expected diagnose, no-gap, nearest-signature"):
        solver_named("oracle")
