"""Nuisance drift: slow noise that resembles no effect. What resembles one is reported as that effect.

The part of a drift d of covariance D along an effect of (whitened) unit direction u is u^T d. A drift with the form of
a warming load cell is an effect, not noise. So u^T d is known to be small, within s = `NOISE.nuisance_drift_size` of
the noise along u, for the signals of all effects. What is known of d then is D conditioned on that,

    H = D - D U (U^T D U + s^2 I)^-1 U^T D,

which keeps all slow noise that no effect makes, and does not take a single effect for noise.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import block_diag, qr

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.whitening import Whitened


def nuisance_drift(whitened: Whitened, waves: Sequence[FloatArray], signals: FloatArray | None = None) -> FloatArray:
    """Covariance of the rest of the drift along smooth waves, shape (d, d).

    Parameters
    ----------
    whitened : Whitened
        Whose noises tell their drift.
    waves : sequence of ndarray, shape (n_r, d_r)
        Whitened, orthonormal, by record; d in all.
    signals : ndarray, shape (N, n_signals), optional
        Whitened signals of effects; without any the drift may be like all.
    """
    blocks = []
    for own, noise in zip(waves, whitened.noises, strict=True):
        rest = np.zeros((own.shape[1], 0))
        if noise.nuisance_drift is not None:
            rest = own.T @ noise.whiten(noise.nuisance_drift)
        blocks.append(rest @ rest.T)
    drift = np.asarray(block_diag(*blocks), dtype=np.float64)
    if signals is None or not drift.any():
        return drift
    seen = whitened.project(signals)
    norm = np.linalg.norm(seen, axis=0)
    whole = np.linalg.norm(signals, axis=0)
    seen = seen[:, norm > 1e-4 * whole] / norm[norm > 1e-4 * whole]
    along = np.vstack([own.T @ seen[part] for own, part in zip(waves, whitened.slices, strict=True)])
    # In coordinates in which the drift is white, too, a signal u has the norm |(I + D)^(-1/2) u|.
    quiet = np.linalg.solve(np.eye(len(drift)) + drift, along)
    size = 1.0 - np.sum(along**2, axis=0) + np.sum(along * quiet, axis=0)
    constrained = quiet / np.sqrt(size)
    values, vectors = np.linalg.eigh(drift)
    _, upper, order = qr(
        np.sqrt(np.maximum(values, 0.0))[:, None] * (vectors.T @ constrained), mode="economic", pivoting=True
    )
    count = int(np.count_nonzero(np.diag(upper) ** 2 > NOISE.known_drift_variance))
    constrained = constrained[:, order[:count]]
    spread = drift @ constrained
    return np.asarray(
        drift
        - spread @ np.linalg.solve(constrained.T @ spread + NOISE.nuisance_drift_size**2 * np.eye(count), spread.T)
    )
