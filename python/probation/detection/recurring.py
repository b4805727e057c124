"""Gaps that recur at one strain in every record: a neck that passes, a band, a scale that errs at one place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtr

from probation.detection.lines_and_steps import left_by_slow_waves
from probation.detection.tail import smallest_of_many
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.whitening import Whitened


@dataclass(frozen=True)
class Recurring:
    """The strongest bump that all records share at one strain.

    Attributes
    ----------
    true_strain : float
        Its middle.
    records : tuple of str
        That reach there.
    p_value : float
        Over all places and widths.
    """

    true_strain: float
    records: tuple[str, ...]
    p_value: float


def find_recurring(whitened: Whitened) -> tuple[Recurring, ...]:
    """Bumps at one strain that several records share, the least probable first.

    What each record's residual holds of a bump, slow waves and its own refit projected out, is added up over the
    records and compared with what they hold elsewhere (Student's t): a noise whose level or colour is taken
    wrongly is the same everywhere, but what a material does at one strain it does in every test.

    Parameters
    ----------
    whitened : Whitened
    """
    ends = [end(record.true_strain) for record in whitened.records for end in (np.min, np.max)]
    largest = float(max(ends, key=abs))  # negative in compression
    bumps = []
    for part in DETECTION.bump_widths:
        width = part * abs(largest)
        places = np.sign(largest) * np.arange(width, abs(largest), width)
        shares = {
            record.name: share
            for index, record in enumerate(whitened.records)
            if len(record) >= DETECTION.fewest_for_lines * DETECTION.slowest_line
            and (share := _share(whitened, index, places, width)) is not None
        }
        reached = np.sum([share.seen for share in shares.values()], axis=0)
        shared = np.flatnonzero(reached >= 2)
        if shared.size:
            bumps.append(_strongest(shares, places, shared))
    return tuple(sorted(bumps, key=lambda bump: bump.p_value))


@dataclass(frozen=True, eq=False)
class _Share:
    """What one record says of bumps at K places.

    Attributes
    ----------
    seen : ndarray of bool, shape (K,)
        Whether it reaches there.
    along : ndarray, shape (K,)
        Products of its residual with the bumps, whitened and projected.
    overlap : ndarray, shape (K, K)
        Products of these with each other.
    """

    seen: NDArray[np.bool_]
    along: FloatArray
    overlap: FloatArray


def _share(whitened: Whitened, index: int, places: FloatArray, width: float) -> _Share | None:
    away = (whitened.records[index].true_strain[:, None] - places) / width
    left, white = left_by_slow_waves(whitened, index, DETECTION.slowest_line)
    bumps = whitened.noises[index].whiten(np.exp(-0.5 * away**2))
    size = np.linalg.norm(bumps, axis=0)
    bumps = bumps - white @ (white.T @ bumps)
    seen = (np.count_nonzero(np.abs(away) < 1.0, axis=0) >= DETECTION.fewest_bump_samples) & (
        np.linalg.norm(bumps, axis=0) > DETECTION.hidden_bump_share * size
    )
    bumps[:, ~seen] = 0.0
    return _Share(seen, bumps.T @ left, bumps.T @ bumps) if seen.any() else None


def _strongest(shares: Mapping[str, _Share], places: FloatArray, shared: NDArray[np.intp]) -> Recurring:
    along = np.sum([share.along for share in shares.values()], axis=0)
    overlap = np.sum([share.overlap for share in shares.values()], axis=0)
    scores = along[shared] / np.sqrt(np.diag(overlap)[shared])
    best = int(np.argmax(np.abs(scores)))
    at = int(shared[best])
    squares, count, freedom = 0.0, 0, 0.0
    for share in shares.values():
        norm = np.sqrt(np.diag(share.overlap)[share.seen])
        rest = (share.along - along[at] / overlap[at, at] * share.overlap[:, at])[share.seen] / norm
        cosines = share.overlap[np.ix_(share.seen, share.seen)] / np.outer(norm, norm)
        squares += float(rest @ rest)
        count += len(norm)
        freedom += len(norm) ** 2 / float(np.sum(cosines**2))
    noise = max(float(np.sqrt(squares / count)), 1.0)
    # A burst of noise sits in one record: the other records must show the same.
    others = sorted(shares.values(), key=lambda share: -share.along[at] * scores[best])[1:]
    product = sum(float(share.along[at]) for share in others) * np.sign(scores[best])
    size = product / np.sqrt(sum(float(share.overlap[at, at]) for share in others)) / noise
    single = 2.0 * float(stdtr(max(freedom - 1.0, 1.0), -max(size, 0.0)))
    tried = len(DETECTION.bump_widths) * len(shared)
    p_value = smallest_of_many(single, tried)
    names = tuple(name for name, share in shares.items() if share.seen[at])
    return Recurring(float(places[at]), names, p_value)
