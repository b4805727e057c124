"""The effect whose own residual, of usual size, points most nearly where the campaign's does."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation.design.effect_signals import EffectSignal, effect_signals
from probation.effects.registry import effects
from probation.noise.span import without
from probation_studies.blind.solvers.survey import NONE, Scored, answer, survey

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def nearest_signature(folder: Path) -> dict[str, object]:
    """Compare whitened, refitted residuals by their cosine c, where the gap test finds a gap.

    A signature is what an effect of usual size leaves of the base law's refit, in all records or in one; an effect that
    has one sign only must point the same way. Its weight is that of normal errors of the residual's direction,
    exp(|z|^2 c^2 / 2).

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    found = survey(folder)
    if not found.gap:
        return answer(found, [NONE])
    base = found.base
    wanted = -base.whitened.residual  # model minus data: what is missing in the model
    signals = [each for each in effect_signals(base.model, base.parameters, effects())[0] if each.usual]
    scored: list[Scored] = []
    white = base.whitener.columns(np.stack([signal.stress for signal in signals], axis=1))
    parts = dict(zip((view.id for view in base.model.views), base.whitened.slices, strict=True))
    for signal, column in zip(signals, white.T, strict=True):
        for records, signature in _placed(signal, column, parts):
            left = without(signature, base.whitened.span)
            size = float(np.linalg.norm(left))
            if size < 1e-4 * float(np.linalg.norm(signature)) or size == 0.0:
                continue
            along = float(left @ wanted) / size
            along = max(along, 0.0) if signal.one_sided else abs(along)
            scored.append((signal.cause.effect.name, 0.5 * along**2, records))
    return answer(found, scored)


def _placed(
    signal: EffectSignal, column: FloatArray, parts: dict[str, slice]
) -> list[tuple[tuple[str, ...] | None, FloatArray]]:
    """The signal where it may sit: as it is, and what it does in each record alone."""
    cause = signal.cause
    if cause.records is not None:
        return [(cause.records, column)]
    possible = cause.effect.placements(cause.form)
    found: list[tuple[tuple[str, ...] | None, FloatArray]] = [(None, column)] if "all" in possible else []
    if "one" in possible:
        for record, part in parts.items():
            alone = np.zeros_like(column)
            alone[part] = column[part]
            found.append(((record,), alone))
    return found
