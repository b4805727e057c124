"""Records as the model has them, for questions that are asked before anything is fitted."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.record_view import RecordView
from probation.errors import InputError
from probation.inference.model import CampaignModel
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


def as_predicted(model: CampaignModel, parameters: FloatArray) -> CampaignModel:
    """The same model whose data are its own predictions, without noise and without a gap."""
    base, causes = model.split(parameters)
    views = []
    for view in model.views:
        stress = model.recorded(view, base, causes)
        views.append(view.as_predicted(stress))
    return CampaignModel(model.law, views, model.causes)


def white_noise(views: Sequence[RecordView], deviation: float | Sequence[float]) -> tuple[NoiseModel, ...]:
    """White stress noise of known size, for planned records or where nothing is measured yet.

    Parameters
    ----------
    views : sequence of RecordView
    deviation : float or sequence of float [MPa]
        Standard deviation, one for all records or one each.

    Raises
    ------
    InputError
        For another number of deviations than records, or one that is not positive.
    """
    sizes = [float(size) for size in np.atleast_1d(np.asarray(deviation, dtype=np.float64))]
    sizes = sizes * len(views) if len(sizes) == 1 else sizes
    if len(sizes) != len(views):
        raise InputError(f"deviation: found {len(sizes)} numbers, expected one or {len(views)}, one per record")
    for size in sizes:
        if not 0.0 < size < np.inf:
            raise InputError(f"deviation: found {size} MPa, expected a positive number")
    return tuple(noise_like(view, Arma(innovation=size)) for view, size in zip(views, sizes, strict=True))


def planned_view(
    name: str, time: FloatArray, true_strain: FloatArray, jumps: Sequence[int], others: Sequence[RecordView]
) -> RecordView:
    """The view of a test that is yet to be done, after the others and with their reference rate; its stress is 0.

    Parameters
    ----------
    name : str
        Its id.
    time, true_strain : ndarray, shape (n_samples,) [s], [-]
    jumps : sequence of int
        Samples at which the rate is discontinuous.
    others : sequence of RecordView
        The records there are.
    """
    last = others[-1]
    return RecordView(
        id=name,
        control="strain-rate",
        role="identify",
        time=time,
        true_strain=true_strain,
        recorded_strain=true_strain,
        strain_rate=None,
        jumps=tuple(jumps),
        direction=np.sign(np.diff(true_strain)),
        data=np.zeros(len(time)),
        stride=1,
        scheme=last.scheme,
        temperature=None,
        index=last.count,
        count=last.count,
        reference_rate=last.reference_rate,
    )


def planned_noise(view: RecordView, noises: Sequence[NoiseModel], others: Sequence[RecordView]) -> NoiseModel:
    """The noise to expect in a planned test: that of the record whose level is the middle one, without its bursts.

    Where it grows with the stretch it does so here; its correlation is taken over from sample to sample.
    """
    level = [float(np.median(noise.long_run)) for noise in noises]
    at = int(np.argsort(level)[len(level) // 2])
    usual = noises[at]
    if usual.growth != "force":
        return noise_like(view, usual.arma)
    stretch, known = view.sampled(view.stretch), others[at].sampled(others[at].stretch)
    size, normal = (float(np.sqrt(np.mean(column**2))) for column in (stretch, known))
    arma = replace(usual.arma, innovation=usual.arma.innovation * size / normal)
    return replace(noise_like(view, arma), profile=stretch / size, growth="force")


def noise_like(view: RecordView, arma: Arma) -> NoiseModel:
    """Stationary noise along a record."""
    return NoiseModel.stationary(view.id, arma, len(view.data))
