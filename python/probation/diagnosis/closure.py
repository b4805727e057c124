"""How far a gap shrinks (docs/diagnosis-method.md, section 8)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import ndtr, stdtrit

from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel


@dataclass(frozen=True)
class Closure:
    """The gap before and after an explanation, against the noise's floor.

    Attributes
    ----------
    before_MPa, after_MPa : float
        Root mean square of the fit residual with the base law and with the explanation, every sample with its
        `NoiseModel.weight`.
    noise_MPa : float
        Of the noise, by the same weights.
    closure : float or None
        1 - (after^2 - noise^2)/(before^2 - noise^2), not clipped; None where before^2 - noise^2 is below two of its
        standard errors.
    interval : (float, float) or None
        90 %.
    how : str
        Where the interval comes from, in words.
    """

    before_MPa: float  # noqa: N815 - as it leaves the program
    after_MPa: float  # noqa: N815
    noise_MPa: float  # noqa: N815
    closure: float | None
    interval: tuple[float, float] | None
    how: str

    def to_dict(self) -> dict[str, Any]:
        """As in `shrink` of docs/formats.md."""
        return {
            "before_MPa": self.before_MPa,
            "after_MPa": self.after_MPa,
            "noise_MPa": self.noise_MPa,
            "closure": self.closure,
            "interval": self.interval,
            "how": self.how,
        }


@dataclass(frozen=True, eq=False)
class Piece:
    """One record, or a part of it, before and after an explanation.

    Attributes
    ----------
    before, after : ndarray, shape (n,) [MPa]
        Fit residuals.
    noise : NoiseModel
        Of the whole record.
    inside : slice, optional
        Which of the record's samples these are; all if left out.
    region : bool
        Whether it stands for itself: then its samples' weights have the mean 1, else the record's.
    """

    before: FloatArray
    after: FloatArray
    noise: NoiseModel
    inside: slice | None = None
    region: bool = False

    @property
    def squares(self) -> tuple[float, float, float]:
        """Sums of squares before and after, and of the noise's variance [MPa^2], by the samples' weights."""
        noise = self._own(self.noise.deviation)
        return self._sum(self.before**2), self._sum(self.after**2), self._sum(noise**2)

    @property
    def both(self) -> float:
        """Sum of the products of what was there before and after [MPa^2]."""
        return self._sum(self.before * self.after)

    @cached_property
    def _weight(self) -> FloatArray:
        weight = self._own(self.noise.weight)
        return weight / np.mean(weight) if self.region else weight

    def _own(self, values: FloatArray) -> FloatArray:
        return values if self.inside is None else values[self.inside]

    def _sum(self, values: FloatArray) -> float:
        return float(self._weight @ values)

    def blocks(self) -> list[Piece]:
        """Contiguous parts of a whole record."""
        parts = np.array_split(np.arange(len(self.before)), EVIDENCE.closure_blocks)
        return [
            Piece(self.before[part], self.after[part], self.noise, slice(int(part[0]), int(part[-1]) + 1))
            for part in parts
            if part.size
        ]


def closure_of(pieces: Sequence[Piece], rng: np.random.Generator) -> Closure:
    """Closure over records, with its interval.

    Six records or more are resampled; fewer keep their places, and the noise is drawn; of one record contiguous parts
    are resampled. The noise level's own error is in every draw.

    Parameters
    ----------
    pieces : sequence of Piece
    rng : numpy.random.Generator
    """
    count = np.array([len(piece.before) for piece in pieces], dtype=np.float64)
    before, after, floor = np.transpose([piece.squares for piece in pieces])
    level = np.sqrt([piece.noise.level_variance + piece.noise.shape_variance for piece in pieces])
    total = float(count.sum())
    excess = float(before.sum() - floor.sum())
    # Sum of squares of correlated noise scatters as if there were fewer samples.
    own = np.sqrt(2.0 * np.array([piece.noise.square_inflation for piece in pieces]) / count) * floor
    error = float(np.sqrt(np.sum(own**2 + (level * floor) ** 2)))
    known = (
        float(np.sqrt(before.sum() / total)),
        float(np.sqrt(after.sum() / total)),
        float(np.sqrt(floor.sum() / total)),
    )
    if not excess > EVIDENCE.closure_gap * error:
        return Closure(
            *known, None, None, f"the gap is not above {EVIDENCE.closure_gap:g} standard errors of the noise"
        )
    value = 1.0 - float(after.sum() - floor.sum()) / excess
    if len(pieces) == 1 and pieces[0].inside is None:
        parts = pieces[0].blocks()
        if len(parts) > 2:
            interval = closure_of_blocks(parts, rng)
            return Closure(*known, value, interval, "contiguous parts of the one record, resampled")
    if len(pieces) >= EVIDENCE.fewest_resampled:
        chosen = rng.integers(len(pieces), size=(EVIDENCE.closure_draws, len(pieces)))
        how = "records resampled, the noise level's error included"
        noise = np.exp(level * rng.standard_normal((EVIDENCE.closure_draws, len(pieces))))
        draws = _ratio(before[chosen], after[chosen], np.take_along_axis(floor * noise, chosen, axis=1))
    else:
        how = "from simulated noise, since there are too few records to resample"
        left = np.maximum(before - floor, 0.0), np.maximum(after - floor, 0.0)
        # The same noise meets what there was of a gap and what is left of it, as far as they are correlated.
        both = np.array([piece.both for piece in pieces]) - floor
        correlation = np.clip(both / np.maximum(np.sqrt(left[0] * left[1]), 1e-300), -1.0, 1.0)
        slow = np.array([piece.noise.slow_inflation for piece in pieces])
        common, first, apart = rng.standard_normal((3, EVIDENCE.closure_draws, len(pieces)))
        met = first, correlation * first + np.sqrt(1.0 - correlation**2) * apart
        drawn = [
            squares + own * common + 2.0 * np.sqrt(part * floor / count * slow) * cross
            for squares, part, cross in zip((before, after), left, met, strict=True)
        ]
        draws = _ratio(
            drawn[0], drawn[1], floor * np.exp(level * rng.standard_normal((EVIDENCE.closure_draws, len(pieces))))
        )
    return Closure(
        *known, value, _interval(draws, value, len(pieces) if len(pieces) >= EVIDENCE.fewest_resampled else None), how
    )


def closure_of_blocks(parts: Sequence[Piece], rng: np.random.Generator) -> tuple[float, float]:
    """Interval from parts of one record."""
    before, after, floor = np.transpose([piece.squares for piece in parts])
    chosen = rng.integers(len(parts), size=(EVIDENCE.closure_draws, len(parts)))
    level = np.sqrt(parts[0].noise.level_variance + parts[0].noise.shape_variance)
    draws = _ratio(
        before[chosen], after[chosen], floor[chosen] * np.exp(level * rng.standard_normal((EVIDENCE.closure_draws, 1)))
    )
    value = 1.0 - float(after.sum() - floor.sum()) / float(before.sum() - floor.sum())
    return _interval(draws, value, len(parts))


def _ratio(before: FloatArray, after: FloatArray, floor: FloatArray) -> FloatArray:
    below = before.sum(axis=1) - floor.sum(axis=1)
    return np.asarray(1.0 - (after.sum(axis=1) - floor.sum(axis=1)) / np.where(below > 0.0, below, np.nan))


def _interval(draws: FloatArray, value: float, resampled: int | None = None) -> tuple[float, float]:
    """Quantiles of the draws; of so few resampled parts further out: "expanded percentiles" (Hesterberg 2015)."""
    tail = 0.5 - 0.5 * EVIDENCE.closure_coverage
    if resampled is not None:
        tail = float(ndtr(np.sqrt(resampled / (resampled - 1.0)) * stdtrit(resampled - 1, tail)))
    low, high = np.nanquantile(draws, [tail, 1.0 - tail])
    return float(min(low, value)), float(max(high, value))
