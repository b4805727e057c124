"""Answers to a split: one file per campaign, written whole, with the version and commit that gave it."""

from __future__ import annotations

import hashlib
import json
import time
import traceback
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

import probation
from probation._files import make_folder, read_whole, write_whole
from probation.origin import origin
from probation.pool import Progress, run_all
from probation_studies.blind.layout import Layout
from probation_studies.blind.seal import read_object
from probation_studies.blind.solvers import Solver, solver_named

"""From a campaign's folder to the answer of ``probation diagnose --json``."""

ANSWER_SCHEMA = "probation.blind.answer/1"


@dataclass(frozen=True)
class Solved:
    """What a run did: answers given before and now, and what failed (campaign and what went wrong)."""

    before: int
    now: int
    failed: dict[str, str]


def diagnosed(folder: Path) -> dict[str, object]:
    """The package's own answer.

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    answer = json.loads(probation.diagnose(probation.Campaign.load(folder), threads=1, design=False).to_json())
    assert isinstance(answer, dict)
    return answer


def solve_split(
    folder: str | Path,
    solve: Solver | None = diagnosed,
    *,
    answers: str | Path | None = None,
    baselines: Iterable[str] = (),
    processes: int | None = None,
    executor: Executor | None = None,
    progress: Progress | None = None,
    again: bool = False,
) -> Solved:
    """Answer every campaign of a split that has no answer yet; each answer is kept as soon as it is there.

    Parameters
    ----------
    folder : path
        As `make_split` left it; only campaigns/ and seals.json are read.
    solve : callable, optional
        From a campaign's folder to the answer, as docs/formats.md has it; a module's own function. None for baselines
        only.
    answers : path, optional
        answers/ in `folder` if left out.
    baselines : iterable of str
        Names of `probation_studies.blind.solvers.BASELINES` that answer, too, in baselines/NAME.
    processes, executor, progress
        As in `make_split`.
    again : bool
        Answer all anew.

    Raises
    ------
    InputError
        If `folder` holds no split.
    """
    layout = Layout(Path(folder), answer_folder=None if answers is None else Path(answers))
    _, seals = layout.published()
    places: dict[Path, Solver] = {} if solve is None else {layout.answers: solve}
    places |= {layout.baseline(name).answers: solver_named(name) for name in baselines}
    for place in places:
        make_folder(place)
        for half_written in place.glob(".*.json-*"):  # by a run that was killed
            half_written.unlink()
    jobs: dict[str, tuple[object, ...]] = {}
    left = 0
    for name in seals:
        waiting = {place: each for place, each in places.items() if again or not _is_answered(place / f"{name}.json")}
        left += len(waiting)
        if waiting:
            jobs[name] = waiting, str(layout.campaigns / name), name
    failed: dict[str, str] = {}

    def keep(name: str, given: dict[Path, dict[str, object]]) -> None:
        for place, answer in given.items():
            write_whole(place / f"{name}.json", json.dumps(answer, ensure_ascii=False, indent=1) + "\n")
            if "error" in answer:
                failed[name if place == layout.answers else f"{place.name}/{name}"] = str(answer["error"])

    run_all(_solve_one, jobs, processes=processes, executor=executor, progress=progress, on_done=keep)
    return Solved(len(seals) * len(places) - left, left - len(failed), failed)


def _is_answered(path: Path) -> bool:
    return path.is_file() and "error" not in read_object(path)


def _solve_one(solvers: Mapping[Path, Solver], folder: str, name: str) -> dict[Path, dict[str, object]]:
    """Answers of several solvers, by where they are kept."""
    return {place: _answered(solve, folder, name) for place, solve in solvers.items()}


def _answered(solve: Solver, folder: str, name: str) -> dict[str, object]:
    """One answer; a failure is one, too, and is tried again next time."""
    begun = time.perf_counter()
    answer: dict[str, object] = {"schema": ANSWER_SCHEMA, "campaign": name, "campaign_sha256": folder_sha256(folder)}
    try:
        answer["diagnosis"] = solve(Path(folder))
    except Exception as failure:  # one campaign must not end the run
        answer["error"] = f"{type(failure).__name__}: {failure}"
        answer["trace"] = traceback.format_exc()
    return {**answer, "seconds": time.perf_counter() - begun, "answered": origin()}


def folder_sha256(folder: str | Path) -> str:
    """SHA-256 over the names and contents of a campaign's files."""
    digest = hashlib.sha256()
    for path in sorted(Path(folder).iterdir()):
        digest.update(path.name.encode() + b"\0" + read_whole(path) + b"\0")
    return digest.hexdigest()
