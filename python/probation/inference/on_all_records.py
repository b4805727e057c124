"""An explanation on all records of a campaign: also on those that were held out, where it was not sought."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.model import CampaignModel

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.effects.effect import EffectParameter
    from probation.effects.record_view import RecordView
    from probation.inference.refit import Refit


@dataclass(frozen=True, eq=False)
class OnAllRecords:
    """A model of all records with an explanation, and its parameters.

    What acts in every fitted record, each time with a size of its own, acts in the others, too: with the mean of its
    parameters, in the form that it has in most of them. What acts in some of several fitted records is theirs alone;
    so is what has an instant or a phase of its own in each.

    Attributes
    ----------
    model : CampaignModel
    parameters : ndarray, shape (n_parameters,)
    from_fitted : ndarray, shape (n_parameters, n_fitted_parameters)
        These parameters over those of the refit.
    spread : ndarray, shape (n_parameters,)
        Standard deviation by which a record's own parameter differs from the mean of the fitted ones'.
    silent : bool
        Whether an effect acts in every fitted record and says nothing of the others.
    """

    model: CampaignModel
    parameters: FloatArray
    from_fitted: FloatArray
    spread: FloatArray
    silent: bool


def on_all_records(found: Refit, views: Sequence[RecordView]) -> OnAllRecords:
    """An explanation on all records.

    Parameters
    ----------
    found : Refit
    views : sequence of RecordView
        Those that were fitted and those that were held out.
    """
    fitted = {view.id for view in found.model.views}
    others = tuple(view.id for view in views if view.id not in fitted)
    causes, rows = list(found.model.causes), [np.eye(len(found.parameters))]
    spread, silent = [np.zeros(len(found.parameters))], False
    for own in _in_each(causes, fitted) if others and len(fitted) > 1 else ():
        usual = Counter(cause.form.name for cause in own).most_common(1)[0][0]
        alike = [cause for cause in own if cause.form.name == usual]
        if any(_of_its_record(parameter) for parameter in alike[0].form.parameters):
            silent = True
            continue
        causes.append(replace(alike[0], records=others))
        sizes = np.array([own for cause, own in found.model.split(found.parameters)[1] if cause in alike])
        spread.append(np.std(sizes, axis=0) * np.sqrt((len(alike) + 1.0) / max(len(alike) - 1.0, 1.0)))
        rows.append(_mean_of(alike, found))
    from_fitted = np.vstack(rows)
    model = CampaignModel(found.model.law, views, causes)
    return OnAllRecords(model, from_fitted @ found.parameters, from_fitted, np.concatenate(spread), silent)


def _of_its_record(parameter: EffectParameter) -> bool:
    """Whether a parameter may be anything in each record: a phase, an instant."""
    return parameter.period > 0.0 or not np.isfinite(parameter.scale)


def _in_each(causes: Iterable[Cause], fitted: set[str]) -> list[list[Cause]]:
    """The causes of every effect that acts in each of the fitted records apart."""
    apart: dict[str, list[Cause]] = {}
    for cause in causes:
        if cause.records is not None:
            apart.setdefault(cause.effect.name, []).append(cause)
    return [own for own in apart.values() if {record for cause in own for record in cause.records or ()} == fitted]


def _mean_of(alike: Sequence[Cause], fit: Refit) -> FloatArray:
    """The mean of the parameters of causes of one form, over those of a refit; shape (n_of_the_form, n_parameters)."""
    count = len(alike[0].form.parameters)
    rows = np.zeros((count, len(fit.parameters)))
    first = fit.model.base_count
    for cause in fit.model.causes:
        if cause in alike:
            rows[:, first : first + count] += np.eye(count) / len(alike)
        first += len(cause.form.parameters)
    return rows
