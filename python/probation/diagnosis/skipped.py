"""Hypotheses that a diagnosis leaves out, and why: none of them ends it (docs/diagnosis-method.md, section 4)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from probation.inference.candidate import cause_key
from probation.inference.unsolvable import UNSOLVABLE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from probation.diagnosis.hypothesis import Hypothesis
    from probation.effects.cause import Cause
    from probation.inference.candidate import Key

Value = TypeVar("Value")


@dataclass(frozen=True)
class Skipped:
    """Effects that were left out in some form and place, alone or jointly.

    Attributes
    ----------
    effects : tuple of str
        Sorted; empty where a part of the answer is left out.
    why : str
        The reason; of several forms and places the first one's.
    count : int
        Forms and places that were left out.
    """

    effects: tuple[str, ...]
    why: str
    count: int = 1

    def to_dict(self) -> dict[str, Any]:
        """As in `skipped` of docs/formats.md."""
        return {"effects": list(self.effects), "why": self.why, "count": self.count}


@dataclass
class Skipping:
    """Takes note of what is left out while a diagnosis runs."""

    _hypotheses: list[tuple[frozenset[Key], str]] = field(default_factory=list)
    _parts: list[str] = field(default_factory=list)

    def hypothesis(self, causes: Iterable[Cause], why: object) -> None:
        """A set of causes could not be solved from one start, or was not tried."""
        self._hypotheses.append((frozenset(cause_key(cause) for cause in causes), str(why)))

    def screened(self, cause: Cause, error: Exception) -> None:
        """A single cause could not be solved."""
        self.hypothesis([cause], error)

    def part(self, what: str, why: object) -> None:
        """A part of the answer was left out."""
        self._parts.append(f"{what}: {why}")

    def tried(self, what: str, work: Callable[[], Value]) -> Value | None:
        """What `work` gives; None, and a note, where a law cannot be solved in it."""
        try:
            return work()
        except UNSOLVABLE as error:
            self.part(what, error)
            return None

    def entries(self, found: Sequence[Hypothesis], untried: Mapping[str, str] | None = None) -> tuple[Skipped, ...]:
        """What was left out, without the hypotheses that were solved from another start.

        A combination is not listed where one of its effects is.

        Parameters
        ----------
        found : sequence of Hypothesis
            All that were solved.
        untried : dict of str to str, optional
            Effects that were not refitted to the end, though a form of theirs may have been solved, and why.
        """
        solved = {hypothesis.refit.keys for hypothesis in found}
        reasons: dict[tuple[str, ...], dict[frozenset[Key], str]] = {}
        for keys, why in self._hypotheses:
            if keys not in solved:
                reasons.setdefault(tuple(sorted({key[0] for key in keys})), {}).setdefault(keys, why)
        for name, why in (untried or {}).items():
            reasons.setdefault((name,), {frozenset(): why})
        hypotheses = [
            Skipped(effects, next(iter(own.values())), len(own))
            for effects, own in sorted(reasons.items())
            if not any(set(other) < set(effects) for other in reasons)
        ]
        return (*hypotheses, *(Skipped((), why) for why in dict.fromkeys(self._parts)))
