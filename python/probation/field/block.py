"""One task: read a block of pixels, identify the law on each, write the maps."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.field.errors import drawn_errors, neighbourhoods, rounds
from probation.field.pixels import Way, identify_pixels, with_more_noise
from probation.field.samples import used_samples
from probation.field.store import map_kinds, product_name
from probation.field.substeps import substeps_of_block

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation.field.grid import Block
    from probation.field.source import FieldSource
    from probation.field.store import MapKind, MapStore
    from probation.law.modal import Law

SEED = 20200905
"""Of the noise that is drawn for standard errors: with the block, so that a block done twice is the same."""


@dataclass(frozen=True)
class FieldTask:
    """All that a worker needs to know, but for the block."""

    source: FieldSource
    store: MapStore
    way: Way


def kinds_of(law: Law) -> dict[str, MapKind]:
    """The maps that an identification of a law writes."""
    return map_kinds(companion=law.companion is not None)


def identify_block(task: FieldTask, block: Block) -> Block:
    """Do one block, unless it is done: a scheduler that lost the news of it asks again."""
    if task.store.done(block, kinds_of(task.way.law)):
        return block
    clock = time.thread_time if task.way.threads == 1 else time.process_time
    start = clock()
    maps, substeps = block_maps(task, block)
    task.store.write(block, maps, clock() - start, substeps)
    return block


def block_maps(task: FieldTask, block: Block) -> tuple[dict[str, NDArray[Any]], int]:
    """Every map on a block, and the steps of the scheme from sample to sample."""
    rows, columns = task.store.grid.slices(block)
    shape = (rows.stop - rows.start, columns.stop - columns.start)
    times, way = task.source.time, task.way
    strain, stress = task.source.read(rows, columns)
    used = used_samples(strain, stress)
    chance = np.random.default_rng([SEED, *block])
    near, level, draws = neighbourhoods(used, shape), np.full(len(used), np.nan), []
    substeps = way.substeps
    if substeps == "auto":
        substeps = substeps_of_block(way, times, strain, stress, used, chance)
    found = identify_pixels(way, times, strain, stress, used, substeps)
    for pixels in rounds(found.identified, near):
        more = with_more_noise(times, strain[pixels], stress[pixels], used[pixels], near[pixels], chance)
        draws.append((pixels, identify_pixels(way, times, more[0], more[1], used[pixels], substeps)))
        level[pixels] = more[2]
    errors = drawn_errors(found, draws, level, near)
    maps: dict[str, NDArray[Any]] = {}
    for column, name in enumerate(way.law.parameter_names):
        maps[name] = found.parameters[:, column]
        maps[f"{name}_standard_error"] = errors.parameters[:, column]
    product = product_name(way.law.parameter_names[1])
    maps[product] = found.parameters[:, 0] * found.parameters[:, 1]
    maps[f"{product}_standard_error"] = errors.product
    maps["rms_residual"], maps["noise"] = found.rms_residual, errors.noise
    maps["samples"] = np.count_nonzero(used, axis=1)
    maps["status"] = found.status
    kinds = kinds_of(way.law)
    return {name: maps[name].reshape(shape).astype(kind.dtype) for name, kind in kinds.items()}, substeps
