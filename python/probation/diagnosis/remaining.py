"""Is there still a gap after an explanation, gap-method section 7."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.form_error import form_columns
from probation.gap.gap_test import GapTest, GapTester
from probation.gap.whitener import Whitener

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.diagnosis.evidence import Discrepancy
    from probation.diagnosis.refit import Refit
    from probation.gap.whitening import Whitened

TOLERATED = 0.05
"""Relative error of an effect's form, record by record, that evidence takes for the effect's own."""

TOLD = 0.25
"""Part of what evidence lets pass beyond which a gap is told to be left: it is real, whatever its cause."""


def remaining_gap(
    found: Refit, base: Refit, whitened: Whitened, discrepancy: Discrepancy, *, seed: int, share: float = TOLD
) -> GapTest:
    """The gap test on what an explanation leaves, its parameters refitted, its form's error let pass.

    Parameters
    ----------
    found, base : Refit
        With and without the explanation's causes.
    whitened : Whitened
        At the base fit.
    discrepancy : Discrepancy
    seed : int
    share : float
        Part of the errors of a form, as evidence takes them, that is let pass.
    """
    energy = (share * TOLERATED) ** 2 * discrepancy.energy(found.residual - base.residual)
    allowed = np.hstack([discrepancy.factor(energy), share * form_columns(found, Whitener(whitened.noises))])
    both = _whitened_beside(allowed, np.column_stack([found.residual, found.jacobian]))
    return GapTester(whitened.beside(both[:, 0], both[:, 1:]), size=2000, seed=seed)()


def _whitened_beside(allowed: FloatArray, values: FloatArray) -> FloatArray:
    """(I + U U^T)^(-1/2) times whitened columns (N, m), U of shape (N, k)."""
    squares, turned = np.linalg.eigh(allowed.T @ allowed)
    seen = squares > 1e-9 * max(float(squares.max(initial=0.0)), 1e-300)
    size = np.sqrt(squares[seen])
    directions = allowed @ (turned[:, seen] / size)
    shrink = 1.0 - 1.0 / np.sqrt(1.0 + size**2)
    return np.asarray(values - directions @ (shrink[:, None] * (directions.T @ values)))
