"""How long a diagnosis may take: beyond it the answer is the best one so far, and says what was not tried."""

from __future__ import annotations

from dataclasses import dataclass
from time import monotonic

from probation.errors import InputError
from probation.settings.search import SEARCH


class Budget:
    """Seconds of wall-clock time, counted from when it is made.

    Parameters
    ----------
    seconds : float, optional
        None: as long as it takes.

    Raises
    ------
    InputError
        If it is not positive.
    """

    def __init__(self, seconds: float | None = None) -> None:
        if seconds is not None and not 0.0 < seconds < float("inf"):
            raise InputError(f"budget: found {seconds!r}, expected a positive number of seconds")
        self.seconds = seconds
        self._start = monotonic()

    def spent(self, part: float = SEARCH.budget_of_search) -> bool:
        """Whether so much of it is gone."""
        return self.seconds is not None and monotonic() - self._start > part * self.seconds

    @property
    def why(self) -> str:
        """The reason for what was left out."""
        return f"not tried within the budget of {self.seconds:g} s"


@dataclass(frozen=True)
class CutShort:
    """How far a search came that its budget ended.

    Attributes
    ----------
    seconds : float
        The budget.
    completed : int
        Effects of an explanation up to which the search was done; 0 if not even with single ones.
    ended : frozenset of str
        Effects that were refitted by themselves to the end.
    """

    seconds: float
    completed: int
    ended: frozenset[str]

    @property
    def why(self) -> str:
        """The reason for an effect that was begun at most."""
        return f"not refitted to the end: the budget of {self.seconds:g} s was spent"

    def text(self, untried: int, effects: int) -> str:
        """That the budget ended the search, and before how many of the effects were refitted to the end."""
        left = (
            f"{untried} of {effects} effects were not refitted to the end" if untried else "not all was tried jointly"
        )
        return f"the budget of {self.seconds:g} s ended the search: {left}"
