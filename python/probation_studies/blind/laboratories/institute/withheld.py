"""What the truth says of a cause."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.names import UNKNOWN, name_of
from probation_studies.blind.laboratories.institute.oracle import Placed, discriminability

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.institute.modal import FloatArray
    from probation_studies.blind.laboratories.institute.planting import Planted
    from probation_studies.blind.laboratories.institute.sight import Sight

_LOCALISED = 0.3
"""Part of a record that a localised cause's window is shorter than."""


def described(planted: Planted, sight: Sight, bank: Sequence[Placed]) -> dict[str, object]:
    """What the truth says of a cause."""
    name, unit = name_of(planted.cause.name), planted.signal / planted.size
    alike: dict[str, float] = {}
    groups: dict[tuple[str, int | None], list[FloatArray]] = {}
    for each in bank:
        if each.cause != planted.cause.name:
            alike[each.cause] = max(alike.get(each.cause, 0.0), min(abs(float(unit @ each.signal)), 1.0))
        if each.name not in (name, UNKNOWN):
            groups.setdefault((each.cause, each.record), []).append(each.signal)
    windows, widest = _windows(planted, sight)
    return {
        "effect": name,
        "kind": planted.cause.name,
        "form": planted.form.name,
        "everywhere": planted.record is None,
        "records": [test.id for k, test in enumerate(sight.tests) if planted.record in (None, k)],
        "amplitude": planted.amplitude,
        "scale": planted.cause.scale,
        "shape": planted.shape,
        "detectability": planted.size,
        "localised": 0.0 < widest < _LOCALISED,
        "windows": windows,
        "alike": alike,
        "discriminability": {other: discriminability(planted.size, cosine) for other, cosine in alike.items()},
        "left_by_best_other": min((_left(planted.signal, group) for group in groups.values()), default=planted.size),
    }


def _left(signal: FloatArray, others: Sequence[FloatArray]) -> float:
    """Norm that the span of others leaves of a signal."""
    basis = np.linalg.qr(np.stack(others, axis=1))[0]
    return float(np.linalg.norm(signal - basis @ (basis.T @ signal)))


def _windows(planted: Planted, sight: Sight) -> tuple[list[dict[str, object]], float]:
    """The shortest stretch of every record with nine tenths of the squared signal; the largest part of a record."""
    found: list[dict[str, object]] = []
    widest = 0.0
    for test, column in zip(sight.tests, planted.columns, strict=True):
        samples = test.path.samples
        time, strain = test.time[::2][samples], test.strain[::2][samples]
        through = np.concatenate([[0.0], np.cumsum(0.5 * (column[1:] ** 2 + column[:-1] ** 2) * np.diff(time))])
        if through[-1] <= 0.0:
            continue
        ends = np.searchsorted(through, through + 0.9 * through[-1] * (1.0 - 1e-12))
        spans = [(float(time[b] - time[a]), a, int(b)) for a, b in enumerate(ends) if b < len(time)]
        span, a, b = min(spans)
        inside = strain[a : b + 1]
        widest = max(widest, span / float(time[-1]))
        found.append(
            {
                "record": test.id,
                "time_s": [float(time[a]), float(time[b])],
                "true_strain": [float(inside.min()), float(inside.max())],
                "part": span / float(time[-1]),
            }
        )
    return found, widest
