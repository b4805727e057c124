"""How the recorded stress answers to the onset of every effect: what a score screen asks of the model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.effects.cause import Cause
from probation.inference.unsolvable import UNSOLVABLE
from probation.parallel import in_parallel

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect, Form
    from probation.effects.record_view import RecordView
    from probation.inference.model import CampaignModel

_Key: TypeAlias = tuple[str, str, tuple[float, ...]]


Wanted: TypeAlias = "tuple[Cause, tuple[float, ...]]"
"""A cause, and the values of its parameters where it begins."""

Answers: TypeAlias = "dict[_Key, FloatArray | Exception]"
"""What is noted of one record, by cause and start; why, where the law cannot be solved."""


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
    """Columns of every effect, form, placement and start, on top of the model as it is; records are worked on at once.

    Parameters
    ----------
    model, effects, residual, unsolved, only
        As in `Screen.of`.
    parameters : ndarray, shape (n_parameters,)
        Of the model.
    threads : int

    Returns
    -------
    list of Column
        In the order of the effects.
    """
    asked = Screen.of(model, effects, residual=residual, unsolved=unsolved, only=only)
    answers = in_parallel(
        lambda index: answers_of_record(model, parameters, index, asked.wanted_of(index), lambda slopes: slopes),
        range(len(model.views)),
        threads,
    )
    everywhere = slice(0, len(model.data))
    return [
        Column(
            onset.cause,
            onset.values,
            model.rows(onset.records[0]) if onset.cause.records else everywhere,
            np.concatenate(onset.parts),
        )
        for onset in asked.found(answers)
    ]


def answers_of_record(
    model: CampaignModel,
    parameters: FloatArray,
    index: int,
    wanted: Sequence[Wanted],
    noted: Callable[[FloatArray], FloatArray],
) -> Answers:
    """What is noted of one record.

    Parameters
    ----------
    model : CampaignModel
    parameters : ndarray, shape (n_parameters,)
    index : int
        Of the record.
    wanted : sequence of (Cause, tuple of float)
    noted : callable
        Of d stress / d amplitude along the record [MPa per its unit], a column of (n, m) for each that is wanted;
        returns (k, m).
    """
    if not wanted:
        return {}
    view, (base, active) = model.views[index], model.split(parameters)
    specimen, still = model.at_rest(view, base, active)
    slopes: dict[_Key, FloatArray] = {}
    errors: Answers = {}
    for cause, values in wanted:
        form = cause.form
        size = values[0] if form.threshold else form.amplitude.step(0.0)
        try:
            stress = model.with_one_more(view, base, active, cause, (size, *values[1:]), specimen)
            slopes[_key(cause, values)] = view.sampled((stress - still) / size)
        except UNSOLVABLE as error:
            errors[_key(cause, values)] = error
    if not slopes:
        return errors
    return errors | dict(zip(slopes, noted(np.column_stack(list(slopes.values()))).T, strict=True))


@dataclass(frozen=True, eq=False)
class Screen:
    """What is wanted of every record, and the causes that it cannot be had of.

    Attributes
    ----------
    views : tuple of RecordView
    wanted : list of (Cause, tuple of float, tuple of RecordView)
        Causes, where they begin, and the records that they act in.
    failed : list of (Cause, Exception)
    unsolved : callable, optional
    """

    views: tuple[RecordView, ...]
    wanted: list[tuple[Cause, tuple[float, ...], tuple[RecordView, ...]]]
    failed: list[tuple[Cause, Exception]]
    unsolved: Callable[[Cause, Exception], None] | None

    @classmethod
    def of(
        cls,
        model: CampaignModel,
        effects: Sequence[Effect],
        *,
        residual: FloatArray | None = None,
        unsolved: Callable[[Cause, Exception], None] | None = None,
        only: Callable[[Form], bool] | None = None,
    ) -> Screen:
        """Every effect, form, placement and start, on top of a model as it is.

        Effects that the law cannot follow, alone or together with those of the model, are left out; see
        `CampaignModel.missing_capabilities` and `clashes`. So are forms that the records could not show.

        Parameters
        ----------
        model : CampaignModel
        effects : sequence of Effect
        residual : ndarray, shape (n_samples,) [MPa], optional
            Fit residual from which starts of the nonlinear parameters may be read; without it they come from a grid.
        unsolved : callable, optional
            Called with each cause that is left out because the law cannot be solved with it, and the error.
        only : callable, optional
            Which forms; all if left out.
        """
        wanted: list[tuple[Cause, tuple[float, ...], tuple[RecordView, ...]]] = []
        failed: list[tuple[Cause, Exception]] = []
        for effect in effects:
            for form in effect.forms:
                if only is not None and not only(form):
                    continue
                cause = Cause(effect, form)
                try:
                    if not form.visible_in(model.views) or model.missing_capabilities(cause) or model.clashes(cause):
                        continue
                    wanted += [
                        (Cause(effect, form, records), values, views)
                        for records, views in _placed(model, effect, form)
                        for values in _starts(model, form, views, residual)
                    ]
                except UNSOLVABLE as error:
                    failed.append((cause, error))
        return cls(model.views, wanted, failed, unsolved)

    def wanted_of(self, index: int) -> list[Wanted]:
        """What is wanted of one record; a form at one start is worked out once, wherever it is placed."""
        view = self.views[index]
        wanted: dict[_Key, Wanted] = {}
        for cause, values, views in self.wanted:
            if view in views:
                wanted.setdefault(_key(cause, values), (cause, values))
        return list(wanted.values())

    def found(self, answers: Sequence[Mapping[_Key, FloatArray | Exception]]) -> list[Onset]:
        """The answers of all records, put together, in the order of the effects."""
        answers_of = dict(zip(self.views, answers, strict=True))
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
        if self.unsolved is not None:
            for cause, why in failed:
                self.unsolved(cause, why)
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
