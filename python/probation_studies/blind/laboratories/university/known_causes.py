"""What a refit with known causes leaves of every record: the floor under every diagnosis."""

from __future__ import annotations

from dataclasses import astuple
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.university.signals import PARAMETERS, added, specimen_response

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation_studies.blind.laboratories.university.design import Test
    from probation_studies.blind.laboratories.university.modal_law import FloatArray
    from probation_studies.blind.laboratories.university.planting import Planted
    from probation_studies.blind.laboratories.university.signals import Bench


def left_when_told(
    bench: Bench, planted: Sequence[Planted], errors: Sequence[FloatArray], force_errors: Mapping[str, FloatArray]
) -> dict[str, float]:
    """Root mean square [MPa] of what is left of every record along the strain without its noise.

    The base law's parameters and the amplitudes of the causes are refitted to the identified records, by generalised
    least squares linear around the truth; forms, nonlinear parameters and places are known. The strain's noise is left
    out of what is left, since an answer smooths it: what an answer leaves of it counts against the answer. Where
    specimens differ, the deviations of an identified one are estimated, too; those of a held-out one nobody can know.

    Parameters
    ----------
    bench : Bench
    planted : sequence of Planted
    errors : sequence of ndarray, each (n,) [MPa]
        All errors of every identified record: force, strain through the law, specimen.
    force_errors : mapping
        Errors of the force channel by record [MPa], held-out ones too.
    """
    scatter = np.zeros(len(PARAMETERS) + 1) if bench.design.scatter is None else np.array(astuple(bench.design.scatter))
    blocks = [_columns(deviating, [each.columns[k] for each in planted]) for k, deviating in enumerate(bench.specimens)]
    white = [bench.whitened(k, block) for k, block in enumerate(blocks)]
    wanted = [bench.whitened(k, error) for k, error in enumerate(errors)]
    size = np.linalg.norm(np.vstack(white), axis=0)
    moved = np.linalg.lstsq(np.vstack(white) / size, np.concatenate(wanted), rcond=1e-10)[0] / size
    left = {}
    for k, test in enumerate(bench.tests):
        estimated = scatter**2 * (bench.whitened(k, bench.specimens[k]).T @ (wanted[k] - white[k] @ moved))
        unknown = bench.specimens[k] @ (np.array(astuple(test.specimen)) - estimated)
        left[test.id] = force_errors[test.id] + unknown - blocks[k] @ moved
    for test in bench.design.tests:
        if test.held_out:
            left[test.id] = force_errors[test.id] + _unforeseen(test, planted, moved)
    return {test.id: float(np.sqrt(np.mean(left[test.id] ** 2))) for test in bench.design.tests}


def _unforeseen(test: Test, planted: Sequence[Planted], moved: FloatArray) -> FloatArray:
    """Of a held-out record, but for the errors of the force: its specimen's deviations less the refit's [MPa]."""
    deviating = specimen_response(test)
    acts = [each.act(test.run, None) for each in planted]
    columns = [added(test.run, [each])[:, 0] if each else None for each in acts]
    return np.asarray(deviating @ np.array(astuple(test.specimen)) - _columns(deviating, columns) @ moved)


def _columns(deviating: FloatArray, causes: Sequence[FloatArray | None]) -> FloatArray:
    """Of the base law's parameters and of the causes [MPa]; zero where a cause does not act."""
    acting = [np.zeros(len(deviating)) if column is None else column for column in causes]
    return np.column_stack([deviating[:, : len(PARAMETERS)], *acting])
