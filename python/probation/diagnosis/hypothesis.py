"""A set of causes with its refit and its evidence."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import comb, log
from typing import TYPE_CHECKING

from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation.effects.cause import Cause
    from probation.inference.evidence import Evidence
    from probation.inference.refit import Refit


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Causes in their forms and places, refitted together with the law.

    Attributes
    ----------
    refit : Refit
    evidence : Evidence
    """

    refit: Refit
    evidence: Evidence

    def as_reached(self, base: Hypothesis) -> Hypothesis:
        """The same without evidence for steps that its search did not take.

        The integral is that of the linearised law, which goes on where the law does not follow. With an unknown the
        parameters move on, the base law's as well.

        Parameters
        ----------
        base : Hypothesis
            The base law without causes.
        """
        lost = self.refit.not_reached
        return replace(
            self,
            evidence=replace(
                self.evidence,
                log_evidence=self.evidence.log_evidence - lost,
                log_evidence_exact=self.evidence.log_evidence_exact - lost,
                log_evidence_unknown=self.evidence.log_evidence_unknown - max(lost - base.refit.not_reached, 0.0),
            ),
        )

    @property
    def standing(self) -> float:
        """Its log evidence, and how probable its forms and places are among those that its effects may have."""
        return self.evidence.log_evidence + self.log_share

    @property
    def causes(self) -> tuple[Cause, ...]:
        """Empty for the base law."""
        return self.refit.model.causes

    @property
    def effects(self) -> tuple[str, ...]:
        """Names of the effects, sorted, each once."""
        return tuple(sorted({cause.effect.name for cause in self.causes}))

    @property
    def acts_in_several(self) -> bool:
        """Whether an effect of it acts in several records, in each by itself."""
        return len(self.causes) > len(self.effects)

    @cached_property
    def log_share(self) -> float:
        """Log prior share of its forms and places among those that its effects may have.

        An effect that acts more than once, in several records or in one in addition to all, pays for every further
        time; how many records it acts in, and which, is as probable beforehand as any other.
        """
        return sum(self._log_share(name) for name in self.effects)

    def _log_share(self, name: str) -> float:
        causes = [cause for cause in self.causes if cause.effect.name == name]
        effect, views = causes[0].effect, len(self.refit.model.views)
        share = -len(causes) * log(len(effect.forms)) + (len(causes) - 1) * log(EVIDENCE.again_in_another_record)
        if any(cause.records is None for cause in causes):
            share -= log(max(len(effect.placements(cause.form)) for cause in causes))
        alone = {cause.records: len(effect.placements(cause.form)) for cause in causes if cause.records is not None}
        if alone:
            share -= log(max(alone.values()) * comb(views, len(alone)))
            if len(alone) > 1:
                share -= log(views - 1)
        return share

    @property
    def records(self) -> tuple[str, ...]:
        """Ids of the records that the causes touch, in the campaign's order."""
        touched = {view.id for view in self.refit.model.views for cause in self.causes if cause.touches(view.id)}
        return tuple(view.id for view in self.refit.model.views if view.id in touched)
