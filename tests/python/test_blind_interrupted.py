"""Runs that are killed at any moment, with signal 9, and begun again: nothing is lost, nothing is left behind."""

import json
import subprocess
import sys
import time
from pathlib import Path

import pytest

from probation_studies.blind.layout import Layout

COUNT = 12
MAKE = """
import time
import numpy as np
from probation_studies.blind import laboratory
from probation_studies.blind.laboratory.campaign import SealedCampaign, WrittenRecord
from probation_studies.blind.make import make_split

class Truth:
    def __init__(self, name):
        self.name = name
    def to_json(self):
        return '{"name": "' + self.name + '"}'

def quick(seed, index, split, stratum):
    time.sleep(0.05)
    name = f"{split}-{index:04d}"
    drawn = np.random.default_rng([seed, index]).standard_normal(400)
    record = WrittenRecord("test-1", "strain-rate", False, np.arange(400.0), drawn, drawn, {})
    return SealedCampaign(name, (record,), None, Truth(name))

laboratory.make = quick
print("begun", flush=True)
make_split("split", seed=3, count=12, processes=1)
"""
SOLVE = """
import sys
from probation_studies.blind.solve import solve_split
sys.path.insert(0, ".")
import solver
print("begun", flush=True)
solve_split("split", solver.solve, processes=int(sys.argv[1]))
"""
SOLVER = """
import time
def solve(folder):
    time.sleep(0.05)
    return {"of": folder.name, "filling": "x" * 200000}
"""


def _begun(script, folder, processes=1):
    started = subprocess.Popen(
        [sys.executable, "-c", script, str(processes)], cwd=folder, stdout=subprocess.PIPE, text=True
    )
    assert started.stdout is not None
    assert started.stdout.readline() == "begun\n"
    return started


def _run(script, folder):
    with _begun(script, folder) as started:
        assert started.wait(60) == 0


def _contents(folder, pattern):
    return {path.name: path.read_bytes() for path in folder.glob(pattern)}


def test_making_goes_on_after_a_kill_with_the_campaigns_and_seals_there_were(tmp_path):
    split = Layout(tmp_path / "split")
    kept = {}
    for made in (2, 6):
        with _begun(MAKE, tmp_path) as started:
            while len(_contents(split.truths, "develop-*.json")) < made:
                time.sleep(0.005)
            started.kill()
        campaigns = _contents(split.campaigns, "develop-*/test-1.csv")
        assert all(text.count(b"\n") == 401 for text in campaigns.values())
        truths = _contents(split.truths, "develop-*.json")
        assert kept.items() <= truths.items()
        assert {path.name for path in split.campaigns.glob("develop-*")} <= {name[:-5] for name in truths}
        assert not (split.folder / "seals.json").exists()
        kept = truths
    (split.campaigns / ".making-left").mkdir()
    _run(MAKE, tmp_path)
    assert kept.items() <= _contents(split.truths, "develop-*.json").items()
    names = [f"develop-{k:04d}" for k in range(COUNT)]
    assert sorted(path.name for path in split.campaigns.iterdir()) == names
    assert sorted(split.published()[1]) == names
    assert all(text.count(b"\n") == 401 for text in _contents(split.campaigns, "develop-*/test-1.csv").values())


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
def test_solving_goes_on_after_a_kill_and_no_process_stays(tmp_path):
    split = Layout(tmp_path / "split")
    names = [f"develop-{k:04d}" for k in range(COUNT)]
    for name in names:
        (split.campaigns / name).mkdir(parents=True)
    (split.folder / "seals.json").write_text(json.dumps({"split": "develop", "seals": dict.fromkeys(names, "")}))
    (tmp_path / "solver.py").write_text(SOLVER)
    with _begun(SOLVE, tmp_path, processes=2) as started:
        while len(there := _contents(split.answers, "develop-*.json")) < 3:
            time.sleep(0.005)
        started.kill()
    kept = _contents(split.answers, "develop-*.json")
    assert there.items() <= kept.items()
    assert all(json.loads(text)["diagnosis"]["of"] == name[:-5] for name, text in kept.items())
    (split.answers / ".develop-0000.json-half").write_text("{")
    _run(SOLVE, tmp_path)
    answers = _contents(split.answers, "*")
    assert sorted(answers) == [f"{name}.json" for name in names]
    assert kept.items() <= answers.items()
    deadline = time.monotonic() + 20.0
    while _working_in(tmp_path) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert _working_in(tmp_path) == []


def _working_in(folder):
    """Processes whose working folder it is."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if (process / "cwd").readlink() == folder:
                found.append(process.name)
        except OSError:
            continue
    return found
