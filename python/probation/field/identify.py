"""`identify_field`: the law on every pixel of a field, block by block, on this machine or on a cluster."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from probation._arrays import as_threads, one_of
from probation._core import __version__
from probation.answers import plain
from probation.bulk import METHODS, SUBSTEPS_LIMIT, Method
from probation.errors import InputError
from probation.field.block import FieldTask, identify_block, kinds_of
from probation.field.fingerprint import COVERS, fingerprint
from probation.field.grid import block_grid
from probation.field.pixels import Substeps, Way
from probation.field.source import FieldSource, open_field
from probation.field.store import MapStore, read_run
from probation.identify.base_law import START
from probation.inference.parameter import by_inside_name, outside_name
from probation.law.answer import law_answer
from probation.law.modal import Law
from probation.law.schemes import BE2, Scheme, SchemeName, identifying
from probation.origin import commit
from probation.pool import WorkersLostError, run_all
from probation.progress import shows_progress

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping
    from concurrent.futures import Executor

    from probation.pool import Progress

PIXELS = 4096
"""Pixels of a task, unless given: seconds of work, megabytes of samples."""


class BlockLostError(RuntimeError):
    """A block could not be done, or its maps did not reach the store; what is done is kept."""


@dataclass(frozen=True)
class FieldRun:
    """What a run has done.

    Attributes
    ----------
    path : str
        Of the maps.
    now, before : int
        Blocks done in this run and found done.
    again : int
        Blocks that were marked as done, but whose maps were not what had been written; done anew.
    """

    path: str
    now: int
    before: int
    again: int


@shows_progress
def identify_field(
    field: str | os.PathLike[str] | FieldSource,
    out: str | os.PathLike[str],
    law: Law | None = None,
    scheme: Scheme | SchemeName = "be2",
    *,
    method: Method = "variable-projection",
    hold: Mapping[str, float] | None = None,
    smoothing: bool = True,
    substeps: Substeps = "auto",
    pixels: int = PIXELS,
    processes: int | None = None,
    threads: int | None = None,
    executor: Executor | None = None,
    afresh: bool = False,
    progress: Progress | None = None,
) -> FieldRun:
    """Identify the law on every pixel.

    A run that was interrupted, or whose workers were, goes on where it stopped when it is called again: a block is
    marked as done once it is whole, and not before.

    Parameters
    ----------
    field : path or FieldSource
        As `open_field` reads it.
    out : path
        A zarr store for the maps; begun, or gone on with.
    law : Law, optional
        Gives spectrum and companion relation; the paper's spectrum and a constant tau_max if left out.
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
    method : {"variable-projection", "levenberg-marquardt"}
    hold : dict of str to float, optional
        Parameters that are not identified, by name with unit ("unrelaxed_modulus_MPa").
    smoothing : bool
        Whether the strain's noise is taken out first, with a spline that each record chooses; leave it on unless the
        strain is free of noise or its rate is discontinuous.
    substeps : int or "auto"
        Steps of the scheme from sample to sample; "auto": in each block as many as it needs for its own error to move
        no parameter by more than a tenth of its standard error, up to 16.
    pixels : int
        Of a task, at most.
    processes : int, optional
        At a time, each with one thread; all processors if left out. 1 stays in this process.
    threads : int, optional
        Of the engine where there is one process; all cores if left out.
    executor : Executor, optional
        Instead of processes of its own, such as that of a cluster's client; its workers see the same folders.
    afresh : bool
        Remove what is in `out` and begin anew.
    progress : callable, optional
        Called with blocks done, blocks in all, and which.

    Raises
    ------
    InputError
        For a field that cannot be read, or maps in `out` that were made from another field or in another way.
    BlockLostError
        If processes die of a block, naming it.
    """
    chosen, substeps = identifying(scheme, substeps)
    one_of(method, "method", METHODS)
    if pixels < 1:
        raise InputError(f"found pixels = {pixels}, expected at least 1")
    as_threads(threads)
    if substeps != "auto" and (type(substeps) is not int or not 1 <= substeps <= SUBSTEPS_LIMIT):
        raise InputError(f"substeps is {substeps!r}; expected 'auto' or a whole number from 1 to {SUBSTEPS_LIMIT}")
    source = field if isinstance(field, FieldSource) else open_field(field)
    law, held = _law_with(law, hold or {})
    grid = block_grid(source.shape, source.chunks, pixels)
    path = Path(out).absolute()
    way = Way(law, chosen, method, held, smoothing, substeps, threads if executor is None and processes == 1 else 1)
    run = _run(source, way, grid.block)
    store = MapStore(str(path), grid)
    if afresh and path.exists():
        read_run(str(path))  # nothing else is ever removed
        shutil.rmtree(path)
    if path.exists():
        _check_same(path, run)
    else:
        begun = {**run, "version": __version__, "commit": commit(), "field": source.path, "sha256_covers": COVERS}
        store.create(kinds_of(law), begun, source.coordinates())
    return _run_blocks(FieldTask(source, store, way), processes=processes, executor=executor, progress=progress)


def _run_blocks(
    task: FieldTask,
    *,
    processes: int | None,
    executor: Executor | None,
    progress: Progress | None,
) -> FieldRun:
    """Do the blocks that are not done, however often it takes.

    Raises
    ------
    BlockLostError
        If a process of its own dies, workers of a cluster die of a block again and again, or a block that was done is
        not there.
    """
    kinds = kinds_of(task.way.law)
    marked = task.store.marked()
    whole = {block for block in task.store.grid.blocks() if marked[block] and task.store.done(block, kinds)}
    left = [block for block in task.store.grid.blocks() if block not in whole]
    total = len(whole) + len(left)
    advance = None if progress is None else lambda done, _, what: progress(len(whole) + done, total, what)
    try:
        run_all(
            identify_block,
            {block: (task, block) for block in left},
            processes=processes,
            executor=executor,
            progress=advance,
            on_done=None,
        )
    except WorkersLostError as failure:
        lost = ", ".join(str(key) for key in sorted(failure.keys))  # type: ignore[type-var]
        raise BlockLostError(
            f"{task.store.path}: processes died while they had block {lost}, as they do where memory is short: "
            f"give fewer --pixels than {task.store.grid.block[0] * task.store.grid.block[1]}; what is done is kept"
        ) from failure
    lacking = np.argwhere(~task.store.marked())
    if len(lacking):
        raise BlockLostError(f"{task.store.path}: block {tuple(lacking[0].tolist())} was done and is not marked")
    return FieldRun(task.store.path, len(left), len(whole), int(np.count_nonzero(marked)) - len(whole))


def _law_with(law: Law | None, hold: Mapping[str, float]) -> tuple[Law, tuple[str, ...]]:
    """The law with what is held, and the names of that."""
    law = law or Law(
        unrelaxed_modulus=START["unrelaxed_modulus"],
        tau_max=START["tau_max"],
        hardening_modulus=START["hardening_modulus"],
    )
    held = {name: float(value) for name, value in by_inside_name(hold, law.parameter_names, "hold").items()}
    if len(held) == len(law.parameter_names):
        raise InputError("hold: found every parameter held, expected one left to identify")
    values = [held.get(name, getattr(law, name)) for name in law.parameter_names]
    return law.with_parameters(values), tuple(name for name in law.parameter_names if name in held)


def _run(source: FieldSource, way: Way, block: tuple[int, int]) -> dict[str, Any]:
    """What must be the same for a run to go on."""
    answer = law_answer(way.law)
    answer["parameters"] = {outside_name(name): getattr(way.law, name) for name in way.held}
    content = {
        "field_sha256": fingerprint(source),
        "law": answer,
        "scheme": way.scheme.name,
        "method": way.method,
        "smoothing": way.smoothing,
        "substeps": way.substeps,
        "block": list(block),
    }
    if way.scheme.start != BE2().start:
        content["start"] = way.scheme.start
    return {name: plain(value) for name, value in content.items()}


def _check_same(path: Path, run: Mapping[str, Any]) -> None:
    """Raise an InputError where maps were begun otherwise."""
    before = read_run(str(path))
    answer = {
        "field_sha256": "the field has changed, or is another",
        "law": "the law is another",
        "scheme": "the scheme is another",
        "start": "the scheme's first step is another",
        "method": "the method is another",
        "smoothing": "the strain is smoothed, or not",
        "substeps": "the steps from sample to sample are others",
        "block": "the blocks are others (--pixels)",
        "version": "the version of probation is another",
    }
    now = {**run, "version": __version__}
    for key, what in answer.items():
        if before.get(key) != now.get(key):
            raise InputError(
                f"{path}: {what}: found maps begun with {key} {_short(before.get(key))}, expected "
                f"{_short(now.get(key))}; give another --out, or --afresh to begin anew"
            )


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= 160 else text[:157] + "..."
