"""Parts of a whole with exact intervals."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from scipy.stats import beta


@dataclass(frozen=True)
class Rate:
    """k of n, with the exact binomial interval of 95 % (Clopper and Pearson 1934)."""

    k: int
    n: int

    @classmethod
    def of(cls, outcomes: Iterable[bool]) -> Rate:
        """How many of the outcomes are true."""
        found = [bool(each) for each in outcomes]
        return cls(sum(found), len(found))

    @property
    def value(self) -> float | None:
        """The part, k / n; None of nothing."""
        return self.k / self.n if self.n else None

    @property
    def interval(self) -> tuple[float, float]:
        """Bounds of the probability; 0 and 1 of nothing."""
        low = 0.0 if self.k == 0 else float(beta.ppf(0.025, self.k, self.n - self.k + 1))
        high = 1.0 if self.k == self.n else float(beta.ppf(0.975, self.k + 1, self.n - self.k))
        return low, high

    def plain(self) -> dict[str, object]:
        """As JSON has it."""
        return {"k": self.k, "n": self.n, "rate": self.value, "interval95": list(self.interval)}

    def __str__(self) -> str:
        if not self.n:
            return "none to score"
        low, high = self.interval
        return f"{100 * self.k / self.n:.1f} % ({self.k} of {self.n}; {100 * low:.1f} to {100 * high:.1f} %)"
