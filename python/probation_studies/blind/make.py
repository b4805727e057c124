"""A split of the benchmark: campaigns made in parallel, truths sealed; an interruption loses nothing."""

from __future__ import annotations

import json
import shutil
import tempfile
from concurrent.futures import Executor
from pathlib import Path
from typing import cast

from probation._files import make_folder, write_whole
from probation.errors import InputError
from probation.origin import origin
from probation.pool import Progress, run_all
from probation_studies.blind.layout import Layout
from probation_studies.blind.release import check_seed
from probation_studies.blind.seal import SEALS_FILE, SEALS_SCHEMA, read_object, read_truth, seal_truth

_PLAN_FILE = "plan.json"
_MAKING = ".making-"


def make_split(
    folder: str | Path,
    *,
    seed: int,
    count: int,
    split: str = "develop",
    truths: str | Path | None = None,
    processes: int | None = None,
    executor: Executor | None = None,
    progress: Progress | None = None,
) -> Layout:
    """Make campaigns and seal their truths.

    Parameters
    ----------
    folder : path
        Gets campaigns/ and seals.json, to be published; may exist from an interrupted run with the same arguments.
    seed, count : int
        Campaigns 0 to count - 1 of that seed.
    split : {"develop", "calibrate", "test"}
    truths : path, optional
        Where the truths are kept; truths/ in `folder` if left out.
    processes : int, optional
        All processors if left out.
    executor : Executor, optional
        Instead of processes of its own.
    progress : callable, optional
        ``progress(done, total, what)``.

    Raises
    ------
    InputError
        For bad arguments, a folder that holds another split, or the seed of a test split that was scored before.
    """
    from probation_studies.blind.laboratory import SPLITS  # noqa: PLC0415 - scipy is slow to load

    if split not in SPLITS:
        raise InputError(f"split: found {split!r}, expected one of {', '.join(SPLITS)}")
    if seed < 0 or count < 1:
        raise InputError(f"seed, count: found {seed}, {count}, expected a seed of at least 0 and a count of at least 1")
    layout = Layout(Path(folder), None if truths is None else Path(truths))
    make_folder(layout.campaigns)
    make_folder(layout.truths)
    _check_plan(layout, {"split": split, "seed": seed, "count": count})
    for left in layout.campaigns.glob(f"{_MAKING}*"):  # of a run that was killed
        shutil.rmtree(left)
    jobs = {index: (str(layout.campaigns), str(layout.truths), split, seed, index) for index in range(count)}
    run_all(_make_one, jobs, processes=processes, executor=executor, progress=progress, on_done=None)
    names = sorted(path.stem for path in layout.truths.glob(f"{split}-*.json"))
    seals = {name: read_truth(layout.truths / f"{name}.json").seal for name in names}
    content = {"schema": SEALS_SCHEMA, "split": split, "count": count, "made": origin(), "seals": seals}
    write_whole(layout.folder / SEALS_FILE, json.dumps(content, indent=1) + "\n")
    return layout


def _check_plan(layout: Layout, plan: dict[str, object]) -> None:
    """The plan is kept with the truths: the seed would give them away. What was begun may be finished."""
    path = layout.truths / _PLAN_FILE
    if path.exists():
        found = {key: value for key, value in read_object(path).items() if key in plan}
        if found != plan:
            raise InputError(f"{layout.folder}: found a split made with {found}, expected {plan} or an empty folder")
        return
    if plan["split"] == "test":
        check_seed(cast("int", plan["seed"]))
    write_whole(path, json.dumps(plan) + "\n")


def _make_one(campaigns: str, truths: str, split: str, seed: int, index: int) -> str:
    """Make one campaign unless it is there; its truth comes first, so that a campaign is never without."""
    from probation_studies.blind.laboratory import make  # noqa: PLC0415
    from probation_studies.blind.laboratory.truth import campaign_name  # noqa: PLC0415

    name = campaign_name(split, index)
    target, kept = Path(campaigns) / name, Path(truths) / f"{name}.json"
    if target.is_dir() and kept.is_file():
        return name
    sealed = make(seed, index, split)
    if not kept.is_file():
        seal_truth(sealed.truth.to_json()).write(kept)
    with tempfile.TemporaryDirectory(dir=campaigns, prefix=_MAKING) as place:
        made = sealed.write(Path(place) / name)
        shutil.rmtree(target, ignore_errors=True)
        made.replace(target)
    return name
