"""One campaign from a seed."""

from __future__ import annotations

from dataclasses import asdict, astuple
from typing import TYPE_CHECKING, cast
from zlib import crc32

import numpy as np

from probation.errors import InputError
from probation_studies.blind.laboratories.university.catalogue_names import UNKNOWN, catalogue_name
from probation_studies.blind.laboratories.university.causes import COMMON, OUTSIDE, Run
from probation_studies.blind.laboratories.university.design import Test, draw_design
from probation_studies.blind.laboratories.university.histories import FINER
from probation_studies.blind.laboratories.university.known_causes import left_when_told
from probation_studies.blind.laboratories.university.modal_law import integrate
from probation_studies.blind.laboratories.university.oracle import Candidate, Oracle, consult, discriminability
from probation_studies.blind.laboratories.university.planting import LEAST, MOST, Bank, Planted, bank_of, plant
from probation_studies.blind.laboratories.university.sealed import Record, SealedCampaign, Truth
from probation_studies.blind.laboratories.university.signals import (
    Bench,
    Products,
    bench_of,
    course_of,
    recorded,
    sampling_error,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator
    from numpy.typing import NDArray

    from probation_studies.blind.laboratories.university.causes import Cause
    from probation_studies.blind.laboratories.university.modal_law import FloatArray

SPLITS = ("develop", "calibrate", "test")
STRATA = ("none", "replicates", "single", "pair", "outside")
"""Nulls of alike specimens and of replicates; half of the others have replicates, too."""

_PARTS = (0.25, 0.2, 0.3, 0.12, 0.13)
_ATTEMPTS = 80
SAMPLING_LIMIT = 1.0
"""Detectability of what is lost between the samples."""


def make(seed: int, index: int, split: str = "develop", stratum: str | None = None) -> SealedCampaign:
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
    random = np.random.default_rng(np.random.SeedSequence([crc32(b"university"), crc32(split.encode()), seed, index]))
    drawn = str(random.choice(STRATA, p=_PARTS))
    stratum = drawn if stratum is None else stratum
    if stratum not in STRATA:
        raise InputError(f"stratum: found {stratum!r}, expected one of {', '.join(STRATA)}")
    name = f"{split}-{index:04d}"
    for _ in range(_ATTEMPTS):
        found = _attempt(random, stratum)
        if found is not None:
            bench, planted = found
            return _sealed(random, name, {"split": split, "seed": seed, "index": index}, stratum, bench, planted)
    raise RuntimeError(f"{name}: no campaign of stratum {stratum} after {_ATTEMPTS} designs")


def _attempt(random: Generator, stratum: str) -> tuple[Bench, list[Planted]] | None:
    causes = _draw_causes(random, stratum)
    replicated = stratum == "replicates" or (stratum not in ("none", "replicates") and random.uniform() < 0.5)
    design = draw_design(random, unloading=any(each.needs == "unloading" for each in causes), replicated=replicated)
    bench = bench_of(design)
    if sampling_error(bench) > SAMPLING_LIMIT:
        return None
    least = LEAST if stratum == "single" else 5.0
    planted = []
    for cause in causes:
        found = plant(random, bench, cause, float(np.exp(random.uniform(np.log(least), np.log(MOST)))))
        if found is None:
            return None
        planted.append(found)
    return bench, planted


def _draw_causes(random: Generator, stratum: str) -> list[Cause]:
    """Material and rig with the same chance."""
    if stratum == "outside":
        return [OUTSIDE[int(random.integers(len(OUTSIDE)))]]
    found: list[Cause] = []
    while len(found) < {"single": 1, "pair": 2}.get(stratum, 0):
        rig = random.uniform() < 0.5
        among = [each for each in COMMON if each.rig == rig]
        cause = among[int(random.integers(len(among)))]
        if catalogue_name(cause.name) not in {catalogue_name(each.name) for each in found}:
            found.append(cause)
    return found


def _sealed(
    random: Generator,
    name: str,
    seeds: dict[str, object],
    stratum: str,
    bench: Bench,
    planted: list[Planted],
) -> SealedCampaign:
    design = bench.design
    records, strain_errors, stress_errors, added_rms = _record(random, bench, planted)
    noise = [
        stress_errors[test.id] - response @ strain_errors[test.id]
        for test, response in zip(bench.tests, bench.responses, strict=True)
    ]
    errors = [
        each + deviating @ np.array(astuple(test.specimen))
        for each, deviating, test in zip(noise, bench.specimens, bench.tests, strict=True)
    ]
    bank = bank_of(random, bench)
    weighed = _Weighed(bench, bank, planted, errors)
    explanation = tuple(sorted({catalogue_name(each.cause.name) for each in planted}))
    oracle = weighed.consult(random, explanation)
    third = "tau_max_s" if design.material.companion is None else "alpha"
    identified = [test.id for test in bench.tests]
    content: dict[str, object] = {
        "name": name,
        **seeds,
        "laboratory": "university",
        "stratum": "none" if stratum == "replicates" else stratum,
        "target": max((each.detectability for each in planted), default=0.0),
        "causes": [weighed.describe(k) for k in range(len(planted))],
        "mimics": "",
        "explanation": list(explanation),
        "detectability": weighed.detectability,
        "base": {
            "unrelaxed_modulus_MPa": design.material.modulus,
            third: design.material.time,
            "hardening_modulus_MPa": design.material.hardening,
        },
        "noise_MPa": dict.fromkeys((test.id for test in design.tests), design.errors.stress),
        "noise": asdict(design.errors),
        "replicates": design.replicates,
        "scatter": None if design.scatter is None else asdict(design.scatter),
        "specimens": {test.id: asdict(test.specimen) for test in design.tests},
        "records": {
            test.id: {
                "history": test.programme.kind,
                "role": "held-out" if test.held_out else "identify",
                "duration_s": float(test.run.time[-1]),
                "samples": len(test.run.time[::FINER]),
            }
            for test in design.tests
        },
        "oracle": {
            "posterior": oracle.posterior,
            "right": oracle.right,
            "resolvable": oracle.resolvable,
            "answer_set": [list(names) for names in oracle.answer_set],
        },
        "added_MPa": added_rms,
        "noise_drawn_MPa": {key: float(np.sqrt(np.mean(each**2))) for key, each in zip(identified, noise, strict=True)},
        "left_when_told_MPa": left_when_told(bench, planted, errors, stress_errors),
    }
    return SealedCampaign(name, records, design.material.companion, design.scatter is None, Truth(content))


def _record(
    random: Generator, bench: Bench, planted: Sequence[Planted]
) -> tuple[tuple[Record, ...], dict[str, FloatArray], dict[str, FloatArray], dict[str, float]]:
    """The records, their errors of strain and stress [MPa], and what was added to the identified ones [MPa]."""
    design, errors = bench.design, bench.design.errors
    declares = random.uniform() < 0.3
    records, added_rms = [], {}
    strain_errors: dict[str, FloatArray] = {}
    stress_errors: dict[str, FloatArray] = {}
    place = {test.id: k for k, test in enumerate(bench.tests)}
    for test in design.tests:
        at = place.get(test.id)
        strain, stress = _seen(test, planted, at)
        n = len(strain)
        strain_error = errors.strain * errors.averaging(n) @ random.standard_normal(n)
        stress_error = errors.draw_stress(random, n)
        coarse = np.round((stress + stress_error) / errors.quantum) * errors.quantum
        records.append(
            Record(
                id=test.id,
                control=test.programme.control,
                held_out=test.held_out,
                time=test.run.time[::FINER],
                true_strain=strain + strain_error,
                true_stress=coarse,
                declared_strain_noise=float(f"{errors.strain:.2g}") if declares else None,
            )
        )
        strain_errors[test.id], stress_errors[test.id] = strain_error, coarse - stress
        if at is not None:
            columns = [each.columns[at] for each in planted]
            whole = sum((column for column in columns if column is not None), np.zeros(n))
            added_rms[test.id] = float(np.sqrt(np.mean(whole**2)))
    return tuple(records), strain_errors, stress_errors, added_rms


def _seen(test: Test, planted: Sequence[Planted], record: int | None) -> tuple[FloatArray, FloatArray]:
    """Recorded strain and stress of the specimen itself, before errors."""
    run = Run(test.specimen.of(test.run.material), test.run.time, test.run.strain, test.run.sampling)
    acts = [act for each in planted for act in each.act(run, record)]
    stress = integrate(run.time, [course_of(run, acts)])[0]
    strain, stress = recorded(run, acts, stress, test.specimen.area)
    return strain[::FINER], stress[::FINER]


class _Weighed:
    """Signals of the bank, of what acts and of the errors, and their inner products."""

    def __init__(self, bench: Bench, bank: Bank, planted: Sequence[Planted], errors: Sequence[FloatArray]) -> None:
        self.bench, self.bank, self.planted = bench, bank, planted
        blocks = []
        for k, error in enumerate(errors):
            columns = [each.columns[k] for each in planted]
            own = [np.zeros(len(error)) if column is None else column for column in columns]
            blocks.append(np.hstack([bank.blocks[k], bench.whitened(k, np.column_stack([*own, error]))]))
        self.blocks = blocks
        self.products: Products = bench.products(blocks)
        self.first = len(bank.kinds)  # of the planted ones' columns
        acting: list[tuple[int, int | None]] = [(self.first + k, None) for k in range(len(planted))]
        self.own = self.products.gram(acting) if acting else np.zeros((0, 0))

    @property
    def detectability(self) -> float:
        """Of all that acts."""
        return float(np.sqrt(max(self.own.sum(), 0.0)))

    def _placed(self, *, told: bool) -> list[tuple[Cause, int, int | None]]:
        """Cause, column and record of the bank's signals."""
        records = range(len(self.bench.tests))
        return [
            (cause, column, place)
            for column, (cause, is_told) in enumerate(zip(self.bank.kinds, self.bank.told, strict=True))
            if is_told or not told
            for place in ((None, *records) if cause.rig else (None,))
        ]

    def consult(self, random: Generator, truth: tuple[str, ...]) -> Oracle:
        """The true form stands in for the bank's of its cause and place."""
        acting = {(each.cause.name, each.record): self.first + k for k, each in enumerate(self.planted)}
        placed = self._placed(told=True)
        columns: list[tuple[int, int | None]] = []
        candidates = []
        parts = len(self.bench.tests)
        for cause, column, record in placed:
            own = acting.get((cause.name, record))
            columns.append((column, record) if own is None else (own, None))
            share = 1.0 if not cause.rig else 0.5 if record is None else 0.5 / parts
            name = catalogue_name(cause.name)
            candidates.append(Candidate(cause.name, name, share, outside=name == UNKNOWN))
        true: list[tuple[int, int | None]] = [(self.first + k, None) for k in range(len(self.planted))]
        error = (self.first + len(self.planted), None)
        gram = self.products.gram([*columns, *true, error])
        # A form that the law cannot follow in these tests has no finite signal, and no claim to be the cause.
        known = np.flatnonzero(np.isfinite(np.diag(gram))[: len(columns)])
        clean = gram[known, len(columns) : len(columns) + len(true)].sum(axis=1)
        seen = [candidates[k] for k in known]
        return consult(random, seen, gram[np.ix_(known, known)], clean, clean + gram[known, -1], truth)

    def describe(self, k: int) -> dict[str, object]:
        """What the truth says of a planted cause."""
        each = self.planted[k]
        effect = catalogue_name(each.cause.name)
        placed = self._placed(told=False)
        columns = [(column, record) for _, column, record in placed]
        gram = self.products.gram([(self.first + k, None), *columns])
        norms = np.sqrt(np.maximum(np.diag(gram), 1e-12))
        cosines = np.abs(gram[0, 1:]) / (norms[0] * norms[1:])
        alike: dict[str, float] = {}
        for (cause, _, _), cosine in zip(placed, cosines, strict=True):
            if cause.name != each.cause.name:
                alike[cause.name] = max(alike.get(cause.name, 0.0), float(min(cosine, 1.0)))
        names = np.array([catalogue_name(cause.name) for cause, _, _ in placed])
        lefts = sorted(_left(gram, 1 + np.flatnonzero(names == name)) for name in set(names) - {effect, UNKNOWN})
        windows = _windows(each, self.bench)
        return {
            "effect": effect,
            "kind": each.cause.name,
            "form": each.form.name,
            "everywhere": each.record is None,
            "records": [
                test.id for test, column in zip(self.bench.tests, each.columns, strict=True) if column is not None
            ],
            "amplitude": each.amplitude,
            "scale": each.cause.scale,
            "shape": each.shape,
            "detectability": each.detectability,
            "localised": bool(windows) and all(cast("float", window["part"]) < 0.4 for window in windows),
            "windows": windows,
            "alike": alike,
            "discriminability": {name: discriminability(each.detectability, cosine) for name, cosine in alike.items()},
            "left_by_best_other": lefts[0],
        }


def _left(gram: FloatArray, others: NDArray[np.intp]) -> float:
    """Detectability of the first signal that the span of others leaves."""
    scale = np.sqrt(np.maximum(np.diag(gram)[others], 1e-12))
    inside = gram[np.ix_(others, others)] / np.outer(scale, scale)
    taken = np.linalg.lstsq(inside, gram[others, 0] / scale, rcond=1e-8)[0] @ (gram[others, 0] / scale)
    return float(np.sqrt(max(gram[0, 0] - taken, 0.0)))


def _windows(planted: Planted, bench: Bench) -> list[dict[str, object]]:
    """The shortest segment of every record that holds nine tenths of the squared signal."""
    found: list[dict[str, object]] = []
    for test, column in zip(bench.tests, planted.columns, strict=True):
        if column is None or not np.any(column):
            continue
        path, time = test.run.strain[::FINER], test.run.time[::FINER]
        sums = np.concatenate([[0.0], np.cumsum(column**2)])
        last = np.searchsorted(sums, sums[:-1] + 0.9 * sums[-1] * (1.0 - 1e-12))
        lengths = np.where(last < len(sums), last - np.arange(len(last)), len(sums))
        begin = int(np.argmin(lengths))
        end = min(begin + int(lengths[begin]), len(time)) - 1
        inside = path[begin : end + 1]
        found.append(
            {
                "record": test.id,
                "time_s": [float(time[begin]), float(time[end])],
                "true_strain": [float(inside.min()), float(inside.max())],
                "part": (end + 1 - begin) / len(time),
            }
        )
    return found
