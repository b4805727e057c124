"""The noise of the records of a problem, from what a law leaves of them: the diagnosis' estimate, where it is noise."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.view_residual import residual_of
from probation.noise.arma import Arma
from probation.noise.estimate import estimate_noise
from probation.noise.model import NoiseModel
from probation.noise.outliers import without_outliers
from probation.noise.white_level import white_level
from probation.noise.whiteness import is_white
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem
    from probation.inference.strain_noise import StrainNoise
    from probation.noise.record_residual import RecordResidual


def with_residual_noise(problem: Problem, parameters: FloatArray, strain: Sequence[StrainNoise | None]) -> Problem:
    """The problem with every record's noise: that of its stress from its residual, that of its strain as it is known.

    The estimate is `noise.estimate_noise`, as in a diagnosis. It is kept where the residual is white by it; else a bias
    hides the noise, and stress noise is white, of the size that the residual has besides the strain's. The noise of a
    strain taken as measured is as rough as that of the stress: the residual tells the size of both together.

    Parameters
    ----------
    problem : Problem
    parameters : ndarray, shape (n_parameters,)
        The best ones, or close to them.
    strain : sequence of StrainNoise or None
        Per record; None where its noise does not matter.
    """
    raw, jacobian = problem.model.residual_and_jacobian(parameters)
    residuals = [
        residual_of(
            view,
            raw[rows],
            jacobian[rows],
            given_noise=view.record.noise.stress_MPa,
            propagated=None if own is None else own.propagated(problem.law_at(parameters)),
        )
        for (view, rows), own in zip(problem.model.parts, strain, strict=True)
    ]
    smooth = [index for index, own in enumerate(strain) if own is None or own.strain is not None]
    smooth = [index for index in smooth if len(residuals[index]) >= NOISE.fewest_for_correlation]
    estimated = dict(zip(smooth, estimate_noise([residuals[index] for index in smooth]), strict=True))
    noises, strains = [], list(strain)
    for index, (record, own) in enumerate(zip(residuals, strain, strict=True)):
        known = problem.views[index].stress_noise
        if own is not None and own.strain is None:
            left = _white(record, known).with_propagated(record.propagated).whiten(record.residual)
            factor = float(np.sqrt(left @ left / max(len(left) - record.tangent.shape[1], 1)))
            noises.append(_white(record, factor * known))
            strains[index] = replace(own, deviation=factor * own.deviation)
            continue
        model = estimated.get(index)
        if model is None or not is_white(model.whiten(without_outliers(record.residual, model.outliers))):
            level = white_level(record.residual, record.tangent, record.propagated, known)
            model = _white(record, max(level, record.given_noise or 0.0))
        noises.append(model.with_propagated(None))
    return problem.with_noises(noises, strains)


def _white(record: RecordResidual, level: float) -> NoiseModel:
    return NoiseModel.stationary(record.name, Arma(innovation=max(level, 1e-12)), len(record))
