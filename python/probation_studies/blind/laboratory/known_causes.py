"""What a refit with known causes leaves of the records: the floor under every diagnosis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.trial import recorded_stress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratory.bank import Bank
    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.placing import Planted


def left_when_told(bank: Bank, planted: Sequence[Planted], noise: Sequence[FloatArray]) -> list[FloatArray]:
    """What is left of every record by the generator's own law, refitted to the identified ones.

    Its parameters and the amplitudes of its causes are refitted (generalised least squares with the covariance that
    the noise was drawn from, linear around the truth); their forms, nonlinear parameters and places are known.

    Parameters
    ----------
    bank : Bank
    planted : sequence of Planted
    noise : sequence of ndarray, each (n,) [MPa]
        What the true law leaves of every record.

    Returns
    -------
    list of ndarray, each (n,) [MPa]
    """
    bench = bank.bench
    columns = []
    for k in range(len(bench.tests)):
        base, tangent = bench.base_and_tangent(k)
        amplitudes = np.zeros((len(base), len(planted)))
        for j, each in enumerate(planted):
            if each.record is None or each.record == k:
                amplitudes[:, j] = recorded_stress([(bench.trial(k), (each.acting,))])[0] - base
        columns.append(np.hstack([tangent, amplitudes]))
    matrix = np.vstack([bank.whitened(k, columns[k]) for k in bench.identified])
    wanted = np.concatenate([bank.whitened(k, noise[k]) for k in bench.identified])
    size = np.linalg.norm(matrix, axis=0)
    moved = np.linalg.lstsq(matrix / size, wanted, rcond=1e-10)[0] / size
    return [np.asarray(own - columns[k] @ moved) for k, own in enumerate(noise)]
