"""What a refit with known causes leaves of every record: the floor under every diagnosis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from probation_studies.blind.laboratories.industry.bench import Programme
from probation_studies.blind.laboratories.industry.memory import FloatArray
from probation_studies.blind.laboratories.industry.sight import Acting, Sight, View, residual, view_of

_PARAMETERS = 3


@dataclass(frozen=True, eq=False)
class Errors:
    """Of one record.

    Attributes
    ----------
    stress : ndarray, shape (n,) [MPa]
        Of the force, over the true section.
    strain : ndarray, shape (n,)
    specimen : ndarray, shape (4,)
        Relative deviations of its E, tau, G and section.
    """

    stress: FloatArray
    strain: FloatArray
    specimen: FloatArray


@dataclass(frozen=True, eq=False)
class RecordAsTested:
    """One record, the causes in the order of the campaign; None where one does not act."""

    programme: Programme
    held_out: bool
    causes: tuple[Acting | None, ...]
    errors: Errors


def left_when_told(sight: Sight, records: Sequence[RecordAsTested]) -> list[float]:
    """Root mean square [MPa] of what is left of every record along the strain without its noise.

    The base law's parameters and the amplitudes of the causes are refitted to the identified records, by generalised
    least squares linear around the truth; forms, nonlinear parameters and places are known. The strain's noise is left
    out of what is left, since an answer smooths it: what an answer leaves of it counts against the answer. Where
    specimens differ, the deviations of an identified one are estimated, too; those of a held-out one nobody can know.

    Parameters
    ----------
    sight : Sight
    records : sequence of RecordAsTested
        All of the campaign, those of the sight in its order.
    """
    matrix, wanted, specimens = [], [], []
    identified = [each for each in records if not each.held_out]
    for view, response, each in zip(sight.views, sight.responses, identified, strict=True):
        deviating = view.at_samples(sight.tangents(view))
        matrix.append(view.means(_columns(sight, view, each)))
        specimens.append(view.means(deviating))
        wanted.append(view.means(each.errors.stress + deviating @ each.errors.specimen) - response @ each.errors.strain)
    white, target = sight.white(np.concatenate(matrix)), sight.white(np.concatenate(wanted))
    size = np.linalg.norm(white, axis=0)
    moved = np.linalg.lstsq(white / size, target, rcond=1e-10)[0] / size
    expected = (sight.white(block_diag(*specimens)).T @ (target - white @ moved)).reshape(len(identified), -1)
    estimated = iter(np.array(sight.scatter or np.zeros(4)) ** 2 * expected)
    return [_left(sight, each, moved, np.zeros(4) if each.held_out else next(estimated)) for each in records]


def _left(sight: Sight, record: RecordAsTested, moved: FloatArray, specimen: FloatArray) -> float:
    """With the deviations of the specimen as they are estimated."""
    view = view_of(record.programme)
    unknown = view.at_samples(sight.tangents(view)) @ (record.errors.specimen - specimen)
    left = record.errors.stress + unknown - _columns(sight, view, record) @ moved
    return float(np.sqrt(np.mean(left**2)))


def _columns(sight: Sight, view: View, record: RecordAsTested) -> FloatArray:
    """Of the base law's parameters and of the causes, at the samples [MPa]."""
    causes = [
        np.zeros(len(view.thin.time)) if each is None else residual(view.thin, sight.law, sight.scales, [each])
        for each in record.causes
    ]
    return view.at_samples(np.column_stack([sight.tangents(view)[:, :_PARAMETERS], *causes]))
