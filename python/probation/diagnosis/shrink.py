"""How far the gap shrinks with the best explanation, on the records it was found on and on others."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.closure import Piece, closure_of
from probation.diagnosis.result import RecordCurves, Shrink
from probation.inference.model import CampaignModel
from probation.inference.unsolvable import UNSOLVABLE
from probation.inference.view_residual import residual_of
from probation.noise.estimate import estimate_noise
from probation.noise.smooth_basis import smooth_basis
from probation.noise.spikes import without_spikes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.detection.where import Located
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.skipped import Skipping
    from probation.inference.base_fit import BaseFit
    from probation.noise.model import NoiseModel
    from probation.records.campaign import Campaign


def shrink_of(
    base: BaseFit,
    best: Hypothesis,
    campaign: Campaign,
    located: Sequence[Located],
    skipping: Skipping,
    *,
    seed: int,
) -> tuple[Shrink, dict[str, RecordCurves]]:
    """Closure by role, record and region, and the curves behind it.

    Parameters
    ----------
    base : BaseFit
    best : Hypothesis
        The explanation; the base law where no effect is needed.
    campaign : Campaign
    located : sequence of Located
        Regions that are given their own closure.
    skipping : Skipping
        Takes note of records that the explanation cannot predict; they are left as the base law has them.
    seed : int
    """
    rng = np.random.default_rng(seed)
    everywhere = CampaignModel(base.law, base.views)
    before = everywhere.predict(base.parameters)
    causes = best.refit.model.causes
    after = _predicted(everywhere.with_causes(causes), best.refit.parameters, before, skipping) if causes else before
    noises = {noise.name: noise for noise in base.whitened.noises} | _noise_of_others(base, everywhere, campaign)
    pieces = {
        view.id: Piece(
            without_spikes(before[view.id] - view.data, noises[view.id].spikes),
            without_spikes(after[view.id] - view.data, noises[view.id].spikes),
            noises[view.id],
        )
        for view in base.views
    }
    fitted = [view.id for view in base.views if view.role == "identify"]
    others = [view.id for view in base.views if view.role != "identify"]
    regions = tuple(
        (
            place,
            closure_of(
                [
                    Piece(
                        pieces[place.record].before[place.samples],
                        pieces[place.record].after[place.samples],
                        noises[place.record],
                        place.samples,
                    )
                ],
                rng,
            ),
        )
        for place in located
    )
    shrink = Shrink(
        identify=closure_of([pieces[name] for name in fitted], rng),
        held_out=closure_of([pieces[name] for name in others], rng) if others else None,
        records={name: closure_of([piece], rng) for name, piece in pieces.items()},
        regions=regions,
        ceiling=closure_of([_flexible(pieces[name], base, name) for name in fitted], rng),
    )
    curves = {
        view.id: RecordCurves(
            id=view.id,
            role=view.role,
            time=view.sampled(view.time),
            true_strain=view.sampled(view.true_strain),
            strain_rate=view.sampled(view.rate),
            data=view.data,
            base=before[view.id],
            explained=after[view.id] if causes else None,
            noise=noises[view.id].deviation,
        )
        for view in base.views
    }
    return shrink, curves


def _predicted(
    model: CampaignModel, parameters: FloatArray, before: dict[str, FloatArray], skipping: Skipping
) -> dict[str, FloatArray]:
    """Predictions of an explanation by record; a record that it cannot be solved for keeps what it had."""
    base, causes = model.split(parameters)
    found = dict(before)
    for view in model.views:
        try:
            found[view.id] = view.sampled(model.recorded(view, base, causes))
        except UNSOLVABLE as error:
            skipping.part(f"the best explanation's prediction of {view.id}", error)
    return found


def _noise_of_others(base: BaseFit, everywhere: CampaignModel, campaign: Campaign) -> dict[str, NoiseModel]:
    """The noise of records that were not fitted, by what is rougher than any law's error."""
    if len(base.views) == len(base.model.views):
        return {}
    raw, jacobian = everywhere.residual_and_jacobian(base.parameters)
    known = {record.id: record for record in campaign.records}
    residuals = [
        residual_of(view, raw[part], jacobian[part], given_noise=known[view.id].noise.stress_MPa)
        for view, part in everywhere.parts
        if view.role != "identify"
    ]
    return {noise.name: noise for noise in estimate_noise(residuals)}


def _flexible(piece: Piece, base: BaseFit, name: str) -> Piece:
    """What any smooth curve would leave of a record, its own freedom paid for."""
    index = [record.name for record in base.whitened.records].index(name)
    record = base.whitened.records[index]
    columns: FloatArray = np.linalg.qr(smooth_basis(record.time, record.jumps).columns)[0]
    left = piece.before - columns @ (columns.T @ piece.before)
    return Piece(piece.before, left * np.sqrt(len(left) / max(len(left) - columns.shape[1], 1)), piece.noise)
