"""A set of causes with its refit and its evidence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

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

    @property
    def causes(self) -> tuple[Cause, ...]:
        """Empty for the base law."""
        return self.refit.model.causes

    @property
    def effects(self) -> tuple[str, ...]:
        """Names of the effects, sorted, each once."""
        return tuple(sorted({cause.effect.name for cause in self.causes}))

    @property
    def records(self) -> tuple[str, ...]:
        """Ids of the records that the causes touch, in the campaign's order."""
        touched = {view.id for view in self.refit.model.views for cause in self.causes if cause.touches(view.id)}
        return tuple(view.id for view in self.refit.model.views if view.id in touched)
