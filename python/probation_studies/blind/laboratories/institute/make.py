"""One campaign: a series of tests, causes in it, records of it, and what is withheld."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from probation.errors import InputError
from probation_studies.blind.laboratories.institute.causes import BEYOND, COMMON, Cause, Change, Form
from probation_studies.blind.laboratories.institute.handover import Made, Record, Truth
from probation_studies.blind.laboratories.institute.modal import FloatArray, solve
from probation_studies.blind.laboratories.institute.names import UNKNOWN, name_of
from probation_studies.blind.laboratories.institute.oracle import Placed, consult, discriminability
from probation_studies.blind.laboratories.institute.series import Series, Test, draw_series
from probation_studies.blind.laboratories.institute.sight import Sight, added, course_of, lost, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

SPLITS = ("develop", "calibrate", "test")
STRATA = ("none", "replicates", "single", "pair", "outside")
"""`replicates` are nulls whose specimens are repeated and differ; so do those of half of the other campaigns."""

_PARTS = (0.2, 0.2, 0.3, 0.15, 0.15)
_TRIES, _PATIENCE = 300, 25
_LEAST, _MOST = 4.0, 100.0
_STRONGER = 2.5
"""Of the least sqrt(lambda): for pairs, and for what lies outside, of which the nearest cause takes a part."""
_ROUNDS, _NEAR = 6, 0.1
_LOST, _ROUGH = 1.0, 8.0
_UNSEEN = 0.05
"""Norm of a usual amplitude's signal below which no record shows a cause."""
_LOCALISED = 0.3


@dataclass(frozen=True, eq=False)
class Planted:
    """A cause at work; `record` is its place among the identified ones, None for all.

    `columns` are what it adds to the identified records [MPa], `signal` the same, whitened, beside the base law.
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


def make(seed: int, index: int, split: str = "develop", stratum: str | None = None) -> Made:
    """Make one campaign; the same for the same arguments.

    Parameters
    ----------
    seed, index : int
        Not negative.
    split : {"develop", "calibrate", "test"}
    stratum : {"none", "replicates", "single", "pair", "outside"}, optional
        Drawn if left out.

    Raises
    ------
    InputError
        For another split or stratum, or negative numbers.
    """
    if split not in SPLITS:
        raise InputError(f"split: found {split!r}, expected one of {', '.join(SPLITS)}")
    if seed < 0 or index < 0:
        raise InputError(f"seed, index: found {seed}, {index}, expected numbers that are not negative")
    random = np.random.default_rng([crc32(b"institute"), crc32(split.encode()), seed, index])
    drawn = str(random.choice(STRATA, p=_PARTS))
    stratum = drawn if stratum is None else stratum
    if stratum not in STRATA:
        raise InputError(f"stratum: found {stratum!r}, expected one of {', '.join(STRATA)}")
    for attempt in range(_TRIES):
        if attempt % _PATIENCE == 0:
            causes = _draw_causes(random, stratum)
        needs = frozenset(each.needs for each in causes)
        series = draw_series(random, needs, replicated={"none": False, "replicates": True}.get(stratum))
        sight = _look(series)
        if sight is None:
            continue
        planted = _plant_all(random, sight, causes)
        if planted is not None:
            seeds = {"split": split, "seed": seed, "index": index, "laboratory": "institute", "stratum": stratum}
            return _finish(random, series, sight, planted, seeds)
    raise RuntimeError(f"{split}-{index:04d}: no campaign of stratum {stratum} in {_TRIES} series")


def _look(series: Series) -> Sight | None:
    """None where sampling alone would be seen: roughly by the force's noise first, then by all errors."""
    rough = [float(np.linalg.norm(lost(test))) / series.instruments.stress for test in series.tests]
    if max(rough) > _ROUGH:
        return None
    sight = Sight(series)
    return sight if _sampling(sight) <= _LOST else None


def _sampling(sight: Sight) -> float:
    return float(np.linalg.norm(sight.left(sight.whitened([lost(test) for test in sight.tests]))))


def _draw_causes(random: Generator, stratum: str) -> list[Cause]:
    if stratum == "outside":
        return [BEYOND[int(random.integers(len(BEYOND)))]]
    count = {"single": 1, "pair": 2}.get(stratum, 0)
    return [COMMON[int(k)] for k in random.choice(len(COMMON), count, replace=False)]


def _plant_all(random: Generator, sight: Sight, causes: Sequence[Cause]) -> list[Planted] | None:
    planted = []
    for cause in causes:
        least = _LEAST * (_STRONGER if len(causes) > 1 or cause in BEYOND else 1.0)
        found = _plant(random, sight, cause, float(np.exp(random.uniform(np.log(least), np.log(_MOST)))))
        if found is None:
            return None
        planted.append(found)
    return planted


def _plant(random: Generator, sight: Sight, cause: Cause, target: float) -> Planted | None:
    """With the amplitude that has the wanted sqrt(lambda), or the largest; None where that does not show."""
    form = cause.forms[int(random.integers(len(cause.forms)))]
    shape = form.draw(random)
    sign = -1.0 if cause.signed and random.uniform() < 0.5 else 1.0
    record = int(random.integers(len(sight.tests))) if cause.rig and random.uniform() < 0.5 else None
    amplitude = cause.scale
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
        amplitude = min(amplitude * float(np.clip(target / size, 0.01, 30.0)), cause.largest)
    if not (1.0 - _NEAR) * _LEAST <= size <= (1.0 + 2.0 * _NEAR) * _MOST:
        return None
    return Planted(cause, form, shape, sign * amplitude, record, columns, signal)


def _finish(random: Generator, series: Series, sight: Sight, planted: list[Planted], seeds: dict[str, object]) -> Made:
    name = f"{seeds['split']}-{seeds['index']:04d}"
    records, errors = _record(random, series, sight, planted)
    told, bank = _bank(random, sight)
    for each in planted:
        told = [other for other in told if (other.cause, other.record) != (each.cause.name, each.record)]
        told.append(_placed(each, len(sight.tests)))
    truth = tuple(sorted({name_of(each.cause.name) for each in planted}))
    acting = np.sum([each.signal for each in planted], axis=0) if planted else np.zeros(sight.rows[-1].stop)
    seen = [
        error + deviating @ test.specimen.values
        for error, deviating, test in zip(errors, sight.deviating, sight.tests, strict=True)
    ]
    oracle = consult(random, told, acting, sight.left(sight.whitened(seen)), truth, UNKNOWN)
    third = "tau_max_s" if series.polymer.companion is None else "alpha"
    gain = series.instruments.gain
    tested = [test.id for test in sight.tests]
    content: dict[str, object] = {
        "name": name,
        **seeds,
        "target": max((each.size for each in planted), default=0.0),
        "causes": [_described(each, sight, bank) for each in planted],
        "mimics": "",
        "explanation": list(truth),
        "detectability": float(np.linalg.norm(acting)),
        "base": {
            "unrelaxed_modulus_MPa": gain * series.polymer.modulus,
            third: series.polymer.time,
            "hardening_modulus_MPa": gain * series.polymer.hardening,
        },
        "noise_MPa": dict.fromkeys((test.id for test in series.tests), series.instruments.stress),
        "noise": asdict(series.instruments),
        "sampling_detectability": _sampling(sight),
        "replicates": series.replicates,
        "scatter": None if series.scatter is None else asdict(series.scatter),
        "specimens": {test.id: asdict(test.specimen) for test in series.tests},
        "records": {
            test.id: {
                "history": test.programme.kind,
                "role": "held-out" if test.held_out else "identify",
                "temperature_C": test.temperature,
                "duration_s": float(test.time[-1]),
                "samples": len(record.time),
            }
            for test, record in zip(series.tests, records, strict=True)
        },
        "oracle": {
            "posterior": oracle.posterior,
            "right": oracle.right,
            "resolvable": oracle.resolvable,
            "answer_set": [list(names) for names in oracle.answer_set],
        },
        "added_MPa": {
            record: float(np.sqrt(np.mean(np.sum([each.columns[k] for each in planted], axis=0) ** 2)))
            if planted
            else 0.0
            for k, record in enumerate(tested)
        },
        "noise_drawn_MPa": {
            record: float(np.sqrt(np.mean(error**2))) for record, error in zip(tested, errors, strict=True)
        },
    }
    return Made(name, tuple(records), series.polymer.companion, series.scatter, series.stated, Truth(content))


def _record(
    random: Generator, series: Series, sight: Sight, planted: Sequence[Planted]
) -> tuple[list[Record], list[FloatArray]]:
    """The records, and the errors of the identified ones: of the stress, and of the strain through the law [MPa]."""
    instruments = series.instruments
    declared = float(f"{instruments.strain:.2g}") if random.uniform() < 0.3 else None
    places = {test.id: k for k, test in enumerate(sight.tests)}
    records, errors = [], []
    for test in series.tests:
        samples, place = test.path.samples, places.get(test.id)
        own = replace(test, polymer=test.specimen.of(test.polymer))
        changes = [change for each in planted for change in each.change(own, place)]
        strain, force = shown(own, changes, solve(own.time, [course_of(own, changes)])[0], test.specimen.area)
        time, strain, force = own.time[::2][samples], strain[samples], instruments.gain * force[samples]
        read_strain = instruments.read_strain(random, time, strain)
        read_stress = instruments.read_force(random, time, force) * np.exp(read_strain)
        temperature = None
        if series.surface_seen:
            rise = sum((each.warmth() for each in changes if each.warmth is not None), np.zeros(len(own.time[::2])))
            probe = 0.1 * random.standard_normal() + 0.1 * random.standard_normal(len(time))
            temperature = np.round(own.temperature + rise[samples] + probe, 2)
        records.append(
            Record(
                test.id, test.programme.control, test.held_out, time, read_strain, read_stress, temperature, declared
            )
        )
        if place is not None:
            strain_error = read_strain - strain
            stress_error = read_stress - force * np.exp(strain) * (1.0 + strain_error)
            errors.append(stress_error + sight.responses[place] @ strain_error)
    return records, errors


def _placed(planted: Planted, count: int) -> Placed:
    cause = planted.cause
    share = _share(cause, planted.record, count)
    return Placed(cause.name, name_of(cause.name), planted.record, share, planted.signal / planted.size)


def _share(cause: Cause, record: int | None, count: int) -> float:
    """A rig's fault sits everywhere or in one record."""
    return 1.0 if not cause.rig or count == 1 else 0.5 if record is None else 0.5 / count


def _bank(random: Generator, sight: Sight) -> tuple[list[Placed], list[Placed]]:
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


def _described(planted: Planted, sight: Sight, bank: Sequence[Placed]) -> dict[str, object]:
    """What the truth says of a cause."""
    name, unit = name_of(planted.cause.name), planted.signal / planted.size
    alike: dict[str, float] = {}
    groups: dict[tuple[str, int | None], list[FloatArray]] = {}
    for each in bank:
        if each.cause != planted.cause.name:
            alike[each.cause] = max(alike.get(each.cause, 0.0), min(abs(float(unit @ each.signal)), 1.0))
        if each.name not in (name, UNKNOWN):
            groups.setdefault((each.cause, each.record), []).append(each.signal)
    windows = _windows(planted, sight)
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
        "localised": bool(windows) and all(each["part"] < _LOCALISED for each in windows),
        "windows": windows,
        "alike": alike,
        "discriminability": {other: discriminability(planted.size, cosine) for other, cosine in alike.items()},
        "left_by_best_other": min((_left(planted.signal, group) for group in groups.values()), default=planted.size),
    }


def _left(signal: FloatArray, others: Sequence[FloatArray]) -> float:
    """Norm that the span of others leaves of a signal."""
    basis = np.linalg.qr(np.stack(others, axis=1))[0]
    return float(np.linalg.norm(signal - basis @ (basis.T @ signal)))


def _windows(planted: Planted, sight: Sight) -> list[dict[str, object]]:
    """The shortest stretch of every record that holds nine tenths of the squared signal."""
    found: list[dict[str, object]] = []
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
        found.append(
            {
                "record": test.id,
                "time_s": [float(time[a]), float(time[b])],
                "true_strain": [float(inside.min()), float(inside.max())],
                "part": span / float(time[-1]),
            }
        )
    return found
