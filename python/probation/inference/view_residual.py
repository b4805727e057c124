"""What the statistics know of a record, from its view and a model's residual there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.noise.record_residual import RecordResidual

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def residual_of(
    view: RecordView,
    residual: FloatArray,
    tangent: FloatArray,
    *,
    given_noise: float | None = None,
    propagated: FloatArray | None = None,
    wander: FloatArray | None = None,
) -> RecordResidual:
    """One record at one fit.

    Parameters
    ----------
    view : RecordView
    residual : ndarray, shape (n_samples,) [MPa]
        Model minus data.
    tangent : ndarray, shape (n_samples, p)
    given_noise, propagated, wander
        As in `RecordResidual`.
    """
    # With its sign, 0 in a dwell.
    rate = np.append(view.direction[:1], view.direction) * view.rate
    return RecordResidual(
        name=view.id,
        time=view.sampled(view.time),
        true_strain=view.sampled(view.true_strain),
        strain_rate=view.sampled(rate),
        residual=residual,
        tangent=tangent,
        jumps=tuple(jump // view.stride for jump in view.jumps),
        measured=view.data,
        given_noise=given_noise,
        propagated=propagated,
        wander=wander,
        specimen_id=view.specimen_id,
        temperature=None if view.temperature is None else float(view.temperature[0]),
    )
