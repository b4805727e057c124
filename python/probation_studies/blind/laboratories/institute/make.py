"""One campaign: a series of tests, causes in it, records of it, and what is withheld."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from probation.errors import InputError
from probation_studies.blind.laboratories.institute.causes import BEYOND, COMMON, Cause
from probation_studies.blind.laboratories.institute.handover import Made, Record, Truth
from probation_studies.blind.laboratories.institute.modal import FloatArray, solve
from probation_studies.blind.laboratories.institute.names import UNKNOWN, name_of
from probation_studies.blind.laboratories.institute.oracle import consult
from probation_studies.blind.laboratories.institute.planting import Planted, bank_of, placed, plant_all
from probation_studies.blind.laboratories.institute.series import Series, draw_series
from probation_studies.blind.laboratories.institute.sight import Sight, course_of, lost, shown
from probation_studies.blind.laboratories.institute.withheld import described

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

SPLITS = ("develop", "calibrate", "test")
STRATA = ("none", "replicates", "single", "pair", "outside")
"""`replicates` are nulls whose specimens are repeated and differ; so do those of half of the other campaigns."""

_PARTS = (0.2, 0.2, 0.3, 0.15, 0.15)
_TRIES, _PATIENCE = 300, 25
_LOST, _ROUGH = 1.0, 8.0


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
        planted = plant_all(random, sight, causes)
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


def _finish(random: Generator, series: Series, sight: Sight, planted: list[Planted], seeds: dict[str, object]) -> Made:
    name = f"{seeds['split']}-{seeds['index']:04d}"
    records, errors = _record(random, series, sight, planted)
    told, bank = bank_of(random, sight)
    for each in planted:
        told = [other for other in told if (other.cause, other.record) != (each.cause.name, each.record)]
        told.append(placed(each, len(sight.tests)))
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
        "causes": [described(each, sight, bank) for each in planted],
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
