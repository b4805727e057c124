"""A planted cause in the words of a truth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.placing import left_by_others, likeness
from probation_studies.blind.laboratory.truth import Window, WithheldCause

if TYPE_CHECKING:
    from probation_studies.blind.laboratory.bank import Bank
    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.placing import Planted

_PART = 0.9
_NEGLIGIBLE = 0.01
"""Part of the whole squared signal below which a record is not said to show it."""


def describe(bank: Bank, planted: Planted) -> WithheldCause:
    """What is withheld of a cause."""
    cause = planted.acting.cause
    bench = bank.bench
    touched = bench.identified if planted.record is None else [planted.record]
    alone, pair, _ = left_by_others(bank.signals, planted.column, (cause.name,))
    return WithheldCause(
        effect=cause.answer,
        kind=cause.name,
        everywhere=planted.record is None,
        records=tuple(bench.ids[k] for k in touched),
        amplitude=planted.acting.amplitude,
        scale=cause.scale,
        shape={name: float(value) for name, value in planted.acting.shape.items()},
        detectability=planted.detectability,
        localised=cause.localised,
        windows=_windows(bank, planted, touched),
        alike=likeness(bank.signals, planted),
        left_by_best_other=alone,
        left_by_best_pair=pair,
    )


def _windows(bank: Bank, planted: Planted, touched: list[int]) -> tuple[Window, ...]:
    added = {k: bank.added(k, [(planted.acting,)])[0] for k in touched}
    whole = sum(float(np.sum(each**2)) for each in added.values())
    windows = []
    for k, signal in added.items():
        if np.sum(signal**2) < _NEGLIGIBLE * whole:
            continue
        test = bank.bench.tests[k]
        first, last = shortest_window(signal)
        strain = test.strain[first : last + 1]
        windows.append(
            Window(
                bank.bench.ids[k],
                (float(test.time[first]), float(test.time[last])),
                (float(strain.min()), float(strain.max())),
            )
        )
    return tuple(windows)


def shortest_window(signal: FloatArray) -> tuple[int, int]:
    """First and last sample of the shortest segment that holds nine tenths of the squares."""
    passed = np.concatenate([[0.0], np.cumsum(signal**2)])
    ends = np.searchsorted(passed, passed[:-1] + _PART * passed[-1])
    length = np.where(ends < len(passed), ends - np.arange(len(signal)), len(passed))
    first = int(np.argmin(length))
    return first, min(int(ends[first]) - 1, len(signal) - 1)
