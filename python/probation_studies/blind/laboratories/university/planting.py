"""Causes that are put into a campaign, and signals of all that might have been."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.university.causes import COMMON, OUTSIDE, Act
from probation_studies.blind.laboratories.university.signals import added

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.causes import Cause, Form, Run
    from probation_studies.blind.laboratories.university.modal_law import FloatArray
    from probation_studies.blind.laboratories.university.signals import Bench

LEAST = 1.5
"""Detectability below which nothing is planted: half of what noise lets through at its limit of three."""
MOST = 150.0
_STEPS = 6


@dataclass(frozen=True, eq=False)
class Planted:
    """A cause that acts.

    Attributes
    ----------
    cause : Cause
    form : Form
    shape : dict
    amplitude : float
    record : int or None
        The identified record that it sits in, None for all.
    columns : tuple of ndarray, or None
        What it adds to every identified record [MPa].
    detectability : float
    """

    cause: Cause
    form: Form
    shape: dict[str, float]
    amplitude: float
    record: int | None
    columns: tuple[FloatArray | None, ...]
    detectability: float

    def act(self, run: Run, record: int | None) -> tuple[Act, ...]:
        """On a test; `record` is its place among the identified ones, None for a held-out one."""
        if self.record is not None and self.record != record:
            return ()
        return (self.form.act(run, self.amplitude, self.shape),)


def plant(random: Generator, bench: Bench, cause: Cause, target: float) -> Planted | None:
    """With the amplitude that has the wanted detectability, or the largest; None where that does not show."""
    form = cause.forms[int(random.integers(len(cause.forms)))]
    shape = form.draw(random, bench.design.setting)
    sign = -1.0 if cause.signed and random.uniform() < 0.5 else 1.0
    record = int(random.integers(len(bench.tests))) if cause.rig and random.uniform() < 0.5 else None
    amplitude = cause.scale
    columns: tuple[FloatArray | None, ...] = ()
    reached = 0.0
    for _ in range(_STEPS):
        columns = tuple(
            added(test.run, [(form.act(test.run, sign * amplitude, shape),)])[:, 0] if record in (None, k) else None
            for k, test in enumerate(bench.tests)
        )
        reached = bench.detectability(columns)
        if not np.isfinite(reached) or reached == 0.0:
            return None
        if abs(np.log(target / reached)) < 0.15 or (amplitude >= cause.largest and reached < target):
            break
        amplitude = min(amplitude * float(np.clip(target / reached, 1e-3, 1e3)), cause.largest)
    else:
        return None  # the signal would be that of another amplitude
    if reached < LEAST or reached > 2.0 * MOST:
        return None
    return Planted(cause, form, shape, sign * amplitude, record, columns, reached)


@dataclass(frozen=True, eq=False)
class Bank:
    """Signals of all forms at usual amplitudes, whitened, by record.

    Attributes
    ----------
    kinds : tuple of Cause
        Of every column.
    told : tuple of bool
        Whether the column is of the form that the oracle is told.
    blocks : tuple of ndarray, shape (n, n_columns)
    """

    kinds: tuple[Cause, ...]
    told: tuple[bool, ...]
    blocks: tuple[FloatArray, ...]


def bank_of(random: Generator, bench: Bench) -> Bank:
    """All causes, each in all its forms, of drawn shapes."""
    drawn = [
        (cause, form, form.draw(random, bench.design.setting), k == chosen)
        for cause in (*COMMON, *OUTSIDE)
        for chosen in [int(random.integers(len(cause.forms)))]
        for k, form in enumerate(cause.forms)
    ]
    blocks = []
    for k, test in enumerate(bench.tests):
        acts = [(form.act(test.run, cause.scale, shape),) for cause, form, shape, _ in drawn]
        blocks.append(bench.whitened(k, added(test.run, acts)))
    return Bank(tuple(each[0] for each in drawn), tuple(each[3] for each in drawn), tuple(blocks))
