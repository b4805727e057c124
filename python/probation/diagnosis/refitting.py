"""Screens and refits of sets of causes on one base fit, and what the data say of each; several at once."""

from __future__ import annotations

from collections import ChainMap
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, cast

import numpy as np

from probation.diagnosis.budget import Budget
from probation.effects.cause import Cause
from probation.inference.base_fit import misfits, specimens_hold_the_gap
from probation.inference.candidate import cause_key, noted
from probation.inference.evidence import Evidence, evidence
from probation.inference.form_error import form_freedom
from probation.inference.refit import Ended, Refit, reached, refit
from probation.inference.remembering import RememberingModel
from probation.inference.screen import answers_of_record
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.own_deviations import furthest_specimen, specimens_within
from probation.parallel import Copies
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect
    from probation.inference.base_fit import BaseFit
    from probation.inference.candidate import Candidate, Extended, Key
    from probation.inference.model import CampaignModel
    from probation.inference.problem import Problem
    from probation.inference.screen import Answers

    Job: TypeAlias = "tuple[CampaignModel, FloatArray | Refit]"
    """A model, and where its refit begins."""


_PARTS = 2
"""In which what is wanted of a record is worked out: of three records two processes would have two and one."""


class _Begun(NamedTuple):
    """Causes to be refitted, as data: another process knows them by their names."""

    keys: tuple[Key, ...]
    start: FloatArray | Ended
    steps: int
    budget: Budget


class _Found(NamedTuple):
    """A refit to be weighed, as data."""

    keys: tuple[Key, ...]
    ended: Ended
    unknown: bool


class _Screened(NamedTuple):
    """Some of the causes to be added to a model, as one record shows them, as data."""

    keys: tuple[Key, ...]
    parameters: FloatArray
    record: int
    wanted: tuple[tuple[Key, tuple[float, ...]], ...]
    directions: FloatArray


class Refitting:
    """Works out screens, refits and evidences on one base fit, in copies of this process until it is closed.

    Parameters
    ----------
    base : BaseFit
    effects : sequence of Effect
        Of all causes.
    threads : int
    """

    def __init__(self, base: BaseFit, effects: Sequence[Effect], threads: int) -> None:
        self.base = base
        self._effects = {effect.name: effect for effect in effects}
        self._copies: Copies[_Begun | _Found | _Screened, Ended | Evidence | Answers | str] = Copies(
            self._done, threads
        )

    def close(self) -> None:
        """End the copies."""
        self._copies.close()

    def refits(
        self,
        jobs: Sequence[Job],
        steps: int,
        budget: Budget,
        *,
        always_one: bool = False,
        progress: Callable[[float], None] | None = None,
    ) -> list[Refit | str]:
        """Refits from models and starts, of at most so many steps; why, where there is none.

        Parameters
        ----------
        jobs : sequence of (CampaignModel, ndarray or Refit)
        steps : int
        budget : Budget
            Once it is spent, nothing is refitted.
        always_one : bool
            But the first one.
        progress : callable, optional
            Called with the part that is done.
        """
        begun = [
            _Begun(
                _keys_of(model),
                start.ended if isinstance(start, Refit) else start,
                steps,
                Budget() if always_one and at == 0 else budget,
            )
            for at, (model, start) in enumerate(jobs)
        ]
        ended = self._copies.results(begun, progress)
        return [
            Refit.of(self.base.problem.with_model(model), one) if isinstance(one, Ended) else str(one)
            for (model, _), one in zip(jobs, ended, strict=True)
        ]

    def candidates(self, extended: Sequence[Extended]) -> list[list[Candidate]]:
        """What may be added to each model, best first; all records of all models, in parts, side by side."""
        screens = [each.screen() for each in extended]
        asked = [
            _Screened(
                _keys_of(each.model),
                each.parameters,
                index,
                tuple((cause_key(cause), values) for cause, values in screen.wanted_of(index)[first::_PARTS]),
                each.directions[rows],
            )
            for each, screen in zip(extended, screens, strict=True)
            for index, rows in enumerate(self.base.whitener.slices)
            for first in range(_PARTS)
        ]
        answers = iter(self._copies.results(asked))
        found: list[list[Candidate]] = []
        for each, screen in zip(extended, screens, strict=True):
            by_record = [ChainMap(*(cast("Answers", next(answers)) for _ in range(_PARTS))) for _ in screen.views]
            found.append(each.candidates(screen.found(by_record)))
        return found

    def evidences(self, fits: Sequence[Refit], *, unknown: bool = False) -> list[Evidence | str]:
        """The evidence of each refit, jointly with an unknown effect, too, where that is asked for; why, if none."""
        found = [_Found(_keys_of(fit.model), fit.ended, unknown) for fit in fits]
        return [one if isinstance(one, Evidence) else str(one) for one in self._copies.results(found)]

    def evidence(self, fit: Refit, *, unknown: bool = False) -> Evidence:
        """The evidence of one, worked out here."""
        forms = form_freedom(fit, self.base.whitener)
        return evidence(fit, self.base.refit, self.base.discrepancy, forms=forms, unknown=unknown)

    def _done(self, task: _Begun | _Found | _Screened) -> Ended | Evidence | Answers | str:
        model = self.base.model.with_causes(self._cause(*key) for key in task.keys)
        if isinstance(task, _Screened):
            wanted = [(self._cause(*key), values) for key, values in task.wanted]
            note = partial(noted, self.base.whitener, task.record, task.directions)
            return answers_of_record(model, task.parameters, task.record, wanted, note)
        problem = self.base.problem.with_model(model)
        try:
            if isinstance(task, _Found):
                return self.evidence(Refit.of(problem, task.ended), unknown=task.unknown)
            if task.budget.spent():
                return task.budget.why
            start = Refit.of(problem, task.start) if isinstance(task.start, Ended) else task.start
            return self.refit(model, start, task.steps).ended
        except UNSOLVABLE as error:
            return str(error)

    def _cause(self, name: str, form: str, records: tuple[str, ...] | None) -> Cause:
        effect = self._effects[name]
        return Cause(effect, effect.form(form), records)

    def refit(self, model: CampaignModel, start: FloatArray | Refit, steps: int) -> Refit:
        """From one start; where specimens differ, not to where their deviations have to hold a gap.

        With a weak gap a refit from the start is taken, unless a specimen deviates unusually and holds the gap. So it
        is with a strong gap, if the slopes at the start promise that no specimen will deviate unusually, none does, and
        no more is left than without an effect. Else deviations of many standard deviations cost little, and the misfit
        counts only along what they do not explain. So specimens that are alike come first there. Where one of them is
        then far from what is usual, that is the end; else the refit goes on from there, unless its next steps leave
        more and a specimen still deviates unusually. A search that explains less than no effect does goes on, too: a
        fault in one record pulls the law of specimens that are alike. Not where its effect changes nothing there.
        """
        problem = self.base.problem.with_model(RememberingModel(model))
        if isinstance(start, Refit):
            start = replace(start, problem=problem)
        if not self.base.scatter.any or steps == 0:
            return refit(problem, start, most_steps=steps)
        try:
            return self._refit(problem, start, steps)
        except UNSOLVABLE:  # perhaps where it went on without derivatives; then it takes twice the time
            return self._refit(problem, start, steps, differentiable=True)

    def _refit(self, problem: Problem, start: FloatArray | Refit, steps: int, *, differentiable: bool = False) -> Refit:
        model, noises = problem.model, self.base.alike.noises
        first = start.parameters if isinstance(start, Refit) else start
        with np.errstate(over="ignore"):  # a misfit too large for a number is infinite
            white, slopes = problem.residual_and_jacobian(first)
            misfit = float(np.sum(white**2))
        weak = misfit <= len(self.base.whitened) + SEARCH.strong_gap
        promised = not weak and self._promises_usual(problem, first, white, slopes)
        if weak or promised:
            fit = refit(problem, start, most_steps=steps)
            if self._may_be(fit, first) if weak else self._usual(fit) and self._explains(fit):
                return fit
        only_alike = problem.with_noises(noises)
        alike = reached(only_alike, first, most_steps=steps, differentiable=differentiable).parameters
        there = refit(problem, alike, most_steps=0)
        stays = self._explains(there) or self._gains_nothing(model, alike)
        if weak or not stays or self._furthest(model, alike) <= SEARCH.farthest_specimen:
            there = self._from_alike(there, alike, steps, differentiable=differentiable)
        return there

    def _promises_usual(self, problem: Problem, parameters: FloatArray, white: FloatArray, slopes: FloatArray) -> bool:
        """Whether one Gauss-Newton step leads to where specimens are nearly usual and some of the gap is explained.

        `white` and `slopes` are the residual and the Jacobian there, in white coordinates.
        """
        with np.errstate(over="ignore"):
            if not np.isfinite(np.sum(white**2) + np.sum(slopes**2)):
                return False
        size = np.linalg.norm(slopes, axis=0)
        size[size == 0.0] = 1.0
        scaled = slopes / size
        step = -np.linalg.pinv(scaled.T @ scaled, hermitian=True) @ (scaled.T @ white)
        if not float(np.sum((white + scaled @ step) ** 2)) < self.base.refit.chi_square:
            return False
        residual, jacobian = problem.model.residual_and_jacobian(parameters)
        left = self.base.without_outliers(problem.model, residual + jacobian @ (step / size))
        return specimens_within(left, self.base.whitened.noises, SEARCH.nearly_usual)

    def _explains(self, fit: Refit) -> bool:
        """Whether it leaves no more than no effect does."""
        return fit.chi_square <= self.base.refit.chi_square

    def _from_alike(self, there: Refit, alike: FloatArray, steps: int, *, differentiable: bool) -> Refit:
        """From where specimens that are alike ended; there itself, where specimens that differ would hold the gap."""
        problem, model, noises = there.problem, there.model, self.base.alike.noises
        near, taken = reached(problem, there, most_steps=min(steps, SEARCH.steps_apart), differentiable=differentiable)
        held = specimens_hold_the_gap(model, noises, alike, near)
        goes_on = not held or self._furthest(model, near) <= SEARCH.nearly_usual
        if not goes_on and self._explains(there):
            return there
        fit = refit(problem, near, most_steps=steps if taken == SEARCH.steps_apart else 0)
        if goes_on and self._may_be(fit, alike):
            return fit
        if self._explains(there):
            return there
        return there if specimens_hold_the_gap(model, noises, self._without_effect(model), fit.parameters) else fit

    def _may_be(self, fit: Refit, before: FloatArray) -> bool:
        """Whether no specimen deviates unusually, or none holds the gap as it was before."""
        return self._usual(fit) or not specimens_hold_the_gap(fit.model, self.base.alike.noises, before, fit.parameters)

    def _usual(self, fit: Refit) -> bool:
        return self._furthest(fit.model, fit.parameters) <= 1.0

    def _furthest(self, model: CampaignModel, parameters: FloatArray) -> float:
        """How far the specimens' deviations are from what specimens may do: at most 1 where they may."""
        left = self.base.without_outliers(model, model.residual(parameters))
        return furthest_specimen(left, self.base.whitened.noises)

    def _gains_nothing(self, model: CampaignModel, alike: FloatArray) -> bool:
        """Whether the records are missed as without an effect, if specimens are alike."""
        left, least = misfits(model, self.base.alike.noises, (alike, self._without_effect(model)))
        return abs(left * left - least * least) <= SEARCH.slack

    def _without_effect(self, model: CampaignModel) -> FloatArray:
        """The base fit as parameters of a model whose causes are absent."""
        law = self.base.model.split(self.base.refit.parameters)[0]
        return np.append(law, model.start[model.base_count :])


def _keys_of(model: CampaignModel) -> tuple[Key, ...]:
    return tuple(cause_key(cause) for cause in model.causes)
