"""How the recorded stress answers to the onset of every effect: what a score screen asks of the model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.effects.cause import Cause
from probation.inference.unsolvable import UNSOLVABLE
from probation.parallel import in_parallel

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect, Form
    from probation.effects.record_view import RecordView
    from probation.inference.model import CampaignModel

_Key: TypeAlias = tuple[str, str, tuple[float, ...]]


@dataclass(frozen=True, eq=False)
class Onset:
    """What is noted of how the recorded stress answers to the amplitude of one cause at one start.

    Attributes
    ----------
    cause : Cause
    values : tuple of float
        As in `Column`.
    records : tuple of str
        Where it acts.
    parts : sequence of ndarray
        Of each of these records.
    """

    cause: Cause
    values: tuple[float, ...]
    records: tuple[str, ...]
    parts: Sequence[FloatArray]


@dataclass(frozen=True, eq=False)
class Column:
    """How the recorded stress answers to the amplitude of one cause at one start of its nonlinear parameters.

    Attributes
    ----------
    cause : Cause
    values : tuple of float
        Of the cause's parameters; the amplitude is 0, or, for a threshold, that of the secant.
    rows : slice
        Which of the model's stacked samples it touches; elsewhere it is zero.
    slope : ndarray, shape (rows,)
        d stress / d amplitude [MPa per its unit].
    """

    cause: Cause
    values: tuple[float, ...]
    rows: slice
    slope: FloatArray


@dataclass(frozen=True, eq=False)
class Asked:
    """What a screen asks, on top of a model as it is.

    Attributes
    ----------
    model : CampaignModel
    parameters : ndarray, shape (n_parameters,)
        Of the model.
    effects : sequence of Effect
    noted : callable
        ``noted(index, slopes)``: a record's number and d stress / d amplitude along it [MPa per its unit], a column of
        (n, m) for each cause and start; returns (k, m). It is called where the record is worked on.
    residual : ndarray, shape (n_samples,) [MPa], optional
        Fit residual from which starts of the nonlinear parameters may be read; without it they come from a grid.
    unsolved : callable, optional
        Called with each cause that is left out because the law cannot be solved with it, and the error.
    only : callable, optional
        Which forms; all if left out.
    """

    model: CampaignModel
    parameters: FloatArray
    effects: Sequence[Effect]
    noted: Callable[[int, FloatArray], FloatArray]
    residual: FloatArray | None = None
    unsolved: Callable[[Cause, Exception], None] | None = None
    only: Callable[[Form], bool] | None = None


def screen(
    model: CampaignModel,
    parameters: FloatArray,
    effects: Sequence[Effect],
    *,
    residual: FloatArray | None = None,
    threads: int = 1,
    unsolved: Callable[[Cause, Exception], None] | None = None,
    only: Callable[[Form], bool] | None = None,
) -> list[Column]:
    """Columns of every effect, form, placement and start, on top of the model as it is; as `Asked` says.

    Returns
    -------
    list of Column
        In the order of the effects.
    """
    asked = Asked(model, parameters, effects, lambda _, slopes: slopes, residual=residual, unsolved=unsolved, only=only)
    [found] = onsets([asked], threads)
    everywhere = slice(0, len(model.data))
    return [
        Column(
            onset.cause,
            onset.values,
            model.rows(onset.records[0]) if onset.cause.records else everywhere,
            np.concatenate(onset.parts),
        )
        for onset in found
    ]


def onsets(asked: Sequence[Asked], threads: int = 1) -> list[list[Onset]]:
    """What is noted of every effect, form, placement and start, in the order of the effects, for each that is asked.

    Effects that the law cannot follow, alone or together with those of the model, are left out; see
    `CampaignModel.missing_capabilities` and `clashes`. So are forms that the records could not show, and those with
    which it cannot be solved. Records are worked on in parallel.
    """
    screens = [_Screen.of(each) for each in asked]
    parts = [(each, index) for each in screens for index in range(len(each.asked.model.views))]
    answers = iter(in_parallel(lambda part: part[0].answers(part[1]), parts, threads))
    return [each.found([next(answers) for _ in each.asked.model.views]) for each in screens]


@dataclass(frozen=True, eq=False)
class _Screen:
    """What is wanted of every record, and the causes that it cannot be had of.

    Attributes
    ----------
    asked : Asked
    wanted : list of (Cause, tuple of float, tuple of RecordView)
        Causes, where they begin, and the records that they act in.
    failed : list of (Cause, Exception)
    """

    asked: Asked
    wanted: list[tuple[Cause, tuple[float, ...], tuple[RecordView, ...]]]
    failed: list[tuple[Cause, Exception]]

    @classmethod
    def of(cls, asked: Asked) -> _Screen:
        model = asked.model
        wanted: list[tuple[Cause, tuple[float, ...], tuple[RecordView, ...]]] = []
        failed: list[tuple[Cause, Exception]] = []
        for effect in asked.effects:
            for form in effect.forms:
                if asked.only is not None and not asked.only(form):
                    continue
                cause = Cause(effect, form)
                try:
                    if not form.visible_in(model.views) or model.missing_capabilities(cause) or model.clashes(cause):
                        continue
                    wanted += [
                        (Cause(effect, form, records), values, views)
                        for records, views in _placed(model, effect, form)
                        for values in _starts(model, form, views, asked.residual)
                    ]
                except UNSOLVABLE as error:
                    failed.append((cause, error))
        return cls(asked, wanted, failed)

    def answers(self, index: int) -> dict[_Key, FloatArray | Exception]:
        """What is noted of one record; a form at one start is worked out once, wherever it is placed."""
        model = self.asked.model
        view, (base, active) = model.views[index], model.split(self.asked.parameters)
        specimen, still = model.at_rest(view, base, active)
        slopes: dict[_Key, FloatArray] = {}
        errors: dict[_Key, FloatArray | Exception] = {}
        for cause, values, views in self.wanted:
            key = _key(cause, values)
            if view not in views or key in slopes or key in errors:
                continue
            form = cause.form
            size = values[0] if form.threshold else form.amplitude.step(0.0)
            try:
                stress = model.with_one_more(view, base, active, cause, (size, *values[1:]), specimen)
                slopes[key] = view.sampled((stress - still) / size)
            except UNSOLVABLE as error:
                errors[key] = error
        if not slopes:
            return errors
        noted = self.asked.noted(index, np.column_stack(list(slopes.values())))
        return errors | dict(zip(slopes, noted.T, strict=True))

    def found(self, answers: Sequence[dict[_Key, FloatArray | Exception]]) -> list[Onset]:
        """The answers of all records, put together."""
        answers_of = dict(zip(self.asked.model.views, answers, strict=True))
        failed, found = list(self.failed), []
        for cause, values, views in self.wanted:
            parts: list[FloatArray] = []
            for view in views:
                part = answers_of[view][_key(cause, values)]
                if isinstance(part, Exception):
                    failed.append((cause, part))
                    break
                parts.append(part)
            else:
                found.append(Onset(cause, values, tuple(view.id for view in views), parts))
        if self.asked.unsolved is not None:
            for cause, why in failed:
                self.asked.unsolved(cause, why)
        return found


def _key(cause: Cause, values: tuple[float, ...]) -> _Key:
    return cause.effect.name, cause.form.name, values


def _placed(
    model: CampaignModel, effect: Effect, form: Form
) -> list[tuple[tuple[str, ...] | None, tuple[RecordView, ...]]]:
    """Where a form may sit: records (None for all), and their views.

    With one record "one" is left out: it would repeat "all", unless a form sits nowhere else.
    """
    possible = effect.placements(form)
    placed: list[tuple[tuple[str, ...] | None, tuple[RecordView, ...]]] = []
    if "all" in possible:
        placed.append((None, model.views))
    if "one" in possible and (len(model.views) > 1 or "all" not in possible):
        placed += [((view.id,), (view,)) for view in model.views]
    return placed


def _starts(
    model: CampaignModel, form: Form, views: tuple[RecordView, ...], residual: FloatArray | None
) -> list[tuple[float, ...]]:
    """Values where the columns are taken: amplitude 0 (or a threshold's own), and the nonlinear parameters."""
    residuals = None if residual is None else [residual[model.rows(view.id)] for view in views]
    starts = form.nonlinear_starts(views, residuals)
    return starts if form.threshold else [(0.0, *start) for start in starts]
