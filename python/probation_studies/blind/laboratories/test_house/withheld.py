"""What the truth says of a cause."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.oracle import discriminability
from probation_studies.blind.laboratories.test_house.planting import signal_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.test_house.metric import Signals
    from probation_studies.blind.laboratories.test_house.planting import Planted, Rival
    from probation_studies.blind.laboratories.test_house.trial import Test

_LOCALISED = 0.3
"""Part of a record that a localised cause's window is shorter than."""
_MOST_OF_IT = 0.9


def described(planted: Planted, tests: Sequence[Test], base: Signals, others: Sequence[Rival]) -> dict[str, object]:
    """Of a cause at work.

    Parameters
    ----------
    planted : Planted
    tests : sequence of Test
        Before the law is refitted.
    base : Signals
        Stresses of their law.
    others : sequence of Rival
    """
    effect, unit = planted.effect, planted.signal / np.linalg.norm(planted.signal)
    alike: dict[str, float] = {}
    for each in others:
        cosine = abs(float(unit @ each.signal)) / float(np.linalg.norm(each.signal))
        alike[each.form.cause] = max(alike.get(each.form.cause, 0.0), min(cosine, 1.0))
    windows, widest = _windows(tests, signal_of(tests, effect, base))
    return {
        "effect": effect.form.cause,
        "kind": effect.form.cause,
        "form": effect.form.name,
        "everywhere": effect.record is None,
        "records": [test.name for test in tests if effect.touches(test)],
        "amplitude": effect.amount,
        "scale": effect.form.usual.amount,
        "shape": dict(effect.shape),
        "detectability": planted.size,
        "localised": 0.0 < widest < _LOCALISED,
        "windows": windows,
        "alike": alike,
        "discriminability": {name: discriminability(planted.size, cosine) for name, cosine in alike.items()},
        "left_by_best_other": planted.left,
        "nearest": planted.nearest,
    }


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
