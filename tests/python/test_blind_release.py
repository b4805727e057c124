"""Rules of the test split: its size, its seeds, scored once."""

import json

import pytest

from probation.cli import main
from probation.commands import progress
from probation.errors import InputError
from probation_studies.blind import make as making
from probation_studies.blind import release
from probation_studies.blind.make import make_split
from probation_studies.blind.release import check_seed, shortfall, spend_seed, spent_seeds
from probation_studies.blind.score import score_split
from probation_studies.blind.seal import seal_truth
from probation_studies.blind.solve import solve_split


@pytest.mark.parametrize(("campaigns", "nulls", "enough"), [(600, 250, True), (599, 270, False), (700, 249, False)])
def test_a_release_takes_600_campaigns_with_250_nulls(campaigns, nulls, enough):
    said = shortfall(campaigns, nulls)
    assert (said is None) == enough
    assert enough or f"{campaigns} campaigns with {nulls} nulls: too few for a release" in said


def test_the_seeds_that_the_package_carries_can_be_read():
    assert all(isinstance(seed, int) for seed in spent_seeds())


@pytest.fixture
def seeds(tmp_path, monkeypatch):
    """A file of its own, in a source tree."""
    path = tmp_path / "seeds.json"
    path.write_text('{"test": []}')
    monkeypatch.setattr(release, "commit", lambda: "0123456789ab")
    return path


def test_a_seed_is_spent_once_and_refused_afterwards(seeds):
    check_seed(7, seeds)
    assert spend_seed(7, 600, seeds)
    assert not spend_seed(7, 600, seeds)
    assert spend_seed(8, 650, seeds)
    assert {seed: each["campaigns"] for seed, each in spent_seeds(seeds).items()} == {7: 600, 8: 650}
    with pytest.raises(InputError, match=r"seed: found 7, whose test split was scored .*not used before"):
        check_seed(7, seeds)


def test_nothing_is_written_outside_of_a_source_tree(seeds, monkeypatch):
    monkeypatch.setattr(release, "commit", lambda: "")
    assert not spend_seed(7, 600, seeds)
    assert spent_seeds(seeds) == {}


def test_a_file_of_seeds_that_is_something_else_is_named(seeds):
    seeds.write_text('{"test": [7]}')
    with pytest.raises(InputError, match=r"seeds\.json: found no list 'test'"):
        check_seed(7, seeds)


def test_a_spent_seed_is_refused_for_a_new_test_split_and_for_nothing_else(tmp_path, seeds, monkeypatch):
    """A folder that was begun with it may be finished; another split draws other campaigns from it."""
    spend_seed(7, 600, seeds)
    monkeypatch.setattr(making, "check_seed", lambda seed: check_seed(seed, seeds))
    monkeypatch.setattr(making, "_make_one", lambda *_: "")
    with pytest.raises(InputError, match="seed: found 7"):
        make_split(tmp_path / "new", seed=7, count=1, split="test", processes=1)
    make_split(tmp_path / "other", seed=7, count=1, processes=1)
    make_split(tmp_path / "fresh", seed=9, count=1, split="test", processes=1)
    (tmp_path / "begun" / "truths").mkdir(parents=True)
    (tmp_path / "begun" / "truths" / "plan.json").write_text('{"split": "test", "seed": 7, "count": 1}')
    make_split(tmp_path / "begun", seed=7, count=1, split="test", processes=1)


def test_a_scored_test_split_says_that_it_is_too_small_and_spends_its_seed(tmp_path, seeds, monkeypatch, capsys):
    monkeypatch.setattr(release, "SEEDS_FILE", seeds)
    monkeypatch.setattr(release.spend_seed, "__defaults__", (seeds,))
    folder = tmp_path / "split"
    (folder / "campaigns" / "test-0000").mkdir(parents=True)
    (folder / "truths").mkdir()
    oracle = {"right": 1.0, "resolvable": True, "posterior": {"": 1.0}}
    truth = {"stratum": "none", "explanation": [], "causes": [], "seed": 7, "base": {}, "records": {}, "oracle": oracle}
    sealed = seal_truth(json.dumps(truth | {"detectability": 0.0}))
    sealed.write(folder / "truths" / "test-0000.json")
    (folder / "seals.json").write_text(json.dumps({"split": "test", "seals": {"test-0000": sealed.seal}}))
    causes = [{"effects": [], "records": [], "probability": 1.0}]
    right = {"verdict": "no_gap", "causes": causes, "answer_set": [[]]}
    solve_split(folder, lambda _: right, processes=1)
    assert main(["blind", "score", str(folder)]) == 0
    told = capsys.readouterr()
    assert "1 campaigns with 1 nulls: too few for a release" in told.out
    assert list(spent_seeds(seeds)) == [7]
    solve_split(folder, lambda _: right | {"headline": "better"}, processes=1, again=True)
    with pytest.raises(InputError, match="not there when the truths were opened"):
        score_split(folder)
    with pytest.raises(InputError, match="it is scored once"):
        score_split(folder, after_opening=True)


def test_a_small_test_split_is_made_with_a_warning(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(making, "_make_one", lambda *_: "")
    monkeypatch.setattr(progress, "LOGGED_AFTER", 0.0)
    make = ["blind", "make", "--seed", "9", "--count", "20", "--processes", "1", "--out"]
    assert main([*make, str(tmp_path / "one"), "--split", "test"]) == 0
    told = capsys.readouterr().err
    assert "--count: found 20; a release takes 600 or more, 250 nulls among them" in told
    assert "making test: 10 %" in told
    assert main([*make, str(tmp_path / "two")]) == 0
    assert "release" not in capsys.readouterr().err
