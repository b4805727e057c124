"""The effect of the largest screen score, where the gap test finds a gap."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from probation.blind.solvers.survey import answer, survey
from probation.gap.span import without


def score_screen(folder: Path) -> dict[str, object]:
    """Rank every effect by its best score, S = (s^T z)^2 / |s|^2 of its projected column; exp(S / 2) is its weight.

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    found = survey(folder)
    if not found.gap:
        return answer(found, {"": 0.0}, {})
    whitened = found.base.whitened
    seen = without(found.columns.matrix, whitened.span)
    size = np.sum(seen**2, axis=0)
    whole = np.sum(found.columns.matrix**2, axis=0)
    score = (seen.T @ whitened.residual) ** 2 / np.where(size > 1e-8 * whole, size, np.inf)
    best: dict[str, float] = {}
    place: dict[str, tuple[str, ...] | None] = {}
    for column, each in zip(found.columns.columns, score.tolist(), strict=True):
        name = column.cause.effect.name
        if 0.5 * each > best.get(name, -np.inf):
            best[name], place[name] = 0.5 * each, column.cause.records
    return answer(found, best, place)
