"""A split on a dask cluster: two worker processes on this machine."""

import json
import os
import shutil
import time
from pathlib import Path

import dask
import distributed
import pytest

from probation.cli import main
from probation.pool import run_all
from probation_studies.blind import laboratory
from probation_studies.blind.layout import Layout
from probation_studies.blind.solve import solve_split

COUNT = 12


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    return laboratory.make(5, 0).write(tmp_path_factory.mktemp("made") / "develop-0000")


@pytest.fixture
def split(campaign, tmp_path):
    layout = Layout(tmp_path / "split")
    names = [f"develop-{k:04d}" for k in range(COUNT)]
    for name in names:
        shutil.copytree(campaign, layout.campaigns / name)
    (layout.folder / "seals.json").write_text(json.dumps({"split": "develop", "seals": dict.fromkeys(names, "")}))
    return layout


def _diagnoses(folder):
    return {path.name: json.loads(path.read_text())["diagnosis"] for path in sorted(folder.glob("develop-*.json"))}


def test_a_cluster_gives_the_same_answers_as_this_process(cluster, split, tmp_path):
    solve = ["blind", "solve", str(split.folder), "--solver", "no-gap"]
    assert main([*solve, "--scheduler", cluster.scheduler_address]) == 0
    assert main([*solve, "--answers", str(tmp_path / "here"), "--processes", "1"]) == 0
    assert len(_diagnoses(split.answers)) == COUNT
    assert _diagnoses(split.answers) == _diagnoses(tmp_path / "here")


def test_a_worker_that_is_killed_half_way_loses_nothing(cluster, split, tmp_path):
    """The sixth campaign kills the process that works on it, the first time."""
    mark = tmp_path / "killed"

    def kills_once(folder):
        if folder.name == "develop-0005" and not mark.exists():
            mark.touch()
            os.kill(os.getpid(), 9)
        return {"verdict": "no_gap", "campaign": folder.name}

    with distributed.Client(cluster) as client, client.get_executor() as executor:
        done = solve_split(split.folder, kills_once, executor=executor)
    assert mark.exists()
    assert (done.before, done.now, done.failed) == (0, COUNT, {})
    assert [each["campaign"] for each in _diagnoses(split.answers).values()] == [
        f"develop-{k:04d}" for k in range(COUNT)
    ]


def test_a_cluster_makes_the_same_campaigns(cluster, campaign, tmp_path):
    make = ["blind", "make", "--seed", "5", "--count", "1", "--out", str(tmp_path)]
    assert main([*make, "--scheduler", cluster.scheduler_address]) == 0
    made = tmp_path / "campaigns" / "develop-0000"
    assert {path.name: path.read_bytes() for path in made.iterdir()} == {
        path.name: path.read_bytes() for path in campaign.iterdir()
    }


def test_nothing_is_left_open(cluster):
    """Clients come and go: a descriptor left by each of them would still be there seconds later."""
    clients = 5

    def use():
        with distributed.Client(cluster) as client, client.get_executor() as executor:
            run_all(pow, {k: (k, 2) for k in range(4)}, processes=None, executor=executor, progress=None, on_done=None)

    def descriptors():
        return len(list(Path("/proc/self/fd").iterdir()))

    use()
    before = descriptors()
    for _ in range(clients):
        use()
    until = time.monotonic() + 10
    while descriptors() >= before + clients and time.monotonic() < until:
        time.sleep(0.1)  # the scheduler closes its side when it gets to it
    assert descriptors() < before + clients


def test_a_scheduler_that_is_not_there_is_named(split, capsys):
    with dask.config.set({"distributed.comm.timeouts.connect": "300ms"}):
        assert main(["blind", "solve", str(split.folder), "--scheduler", "tcp://127.0.0.1:9"]) == 2
    assert "--scheduler: found nobody at tcp://127.0.0.1:9" in capsys.readouterr().err
