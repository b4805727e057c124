"""The table that splits what was not named: each class where it is known to be right."""

import json

import pytest
from bench.shortfall import CLASSES, before, missed, page, why

from probation_studies.blind.laboratories import industry
from probation_studies.blind.layout import Layout
from probation_studies.blind.seal import seal_truth


@pytest.fixture(scope="module")
def locking():
    """A network that locks, sqrt(lambda) of 78, which the catalogue's form follows to the noise."""
    return industry.make(11, 5, "develop", "single")


def _sealed(made, folder, led, explanation=None, verdict="unexplained"):
    """A folder whose answer has `led` in front, the true explanation as told."""
    made.write(folder / "campaigns" / made.name)
    truth = json.loads(made.truth.to_json())
    truth["explanation"] = explanation or truth["explanation"]
    for name in ("truths", "answers"):
        (folder / name).mkdir()
    seal_truth(json.dumps(truth)).write(folder / "truths" / f"{made.name}.json")
    causes = [{"effects": led, "probability": 0.9}, {"effects": [] if led else ["damage"], "probability": 0.1}]
    answer = {"diagnosis": {"causes": causes, "verdict": verdict, "answer_set": [led]}}
    (folder / "answers" / f"{made.name}.json").write_text(json.dumps(answer))
    return Layout(folder)


def _class(layout):
    (case,) = missed(layout)
    return why(layout, case)


def test_what_leads_once_it_is_told_was_not_found_by_the_search(locking, tmp_path):
    found = _class(_sealed(locking, tmp_path, ["damage"]))
    assert found.what == "search", found.line
    assert found.both.startswith("finite_extensibility")


def test_an_unknown_in_place_of_what_leads_once_it_is_told_is_the_search(tmp_path):
    """A machine's compliance, sqrt(lambda) of 42."""
    found = _class(_sealed(industry.make(11, 12, "develop", "single"), tmp_path, ["unknown"]))
    assert found.what == "search", found.line
    assert found.both.startswith("machine_compliance")


def test_an_unknown_that_stays_ahead_of_what_is_told_is_evidence(locking, tmp_path):
    """The form leaves nothing, and an unknown is some log units ahead of it."""
    assert _class(_sealed(locking, tmp_path, ["unknown"])).what == "evidence: an unknown"


def test_a_form_that_cannot_follow_the_gap_is_the_form(locking, tmp_path):
    """An offset of the force in place of a network that locks."""
    assert _class(_sealed(locking, tmp_path, ["damage"], ["force_offset"])).what == "form"


def test_an_effect_too_many_is_outweighed_by_the_explanation_without_it(locking, tmp_path):
    found = _class(_sealed(locking, tmp_path, ["unknown"], ["finite_extensibility", "force_offset"]))
    assert found.what == "evidence: a part of it"


def test_what_is_not_declared_is_too_weak_and_what_has_no_name_is_imitated(locking, tmp_path):
    quiet = _class(_sealed(locking, tmp_path / "quiet", [], verdict="no_gap"))
    outside = _class(_sealed(locking, tmp_path / "outside", ["damage"], ["unknown"]))
    assert (quiet.what, outside.what) == ("strength", "imitation")
    lines = page("industry", [quiet, outside])
    assert lines[0] == "**industry**: 2 resolvable gaps that are not named"
    assert lines[4] == f"| {' | '.join(str(int(each in ('strength', 'imitation'))) for each in CLASSES)} |"
    assert [line.split(" | ")[3] for line in lines[8:10]] == ["strength", "imitation"]


def test_what_is_named_is_not_missed(locking, tmp_path):
    assert missed(_sealed(locking, tmp_path, ["finite_extensibility"])) == []


@pytest.mark.parametrize(
    ("leader", "expected"),
    [
        (("damage", "unknown"), "an unknown"),
        (("damage", "prestress"), "another cause"),
        (("force_offset", "grip_slip", "prestress"), "a further effect"),
        (("prestress",), "a part of it"),
    ],
)
def test_what_comes_before_the_truth_is_named(leader, expected):
    assert before(leader, ("grip_slip", "prestress")) == expected
