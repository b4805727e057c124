"""The example on disk: field.zarr, as a laboratory would have it, and truth.zarr beside it."""

from __future__ import annotations

import math
import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from probation._files import make_folder, written_to
from probation.errors import InputError
from probation.field.chunks import create, write
from probation.field.example import specimen
from probation.field.example.superposition import superpose
from probation.field.extra import load
from probation.field.grid import BlockGrid
from probation.pool import run_all

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from probation._arrays import FloatArray
    from probation.field.grid import Block
    from probation.pool import Progress

CHUNK = 64
"""Pixels along each side of a chunk of a large field."""
LONGEST_STEP = 0.1
"""Of the integration [s], however far apart the samples are: its error falls with the square of the step."""
STRAIN_NOISE = 1e-4
FORCE_NOISE = 0.04
"""Of the stress over the initial cross-section [MPa]: that of the true stress grows as e^strain."""
LOST, LOST_LATER, DROPPED = 0.004, 0.01, 0.0002
"""Pixels that never correlate, that stop to at some instant, and samples that lack."""
_AT_ONCE = 512  # pixels integrated together

TRUTH = {"unrelaxed_modulus": "MPa", "tau_max": "s", "hardening_modulus": "MPa"}


def make_example(
    folder: str | os.PathLike[str],
    *,
    size: int = 256,
    times: int = 301,
    seed: int = 1,
    processes: int | None = None,
    executor: Executor | None = None,
    progress: Progress | None = None,
) -> tuple[Path, Path]:
    """Write the field and its truth; the same for the same size, times and seed, however many processes.

    Parameters
    ----------
    folder : path
        Where field.zarr and truth.zarr go; neither may be there.
    size : int
        Pixels along each side.
    times : int
        Instants.
    seed : int
        Of the noise, and of which pixels are lost.
    processes, executor, progress
        As in `identify_field`.
    """
    if size < 4 or times < 20 or seed < 0:
        raise InputError(f"found size {size}, times {times}, seed {seed}; expected at least 4, 20 and 0")
    field, truth = Path(folder) / "field.zarr", Path(folder) / "truth.zarr"
    for path in (field, truth):
        if path.exists():
            raise InputError(f"{path}: found it there, expected another --out")
    chunk = min(CHUNK, max(4, size // 4))
    grid = BlockGrid((size, size), (chunk, chunk))
    part = Path(folder) / f"field.zarr.{os.getpid()}.part"
    try:
        make_folder(folder)
        with written_to(folder):
            _create(part, grid, times, seed)
            jobs = {block: (str(part), grid, times, seed, block) for block in grid.blocks()}
            run_all(make_block, jobs, processes=processes, executor=executor, progress=progress, on_done=None)
            _write_truth(truth, size)
            part.rename(field)
    finally:
        shutil.rmtree(part, ignore_errors=True)
    return field, truth


def make_block(path: str, grid: BlockGrid, times: int, seed: int, block: Block) -> None:
    """Histories of a block: drawn, integrated, measured."""
    at = grid.slices(block)
    across = specimen.positions(grid.shape[0])
    y, x = (positions.ravel() for positions in np.meshgrid(across[at[0]], across[at[1]], indexing="ij"))
    there = np.flatnonzero(specimen.inside(y, x))
    strain, stress = np.full((2, len(y), times), np.nan, dtype=np.float32)
    substeps = math.ceil(specimen.DURATION / (times - 1) / LONGEST_STEP)
    instants = np.linspace(0.0, specimen.DURATION, substeps * (times - 1) + 1)
    chance = np.random.default_rng([seed, *block])
    for some in np.split(there, range(_AT_ONCE, len(there), _AT_ONCE)):
        drawn = specimen.true_strain(instants, y[some], x[some])
        made = specimen.material(y[some], x[some])
        true = superpose(instants[1], drawn, made.unrelaxed_modulus, made.tau_max, made.hardening_modulus)
        strain[some], stress[some] = _measured(drawn[:, ::substeps], true[:, ::substeps], chance)
    shape = (at[0].stop - at[0].start, at[1].stop - at[1].start, times)
    write(path, "true_strain", at, strain.reshape(shape))
    write(path, "true_stress", at, stress.reshape(shape))


def _measured(strain: FloatArray, stress: FloatArray, chance: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """With noise, and without what image correlation lost."""
    shape = strain.shape
    measured = strain + STRAIN_NOISE * chance.standard_normal(shape)
    with_noise = stress + FORCE_NOISE * np.exp(strain) * chance.standard_normal(shape)
    lost_from = np.full(shape[0], shape[1])
    late = chance.random(shape[0]) < LOST_LATER
    lost_from[late] = chance.integers(shape[1] // 4, shape[1], np.count_nonzero(late))
    lost_from[chance.random(shape[0]) < LOST] = 0
    dropped = chance.random(shape) < DROPPED
    dropped[:, 0] = False
    measured[dropped | (np.arange(shape[1]) >= lost_from[:, None])] = np.nan
    return measured, with_noise


def _create(path: Path, grid: BlockGrid, times: int, seed: int) -> None:
    """An empty field."""
    title = "synthetic necking specimen: made by probation field example, not measured"
    group = load("zarr").open_group(path, mode="w", attributes={"title": title, "seed": seed})
    _axes(group, grid.shape[0])
    time = create(group, "time", (times,), ("time",), attributes={"units": "s"})
    time[...] = np.linspace(0.0, specimen.DURATION, times)
    for name, unit in (("true_strain", "1"), ("true_stress", "MPa")):
        shape, chunks = (*grid.shape, times), (*grid.block, times)
        create(group, name, shape, ("y", "x", "time"), chunks=chunks, dtype="<f4", attributes={"units": unit})


def _write_truth(path: Path, size: int) -> None:
    """What the specimen is made of, NaN where there is none."""
    across = specimen.positions(size)
    y, x = np.meshgrid(across, across, indexing="ij")
    made = specimen.material(y, x)
    group = load("zarr").open_group(path, mode="w", attributes={"title": "what the example's field was made with"})
    _axes(group, size)
    for name, unit in TRUTH.items():
        values = np.where(specimen.inside(y, x), getattr(made, name), np.nan)
        create(group, name, values.shape, ("y", "x"), attributes={"units": unit})[...] = values


def _axes(group: Any, size: int) -> None:
    for name in ("y", "x"):
        create(group, name, (size,), (name,), attributes={"units": "mm"})[...] = specimen.positions(size)
