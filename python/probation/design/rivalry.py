"""Every effect's signal against every other's, at any size of the one that is there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.design.discrimination import best_match, probability_of_the_right_one
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.design.effect_signals import EffectSignal

_HALVINGS = 30


@dataclass(frozen=True, eq=False)
class Rivalry:
    """Signals of effects, one of each of which stands for the effect where it is there.

    Attributes
    ----------
    names : tuple of str
        Of the effects.
    owner : ndarray of int, shape (m,)
        Whose signal each is, an index into `names`.
    chosen : tuple of int
        Which signal stands for each effect.
    left : ndarray, shape (n_samples, m)
        The signals, whitened and projected.
    sizes : ndarray, shape (m,)
        Their lengths.
    lower, upper : ndarray, shape (m,)
        Bounds of the amplitudes as multiples of the signals' own.
    """

    names: tuple[str, ...]
    owner: NDArray[np.intp]
    chosen: tuple[int, ...]
    left: FloatArray
    sizes: FloatArray
    lower: FloatArray
    upper: FloatArray

    @classmethod
    def of(cls, signals: Sequence[EffectSignal], left: FloatArray, sizes: FloatArray) -> Rivalry:
        """Of signals, whitened and projected: `left` (n_samples, m), with their lengths (m,)."""
        names = tuple(dict.fromkeys(signal.cause.effect.name for signal in signals))
        owner = np.array([names.index(signal.cause.effect.name) for signal in signals])
        chosen = tuple(_representative(signals, sizes, np.flatnonzero(owner == row)) for row in range(len(names)))
        reach = np.array([signal.reach for signal in signals])
        return cls(names, owner, chosen, left, sizes, reach[:, 0], reach[:, 1])

    def against(self, row: int) -> tuple[FloatArray, FloatArray]:
        """An effect that is there, in both signs if it may have both, against every effect.

        Parameters
        ----------
        row : int
            Which effect.

        Returns
        -------
        cosine, probability : ndarray, each of shape (n_names,)
            Of the likest match; of finding the right one more likely than the worst rival signal, the signs' mean.
        """
        truth = self.left[:, self.chosen[row]]
        return self._weighed(row, truth @ self.left, float(np.linalg.norm(truth)), 1.0)

    def length_to_name(self, row: int, truth: FloatArray, most: float) -> float | None:
        """sqrt(lambda) from which on an effect that looks like `truth` is discriminated from every other.

        None if it would have to be more than `most` times as large.
        """
        length, products = float(np.linalg.norm(truth)), truth @ self.left
        if length == 0.0:
            return None

        def named(factor: float) -> bool:
            return bool(np.all(self._weighed(row, products, length, factor)[1] >= DESIGN.discriminated))

        low, high = DESIGN.detected / length, max(most, DESIGN.detected / length)
        if not named(high):
            return None
        if named(low):
            return DESIGN.detected
        for _ in range(_HALVINGS):
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if named(middle) else (middle, high)
            if high < 1.01 * low:
                break
        return high * length

    def _weighed(self, row: int, products: FloatArray, length: float, factor: float) -> tuple[FloatArray, FloatArray]:
        sided = (self.lower == 0.0) | (self.upper == 0.0)
        one_sided = bool(sided[self.chosen[row]])
        cosines, chances = [], []
        for sign in (1.0,) if one_sided else (1.0, -1.0):
            cosine = best_match(factor * length, sign * factor * products, self.sizes, self.lower, self.upper)
            free, bound = (
                probability_of_the_right_one(
                    factor * length, cosine, one_sided=one_sided, rival_one_sided=rival_one_sided
                )
                for rival_one_sided in (False, True)
            )
            cosines.append(cosine)
            chances.append(np.where(sided, bound, free))
        best, worst = np.full(len(self.names), -1.0), np.ones(len(self.names))
        np.maximum.at(best, self.owner, np.max(cosines, axis=0))
        np.minimum.at(worst, self.owner, np.mean(chances, axis=0))
        best[row] = worst[row] = 1.0
        return best, worst


def _representative(signals: Sequence[EffectSignal], sizes: FloatArray, columns: NDArray[np.intp]) -> int:
    """Of the first form: the record where it shows best, the start whose signal is of middle length."""
    usual = [int(k) for k in columns if signals[k].usual]
    form = signals[usual[0]].cause.form.name
    first = [k for k in usual if signals[k].cause.form.name == form]
    best = signals[max(first, key=lambda k: sizes[k])].cause.records
    there = sorted((k for k in first if signals[k].cause.records == best), key=lambda k: sizes[k])
    return there[len(there) // 2]
