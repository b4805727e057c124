"""Is there a gap? The residual against "nothing but noise" (docs/diagnosis-method.md, section 2)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.detection.tail import chi_square_tail, family_p_value, normal_tail
from probation.noise.joint_noise import jointly_whitened
from probation.noise.local_noise import local_noise_sd, samples_within
from probation.noise.smooth_basis import smooth_basis
from probation.noise.span import orthonormal, span_of, without
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.uncertain_scatter import UncertainScatter
    from probation.noise.whitening import Whitened

ABSORBED = 1e-8
"""Squared norm of a projected direction over the whole one's, below which the base parameters hide it altogether."""


@dataclass(frozen=True, eq=False)
class GapTest:
    """The answer to "is there a gap?".

    Attributes
    ----------
    p_value : float
    p_value_low_noise, p_value_high_noise : float
        The same if the noise were `low_noise` and `high_noise` of the settings times what is estimated.
    level : float
        Below which a gap is declared.
    statistics : dict of str to float
        T = |B_s^T z|^2 by what was looked for.
    p_values : dict of str to float
        Each alone: "smooth-2" ..., "record NAME", "effect NAME".
    scores : dict of str to float
        Signed score s~_k^T z / |s~_k| of each direction; standard normal without a gap. Negative where adding the
        effect to the model would close the gap.
    record_share : dict of str to float
        Each record's part of T over the smooth basis; sums to 1.
    """

    p_value: float
    p_value_low_noise: float
    p_value_high_noise: float
    level: float
    statistics: Mapping[str, float]
    p_values: Mapping[str, float]
    scores: Mapping[str, float]
    record_share: Mapping[str, float]

    @property
    def rejected(self) -> bool:
        """Whether there is a gap."""
        return self.p_value < self.level

    @property
    def robust(self) -> bool:
        """Whether the verdict is the same with less and with more noise."""
        return (self.p_value_low_noise < self.level) == (self.p_value_high_noise < self.level)


class GapTester:
    """The null distribution for one campaign: made once, asked as often as there are residuals.

    The statistic is the smallest p-value of a family: T = |B_s^T z|^2 on nested smooth bases, orthonormalised in
    P-space over all records (Neyman's smooth test, data-driven); the same on each record alone; and the scores along
    known effects, which need no more room than a smooth basis spends on what no effect could do. The family's own
    distribution is that of a parametric bootstrap with refit and with the level's own error (`Reduced`); the refit is
    linearised, which is a projection.

    Parameters
    ----------
    whitened : Whitened
    directions : dict of str to ndarray, shape (N,) or (N, m), optional
        Whitened, unprojected sensitivities of the model along effects' amplitudes; several columns are tried one by
        one (the nonlinear parameters that an effect may have).
    scatter : UncertainScatter, optional
        How far specimens differ, as replicates leave it open; left out, it is in the noise as estimated.
    size : int, optional
        Draws.
    seed : int
    """

    def __init__(
        self,
        whitened: Whitened,
        directions: Mapping[str, FloatArray] | None = None,
        *,
        scatter: UncertainScatter | None = None,
        size: int | None = None,
        seed: int = 0,
    ) -> None:
        if size is None:
            size = DETECTION.gap_draws if scatter is None else DETECTION.gap_draws_with_scatter
        self.whitened = whitened
        self._spread = whitened.scale_spread
        waves, order, owner = _smooth_columns(whitened)
        given = {name: np.reshape(columns, (len(whitened), -1)) for name, columns in (directions or {}).items()}
        self._reduced = whitened.reduced(np.hstack([waves, *given.values()]))
        span = self._reduced.of(whitened.span)
        # No wave is a sign of an effect that the rest of the drift makes, too.
        waves = self._with_drift(self._reduced.of(waves))
        waves = without(waves, span_of(self._with_drift(span)))
        smooth, kept = orthonormal(waves)
        full_order, order, parts = order, order[kept], [smooth]
        self._families: list[tuple[str, slice]] = []
        for most in DETECTION.smooth_orders:  # nested: the smoother columns come first
            count = int(np.count_nonzero(order < most))
            if count and (not self._families or count > self._families[-1][1].stop):
                self._families.append((f"smooth-{most}", slice(0, count)))
        self._nested = len(self._families)
        at = smooth.shape[1]
        if len(whitened.records) > 1:
            for index, record in enumerate(whitened.records):
                ours = waves[:, (owner == index) & (full_order < DETECTION.record_order)]
                columns = orthonormal(ours)[0]
                parts.append(columns)
                self._families.append((f"record {record.name}", slice(at, at + columns.shape[1])))
                at += columns.shape[1]
        self._effects: list[str] = []
        signals: list[FloatArray] = []
        for name, whole in given.items():
            size_of = np.sum(whole**2, axis=0)
            columns = without(self._reduced.of(whole), span)
            norm = np.sum(columns**2, axis=0)
            seen = norm > ABSORBED * np.maximum(size_of, 1e-300)
            parts.append(columns[:, seen] / np.sqrt(norm[seen]))
            signals.append(whole[:, seen] / np.sqrt(norm[seen]))
            self._effects += [name] * int(np.count_nonzero(seen))
        self._effect_slice = slice(at, at + len(self._effects))
        self._features = np.hstack(parts)
        self._directions = whitened.project(np.hstack(signals)) if signals else np.zeros((len(whitened), 0))
        rng = np.random.default_rng(seed)
        products = self._reduced.draws(self._features, rng, size, scatter)
        if self._effects:
            within = samples_within(self._directions)
            local_variance = rng.chisquare(within, (size, len(within))) / within
            products[:, self._effect_slice] /= np.sqrt(np.maximum(local_variance, 1.0))
        # How many independent directions the effects amount to, read off the draws' own tail.
        self._effective = 1.0
        if self._effects:
            largest = np.sort(np.max(np.abs(products[:, self._effect_slice]), axis=1))[::-1]
            rank = max(size // DETECTION.effective_one_in, 1)
            # Where specimens differ by far more than noise no tail is left: beyond 37 deviations draws are alike.
            single = max(float(2.0 * normal_tail(largest[rank - 1], self._spread)), 1e-300)
            self._effective = max(np.log1p(-rank / size) / np.log1p(-single), 1.0)
        self._drawn = self._smallest(products)

    def __call__(self, residual: FloatArray | None = None, level: float = DETECTION.gap_level) -> GapTest:
        """Test z, by default the campaign's own.

        Parameters
        ----------
        residual : ndarray, shape (N,), optional
            Whitened; projected or not.
        level : float
        """
        whitened = self.whitened
        z = whitened.residual if residual is None else residual
        seen = self._reduced.of(z)
        smooth, directed = np.split(self._features, [self._effect_slice.start], axis=1)
        directed_scores = directed.T @ seen / local_noise_sd(self._directions, z, whitened.slices)
        products = np.concatenate([smooth.T @ self._with_drift(seen), directed_scores])[None]
        single = self._p_values(products)
        levels = (1.0, DETECTION.low_noise, DETECTION.high_noise)
        p = [float(family_p_value(self._smallest(products / noise)[0], self._drawn)) for noise in levels]
        statistics = {name: float(np.sum(products[0, part] ** 2)) for name, part in self._families}
        scores: dict[str, float] = {}
        for name, score in zip(self._effects, products[0, self._effect_slice], strict=True):
            if abs(score) >= abs(scores.get(name, 0.0)):
                scores[name] = float(score)
        statistics |= {f"effect {name}": score**2 for name, score in scores.items()}
        values = {name: float(p[0]) for name, p in single.items()}
        values |= {f"effect {name}": float(2.0 * normal_tail(abs(s), self._spread)) for name, s in scores.items()}
        last = self._families[self._nested - 1][1]
        fitted = np.square(self._features[:, last] @ products[0, last])
        borders = np.cumsum([0, *(frame.shape[1] for frame in self._reduced.frames)])
        power = np.array([fitted[first:stop].sum() for first, stop in pairwise(borders)])
        share = power / max(float(power.sum()), 1e-300)
        names = [record.name for record in whitened.records]
        return GapTest(
            p[0], p[1], p[2], level, statistics, values, scores, dict(zip(names, share.tolist(), strict=True))
        )

    def _with_drift(self, values: FloatArray) -> FloatArray:
        """Reduced coordinates in which the rest of the drift is white, too."""
        white = values.copy()
        first = 0
        for frame, noise in zip(self._reduced.frames, self.whitened.noises, strict=True):
            part = slice(first, first + frame.shape[1])
            first = part.stop
            if noise.nuisance_drift is not None:
                white[part] = jointly_whitened(frame.T @ noise.whiten(noise.nuisance_drift), values[part])
        return white

    def _p_values(self, products: FloatArray) -> dict[str, FloatArray]:
        return {
            name: chi_square_tail(np.sum(products[:, part] ** 2, axis=1), part.stop - part.start, self._spread)
            for name, part in self._families
        }

    def _smallest(self, products: FloatArray) -> FloatArray:
        """The family's smallest p-value of each row of products."""
        single = self._p_values(products)
        whole = [p for name, p in single.items() if name.startswith("smooth")]
        own = [p for name, p in single.items() if name.startswith("record")]
        smooth = np.min(whole, axis=0) * len(whole)
        if own:
            smooth = np.minimum(smooth, np.min(own, axis=0) * len(own) * len(whole))
        if not self._effects:
            return np.asarray(smooth, dtype=np.float64)
        largest = np.max(np.abs(products[:, self._effect_slice]), axis=1)
        directed = self._effective * 2.0 * normal_tail(largest, self._spread)
        return np.asarray(
            np.minimum(directed / DETECTION.directed_share, smooth / (1.0 - DETECTION.directed_share)), dtype=np.float64
        )


def _smooth_columns(whitened: Whitened) -> tuple[FloatArray, NDArray[np.intp], NDArray[np.intp]]:
    """Whitened smooth waves of all records, the smoothest first; their orders, and the record each lives in."""
    bases = [smooth_basis(record.time, record.jumps) for record in whitened.records]
    order = np.concatenate([basis.order for basis in bases])
    owner = np.repeat(np.arange(len(bases)), [len(basis.order) for basis in bases])
    columns = np.zeros((len(whitened), len(order)))
    for index, (basis, part, noise) in enumerate(zip(bases, whitened.slices, whitened.noises, strict=True)):
        columns[part, owner == index] = noise.whiten(basis.columns)
    columns /= np.linalg.norm(columns, axis=0)
    ranking = np.argsort(order, kind="stable")
    return columns[:, ranking], order[ranking], owner[ranking]
