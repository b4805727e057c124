"""Which changes: every cause in every record and in all, refitted to those records; then two at once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq

from probation.comparison.evidence import SmoothChange, Tangent
from probation.effects.cause import Cause
from probation.errors import ConvergenceError, InputError
from probation.inference.candidate import Candidate, Key, WhitenedColumns, cause_key
from probation.inference.model import CampaignModel
from probation.inference.problem import Problem
from probation.inference.refit import Refit, refit
from probation.inference.screen import screen
from probation.noise.whitener import Whitener
from probation.parallel import in_parallel
from probation.settings.comparison import COMPARISON

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual


LEVEL, FARTHEST = 3.841458820694124, 20.0
"""Rise of the objective at the ends of a 95 % interval (chi-square, one degree of freedom); most deviations looked at.
"""

LEADING, ADDITIONS = 3, 6
"""Changes beside which a second one in the same records is sought, and how many are tried."""


@dataclass(frozen=True, eq=False)
class Found:
    """A change, refitted.

    Attributes
    ----------
    causes : tuple of Cause
        Empty: no change.
    records : tuple of str
        Ids of the records that it touches.
    refits : tuple of Refit
        On those records; causes that sit in different records were fitted apart.
    log_evidence : float
        Over that of no change.
    log_evidence_with_unknown : float
        With an unknown change in the same records beside it.
    """

    causes: tuple[Cause, ...]
    records: tuple[str, ...]
    refits: tuple[Refit, ...]
    log_evidence: float
    log_evidence_with_unknown: float = -np.inf

    @property
    def effects(self) -> tuple[str, ...]:
        """Names, sorted, each once."""
        return tuple(sorted({each.effect.name for each in self.causes}))


@dataclass(frozen=True, eq=False)
class ChangeSearch:
    """Records minus what their references predict, and the causes that may explain that.

    Attributes
    ----------
    model : CampaignModel
        The measured law on all records, without causes.
    noises : tuple of NoiseModel
    residuals : tuple of RecordResidual
    effects : tuple of Effect
    threads : int
    """

    model: CampaignModel
    noises: tuple[NoiseModel, ...]
    residuals: tuple[RecordResidual, ...]
    effects: tuple[Effect, ...]
    threads: int = 1

    @cached_property
    def still(self) -> tuple[FloatArray, ...]:
        """Whitened residual of every record without a change."""
        raw = self.model.residual(self.model.law.start)
        parts = (raw[part] for _, part in self.model.parts)
        return tuple(noise.whiten(part) for noise, part in zip(self.noises, parts, strict=True))

    @cached_property
    def smooth(self) -> tuple[SmoothChange, ...]:
        """What an unknown change of every record may look like."""
        return tuple(SmoothChange.of(*each) for each in zip(self.residuals, self.noises, strict=True))

    @cached_property
    def unknown(self) -> tuple[float, ...]:
        """Log evidence of an unknown change in every record, over none."""
        return tuple(
            Tangent.nothing(own).log_integral_with_unknown(smooth) + 0.5 * float(own @ own)
            for own, smooth in zip(self.still, self.smooth, strict=True)
        )

    def singles(self) -> list[Found]:
        """Every cause at its best, most evidence first."""
        model = self.model
        start = model.law.start
        residual = model.residual(start)
        columns = screen(model, start, self.effects, residual=residual, threads=self.threads)
        white = WhitenedColumns.of(columns, Whitener(self.noises), len(residual))
        stacked = np.concatenate(self.still)
        chosen = _best_starts(white.candidates(stacked, np.zeros((len(stacked), 0))))
        return self._judged([((), each) for each in chosen])

    def pairs(self, singles: Sequence[Found]) -> list[Found]:
        """Two causes: in different records both as they are alone, in the same records refitted."""
        found = []
        leading = [each for each in singles[:LEADING] if len(each.causes) == 1]
        for first in leading:
            apart = [each for each in singles if not set(each.records) & set(first.records)]
            best: dict[tuple[str, ...], Found] = {}
            for each in apart:
                best.setdefault((*each.effects, *each.records), each)
            found += [_together(first, each) for each in list(best.values())[:ADDITIONS]]
            found += self._additions(first)
        return sorted(found, key=lambda each: -each.log_evidence)

    def _additions(self, first: Found) -> list[Found]:
        """A second cause in the records of the first."""
        before = first.refits[0]
        model, at = before.model, before.parameters
        others = [each for each in self.effects if each.name not in first.effects]
        columns = screen(model, at, others, residual=model.residual(at), threads=self.threads)
        whitener = Whitener(self._noises_of(model))
        white = WhitenedColumns.of(columns, whitener, len(before.residual))
        ranked = _best_starts(white.candidates(before.residual, np.linalg.qr(before.jacobian)[0]), 1)
        seen: dict[str, Candidate] = {}
        for each in ranked:
            if each.gain > COMPARISON.worth_refitting:
                seen.setdefault(each.cause.effect.name, each)
        return self._judged([((before,), each) for each in list(seen.values())[:ADDITIONS]])

    def _judged(self, jobs: Iterable[tuple[tuple[Refit, ...], Candidate]]) -> list[Found]:
        found: dict[tuple[Key, ...], Found] = {}
        for each in in_parallel(self._one, list(jobs), self.threads):
            if each is None:
                continue
            key = tuple(cause_key(cause) for cause in each.causes)
            if key not in found or each.log_evidence > found[key].log_evidence:
                found[key] = each
        return sorted(found.values(), key=lambda each: -each.log_evidence)

    def _one(self, job: tuple[tuple[Refit, ...], Candidate]) -> Found | None:
        befores, candidate = job
        cause = candidate.cause
        before = befores[0] if befores else None
        ids = cause.records if before is None else tuple(view.id for view in before.model.views)
        views = [view for view in self.model.views if ids is None or view.id in ids]
        causes = (*(before.model.causes if before else ()), cause)
        model = CampaignModel(self.model.law, views, causes)
        start = np.append(before.parameters if before else self.model.law.start, candidate.values)
        noises = self._noises_of(model)
        try:
            steps = 15 if candidate.gain > COMPARISON.worth_refitting else 2
            done = refit(Problem(model, Whitener(noises)), start, most_steps=steps)
        except (ConvergenceError, InputError):
            return None
        return Found(causes, tuple(view.id for view in views), (done,), self._log_evidence(done))

    def with_unknown(self, found: Found) -> Found:
        """The same with its evidence beside an unknown change in the same records, if it is in one record."""
        if len(found.records) > 1 or len(found.refits) > 1:
            return found
        at = self._index(found.records[0])
        score = Tangent.of(found.refits[0]).log_integral_with_unknown(self.smooth[at])
        score += 0.5 * float(self.still[at] @ self.still[at])
        return Found(found.causes, found.records, found.refits, found.log_evidence, score)

    def interval(self, done: Refit) -> tuple[float, float]:
        """95 % interval of the only parameter of a refit, by the profile of the objective."""
        parameter, whitener = done.model.effect_parameters[0], Whitener(self._noises_of(done.model))
        coordinates = done.coordinates
        centre = float(coordinates.of(done.parameters)[0])
        least = done.chi_square + coordinates.prior.penalty(np.array([centre]))
        deviation = float(np.sqrt(Tangent.of(done).covariance[0, 0]))

        def excess(coordinate: float) -> float:
            x = np.array([coordinate])
            residual = whitener.residual(done.model.residual(coordinates.parameters(x)))
            return float(residual @ residual) + coordinates.prior.penalty(x) - least - LEVEL

        ends = []
        for side, bound in ((-1.0, coordinates.bounds.lower[0]), (1.0, coordinates.bounds.upper[0])):
            inside, step = centre, 2.0 * deviation
            outside = float(np.clip(centre + side * step, coordinates.bounds.lower[0], coordinates.bounds.upper[0]))
            while outside != bound and excess(outside) < 0.0 and step < FARTHEST * deviation:
                inside, step = outside, 1.6 * step
                outside = float(np.clip(centre + side * step, coordinates.bounds.lower[0], coordinates.bounds.upper[0]))
            if outside == bound and excess(outside) < 0.0:
                ends.append(float(bound))
            elif excess(inside) >= 0.0 or excess(outside) <= 0.0:  # no smooth valley: what the curvature says
                ends.append(float(np.clip(centre + side * np.sqrt(LEVEL) * deviation, *sorted((bound, centre)))))
            else:
                ends.append(float(brentq(excess, inside, outside, xtol=0.02 * deviation, disp=False)))
        return parameter.from_search(ends[0]), parameter.from_search(ends[1])

    def _log_evidence(self, done: Refit) -> float:
        none = sum(0.5 * float(self.still[at] @ self.still[at]) for at in (self._index(v.id) for v in done.model.views))
        return Tangent.of(done).log_integral() + none

    def _index(self, record: str) -> int:
        return [view.id for view in self.model.views].index(record)

    def _noises_of(self, model: CampaignModel) -> tuple[NoiseModel, ...]:
        return tuple(self.noises[self._index(view.id)] for view in model.views)


def _best_starts(candidates: Sequence[Candidate], count: int = COMPARISON.starts) -> list[Candidate]:
    """The best starts of every form and place."""
    taken: dict[Key, int] = {}
    found = []
    for each in candidates:
        key = cause_key(each.cause)
        if taken.get(key, 0) < count:
            taken[key] = taken.get(key, 0) + 1
            found.append(each)
    return found


def _together(first: Found, second: Found) -> Found:
    return Found(
        (*first.causes, *second.causes),
        (*first.records, *second.records),
        (*first.refits, *second.refits),
        first.log_evidence + second.log_evidence,
    )
