"""How free numbers are drawn, and what is usual of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator


@dataclass(frozen=True)
class Even:
    """Evenly between two ends."""

    first: float
    last: float

    @property
    def middle(self) -> float:
        """In the middle."""
        return 0.5 * (self.first + self.last)

    def draw(self, random: Generator) -> float:
        """Draw one."""
        return self.first + (self.last - self.first) * random.uniform()


@dataclass(frozen=True)
class LogEven:
    """Evenly in the logarithm."""

    low: float
    high: float

    @property
    def middle(self) -> float:
        """The geometric mean."""
        return float(np.sqrt(self.low * self.high))

    def draw(self, random: Generator) -> float:
        """Draw one."""
        return float(np.exp(random.uniform(np.log(self.low), np.log(self.high))))


@dataclass(frozen=True)
class OneOf:
    """One of some values, the usual one first."""

    values: tuple[float, ...]

    @property
    def middle(self) -> float:
        """The first."""
        return self.values[0]

    def draw(self, random: Generator) -> float:
        """Draw one."""
        return float(random.choice(self.values))


Free: TypeAlias = Even | LogEven | OneOf
"""A number that is drawn."""
