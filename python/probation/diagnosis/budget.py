"""How long a diagnosis may take: beyond it the answer is the best one so far, and says what was not tried."""

from __future__ import annotations

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
