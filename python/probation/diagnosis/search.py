"""Which causes: single ones first, then combinations (docs/diagnosis-method.md, sections 4 and 6)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import combinations, compress, product
from operator import attrgetter
from typing import TYPE_CHECKING, Self
from weakref import WeakKeyDictionary

import numpy as np

from probation.diagnosis.beginnings import (
    each_alone,
    first_of_each,
    forms_of_the_best,
    further_starts,
    gain_together,
    in_several,
    promising,
    promising_in_several,
)
from probation.diagnosis.budget import Budget, CutShort
from probation.diagnosis.credible import credible
from probation.diagnosis.hypothesis import Hypothesis
from probation.diagnosis.refits_by_cause import (
    effects_placed,
    least_of_each,
    least_of_each_effect,
    of_one_cause,
    parts_of,
    with_others_absent,
)
from probation.diagnosis.refitting import Refitting
from probation.diagnosis.skipped import Skipping
from probation.effects.cause import Cause
from probation.inference.base_fit import with_joint_noise
from probation.inference.candidate import Candidate, Extended, Key, cause_key
from probation.inference.refit import MOST_STEPS, Refit
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.span import span_of, without
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.diagnosis.refitting import Job
    from probation.effects.effect import Effect
    from probation.inference.base_fit import BaseFit
    from probation.inference.evidence import Evidence
    from probation.inference.model import CampaignModel
    from probation.noise.whitening import Whitened


_USUAL = 20
"""Refits by which a phase of the search is reported as half done."""


@dataclass
class Search:
    """Hypotheses that were refitted, and the means to refit more.

    Attributes
    ----------
    base : BaseFit
    effects : tuple of Effect
    threads : int
    skipping : Skipping
        What is left out.
    budget : Budget
        Once it is spent, no further hypothesis is begun.
    found : list of Hypothesis
        The base law's first.
    """

    base: BaseFit
    effects: tuple[Effect, ...]
    threads: int = 1
    progress: Callable[[float], None] | None = None
    skipping: Skipping = field(default_factory=Skipping)
    budget: Budget = field(default_factory=Budget)
    found: list[Hypothesis] = field(default_factory=list)
    _phase: tuple[float, float] = (0.0, 0.5)
    _refits: int = 0
    _taken_apart: set[frozenset[Key]] = field(default_factory=set)
    _completed: int = 0
    _ended: set[str] = field(default_factory=set)
    _cut: bool = False
    _candidates: list[Candidate] = field(default_factory=list)
    _weighed: WeakKeyDictionary[Refit, Evidence | str] = field(default_factory=WeakKeyDictionary)

    def __post_init__(self) -> None:
        self.refitting = Refitting(self.base, self.effects, self.threads)
        self.found.append(Hypothesis(self.base.refit, self.refitting.evidence(self.base.refit, unknown=True)))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.refitting.close()

    def run(self) -> list[Hypothesis]:
        """Singles, then combinations while something is left."""
        self._singles()
        if self.base.scatter.any:
            self._scatter_around_the_best()
        self._passed_over()
        self._complete(1)
        self._try_with_unknown()
        self._begin(0.5, 0.65)
        first, extended = self.ranked()[:1], set[frozenset[Key]]()
        size = len(first[0].effects) if first and not self._something_left(first[0]) else 1
        while True:
            leading = self.ranked(size)
            if not leading:
                break
            if self.budget.spent():
                self.skipping.part(f"combinations of more than {size} effects", self.budget.why)
                break
            left = self._something_left(self.ranked()[0])
            self._extend(self._worth_extending(size, left), extended)
            if size == 1 and left:
                self._swaps(extended)
            self._rivals_jointly()
            self._try_with_unknown()
            if self._something_left(self.ranked()[0]):
                self._parts_of_the_leader()
            self._complete(size + 1)
            best = self.ranked()[0]
            if best in leading:
                break
            size = len(best.effects)  # the same where an effect acts in another record, too
            self._begin(0.65, 0.8)
        self._begin(0.8, 1.0)
        self._parts_of_the_leader()
        self._begun_anew()
        self._cut = self.budget.spent()
        return self.found

    @property
    def cut_short(self) -> CutShort | None:
        """How far the search came, if the budget ended it."""
        seconds = self.budget.seconds
        return CutShort(seconds, self._completed, frozenset(self._ended)) if self._cut and seconds else None

    def _complete(self, size: int) -> None:
        """Explanations of so many effects were tried, unless there was no time for all of them."""
        if not self.budget.spent():
            self._completed = size

    def _scatter_around_the_best(self) -> None:
        """What specimens do, around the best single effect: a law that lacks one may be far from what they are.

        Around one that acts once: a size of its own in every record would be taken for what the specimen is.
        """
        leading = self.ranked(1, acting_once=True)
        if leading:
            self.refitting.close()
            self.base = with_joint_noise(self.base, leading[0].refit)
            again = self._on_top_of(self.base, np.inf, race=True)
            self.found, self.refitting = again.found, again.refitting
            self._screen()

    def _passed_over(self) -> None:
        """Single effects that were not begun, though no refit reached what set the measure.

        A linearised gain may be one that no refit realises, and specimens may be taken for more than they are until
        their deviations are found around the best effect.
        """
        there = {cause_key(fit.model.causes[0]) for fit in of_one_cause(each.refit for each in self.found[1:])}
        reached = self._most_realised()
        least = max(min(reached - SEARCH.race_gain, SEARCH.passed_over * reached), 0.0)
        candidates = first_of_each(self._candidates)
        new = [each for each in candidates if each.gain > least and cause_key(each.cause) not in there]
        begun = self._solved(self._jobs(self.base.refit, each_alone(new), self.base.other_starts), SEARCH.first_steps)
        limit = self._limit([*begun, *(each.refit for each in self.found[1:])])
        self.found += self._judged(self._further([fit for fit in begun if fit.chi_square <= limit]))

    def reconsidered(self, base: BaseFit) -> list[Hypothesis]:
        """The leading hypotheses refitted on top of another base fit: the same law, another noise."""
        with self._on_top_of(base, SEARCH.hopeless) as again:
            again._parts_of_the_leader()
            again._begun_anew()
        return again.found

    def _on_top_of(self, base: BaseFit, hopeless: float, *, race: bool = False) -> Search:
        """A search on another base fit that begins with the leading hypotheses of every number of effects.

        In a race only those that may lead after their first steps go on.
        """
        again = Search(base, self.effects, self.threads, self._moved, self.skipping, _ended=self._ended)
        leading = self._near_the_best_of_as_many(hopeless)
        steps = SEARCH.first_steps if race or self.budget.spent() else MOST_STEPS
        begun = [(hypothesis.refit.model, hypothesis.refit.parameters) for hypothesis in leading]
        try:
            running, behind = again._solved(begun, steps), list[Refit]()
            if race:
                running, behind = again._in_the_running(running)
                running = again._further(running)
            again.found += again._judged([*behind, *running])
            again._try_with_unknown()
        except BaseException:
            again.refitting.close()
            raise
        return again

    def _near_the_best_of_as_many(self, hopeless: float) -> list[Hypothesis]:
        """Hypotheses no further than `hopeless` behind the best of as many effects; every single effect in the race.

        What the last effects of an explanation gain may be an error of the first one's form, and count for nothing in
        the end (`probabilities`): then what is as good as the first one by itself is as probable. Many forms of a few
        effects leave room for the others: of each set of effects the best form is among them.
        """
        forms: dict[frozenset[Key], Hypothesis] = {}
        for hypothesis in sorted(self.found[1:], key=attrgetter("standing"), reverse=True):
            forms.setdefault(hypothesis.refit.keys, hypothesis)
        chosen: list[Hypothesis] = []
        for size in dict.fromkeys(len(hypothesis.effects) for hypothesis in forms.values()):
            as_many = [hypothesis for hypothesis in forms.values() if len(hypothesis.effects) == size]
            best, sets = as_many[0].standing, self.ranked(size)
            if size == 1:
                race = max(hopeless, SEARCH.slack)
            else:
                race, sets = hopeless, sets[: SEARCH.reconsidered]
            chosen += [each for each in as_many[: SEARCH.reconsidered] if each.standing >= best - hopeless]
            chosen += [each for each in sets if each.standing >= best - race and each not in chosen]
        return chosen

    def ranked(self, size: int | None = None, *, acting_once: bool = False) -> list[Hypothesis]:
        """Hypotheses with causes, most evidence first, the best of each set of effects.

        Of so many effects only; of those only whose effects act once each.
        """
        best: dict[tuple[str, ...], Hypothesis] = {}
        for hypothesis in self.found[1:]:
            if (size is not None and len(hypothesis.effects) != size) or (acting_once and hypothesis.acts_in_several):
                continue
            known = best.get(hypothesis.effects)
            if known is None or hypothesis.standing > known.standing:
                best[hypothesis.effects] = hypothesis
        return sorted(best.values(), key=attrgetter("standing"), reverse=True)

    def _worth_extending(self, size: int, left: bool) -> list[Hypothesis]:
        """The best of so many effects, and where it leaves something the next; of several those not far behind it.

        Those that act once each come first, and are as many: one that acts in several records may stand in for two.
        """
        most = SEARCH.extended_explanations if left else 1
        leading, once = self.ranked(size), self.ranked(size, acting_once=True)
        least = -np.inf if size == 1 else leading[0].standing - SEARCH.hopeless
        first, *others = [*once[:most], *(each for each in leading[:most] if each.acts_in_several)]
        return [first, *(hypothesis for hypothesis in others if hypothesis.standing > least)]

    def _something_left(self, best: Hypothesis) -> bool:
        return best.evidence.log_evidence_unknown > best.evidence.log_evidence + SEARCH.unknown_lead

    def candidates(self) -> list[Candidate]:
        """Where single effects may begin, most gain first."""
        [started] = self.refitting.candidates([self.base.extended(self.effects, self.skipping.screened)])
        for start in self.base.other_starts if self.base.screens_other_starts else ():
            started += self._candidates_at(start)
        return sorted(started, key=lambda candidate: -candidate.gain)

    def _left_by(self, refit: Refit) -> Whitened:
        return self.base.whitened.with_residual(refit.residual, refit.jacobian)

    def _screen(self) -> None:
        self._candidates = credible(self.candidates(), self._left_by(self.base.refit))

    def _most_realised(self) -> float:
        """Largest gain of a single effect that was refitted."""
        return 0.5 * max((self.base.refit.chi_square - each.refit.chi_square for each in self.found[1:]), default=0.0)

    def _singles(self) -> None:
        self._screen()
        candidates = self._candidates
        first = promising(first_of_each(candidates))
        base = self.base
        jobs = self._jobs(base.refit, each_alone(first), base.other_starts)
        begun = self._solved([*jobs, *self._jobs(base.refit, promising_in_several(candidates))], SEARCH.first_steps)
        begun += self._each_by_itself(begun)
        running, behind = self._in_the_running(begun)
        self.found += self._judged(behind)
        keys = {cause_key(fit.model.causes[0]) for fit in of_one_cause(running)}
        others = further_starts(promising(candidates), first, SEARCH.starts - 1)
        more = [candidate for candidate in others if cause_key(candidate.cause) in keys]
        polished = self._further(running, self._jobs(base.refit, each_alone(more), base.other_starts))
        self.found += self._judged(polished)
        # What acts in several records with numbers of its own in each may stand in for two faults of all.
        if self._gap_left(of_one_cause(polished)) > SEARCH.strong_gap:
            self.found += self._judged(self._begun_jointly(of_one_cause(begun)))
        self._forms_of_the_leader()

    def _forms_of_the_leader(self) -> None:
        """The leading single effect in its forms of the same amplitude, from where its best form ended.

        From the base fit, far from there, a form may end beside its optimum.
        """
        for leading in self.ranked(1, acting_once=True)[:1]:
            base, ((cause, values),) = leading.refit.model.split(leading.refit.parameters)
            views = [view for view in self.base.model.views if cause.touches(view.id)]
            jobs: list[Job] = []
            for form in cause.effect.forms:
                if form.amplitude is not cause.form.amplitude or form.threshold:
                    continue
                model = self.base.model.with_causes([Cause(cause.effect, form, cause.records)])
                starts = form.nonlinear_starts(views)[: SEARCH.starts]
                jobs += [(model, model.parameters(base, (values[0], *start))) for start in starts]
            self.found += self._judged(self._solved(jobs, MOST_STEPS))

    def _begun_jointly(self, singles: Sequence[Refit]) -> list[Refit]:
        """Pairs of gross faults of which one alone hides the other, from the starts of both."""
        jobs: list[Job] = []
        residual = self.base.model.residual(self.base.refit.parameters)
        for pair in self._hidden_pairs(singles):
            if (model := self._with_causes(self.base.model, pair)) is None:
                continue
            views = [view for view in model.views if pair[0].touches(view.id)]
            residuals = [residual[model.rows(view.id)] for view in views]
            try:
                grids = [cause.form.nonlinear_starts(views, residuals)[: SEARCH.starts] for cause in pair]
            except UNSOLVABLE as error:
                self.skipping.hypothesis(pair, error)
                continue
            jobs += [(model, model.parameters(self.base.refit.parameters, *starts)) for starts in product(*grids)]
        begun = sorted(self._solved(jobs, SEARCH.first_steps), key=lambda fit: fit.chi_square)
        best = list(least_of_each(begun).values())
        return self._further([*best, *(fit for fit in begun if fit not in best)][: SEARCH.starts])

    def _hidden_pairs(self, singles: Sequence[Refit]) -> list[tuple[Cause, Cause]]:
        """Gross faults in the same records of which one alone may hide the other.

        Also such as are far behind by themselves, if they explain anything: the other one is why. The one that leaves
        least also with such as were not solved by themselves.
        """
        solved = least_of_each(single for single in singles if single.model.causes[0].form.hidden_by is not None)
        most = self.base.refit.chi_square - SEARCH.slack
        gross = sorted((fit for fit in solved.values() if fit.chi_square < most), key=lambda fit: fit.chi_square)
        causes = [fit.model.causes[0] for fit in gross]
        pairs = list(combinations(causes, 2))
        for first in causes[:1]:
            placed = "all" if first.records is None else "one"
            for effect in self.effects:
                forms = (form for form in effect.forms if placed in effect.placements(form))
                others = [
                    Cause(effect, form, first.records) for form in forms if form.visible_in(self.base.model.views)
                ]
                pairs += [(first, other) for other in others if frozenset({cause_key(other)}) not in solved]
        return [
            (one, other)
            for one, other in pairs
            if one.form.hidden_by == other.form.hidden_by
            and one.records == other.records
            and one.effect is not other.effect
        ]

    def _candidates_at(self, start: FloatArray) -> list[Candidate]:
        """Causes as they look from other parameters of the law; gains are over what the base fit leaves."""
        model, base = self.base.model, self.base.refit
        try:
            residual, slopes = self.base.problem.residual_and_jacobian(start)
        except UNSOLVABLE:
            return []
        extended = Extended(model, start, self.effects, self.base.whitener, residual, slopes)
        [candidates] = self.refitting.candidates([extended])
        more, least = without(residual, extended.span), without(base.residual, span_of(base.jacobian))
        worse = float(more @ more - least @ least)
        return [replace(candidate, base=start, gain=candidate.gain - worse) for candidate in candidates]

    def _in_the_running(self, refits: Sequence[Refit]) -> tuple[list[Refit], list[Refit]]:
        """Which of unfinished refits may lead, by what they leave and by their evidence, and which are far behind.

        Where no single effect explains a strong gap, all leave about as much of it; but the evidence of most is so low
        that nothing which is left to gain brings them back. Forms of one effect stay together: one that is stuck on
        its way has lower evidence than one that arrives at a worse place.
        """
        limit = self._limit(refits)
        near = {id(fit) for fit in refits if fit.chi_square <= limit}
        if self._gap_left(refits) > SEARCH.strong_gap:
            close = [fit for fit in refits if id(fit) in near]
            scores = {id(fit): _score(known) for fit, known in zip(close, self._evidences(close), strict=True)}
            count = len(self.base.whitened)
            best = max((score for score in scores.values() if np.isfinite(score)), default=0.0)
            left = max(-best - 0.5 * count - np.sqrt(2.0 * count), 0.0)
            least = best - (SEARCH.worth_polishing - 1.0) * left - SEARCH.slack
            effects = {effects_placed(fit) for fit in refits if scores.get(id(fit), -np.inf) >= least}
            near = {id(fit) for fit in refits if id(fit) in near and effects_placed(fit) in effects}
        return [fit for fit in refits if id(fit) in near], [fit for fit in refits if id(fit) not in near]

    def _gap_left(self, refits: Sequence[Refit]) -> float:
        """What the best refit leaves of the gap, above the noise for certain; the noise itself is the same for all."""
        best = min((fit.chi_square for fit in refits), default=np.inf)
        count = len(self.base.whitened)
        return float(max(best - count - SEARCH.certain_gap * np.sqrt(2.0 * count), 0.0))

    def _limit(self, refits: Sequence[Refit]) -> float:
        """Least that a cause may leave and still be out of the race."""
        best = min((fit.chi_square for fit in refits), default=np.inf)
        return float(best + (SEARCH.in_the_race - 1.0) * self._gap_left(refits) + SEARCH.slack)

    def _extend(self, leading: Iterable[Hypothesis], extended: set[frozenset[Key]]) -> None:
        """One more cause jointly with those of hypotheses that were not `extended` yet."""
        wanted = [hypothesis for hypothesis in leading if hypothesis.refit.keys not in extended]
        self._additions([(hypothesis, None) for hypothesis in wanted])
        extended.update(hypothesis.refit.keys for hypothesis in wanted)

    def _additions(self, wanted: Sequence[tuple[Hypothesis, Cause | None]]) -> None:
        """One more cause jointly with those of each hypothesis.

        With as many effects as an explanation may have, only one of these, in another record. With a cause, its effect
        in the same records, in any form.
        """
        if self.budget.spent():
            for leading, _ in wanted:
                self.skipping.part(f"a further effect jointly with {' and '.join(leading.effects)}", self.budget.why)
            return
        candidates = self.refitting.candidates([self._extended(leading, only) for leading, only in wanted])
        jobs = [
            self._jobs(leading.refit, self._worth_adding(leading, only, own))
            for (leading, only), own in zip(wanted, candidates, strict=True)
        ]
        behind: list[Refit] = []
        ahead: list[Refit] = []
        for (leading, _), begun in zip(wanted, self._solved_in_groups(jobs, SEARCH.first_steps), strict=True):
            least = least_of_each_effect(begun, len(leading.causes))
            kept = {id(fit) for fit in least}
            behind += [fit for fit in begun if id(fit) not in kept]
            ahead += least
        self.found += self._judged(behind, SEARCH.first_steps)
        self.found += self._judged(self._further(ahead))

    def _extended(self, leading: Hypothesis, only: Cause | None) -> Extended:
        """A hypothesis to which an effect is to be added: any, or that of a cause."""
        refit = leading.refit

        def unsolved(cause: Cause, error: Exception) -> None:
            self.skipping.hypothesis([*leading.causes, cause], error)

        effects = [effect for effect in self.effects if only is None or effect.name == only.effect.name]
        # Where the best one leaves nothing there is no fault so large that its force has to be sought.
        every = only is not None or self._something_left(self.ranked()[0])
        return Extended(
            refit.model,
            refit.parameters,
            effects,
            self.base.whitener,
            refit.residual,
            refit.jacobian,
            unsolved=unsolved,
            only=None if every else lambda form: not form.own_force,
        )

    def _worth_adding(
        self, leading: Hypothesis, only: Cause | None, candidates: Sequence[Candidate]
    ) -> list[tuple[Candidate, ...]]:
        """What is added to a hypothesis: every form of the best effects by itself, and one in several records."""
        taken = {(cause.effect.name, cause.records) for cause in leading.causes}
        once = {cause.effect.name for cause in leading.causes if not cause.form.several}

        def may_be_added(cause: Cause) -> bool:
            name = cause.effect.name
            if (name, cause.records) in taken or (name in once and not cause.form.several):
                return False
            if only is not None:
                return cause.records == only.records
            return len(leading.effects) < SEARCH.most_effects or name in leading.effects

        possible = [candidate for candidate in candidates if may_be_added(candidate.cause)]
        ranked = credible(possible, self._left_by(leading.refit))
        chosen = forms_of_the_best(
            [candidate for candidate in ranked if candidate.gain > SEARCH.worth_refitting], SEARCH.additions
        )
        most = max((candidate.gain for candidate in ranked), default=0.0)
        several = [together for together in in_several(ranked) if only is None and gain_together(together) > most]
        return [*each_alone(chosen), *several]

    def _parts_of_the_leader(self) -> None:
        """Every part of the leading explanation from its own values: a part that was stuck elsewhere may lead.

        And every effect of it that acts once in its other forms: one that had to explain what two of them do may take
        another form jointly with the second one. An effect that acts in several records was begun in them together.
        """
        while leading := self.ranked()[:1]:
            whole = leading[0].refit
            causes = whole.model.causes
            key = whole.keys
            if len(causes) < 2 or key in self._taken_apart or self.budget.spent():
                return
            self._taken_apart.add(key)
            base, values = whole.model.split(whole.parameters)
            jobs = []
            for kept in parts_of(causes):
                part = list(compress(values, kept))
                model = whole.model.with_causes(cause for cause, _ in part)
                jobs.append((model, model.parameters(base, *(own for _, own in part))))
            parts = self._judged(self._solved(jobs, MOST_STEPS))
            self.found += parts
            once = [cause for cause in causes if sum(other.effect is cause.effect for other in causes) == 1]
            of = {hypothesis.refit.keys: hypothesis for hypothesis in reversed(parts)}
            without = [(of.get(key - {cause_key(cause)}), cause) for cause in once]
            self._additions([(part, cause) for part, cause in without if part is not None])
            self._try_with_unknown()

    def _begun_anew(self) -> None:
        """What leaves more than a part that was found after it, from that part; without what still does.

        Where specimens differ a refit may end above its start, not to leave the gap to them. It is no optimum. What is
        far behind the leader, as its parts are, is not worth the time: it goes at once.
        """
        leading = self.ranked()[:1]
        least_standing = leading[0].standing - SEARCH.hopeless if leading else -np.inf
        near = [hypothesis.refit.keys for hypothesis in self.found[1:] if hypothesis.standing > least_standing]
        hopeful = [any(keys <= hypothesis.refit.keys for keys in near) for hypothesis in self.found[1:]]
        before = [hypothesis.refit for hypothesis in compress(self.found[1:], hopeful)]
        after = self._not_above_their_parts(before)
        moved = {id(old): new for old, new in zip(before, after, strict=True) if new is not old}
        kept = [hypothesis for hypothesis in self.found[1:] if id(hypothesis.refit) not in moved]
        hypotheses = [*kept, *self._judged(moved.values())]
        least = least_of_each(hypothesis.refit for hypothesis in hypotheses)
        self.found = self.found[:1]
        for hypothesis in hypotheses:
            parts = [other.chi_square for keys, other in least.items() if keys < hypothesis.refit.keys]
            if hypothesis.refit.chi_square <= min(parts, default=np.inf) + SEARCH.settled:
                self.found.append(hypothesis)
            else:
                self.skipping.hypothesis(hypothesis.causes, "not solved: its fit ended worse than that of a part of it")
        self._try_with_unknown()

    def _swaps(self, extended: set[frozenset[Key]]) -> None:
        """The best pair with one of its causes given up for another: the first may have stood in for both.

        Not from a cause that was `extended` already.
        """
        if pairs := self.ranked(2):
            self._extend([each for each in self.ranked(1) if each.effects[0] in pairs[0].effects], extended)

    def _each_by_itself(self, refits: Sequence[Refit]) -> list[Refit]:
        """Faults of the force that leave something if they are alike in all records, with sizes of their own in each.

        A limit is a force, and specimens have sections of their own. Of each effect the form that leaves least.
        """
        views, jobs = self.base.model.views, []
        for single in least_of_each_effect(of_one_cause(refits), 0):
            cause = single.model.causes[0]
            of_the_force = cause.form.recorded_stress is not None and "one" in cause.effect.placements(cause.form)
            alike = cause.records is None and len(views) > 1
            if of_the_force and alike and self._gap_left([single]) > SEARCH.strong_gap:
                base, ((_, values),) = single.model.split(single.parameters)
                apart = self.base.model.with_causes(Cause(cause.effect, cause.form, (view.id,)) for view in views)
                jobs.append((apart, apart.parameters(base, *[values] * len(views))))
        return self._solved(jobs, SEARCH.first_steps)

    def _rivals_jointly(self) -> None:
        """The leader of several effects with its first one given up for what is about as good as that by itself."""
        leading = self.ranked()[0]
        alone = {hypothesis.effects[0]: hypothesis for hypothesis in self.ranked(1)}
        known = [name for name in leading.effects if name in alone]
        if len(leading.effects) < 2 or not known:
            return
        first = max(known, key=lambda name: alone[name].standing)
        least = alone[first].standing - SEARCH.hopeless
        near = [
            hypothesis for hypothesis in self.found[1:] if len(hypothesis.effects) == 1 and hypothesis.standing > least
        ]
        rivals = [hypothesis for hypothesis in near if hypothesis.effects[0] not in leading.effects]
        base, values = leading.refit.model.split(leading.refit.parameters)
        rest = [(cause, own) for cause, own in values if cause.effect.name != first]
        tried, jobs = {hypothesis.refit.keys for hypothesis in self.found}, []
        for rival in least_of_each(hypothesis.refit for hypothesis in rivals).values():
            together = [*rival.model.split(rival.parameters)[1], *rest]
            causes = [cause for cause, _ in together]
            if frozenset(cause_key(cause) for cause in causes) in tried:
                continue
            if (model := self._with_causes(leading.refit.model, causes)) is not None:
                jobs.append((model, model.parameters(base, *(own for _, own in together))))
        self.found += self._judged(self._solved(jobs, MOST_STEPS))

    def _jobs(
        self, before: Refit, added: Iterable[Sequence[Candidate]], other_starts: Sequence[FloatArray] = ()
    ) -> list[Job]:
        """Refits of candidates jointly with the causes that are there, from where these are and from other starts.

        Every item of `added` is what is added at once: a candidate, or those of one effect in several records.
        """
        jobs: list[Job] = []
        for together in added:
            causes = [*before.model.causes, *(candidate.cause for candidate in together)]
            if (model := self._with_causes(before.model, causes)) is None:
                continue
            own = together[0].base
            begun = (before.parameters, *other_starts) if own is None else (own,)
            jobs += [(model, np.concatenate([start, *(candidate.values for candidate in together)])) for start in begun]
        return jobs

    def _with_causes(self, model: CampaignModel, causes: Sequence[Cause]) -> CampaignModel | None:
        """A model with these causes instead of its own; None, and noted, where it cannot hold them together."""
        try:
            return model.with_causes(causes)
        except UNSOLVABLE as error:
            self.skipping.hypothesis(causes, error)
            return None

    def _further(self, refits: Sequence[Refit], more: Sequence[Job] = ()) -> list[Refit]:
        """Unfinished refits taken to their ends, and `more` begun; once the budget is spent, they stay as they are."""
        if self.budget.spent():
            return list(refits)
        further = self._solved([*((fit.model, fit) for fit in refits), *more], MOST_STEPS)
        if self.budget.spent():
            there = {id(fit.model) for fit in further}
            further += [fit for fit in refits if id(fit.model) not in there]
        return further

    def _solved(self, jobs: Sequence[Job], steps: int) -> list[Refit]:
        """Refits from models and starts; without those that the law cannot follow from there."""
        [solved] = self._solved_in_groups([jobs], steps)
        return solved

    def _solved_in_groups(self, groups: Sequence[Sequence[Job]], steps: int) -> list[list[Refit]]:
        """The same of several groups, all at once."""
        jobs = [job for group in groups for job in group]
        nothing_yet = len(self.found) == 1
        refits = iter(self.refitting.refits(jobs, steps, self.budget, always_one=nothing_yet, progress=self._moved))
        solved: list[list[Refit]] = []
        for group in groups:
            solved.append([])
            for (model, _), fit in zip(group, refits, strict=False):
                if isinstance(fit, str):
                    self.skipping.hypothesis(model.causes, fit)
                else:
                    solved[-1].append(fit)
            if steps == MOST_STEPS:
                alone = ({cause.effect.name for cause in fit.model.causes} for fit in solved[-1])
                self._ended.update(*(names for names in alone if len(names) == 1))
        return solved

    def _not_above_their_parts(self, refits: list[Refit], steps: int = MOST_STEPS) -> list[Refit]:
        """Refits that leave more than a part of their causes does by itself, begun anew from there: so many steps."""
        known = [*(hypothesis.refit for hypothesis in self.found), *refits]
        waiting = {fit.keys for fit in refits}
        while waiting and not self.budget.spent():
            alone = {keys for keys in waiting if len(keys) == 1}
            ready = alone or {keys for keys in waiting if not any(part < keys for part in waiting)}
            waiting -= ready
            least = least_of_each(known)
            jobs: list[tuple[CampaignModel, FloatArray]] = []
            before: list[Refit] = []
            for whole in refits:
                if whole.keys not in ready:
                    continue
                part = min(
                    (other for keys, other in least.items() if keys < whole.keys), key=lambda other: other.chi_square
                )
                if whole.chi_square > part.chi_square + SEARCH.settled:
                    jobs.append((whole.model, with_others_absent(whole, part)))
                    before.append(whole)
            # A single effect that leaves more than none has lost the race: none of it leaves as much as none.
            lower = {id(fit.model): fit for fit in self._solved(jobs, 0 if alone else steps)}
            better = {
                id(fit): lower[id(fit.model)]
                for fit in before
                if id(fit.model) in lower and lower[id(fit.model)].chi_square < fit.chi_square
            }
            refits = [better.get(id(fit), fit) for fit in refits]
            known += better.values()
        return refits

    def _judged(self, refits: Iterable[Refit], steps: int = MOST_STEPS) -> list[Hypothesis]:
        """Refits with their evidence; without those of which it cannot be worked out.

        `steps` are those of one that is begun anew, since it leaves more than a part of its causes does.
        """
        final = self._not_above_their_parts(list(refits), steps)
        judged = []
        for fit, known in zip(final, self._evidences(final), strict=True):
            if isinstance(known, str):
                self.skipping.hypothesis(fit.model.causes, known)
            elif np.isfinite(known.log_evidence):
                judged.append(Hypothesis(fit, known))
            else:
                self.skipping.hypothesis(fit.model.causes, "its evidence is not finite")
        return judged

    def _evidences(self, refits: Sequence[Refit]) -> list[Evidence | str]:
        """The evidence of each refit, worked out once; why, where it cannot be."""
        new = [fit for fit in refits if fit not in self._weighed]
        self._weighed.update(zip(new, self.refitting.evidences(new), strict=True))
        return [self._weighed[fit] for fit in refits]

    def _try_with_unknown(self) -> None:
        """Whether the leading hypotheses leave room for an unknown effect: for all of them it would take long."""
        ahead = [
            *self.ranked()[: SEARCH.with_unknown],
            *self.ranked(1)[: SEARCH.fewer_with_unknown],
            *self.ranked(2)[: SEARCH.fewer_with_unknown],
        ]
        untried = {id(known): known for known in ahead if not np.isfinite(known.evidence.log_evidence_unknown)}
        evidences = self.refitting.evidences([known.refit for known in untried.values()], unknown=True)
        weighed: dict[int, Hypothesis] = {}
        for (number, hypothesis), known in zip(untried.items(), evidences, strict=True):
            if isinstance(known, str):
                self.skipping.part(f"{' and '.join(hypothesis.effects)} jointly with an unknown effect", known)
            else:
                weighed[number] = Hypothesis(hypothesis.refit, known)
        self.found = [weighed.get(id(hypothesis), hypothesis) for hypothesis in self.found]

    def _begin(self, low: float, high: float) -> None:
        """Another phase of the search, and what part of it that is; one that is on goes on."""
        if self._phase != (low, high):
            self._phase, self._refits = (low, high), 0

    def _moved(self, _: float) -> None:
        """One more refit is done, here or in a search for this one; a phase is half done after `_USUAL` of them."""
        self._refits += 1
        if self.progress:
            low, high = self._phase
            self.progress(low + (high - low) * self._refits / (self._refits + _USUAL))


def _score(known: Evidence | str) -> float:
    """Of an unfinished refit; without an answer it stays in the race, and that is said where it is judged."""
    return np.inf if isinstance(known, str) else known.log_evidence
