"""Causes that are put into a series, and the signals of all that might have been."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.causes import BEYOND, COMMON, Cause, Change, Form
from probation_studies.blind.laboratories.institute.modal import FloatArray
from probation_studies.blind.laboratories.institute.names import name_of
from probation_studies.blind.laboratories.institute.oracle import Placed
from probation_studies.blind.laboratories.institute.sight import Sight, added

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.institute.series import Test

_LEAST, _MOST = 4.0, 100.0
_STRONGER = 2.5
"""Of the least sqrt(lambda): for pairs, and for what lies outside, of which the nearest cause takes a part."""
_ROUNDS, _NEAR, _POWERS = 8, 0.1, (0.3, 8.0)
_UNSEEN = 0.05
"""Norm of a usual amplitude's signal below which no record shows a cause."""


@dataclass(frozen=True, eq=False)
class Planted:
    """A cause at work; `record` is its place among the identified ones, None for all.

    `columns` are what it adds to the identified records [MPa], `signal` the same, whitened, orthogonal to the base law.
    """

    cause: Cause
    form: Form
    shape: dict[str, float]
    amplitude: float
    record: int | None
    columns: tuple[FloatArray, ...]
    signal: FloatArray

    @property
    def size(self) -> float:
        """sqrt(lambda)."""
        return float(np.linalg.norm(self.signal))

    def change(self, test: Test, place: int | None) -> list[Change]:
        """What it does to a test; a held-out one (None) has what acts everywhere."""
        here = self.record is None or self.record == place
        return [self.form.change(test, self.amplitude, self.shape)] if here else []


def plant_all(random: Generator, sight: Sight, causes: Sequence[Cause]) -> list[Planted] | None:
    """All causes with drawn forms, places and sizes; None where one of them does not show."""
    planted = []
    for cause in causes:
        least = _LEAST * (_STRONGER if len(causes) > 1 or cause in BEYOND else 1.0)
        found = plant(random, sight, cause, float(np.exp(random.uniform(np.log(least), np.log(_MOST)))))
        if found is None:
            return None
        planted.append(found)
    return planted


def plant(random: Generator, sight: Sight, cause: Cause, target: float) -> Planted | None:
    """With the amplitude that has the wanted sqrt(lambda), or the largest; None where that does not show."""
    form = cause.forms[int(random.integers(len(cause.forms)))]
    shape = form.draw(random)
    sign = -1.0 if cause.signed and random.uniform() < 0.5 else 1.0
    record = int(random.integers(len(sight.tests))) if cause.rig and random.uniform() < 0.5 else None
    amplitude, before, power = cause.scale, None, 1.0
    for _ in range(_ROUNDS):
        columns = tuple(
            added(test, [form.change(test, sign * amplitude, shape)])[:, 0]
            if record in (None, k)
            else np.zeros(len(sight.deviating[k]))
            for k, test in enumerate(sight.tests)
        )
        if not all(np.all(np.isfinite(each)) for each in columns):
            return None
        signal = sight.left(sight.whitened(columns))
        size = float(np.linalg.norm(signal))
        if size < 1e-6 or (amplitude == cause.largest and size < target):
            break
        if abs(np.log(target / size)) < _NEAR:
            break
        # Secants of the logarithms: what goes with a power of the amplitude would be overshot ever further.
        here = np.log(amplitude), np.log(size)
        if before is not None and here[0] != before[0]:
            power = float(np.clip((here[1] - before[1]) / (here[0] - before[0]), *_POWERS))
        before = here
        amplitude = min(amplitude * float(np.clip((target / size) ** (1.0 / power), 0.01, 30.0)), cause.largest)
    else:
        return None  # the signal would be that of another amplitude
    if not (1.0 - _NEAR) * _LEAST <= size <= (1.0 + 2.0 * _NEAR) * _MOST:
        return None
    return Planted(cause, form, shape, sign * amplitude, record, columns, signal)


def placed(planted: Planted, count: int) -> Placed:
    """As a candidate of the oracle, among `count` records."""
    cause = planted.cause
    share = _share(cause, planted.record, count)
    return Placed(cause.name, name_of(cause.name), planted.record, share, planted.signal / planted.size)


def _share(cause: Cause, record: int | None, count: int) -> float:
    """A rig's fault sits everywhere or in one record."""
    return 1.0 if not cause.rig or count == 1 else 0.5 if record is None else 0.5 / count


def bank_of(random: Generator, sight: Sight) -> tuple[list[Placed], list[Placed]]:
    """All causes in all places at usual amplitudes, of drawn shapes: one form of each that is told, and all forms."""
    forms = [(cause, form, form.draw(random)) for cause in (*COMMON, *BEYOND) for form in cause.forms]
    chosen = {cause.name: cause.forms[int(random.integers(len(cause.forms)))].name for cause in (*COMMON, *BEYOND)}
    columns = sight.whitened(
        [added(test, [form.change(test, cause.scale, shape) for cause, form, shape in forms]) for test in sight.tests]
    )
    finite = np.all(np.isfinite(columns), axis=0)
    count = len(sight.tests)
    told, bank = [], []
    for record in (None, *(range(count) if count > 1 else ())):
        signals = sight.placed(columns[:, finite], record)
        for (cause, form, _), signal in zip(
            (each for each, is_finite in zip(forms, finite, strict=True) if is_finite), signals.T, strict=True
        ):
            size = float(np.linalg.norm(signal))
            if size < _UNSEEN or (record is not None and not cause.rig):
                continue
            share = _share(cause, record, count)
            bank.append(Placed(cause.name, name_of(cause.name), record, share, signal / size))
            if form.name == chosen[cause.name]:
                told.append(bank[-1])
    return told, bank
