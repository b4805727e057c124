"""Which causes explain a gap between a base law and its records, and how probable each is.

Of a law that was fitted (`probation.diagnose`) and of one that was measured on other records (`probation.compare`)
alike: docs/diagnosis-method.md, sections 4 and 6 to 8.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from probation.diagnosis.checks import checks
from probation.diagnosis.held_out import HeldToAccount
from probation.diagnosis.linear import linear_hypotheses
from probation.diagnosis.probabilities import (
    effect_count,
    given_a_gap,
    given_no_gap,
    leading,
    none_behind,
    probabilities_of,
    with_untried,
)
from probation.diagnosis.remaining import leaves_too_much, remaining_gap
from probation.diagnosis.search import Search
from probation.diagnosis.shrink import shrink_of
from probation.diagnosis.trust import Tempered, trust_in
from probation.effects.large_forms import with_large_forms
from probation.inference.base_fit import with_joint_noise
from probation.inference.unknown import UNKNOWN
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from probation.detection.where import Located
    from probation.diagnosis.budget import Budget, CutShort
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.probabilities import Weighed
    from probation.diagnosis.remainder import Remainder
    from probation.diagnosis.result import Checks, RecordCurves, Shrink, Verdict
    from probation.diagnosis.skipped import Skipped, Skipping
    from probation.diagnosis.trust import Trust
    from probation.effects.effect import Effect
    from probation.inference.base_fit import BaseFit
    from probation.inference.calibration_check import CalibrationCheck


@dataclass(frozen=True, eq=False)
class Causes:
    """Explanations of what a base law leaves.

    Attributes
    ----------
    base : BaseFit
        With the noise as the best explanation leaves it.
    considered : tuple of Effect
        With the large forms, where there is a gap.
    found : list of Hypothesis
        All that were solved.
    weighed : list of Weighed
        By probability.
    checks : dict of tuple of str to Checks
        Of the explanations of the answer set.
    verdict : {"explained", "no_gap", "unexplained"}
    trust : Trust
        How far evidence counts.
    cut : CutShort or None
        How far the search came, if the budget ended it.
    """

    base: BaseFit
    considered: tuple[Effect, ...]
    found: list[Hypothesis]
    weighed: list[Weighed]
    checks: Mapping[tuple[str, ...], Checks]
    verdict: Verdict
    trust: Trust
    cut: CutShort | None = None

    @property
    def nearest(self) -> Hypothesis:
        """As far as known effects come: the best explanation, or the most probable refitted one that has any.

        The latter where an unknown effect leads alone.
        """
        first = self.weighed[0]
        if first.effects != (UNKNOWN,):
            return first.hypothesis
        return next((each.hypothesis for each in self.weighed if each.hypothesis.causes), first.hypothesis)

    @property
    def untried(self) -> tuple[str, ...]:
        """Effects that the budget left no time to try to the end; none where the search would not go back to them.

        It would not where the best explanation leaves nothing, and all of as many effects were tried.
        """
        count = len(self.weighed[0].hypothesis.effects)
        if self.cut is None or (self.verdict == "explained" and count <= self.cut.completed):
            return ()
        return tuple(effect.name for effect in self.considered if effect.name not in self.cut.ended)

    def not_among(self, effects: Sequence[Effect]) -> tuple[Effect, ...]:
        """Which of the effects were not considered, since the law cannot follow them."""
        considered = {effect.name for effect in self.considered}
        return tuple(effect for effect in effects if effect.name not in considered)

    def with_untried(self, weighed: Sequence[Weighed]) -> list[Weighed]:
        """Explanations weighed against the effects that were not refitted to the end."""
        return with_untried(weighed, self.considered, self.untried, self.found[0])

    @property
    def cut_text(self) -> str:
        """That the budget ended the search; empty if it did not."""
        return "" if self.cut is None else self.cut.text(len(self.untried), len(self.considered))

    def skipped(self, skipping: Skipping) -> tuple[Skipped, ...]:
        """What was left out."""
        return skipping.entries(self.found, {} if self.cut is None else dict.fromkeys(self.untried, self.cut.why))

    def shrunk(
        self, located: Sequence[Located], skipping: Skipping, *, seed: int
    ) -> tuple[Causes, Shrink, dict[str, RecordCurves]]:
        """How far the gap shrinks (`shrink_of`), and the causes: unexplained where too much is left."""
        shrink, curves = shrink_of(self.base, self.nearest, located, skipping, seed=seed)
        return self.judged_by(shrink), shrink, curves

    def judged_by(self, shrink: Shrink, left: Remainder | None = None) -> Causes:
        """Unexplained where `leaves_too_much` says so of the best explanation."""
        too_much = self.verdict == "explained" and leaves_too_much(shrink, left)
        return replace(self, verdict="unexplained") if too_much else self


def causes_of(
    base: BaseFit,
    considered: Sequence[Effect],
    p_value: float,
    *,
    gap: bool,
    threads: int,
    seed: int,
    skipping: Skipping,
    budget: Budget,
    progress: Callable[[float], None],
    calibration: CalibrationCheck,
) -> Causes:
    """Explanations of what a base law leaves, weighed and checked.

    Parameters
    ----------
    base : BaseFit
        With the signals of the effects, `BaseFit.screened`.
    considered : sequence of Effect
    p_value : float
        Of the test for a gap.
    gap : bool
        Whether there is one. If not, the linearised model says all there is to say.
    threads, seed : int
    skipping : Skipping
    budget : Budget
    progress : callable
        Called with the fraction done.
    calibration : CalibrationCheck
        How far the evidence counts.
    """
    considered = tuple(considered)
    if not gap:
        hypotheses = linear_hypotheses(base, base.columns, skipping)
        tempered = Tempered(EVIDENCE.evidence_power)  # no form describes anything here
        weighed = given_no_gap(probabilities_of(hypotheses, effect_count(considered), tempered), p_value)
        return Causes(base, considered, hypotheses, weighed, {}, "no_gap", tempered)
    visible_count = len(considered)
    considered = base.model.followed(with_large_forms(considered, base.model.views))
    base, hypotheses, cut = _searched(base, considered, threads, skipping, budget, progress)
    hypotheses = [hypothesis.as_reached(hypotheses[0]) for hypothesis in hypotheses]
    account = HeldToAccount(base, seed=seed)

    followed = len(considered) if _acts_everywhere(hypotheses) else visible_count
    trust = trust_in(calibration, followed, visible_count)
    weighed = probabilities_of(hypotheses, effect_count(considered), trust)
    weighed = none_behind(account.ranked(given_a_gap(weighed, p_value)))
    left, checked = _judged(leading(weighed), base, account, seed)
    best = weighed[0]
    more = (
        UNKNOWN in best.effects or left or account.worse(best.hypothesis) or _another_acts(best.hypothesis, base, seed)
    )
    return Causes(base, considered, hypotheses, weighed, checked, "unexplained" if more else "explained", trust, cut)


def _acts_everywhere(hypotheses: Sequence[Hypothesis]) -> bool:
    """Whether the best known explanation acts in all records, as an effect that the law cannot follow would."""
    best = max(hypotheses[1:], key=lambda each: each.evidence.log_evidence, default=hypotheses[0])
    return not best.causes or len(best.records) == len(best.refit.model.views)


def _searched(
    base: BaseFit,
    considered: tuple[Effect, ...],
    threads: int,
    skipping: Skipping,
    budget: Budget,
    progress: Callable[[float], None],
) -> tuple[BaseFit, list[Hypothesis], CutShort | None]:
    """Hypotheses of a gap, the base fit with the noise that the best one leaves, and where the budget ended it."""
    with Search(base, considered, threads, progress, skipping, budget) as search:
        hypotheses = search.run()
    leading = search.ranked()
    if not leading:
        return base, hypotheses, search.cut_short
    base = with_joint_noise(search.base, leading[0].refit)
    hypotheses = search.reconsidered(base)
    return base, hypotheses, search.cut_short


def _judged(
    chosen: Sequence[Weighed], base: BaseFit, account: HeldToAccount, seed: int
) -> tuple[bool, dict[tuple[str, ...], Checks]]:
    """Whether the best explanation leaves a gap, and the checks of every one in the answer set that has causes."""
    left, checked = False, {}
    for index, explanation in enumerate(chosen):
        if index and not explanation.hypothesis.causes:
            continue
        after = remaining_gap(explanation.hypothesis.refit, base, seed=seed)
        if index == 0:
            left = after.rejected
        if explanation.hypothesis.causes:
            made = checks(explanation.hypothesis, base.refit, base.whitened, after.p_value)
            refused = tuple(one.text for one in account.worse(explanation.hypothesis))
            checked[explanation.effects] = replace(made, notes=(*made.notes, *refused))
    return left, checked


def _another_acts(best: Hypothesis, base: BaseFit, seed: int) -> bool:
    """Whether what is left is more than the errors of the best explanation's forms."""
    return remaining_gap(best.refit, base, seed=seed, share=1.0).rejected
