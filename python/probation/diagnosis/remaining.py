"""Is there still a gap after an explanation, gap-method section 7."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.candidate import span_of
from probation.gap.gap_test import GapTest, GapTester

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.diagnosis.evidence import Discrepancy
    from probation.diagnosis.refit import Refit
    from probation.gap.whitening import Whitened

TOLERATED = 0.05
"""Relative error of an effect's form that is let pass: so much of what an effect does is not another effect's doing."""


def remaining_gap(found: Refit, base: Refit, whitened: Whitened, discrepancy: Discrepancy, *, seed: int) -> GapTest:
    """The gap test on what an explanation leaves, its parameters refitted, its form's error let pass.

    Parameters
    ----------
    found, base : Refit
        With and without the explanation's causes.
    whitened : Whitened
        At the base fit.
    discrepancy : Discrepancy
    seed : int
    """
    allowed = TOLERATED**2 * discrepancy.energy(found.residual - base.residual)
    span = span_of(_widened(found.jacobian, discrepancy, allowed))
    residual = _widened(found.residual, discrepancy, allowed)
    after = replace(whitened, residual=residual - span @ (span.T @ residual), span=span)
    return GapTester(after, size=2000, seed=seed)()


def _widened(values: FloatArray, discrepancy: Discrepancy, energy: FloatArray) -> FloatArray:
    """(I + B D B^T)^(-1/2) times whitened columns (N,) or (N, m)."""
    variances = discrepancy.variances(energy)
    shrink = 1.0 - 1.0 / np.sqrt(1.0 + variances)
    found = values.copy()
    for own, part, place in zip(discrepancy.columns, discrepancy.slices, discrepancy.places, strict=True):
        along = own.T @ values[part]
        weight = shrink[place] if values.ndim == 1 else shrink[place][:, None]
        found[part] -= own @ (weight * along)
    return found
