"""Records that were not fitted, as the fitted ones predict them: errors of the parameters are part of their noise.

A prediction is linear in these errors only as far as the parameters are known. One ramp may leave E_u and tau_max
unknown but for their product; along it another rate is predicted well, off the straight line by many times the noise.
So what a prediction errs by is linearised once more where the parameters describe the record jointly with the fitted
ones (`jointly`).
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from probation.inference.model import CampaignModel
from probation.inference.problem import Problem
from probation.inference.refit import refit
from probation.inference.unsolvable import UNSOLVABLE
from probation.law.modification import InitialStress, Modification
from probation.noise.whitener import Whitener
from probation.records.start import is_far
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.base_fit import BaseFit
    from probation.inference.refit import Refit
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual

    Predicted = tuple[RecordResidual, NoiseModel]
    """What the prediction of a record errs by, without derivatives, and its noise, the parameters' within."""


MOST_STEPS = 100
"""Of the search for parameters that describe a record jointly with the fitted ones: a valley is long."""


def predictions(base: BaseFit) -> tuple[tuple[RecordResidual, ...], tuple[NoiseModel, ...]]:
    """The records that were not fitted, and their noise: the uncertainty of the parameters is part of it.

    Nothing of such a record is refitted: its tangent is zero, and what the parameters do to it is propagated as the
    strain's noise is. So is a stress of unknown history with which it begins.
    """
    found = [
        _with_parameters_as_noise(base, record, _own_noise(base, index)) for index, record in enumerate(base.held_out)
    ]
    return tuple(record for record, _ in found), tuple(noise for _, noise in found)


def jointly(base: BaseFit, index: int) -> Predicted | None:
    """A record that was not fitted, linearised where it is described best jointly with those that were.

    The fitted records by themselves would take a Gauss-Newton step from there; what that leaves of this record is the
    prediction's error. None where the fitted records refute the parameters there, or the law cannot be solved with any.

    Parameters
    ----------
    base : BaseFit
    index : int
        Of the record among those that were held out.
    """
    record, noise = base.held_out[index], _own_noise(base, index)
    view = base.view(record.name)
    model = CampaignModel(base.law, [*base.model.views, view])
    both = Problem(model, Whitener((*base.whitened.noises, noise)))
    described: list[Refit] = []
    for start in (base.parameters, *base.other_starts):
        with suppress(*UNSOLVABLE):
            described.append(refit(both, start, most_steps=MOST_STEPS))
    if not described:
        return None
    found = min(described, key=lambda fit: fit.chi_square).parameters
    try:
        there = refit(base.problem, found, most_steps=0)
        left, tangent = CampaignModel(base.law, [view]).residual_and_jacobian(found)
    except UNSOLVABLE:
        return None
    worse = max(there.chi_square - base.refit.chi_square, 0.0)
    if chdtrc(max(len(found), 1), worse) < DETECTION.gap_level:
        return None
    predicted = replace(record, residual=left + tangent @ _step(there), tangent=tangent)
    return _with_parameters_as_noise(replace(base, refit=there), predicted, noise)


def _step(fit: Refit) -> FloatArray:
    """The Gauss-Newton step from there, shape (n_parameters,); none of a parameter that wants beyond its bound."""
    coordinates = fit.coordinates
    gradient = fit.jacobian.T @ fit.residual
    free = ~coordinates.bounds.pushed_out(coordinates.of(fit.parameters), gradient)
    step = np.zeros(len(free))
    step[free] = -np.linalg.pinv(fit.jacobian[:, free]) @ fit.residual
    return np.asarray(step * coordinates.slopes(fit.parameters))


def _with_parameters_as_noise(base: BaseFit, record: RecordResidual, noise: NoiseModel) -> Predicted:
    spread = record.tangent @ _root(base.covariance)
    nothing = np.zeros((len(record), spread.shape[1]))
    return replace(record, tangent=nothing), replace(noise, propagated=np.hstack([noise.propagated, spread]))


def _root(covariance: FloatArray) -> FloatArray:
    size, directions = np.linalg.eigh(covariance)
    return np.asarray(directions * np.sqrt(np.maximum(size, 0.0)))


def _own_noise(base: BaseFit, index: int) -> NoiseModel:
    """Of a record that was not fitted: without the parameters' errors."""
    noise = base.predicted_noises[index]
    return replace(noise, propagated=np.hstack([noise.propagated, _unknown_start(base, base.held_out[index])]))


def _unknown_start(base: BaseFit, record: RecordResidual) -> FloatArray:
    """What a record that begins far from zero may carry of a history that nobody knows, shape (n, 0 or 1) [MPa].

    The law takes its first sample as relaxed. As much as it begins with may relax as the law does.
    """
    view = base.view(record.name)
    if "initial_stress" not in base.law.capabilities or not is_far(record.time, view.data):
        return np.zeros((len(record), 0))
    start = Modification(initial_stress=InitialStress(float(view.data[0])))
    carried = base.law.stress(view, base.parameters, start) - base.law.stress(view, base.parameters)
    return view.sampled(carried)[:, None]
