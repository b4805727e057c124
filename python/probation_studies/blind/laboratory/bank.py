"""Signals of every cause in a campaign: what it adds to the stress, whitened, the base law's tangent projected out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import solve_triangular

from probation_studies.blind.laboratory.material import integrate
from probation_studies.blind.laboratory.specimens import Own
from probation_studies.blind.laboratory.trial import ROOM_DEGREES, Acting, Setting, Trial, recorded_stress

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import BaseLaw, FloatArray
    from probation_studies.blind.laboratory.noise import RecordNoise
    from probation_studies.blind.laboratory.rig import Driven
    from probation_studies.blind.laboratory.trial import Cause, Shape

_PARAMETER_STEP = 1e-4
_SECANT = 0.5
"""Part of the usual amplitude at which signals are taken."""


@dataclass(frozen=True)
class Bench:
    """A campaign before anything acts on it.

    Attributes
    ----------
    law : BaseLaw
    tests : tuple of Driven
    ids, held_out : tuple
        Of the records.
    reference_rate : float [1/s]
    specimens : tuple of Own
        Of the records; empty where they are alike.
    degrees : tuple of float [°C]
        Temperatures of the tests, which are recorded; empty where all are made in the same room.
    """

    law: BaseLaw
    tests: tuple[Driven, ...]
    ids: tuple[str, ...]
    held_out: tuple[bool, ...]
    reference_rate: float
    specimens: tuple[Own, ...] = ()
    degrees: tuple[float, ...] = ()

    def specimen(self, k: int) -> Own:
        """What the specimen of a record has of its own."""
        return self.specimens[k] if self.specimens else Own()

    @property
    def identified(self) -> list[int]:
        """Records that are not held out."""
        return [k for k, out in enumerate(self.held_out) if not out]

    def trial(self, k: int, *, fine: bool = False, law: BaseLaw | None = None) -> Trial:
        """A fresh specimen in a record, on the samples or on the fine grid."""
        test = self.tests[k]
        return Trial(
            law or self.law,
            test.fine_time if fine else test.time,
            test.fine_strain if fine else test.strain,
            k / max(len(self.tests) - 1, 1),
            self.reference_rate,
            self.degrees[k] if self.degrees else ROOM_DEGREES,
        )

    def base_and_tangent(self, k: int) -> tuple[FloatArray, FloatArray]:
        """The base law's stress in a record (n,) [MPa], and its slopes along its log parameters (n, 3)."""
        laws = [self.law, *(self.law.shifted(which, _PARAMETER_STEP) for which in range(3))]
        base, *moved = recorded_stress([(self.trial(k, law=law), ()) for law in laws])
        return base, np.stack([each - base for each in moved], axis=1) / _PARAMETER_STEP

    def scattered(self, k: int, sizes: Sequence[float]) -> FloatArray:
        """What one standard deviation of each of a specimen's deviations adds to a record, (n, 5) [MPa]."""
        if not sizes:
            return np.zeros((len(self.tests[k].time), 0))
        base, tangent = self.base_and_tangent(k)
        late = self.trial(k)
        late.strain = late.strain - _PARAMETER_STEP
        late.measure()
        start = (integrate([late.specimen()])[0] - base) / _PARAMETER_STEP
        return np.asarray(np.column_stack([tangent, base, start]) * np.asarray(sizes))


@dataclass(frozen=True)
class Signal:
    """A cause of some shape in some records.

    Attributes
    ----------
    cause : Cause
    shape : dict
    records : tuple of int
        It sits in; all identified ones for placement "all".
    everywhere : bool
    column : ndarray, shape (n_all,)
        Whitened and projected, of one usual amplitude.
    """

    cause: Cause
    shape: Shape
    records: tuple[int, ...]
    everywhere: bool
    column: FloatArray

    @property
    def where(self) -> tuple[str, tuple[int, ...]]:
        """Name and placement."""
        return self.cause.name, (() if self.everywhere else self.records)

    @property
    def norm(self) -> float:
        """Detectability of one usual amplitude."""
        return float(np.linalg.norm(self.column))


class Bank:
    """Signals of all causes.

    Parameters
    ----------
    bench : Bench
    noises : sequence of RecordNoise
        Of all records.
    """

    def __init__(self, bench: Bench, noises: Sequence[RecordNoise]) -> None:
        self.bench, self._noises = bench, noises
        sizes = [len(bench.tests[k].time) for k in bench.identified]
        ends = np.cumsum(sizes)
        self._rows = {k: slice(end - size, end) for k, size, end in zip(bench.identified, sizes, ends, strict=True)}
        self.size = int(ends[-1])
        self.base: dict[int, FloatArray] = {}
        tangent = np.zeros((self.size, 3))
        for k in bench.identified:
            self.base[k], moved = bench.base_and_tangent(k)
            tangent[self._rows[k]] = self.whitened(k, moved)
        self._tangent = np.linalg.qr(tangent)[0]
        self.signals: list[Signal] = []

    def whitened(self, k: int, samples: FloatArray) -> FloatArray:
        """Samples or columns of one record [MPa] in units of its noise, and without its correlation."""
        return np.asarray(solve_triangular(self._noises[k].factor, samples, lower=True, check_finite=False))

    def column(self, stresses: dict[int, FloatArray]) -> FloatArray:
        """Whitened, projected column of what is added to the stress in some identified records."""
        column = np.zeros(self.size)
        for k, added in stresses.items():
            if k in self._rows:
                column[self._rows[k]] = self.whitened(k, added)
        return self.projected(column)

    def projected(self, column: FloatArray) -> FloatArray:
        """Without what the base law's parameters can follow."""
        return np.asarray(column - self._tangent @ (self._tangent.T @ column))

    def samples(self, column: FloatArray) -> dict[int, FloatArray]:
        """Samples [MPa] that have a projected, whitened column, by record."""
        return {k: self._noises[k].factor @ column[rows] for k, rows in self._rows.items()}

    def setting(self, records: Sequence[int]) -> Setting:
        """What a shape may go by, for a cause in these records."""
        bench = self.bench
        tests = [bench.tests[k] for k in records]
        rates = np.concatenate([np.abs(np.diff(test.strain) / np.diff(test.time)) for test in tests])
        moving = rates[rates > 1e-3 * rates.max()]
        forces = [
            float(np.max(np.abs(self.base[k] * np.exp(-bench.tests[k].strain)))) for k in records if k in self.base
        ]
        return Setting(
            duration=max(test.schedule.duration for test in tests),
            end_strain=max(float(test.strain.max()) for test in tests),
            largest_force=max(forces),
            slowest=float(moving.min()),
            fastest=float(moving.max()),
            reference_rate=bench.reference_rate,
            sample=max(test.schedule.duration / len(test.time) for test in tests),
            longest_time=float(np.exp(bench.law.log_time(np.array([bench.reference_rate]))[0])),
            unloads=any(test.schedule.unloads for test in tests),
            temperatures=bool(bench.degrees),
        )

    def add(self, random: Generator, causes: Sequence[Cause]) -> None:
        """Add signals of causes, in shapes that are drawn."""
        everywhere: list[tuple[Cause, Shape]] = []
        single: list[tuple[Cause, Shape, int]] = []
        bench = self.bench
        overall = self.setting(bench.identified)
        for cause in causes:
            if not cause.shows(overall):
                continue
            if "all" in cause.placements:
                everywhere += [(cause, cause.draw(random, overall)) for _ in range(cause.draws)]
            else:
                for k in bench.identified:
                    single += [(cause, cause.draw(random, self.setting([k])), k) for _ in range(cause.draws)]
        blocks: dict[int, list[FloatArray]] = {}
        for k in bench.identified:
            here = [*everywhere, *((cause, shape) for cause, shape, record in single if record == k)]
            blocks[k] = self._signals(k, here)
        for row, (cause, shape) in enumerate(everywhere):
            parts = {k: blocks[k][row] for k in bench.identified}
            if "all" in cause.placements:
                self._keep(cause, shape, parts, everywhere=True)
            if "one" in cause.placements:
                for k in bench.identified:
                    self._keep(cause, shape, {k: parts[k]}, everywhere=False)
        taken = dict.fromkeys(bench.identified, len(everywhere))
        for cause, shape, k in single:
            self._keep(cause, shape, {k: blocks[k][taken[k]]}, everywhere=False)
            taken[k] += 1

    def _keep(self, cause: Cause, shape: Shape, parts: dict[int, FloatArray], *, everywhere: bool) -> None:
        column = np.zeros(self.size)
        for k, part in parts.items():
            column[self._rows[k]] = part
        column = self.projected(column)
        if np.linalg.norm(column) > 1e-3:
            self.signals.append(Signal(cause, shape, tuple(parts), everywhere, column))

    def _signals(self, k: int, causes: Sequence[tuple[Cause, Shape]]) -> list[FloatArray]:
        """Whitened signals of one usual amplitude each in one record."""
        overall = self.setting(self.bench.identified)
        size = [min(_SECANT * cause.scale, 0.5 * cause.largest(overall)) for cause, _ in causes]
        acting = [Acting(cause, part, shape) for part, (cause, shape) in zip(size, causes, strict=True)]
        added = self.added(k, [(each,) for each in acting])
        if not added:
            return []
        usual = np.array([cause.scale for cause, _ in causes]) / np.array(size)
        return list(self.whitened(k, np.stack(added, axis=1) * usual).T)

    def added(self, k: int, causes: Sequence[Sequence[Acting]]) -> list[FloatArray]:
        """What sets of causes add to the recorded stress of a record, on the samples' grid."""
        solving = [j for j, cause in enumerate(causes) if any(acting.cause.solves for acting in cause)]
        stress = dict(zip(solving, recorded_stress([(self.bench.trial(k), causes[j]) for j in solving]), strict=True))
        plain = self.bench.trial(k)
        answers = []
        for j, cause in enumerate(causes):
            found = stress.get(j)
            if found is None:
                found = self.base[k]
                for acting in cause:
                    assert acting.cause.record is not None
                    found = acting.cause.record(plain, acting.amplitude, acting.shape, found)
            answers.append(found - self.base[k])
        return answers
