"""The noise of a change: that of the record, that of its reference along the curves by which this is followed."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.comparison.measured_law import followed
from probation.comparison.strain_path import branches
from probation.inference.propagated import propagated_noise
from probation.inference.view_residual import residual_of
from probation.noise.drift import with_drift
from probation.noise.estimate import estimate_noise
from probation.settings.comparison import COMPARISON
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.comparison.measured_law import MeasuredLaw
    from probation.effects.record_view import RecordView
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation


def own_residual(view: RecordView, residual: FloatArray) -> RecordResidual:
    """A record by itself, all that is slow in a residual (n,) [MPa] set aside: what is left is its noise."""
    left, frames = residual.copy(), []
    for part in branches(view):
        frame = followed(view.time[part])
        left[part] -= frame @ (frame.T @ left[part])
        whole = np.zeros((len(view), frame.shape[1]))
        whole[part] = frame
        frames.append(whole)
    return residual_of(view, left, np.hstack(frames))


def record_noises(records: Sequence[RecordResidual]) -> tuple[NoiseModel, ...]:
    """The noise of records by themselves, their slow course (`tangent`) apart, with the least drift that is likely.

    Never less than what is left of them: a corner that no smooth curve follows is no better known than noise.
    """
    noises = []
    for record, noise in zip(records, estimate_noise(records), strict=True):
        rough = np.sort(noise.whiten(record.residual) ** 2)[: -max(len(record) // COMPARISON.outlying_one_in, 1)]
        excess = float(np.sum(rough)) / max(len(record) - record.tangent.shape[1], 1)
        noises.append(with_drift(noise.scaled(max(np.sqrt(excess), 1.0)), NOISE.least_drift))
    return tuple(noises)


def change_noise(
    view: RecordView,
    own: NoiseModel,
    law: MeasuredLaw,
    references: Sequence[NoiseModel],
    missed: NDArray[np.bool_],
) -> NoiseModel:
    """The noise of a record minus what its references predict.

    The reference is another measurement: its noise is let be independent of the record's, and along the curves by
    which it was followed it is part of what is predicted.

    Parameters
    ----------
    view : RecordView
    own : NoiseModel
        The record's.
    law : MeasuredLaw
    references : sequence of NoiseModel
        Of each reference of that record.
    missed : ndarray of bool, shape (n,)
        Samples whose strain the smoother did not follow.
    """
    followed = law.frames(view)
    columns = [
        float(np.sqrt(np.mean(noise.long_run**2))) / len(followed) * frame
        for frame, noise in zip(followed, references, strict=True)
    ]
    columns += law.beyond(view)
    strain = propagated_noise(law, view, law.start)
    if strain is not None:
        columns.append(np.sqrt(1.0 + 1.0 / len(followed)) * strain)
    undecided = _undecided(view, law, missed)
    free = np.zeros((len(view), len(undecided)))
    free[undecided, np.arange(len(undecided))] = float(np.max(np.abs(view.data)))
    slow = free if own.drift is None else np.hstack([own.drift, free])
    return replace(own, propagated=np.hstack([own.propagated, *columns]), drift=slow, outliers=tuple(undecided))


def missed_by_smoother(record: Record, excitation: Excitation) -> NDArray[np.bool_]:
    """Samples whose strain a smoother did not follow, and their neighbours; shape (n,)."""
    missed = np.abs(record.true_strain - excitation.true_strain)
    far = (
        missed > COMPARISON.smoother_distance * float(np.median(missed))
        if excitation.operators is not None
        else np.zeros(len(record), bool)
    )
    return np.asarray(np.convolve(far, np.ones(2 * COMPARISON.branch_ends + 1), mode="same") > 0.0)


def _undecided(view: RecordView, law: MeasuredLaw, missed: NDArray[np.bool_]) -> list[int]:
    """Single samples next to turns and the start, where a smoother or the reference does not follow: of any size."""
    at = set(np.flatnonzero(law.sharp(view) | missed).tolist())
    for part in branches(view):
        first = part.start if part.start == 0 else part.start - COMPARISON.branch_ends
        at.update(range(max(first, 0), min(part.start + COMPARISON.branch_ends, len(view))))
    return sorted(at)
