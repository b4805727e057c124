"""Records as the model has them, for questions that are asked before anything is fitted."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.gap.arma import Arma
from probation.gap.model import CampaignModel
from probation.gap.noise_model import NoiseModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.gap.record_view import RecordView


def as_predicted(model: CampaignModel, parameters: FloatArray) -> CampaignModel:
    """The same model whose data are its own predictions, without noise and without a gap."""
    base, causes = model.split(parameters)
    views = []
    for view in model.views:
        stress = model.recorded(view, base, causes)
        views.append(replace(view.with_data(view.sampled(stress)), quiet_stress=stress))
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


def noise_like(view: RecordView, arma: Arma) -> NoiseModel:
    """Stationary noise along a record."""
    count = len(view.data)
    return NoiseModel(
        name=view.id,
        arma=arma,
        profile=np.ones(count),
        growth="constant",
        sigma=arma.deviation,
        white=arma.innovation,
        quantum=0.0,
        carried=np.zeros((count, 0)),
        level_variance=0.0,
        shape_variance=0.0,
        spikes=(),
        source="as given",
    )
