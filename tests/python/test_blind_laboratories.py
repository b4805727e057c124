"""Laboratories beside the project's own: how they are chosen, and what each must hold to."""

import json

import pytest

from probation.cli import main
from probation.errors import InputError
from probation_studies.blind import laboratory
from probation_studies.blind.laboratory_named import LABORATORIES, laboratory_named
from probation_studies.blind.make import make_split


class _Quick:
    """A campaign that says its stratum in its truth."""

    def __init__(self, stratum):
        self.stratum, self.truth = stratum, self

    def to_json(self):
        return json.dumps({"stratum": self.stratum})

    def write(self, folder):
        folder.mkdir()
        (folder / "campaign.toml").write_text("")
        return folder


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(laboratory, "make", lambda seed, index, split, stratum: _Quick(stratum))


def _strata(folder):
    truths = [json.loads(path.read_text())["truth"] for path in sorted(folder.glob("truths/develop-*.json"))]
    return [json.loads(each)["stratum"] for each in truths]


def test_a_split_holds_as_many_campaigns_of_each_stratum_as_asked_in_no_telling_order(quick, tmp_path):
    make = ["blind", "make", "--seed", "4", "--strata", "none=12,single=8", "--processes", "1", "--out"]
    assert main([*make, str(tmp_path)]) == 0
    strata = _strata(tmp_path)
    assert sorted(strata) == ["none"] * 12 + ["single"] * 8
    assert strata != sorted(strata)
    seals = json.loads((tmp_path / "seals.json").read_text())
    assert (seals["laboratory"], seals["count"]) == ("own", 20)
    assert main([*make, str(tmp_path)]) == 0  # what was begun may be finished
    assert _strata(tmp_path) == strata


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--strata", "none=2,quiet=1"], "strata: found quiet=1, expected counts of at least 0 of none, single"),
        (["--strata", "none=2", "--count", "3"], "count, strata: found both or neither"),
        (["--laboratory", "nowhere"], "laboratory: found 'nowhere', expected one of own, "),
    ],
)
def test_what_a_laboratory_does_not_have_is_named(quick, capsys, tmp_path, options, message):
    assert main(["blind", "make", "--seed", "4", *options, "--out", str(tmp_path)]) == 2
    assert message in capsys.readouterr().err


def test_another_laboratory_or_other_strata_are_another_split(quick, tmp_path):
    make_split(tmp_path, seed=4, strata={"none": 2}, processes=1)
    with pytest.raises(InputError, match="found a split made with"):
        make_split(tmp_path, seed=4, strata={"none": 1, "single": 1}, processes=1)


def test_the_own_laboratory_makes_the_stratum_it_is_asked_for():
    assert laboratory.make(1, 22, stratum="none").truth.stratum == "none"


@pytest.mark.parametrize("name", LABORATORIES)
@pytest.mark.parametrize(("split", "stratum"), [("train", "none"), ("develop", "quiet")])
def test_every_laboratory_names_a_split_or_a_stratum_that_it_does_not_have(name, split, stratum):
    with pytest.raises(InputError, match="'train'" if split == "train" else "'quiet'"):
        laboratory_named(name).make(0, 0, split, stratum)
