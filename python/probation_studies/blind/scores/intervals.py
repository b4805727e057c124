"""Parts of a whole, means and medians, each with its interval of 95 %."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import beta, binom, t

DRAWS = 2000
"""Of a bootstrap."""


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


@dataclass(frozen=True)
class Average:
    """A mean, a median or a ratio of n numbers, with an interval of 95 %; None where there are too few."""

    n: int
    value: float | None
    interval: tuple[float, float] | None

    @classmethod
    def mean(cls, numbers: Sequence[float]) -> Average:
        """The mean, with Student's interval; of two or more."""
        n = len(numbers)
        if not n:
            return cls(0, None, None)
        value = float(np.mean(numbers))
        if n < 2:
            return cls(n, value, None)
        reach = float(t.ppf(0.975, n - 1) * np.std(numbers, ddof=1) / np.sqrt(n))
        return cls(n, value, (value - reach, value + reach))

    @classmethod
    def median(cls, numbers: Sequence[float]) -> Average:
        """The median, between order statistics that hold it with 95 % or more whatever the distribution; of six on."""
        n = len(numbers)
        if not n:
            return cls(0, None, None)
        ranked = np.sort(numbers)
        below = int(binom.ppf(0.025, n, 0.5))  # so many lie below the lower end: P(fewer below the median) <= 2.5 %
        ends = (float(ranked[below - 1]), float(ranked[n - below])) if below else None
        return cls(n, float(np.median(ranked)), ends)

    @classmethod
    def ratio(cls, over: Sequence[float], under: Sequence[float]) -> Average:
        """The ratio of two means over the same n campaigns; None where the lower one is 0.

        Bootstrapped by campaign, percentiles; of six on. Of 26 answer sets such an interval holds the ratio in 88 to
        93 % of repeats.
        """
        n = len(over)
        if not sum(under):
            return cls(n, None, None)
        pairs = np.array([over, under], dtype=np.float64)
        drawn = pairs[:, np.random.default_rng(0).integers(n, size=(DRAWS, n))].sum(axis=2)
        low, high = np.quantile(drawn[0] / drawn[1], [0.025, 0.975])
        return cls(n, float(pairs[0].sum() / pairs[1].sum()), (float(low), float(high)) if n > 5 else None)

    @property
    def ends(self) -> list[float] | None:
        """The interval as JSON has it."""
        return None if self.interval is None else list(self.interval)

    def plain(self) -> dict[str, object]:
        """As JSON has it."""
        return {"n": self.n, "value": self.value, "interval95": self.ends}
