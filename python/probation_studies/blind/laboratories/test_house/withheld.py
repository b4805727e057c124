"""What the truth says of a cause."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.planting import signal_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.test_house.causes import Effect
    from probation_studies.blind.laboratories.test_house.metric import Signals
    from probation_studies.blind.laboratories.test_house.planting import Planted
    from probation_studies.blind.laboratories.test_house.trial import Test

_LOCALISED = 0.3
"""Part of a record that a localised cause's window is shorter than."""
_MOST_OF_IT = 0.9


def described(planted: Planted, tests: Sequence[Test], base: Signals) -> dict[str, object]:
    """Of a cause at work.

    Parameters
    ----------
    planted : Planted
    tests : sequence of Test
        Before the law is refitted.
    base : Signals
        Stresses of their law.
    """
    effect, touched = planted.effect, [test for test in tests if planted.effect.touches(test)]
    windows, widest = _windows(tests, signal_of(tests, effect, base))
    return {
        "effect": effect.form.cause,
        "kind": effect.form.cause,
        "form": effect.form.name,
        "everywhere": effect.record is None,
        "records": [test.name for test in touched],
        "amplitude": _amplitude(effect, touched),
        "scale": effect.form.usual.amount,
        "shape": dict(effect.shape),
        "detectability": planted.size,
        "localised": 0.0 < widest < _LOCALISED,
        "windows": windows,
        "left_by_best_other": planted.left,
        "nearest": planted.nearest,
    }


def _amplitude(effect: Effect, touched: Sequence[Test]) -> float:
    """Signed, in the benchmark's units: a gain's excess, what a drift comes to, by how many seconds the strain lags."""
    signed, first = effect.amount * effect.shape.get("sign", 1.0), touched[0]
    match effect.form.cause, effect.form.name:
        case "force_gain", "section":
            return float((1.0 - 0.5 * signed) ** -2 - 1.0)
        case "force_drift", "warm_up":
            duration = max(float(test.history.time[-1]) for test in touched)
            return float(-signed * np.expm1(-duration / (effect.shape["part"] * first.longest)))
        case "force_strain_lag", "late_strain":
            return signed * first.shortest_interval
        case "force_strain_lag", "filter":
            return -signed * first.shortest_interval
    return signed


def _windows(tests: Sequence[Test], signals: Signals) -> tuple[list[dict[str, object]], float]:
    """The shortest stretch of every record with nine tenths of the squared signal; the largest part of a record."""
    found: list[dict[str, object]] = []
    widest = 0.0
    for test in tests:
        signal, time = signals.get(test.name), test.history.time
        if signal is None or not np.any(signal):
            continue
        squares = 0.5 * (signal[1:] ** 2 + signal[:-1] ** 2) * np.diff(time)
        through = np.concatenate([[0.0], np.cumsum(squares)])
        ends = np.searchsorted(through, through + _MOST_OF_IT * through[-1] * (1.0 - 1e-12))
        span, start, end = min((float(time[b] - time[a]), a, int(b)) for a, b in enumerate(ends) if b < len(time))
        strain = test.history.strain[test.history.at][start : end + 1]
        widest = max(widest, span / float(time[-1]))
        found.append(
            {
                "record": test.name,
                "time_s": [float(time[start]), float(time[end])],
                "true_strain": [float(strain.min()), float(strain.max())],
                "part": span / float(time[-1]),
            }
        )
    return found, widest
