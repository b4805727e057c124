"""What happens at one instant of a record: where it may be, and how samples follow it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import EffectParameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_EVEN = tuple(np.linspace(0.05, 0.95, 19).tolist())

INSTANT = EffectParameter(
    name="instant_of_record",
    unit="",
    lower=0.0,
    upper=1.0,
    centre=0.5,
    scale=float("inf"),
    starts=_EVEN,
    reason="at any time",
)


def passed(view: RecordView, instant: float, duration: float = 0.0) -> FloatArray:
    """0 before an instant, 1 after it, both parts of the record; it lasts a duration, a sample at least; shape (n,)."""
    width = view.stride * float(np.median(np.diff(view.time))) + duration * view.duration
    part = np.clip((view.elapsed - instant * view.duration) / width + 0.5, 0.0, 1.0)
    return np.asarray(part**2 * (3.0 - 2.0 * part))


def likely_instants(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[float]:
    """An even grid and, with residuals, the two instants of each record where they jump most."""
    return [*_EVEN, *sudden_instants(views, residuals)]


def sudden_instants(
    views: Sequence[RecordView], residuals: Sequence[FloatArray] | None, *, near_jumps: bool = True
) -> list[float]:
    """The two instants of each record where residuals jump most; also, if wanted, where the strain's rate does."""
    instants = []
    for view, residual in zip(views, residuals or (), strict=False):
        window = max(len(residual) // 100, 2)
        means = np.convolve(residual, np.ones(window) / window, mode="valid")
        jump = np.abs(means[window:] - means[:-window])
        places = [] if near_jumps else [corner // view.stride - window for corner in view.jumps]
        for place in places:
            jump[max(place - 2 * window, 0) : max(place + 2 * window, 0)] = 0.0
        for _ in range(2):
            best = int(np.argmax(jump))
            if jump[best] == 0.0:
                break
            instant = view.sampled(view.elapsed)[best + window] / view.duration
            instants.append(float(np.clip(instant, 0.0, 1.0)))
            jump[max(best - 2 * window, 0) : best + 2 * window] = 0.0
    return instants
