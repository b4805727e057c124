"""How far the gap shrinks, on the records that causes were fitted to and on others."""

from __future__ import annotations

from math import isclose
from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.closure import Piece, closure_of
from probation.diagnosis.result import RecordCurves, Shrink
from probation.inference.model import CampaignModel
from probation.inference.on_all_records import on_all_records
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.outliers import without_outliers
from probation.noise.own_deviations import own_deviations
from probation.noise.smooth_basis import smooth_basis

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.detection.where import Located
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.skipped import Skipping
    from probation.inference.base_fit import BaseFit
    from probation.inference.on_all_records import OnAllRecords


def shrink_of(
    base: BaseFit,
    nearest: Hypothesis,
    located: Sequence[Located],
    skipping: Skipping,
    *,
    seed: int,
) -> tuple[Shrink, dict[str, RecordCurves]]:
    """Closure by role, record and region, and the curves behind it.

    Parameters
    ----------
    base : BaseFit
    nearest : Hypothesis
        The explanation, `Causes.nearest`; the base law where no effect is needed.
    located : sequence of Located
        Regions that are given their own closure.
    skipping : Skipping
        Takes note of records that the explanation cannot predict; they are left as the base law has them.
    seed : int
    """
    rng = np.random.default_rng(seed)
    everywhere = CampaignModel(base.law, base.views)
    before = everywhere.predict(base.before)
    causes = nearest.refit.model.causes
    after = _predicted(on_all_records(nearest.refit, base.views), before, skipping) if causes else before
    noises = {noise.name: noise for noise in base.whitened.noises} | {
        noise.name: noise for noise in base.held_out_noises
    }
    before, after = (_without_specimens(base, predicted) for predicted in (before, after))
    pieces = {
        view.id: Piece(
            without_outliers(before[view.id] - view.data, noises[view.id].outliers),
            without_outliers(after[view.id] - view.data, noises[view.id].outliers),
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
                        region=True,
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
        effects=nearest.effects,
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
            noise_MPa=noises[view.id].sigma,
            noise_given=isclose(noises[view.id].sigma, view.record.noise.stress_MPa or 0.0),
            strain_noise=view.excitation.strain_noise,
            strain_noise_given=view.record.noise.strain is not None,
        )
        for view in base.views
    }
    return shrink, curves


def _predicted(explained: OnAllRecords, before: dict[str, FloatArray], skipping: Skipping) -> dict[str, FloatArray]:
    """Predictions of an explanation by record; a record that it cannot be solved for keeps what it had."""
    model = explained.model
    base, causes = model.split(explained.parameters)
    predicted = dict(before)
    for view in model.views:
        try:
            predicted[view.id] = view.sampled(model.recorded(view, base, causes))
        except UNSOLVABLE as error:
            skipping.part(f"the explanation's prediction of {view.id}", error)
    return predicted


def _without_specimens(base: BaseFit, predicted: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Predictions by record [MPa] as they are once each specimen has its own deviations, no larger than scatter is."""
    data = {view.id: view.data for view in base.views}
    corrected = dict(predicted)
    for noises in (base.whitened.noises, base.held_out_noises):
        residuals = [without_outliers(predicted[noise.name] - data[noise.name], noise.outliers) for noise in noises]
        for noise, own in zip(noises, own_deviations(residuals, noises), strict=True):
            corrected[noise.name] = predicted[noise.name] - own
    return corrected


def _flexible(piece: Piece, base: BaseFit, name: str) -> Piece:
    """What any smooth curve would leave of a record, its own freedom paid for."""
    index = [record.name for record in base.whitened.records].index(name)
    record = base.whitened.records[index]
    root = np.sqrt(piece.noise.weight)
    columns: FloatArray = np.linalg.qr(root[:, None] * smooth_basis(record.time, record.jumps).columns)[0]
    left = piece.before - columns @ (columns.T @ (root * piece.before)) / root
    return Piece(piece.before, left * np.sqrt(len(left) / max(len(left) - columns.shape[1], 1)), piece.noise)
