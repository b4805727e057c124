"""A split of the benchmark: campaigns made in parallel, truths sealed; an interruption loses nothing."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import cast

import numpy as np

from probation._files import make_folder, write_whole
from probation.errors import InputError
from probation.origin import origin
from probation.pool import Progress, run_all
from probation_studies.blind.laboratory_named import OWN, Laboratory, laboratory_named
from probation_studies.blind.layout import Layout
from probation_studies.blind.release import check_seed
from probation_studies.blind.seal import SEALS_FILE, SEALS_SCHEMA, read_object, read_truth, seal_truth

_PLAN_FILE = "plan.json"
_MAKING = ".making-"


def make_split(
    folder: str | Path,
    *,
    seed: int,
    count: int | None = None,
    strata: Mapping[str, int] | None = None,
    split: str = "develop",
    laboratory: str = OWN,
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
    seed : int
    count : int, optional
        Campaigns 0 to count - 1 of that seed, their strata drawn.
    strata : mapping, optional
        Instead of a count: how many campaigns of each stratum; they come in a drawn order.
    split : {"develop", "calibrate", "test"}
    laboratory : str
        One of `probation_studies.blind.laboratory_named.LABORATORIES`.
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
    made_by = laboratory_named(laboratory)
    if split not in made_by.SPLITS:
        raise InputError(f"split: found {split!r}, expected one of {', '.join(made_by.SPLITS)}")
    if (count is None) == (strata is None):
        raise InputError("count, strata: found both or neither, expected one of them")
    drawn = _drawn_order(made_by, strata, seed) if strata is not None else [None] * (count or 0)
    if seed < 0 or not drawn:
        raise InputError(
            f"seed, count: found {seed}, {len(drawn)}, expected a seed of at least 0 and a count of at least 1"
        )
    layout = Layout(Path(folder), None if truths is None else Path(truths))
    make_folder(layout.campaigns)
    make_folder(layout.truths)
    plan = {"split": split, "seed": seed, "count": len(drawn), "laboratory": laboratory}
    _check_plan(layout, plan | {"strata": None if strata is None else dict(strata)})
    for left in layout.campaigns.glob(f"{_MAKING}*"):  # of a run that was killed
        shutil.rmtree(left)
    places = str(layout.campaigns), str(layout.truths)
    jobs = {index: (*places, laboratory, split, seed, index, stratum) for index, stratum in enumerate(drawn)}
    run_all(_make_one, jobs, processes=processes, executor=executor, progress=progress, on_done=None)
    names = sorted(path.stem for path in layout.truths.glob(f"{split}-*.json"))
    seals = {name: read_truth(layout.truths / f"{name}.json").seal for name in names}
    said = {"split": split, "laboratory": laboratory, "count": len(drawn)}
    content = {"schema": SEALS_SCHEMA, **said, "made": origin(), "seals": seals}
    write_whole(layout.folder / SEALS_FILE, json.dumps(content, indent=1) + "\n")
    return layout


def _drawn_order(laboratory: Laboratory, strata: Mapping[str, int], seed: int) -> list[str | None]:
    """The stratum of every campaign, in an order that says nothing of it."""
    for name, count in strata.items():
        if name not in laboratory.STRATA or count < 0:
            raise InputError(
                f"strata: found {name}={count}, expected counts of at least 0 of {', '.join(laboratory.STRATA)}"
            )
    each = [name for name, count in strata.items() for _ in range(count)]
    return [each[k] for k in np.random.default_rng(max(seed, 0)).permutation(len(each))]


def _check_plan(layout: Layout, plan: dict[str, object]) -> None:
    """The plan is kept with the truths: the seed would give them away. What was begun may be finished."""
    path = layout.truths / _PLAN_FILE
    if path.exists():
        before: dict[str, object] = {"laboratory": OWN, "strata": None}  # of plans that do not say
        found = {key: value for key, value in (before | read_object(path)).items() if key in plan}
        if found != plan:
            raise InputError(f"{layout.folder}: found a split made with {found}, expected {plan} or an empty folder")
        return
    if plan["split"] == "test":
        check_seed(cast("int", plan["seed"]))
    write_whole(path, json.dumps(plan) + "\n")


def _make_one(
    campaigns: str, truths: str, laboratory: str, split: str, seed: int, index: int, stratum: str | None
) -> str:
    """Make one campaign unless it is there; its truth comes first, so that a campaign is never without."""
    name = campaign_name(split, index)
    target, kept = Path(campaigns) / name, Path(truths) / f"{name}.json"
    if target.is_dir() and kept.is_file():
        return name
    sealed = laboratory_named(laboratory).make(seed, index, split, stratum)
    if not kept.is_file():
        seal_truth(sealed.truth.to_json()).write(kept)
    with tempfile.TemporaryDirectory(dir=campaigns, prefix=_MAKING) as place:
        made = sealed.write(Path(place) / name)
        shutil.rmtree(target, ignore_errors=True)
        made.replace(target)
    return name


def campaign_name(split: str, index: int) -> str:
    """Such as "develop-0012"; it says nothing of the truth, nor of the seed that would give it away."""
    return f"{split}-{index:04d}"
