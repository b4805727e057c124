"""The effect of the largest screen score, where the gap test finds a gap."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from probation.noise.span import without
from probation_studies.blind.solvers.survey import NONE, answer, survey


def score_screen(folder: Path) -> dict[str, object]:
    """Rank every effect by its best score, S = (s^T z)^2 / |s|^2 of its projected column; exp(S / 2) is its weight.

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    found = survey(folder)
    if not found.gap:
        return answer(found, [NONE])
    whitened = found.base.whitened
    seen = without(found.columns.matrix, whitened.span)
    size = np.sum(seen**2, axis=0)
    whole = np.sum(found.columns.matrix**2, axis=0)
    score = (seen.T @ whitened.residual) ** 2 / np.where(size > 1e-8 * whole, size, np.inf)
    causes = [column.cause for column in found.columns.columns]
    return answer(found, ((c.effect.name, each, c.records) for c, each in zip(causes, 0.5 * score, strict=True)))
