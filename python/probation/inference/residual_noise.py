"""The noise of the records of a problem, from what a law leaves of them: the diagnosis' estimate, where it is noise."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.record_noise import RecordNoise
from probation.noise.arma import Arma
from probation.noise.estimate import estimate_noise
from probation.noise.model import NoiseModel
from probation.noise.outliers import without_outliers
from probation.noise.record_residual import RecordResidual
from probation.noise.white_level import white_level
from probation.noise.whiteness import is_white

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem
    from probation.inference.strain_noise import StrainNoise
    from probation.law.modal import Law

SHORTEST = 30
"""Samples of a record below which its stress noise is taken as white."""


def residual_noises(problem: Problem, law: Law, strain: Sequence[StrainNoise | None]) -> list[RecordNoise]:
    """Every record's noise: that of its stress from its residual at a law, that of its strain as it is known.

    The estimate is `noise.estimate_noise`, as in a diagnosis. It is kept where the residual is white by it; else a bias
    hides the noise, and stress noise is white, of the size that the residual has beside the strain's. The noise of a
    strain taken as measured is as rough as that of the stress: the residual tells the size of both together.

    Parameters
    ----------
    problem : Problem
    law : Law
        The best one, or close to it.
    strain : sequence of StrainNoise or None
        Per record; None where its noise does not matter.
    """
    residuals = [
        _residual(problem, index, law, None if own is None else own.carried(law)) for index, own in enumerate(strain)
    ]
    smooth = [index for index, own in enumerate(strain) if own is None or own.strain is not None]
    smooth = [index for index in smooth if len(residuals[index]) >= SHORTEST]
    estimated = dict(zip(smooth, estimate_noise([residuals[index] for index in smooth]), strict=True))
    found = []
    for index, (each, own) in enumerate(zip(residuals, strain, strict=True)):
        known = problem.records[index].noise
        if own is not None and own.strain is None:
            left = _white(each, known).with_carried(each.carried).whiten(each.residual)
            factor = float(np.sqrt(left @ left / max(len(left) - each.tangent.shape[1], 1)))
            found.append(RecordNoise(_white(each, factor * known), replace(own, deviation=factor * own.deviation)))
            continue
        model = estimated.get(index)
        if model is None or not is_white(model.whiten(without_outliers(each.residual, model.outliers))):
            level = white_level(each.residual, each.tangent, each.carried, known)
            model = _white(each, max(level, each.given_noise or 0.0))
        found.append(RecordNoise(model.with_carried(None), own))
    return found


def _white(each: RecordResidual, level: float) -> NoiseModel:
    return NoiseModel.stationary(each.name, Arma(innovation=max(level, 1e-12)), len(each))


def _residual(problem: Problem, index: int, law: Law, carried: FloatArray | None) -> RecordResidual:
    each = problem.records[index]
    stress, sensitivity = each.sensitivity(law)
    drive = each.excitation
    return RecordResidual(
        name=each.record.id,
        time=each.record.time,
        true_strain=drive.true_strain,
        strain_rate=drive.rate,
        residual=stress - each.record.true_stress,
        tangent=sensitivity[:, problem.free],
        jumps=drive.jumps,
        measured=each.record.true_stress,
        given_noise=each.record.noise.stress_MPa,
        carried=carried,
    )
