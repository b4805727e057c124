"""One campaign of the test house: drawn, tested, recorded, and what is withheld of it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path

import numpy as np

from probation.errors import InputError
from probation_studies.blind.laboratories.industry.bench import Law, Programme, base_stress
from probation_studies.blind.laboratories.industry.campaign import Record, write_campaign
from probation_studies.blind.laboratories.industry.causes import CATALOGUE, CAUSES, Cause, Form, effect
from probation_studies.blind.laboratories.industry.instruments import Instruments, draw_instruments, read_out
from probation_studies.blind.laboratories.industry.known_causes import Errors, RecordAsTested, left_when_told
from probation_studies.blind.laboratories.industry.memory import FloatArray
from probation_studies.blind.laboratories.industry.oracle import Column, beats, consult, left_by
from probation_studies.blind.laboratories.industry.programmes import (
    CONTROL,
    Condition,
    Design,
    draw_design,
    draw_programme,
)
from probation_studies.blind.laboratories.industry.sight import Acting, Sight, refined, residual, tested

SPLITS = ("develop", "calibrate", "test")
STRATA = ("none", "single", "pair", "outside", "replicates")
"""`replicates` is none with repeated specimens that differ."""

_SCHEMA = "probation.blind.truth/1"
_DRAWN = (0.25, 0.25, 0.15, 0.15, 0.2)
_CROSSHEAD = {name for name, cause in CAUSES.items() if not cause.forms_seen(clip_on=True)}
_CLIP_ON = {"bending"}
_TARGETS = 2.5, 300.0
_SEEN, _UNSEEN, _LOST = 2.0, 0.05, 1.5
_TRIES, _PATIENCE = 240, 30
_SMALL = 0.02, 0.2
"""Parts of the largest amplitude that the bank's signals have; the second where the first is not seen."""
_LOCALISED = 0.25
_REFINED = 800
"""Samples below which a test is computed between them, too."""

Scatter = tuple[float, float, float, float]


@dataclass(frozen=True)
class Truth:
    """What is withheld."""

    content: dict[str, object]

    @property
    def stratum(self) -> str:
        """One of `STRATA`."""
        return str(self.content["stratum"])

    def to_json(self) -> str:
        """As JSON text."""
        return json.dumps(self.content, allow_nan=False, indent=1) + "\n"


@dataclass(frozen=True, eq=False)
class Made:
    """A campaign and what is withheld of it."""

    name: str
    records: tuple[Record, ...]
    law: Law
    notes: tuple[str, ...]
    replicates: bool
    truth: Truth

    def write(self, folder: str | Path) -> Path:
        """Write campaign.toml and one file per record; nothing of the truth.

        Raises
        ------
        InputError, OSError
            If the folder cannot be written.
        """
        return write_campaign(
            folder, self.name, self.records, self.law.companion, self.notes, alike=not self.replicates
        )


@dataclass(frozen=True, eq=False)
class _Series:
    """Tests as they are planned, whole (`tests`) and at the samples that are kept (`programmes`)."""

    design: Design
    conditions: tuple[Condition, ...]
    tests: tuple[Programme, ...]
    programmes: tuple[Programme, ...]
    starts: tuple[str, ...]
    held_out: int | None
    instruments: Instruments
    scatter: Scatter | None

    @property
    def identified(self) -> list[int]:
        return [k for k in range(len(self.programmes)) if k != self.held_out]


@dataclass(frozen=True, eq=False)
class _Placed:
    """A cause at work in some identified records (places among them), or everywhere."""

    acting: Acting
    everywhere: bool
    places: tuple[int, ...]


def make(seed: int, index: int, split: str = "develop", stratum: str | None = None) -> Made:
    """Make a campaign; the same for the same arguments.

    Parameters
    ----------
    seed, index : int
    split : {"develop", "calibrate", "test"}
    stratum : str, optional
        One of `STRATA`; drawn if left out.

    Raises
    ------
    InputError
        For another split or stratum.
    """
    if split not in SPLITS or (stratum is not None and stratum not in STRATA):
        raise InputError(
            f"split, stratum: found {split!r}, {stratum!r}, expected one of {', '.join(SPLITS)} and of "
            f"{', '.join(STRATA)}"
        )
    random = np.random.default_rng([seed, index, SPLITS.index(split), 3])
    drawn = str(random.choice(STRATA, p=_DRAWN))
    stratum = drawn if stratum is None else stratum
    for k in range(_TRIES):
        if k % _PATIENCE == 0:
            causes = _draw_causes(random, stratum)
        series = _draw_series(random, stratum, causes)
        sight = _look(series)
        if sight is None:
            continue
        placed = _place(random, sight, causes, clip_on=series.design.clip_on)
        if placed is not None:
            return _finish(random, series, sight, placed, (seed, index, split, stratum))
    raise AssertionError(f"no campaign of stratum {stratum} in {_TRIES} draws")


def _draw_causes(random: np.random.Generator, stratum: str) -> list[Cause]:
    known = [name for name in CAUSES if name in CATALOGUE]
    beyond = [name for name in CAUSES if name not in CATALOGUE]
    if stratum in ("none", "replicates"):
        return []
    if stratum == "outside":
        return [CAUSES[str(random.choice(beyond))]]
    if stratum == "single":
        return [CAUSES[str(random.choice(known))]]
    while True:
        one, other = (str(each) for each in random.choice(known, 2, replace=False))
        both = {one, other}
        if effect(one) != effect(other) and not (both & _CROSSHEAD and both & _CLIP_ON):
            return [CAUSES[one], CAUSES[other]]


def _draw_series(random: np.random.Generator, stratum: str, causes: Sequence[Cause]) -> _Series:
    names = {cause.name for cause in causes}
    clip_on = bool(names & _CLIP_ON) or (not names & _CROSSHEAD and random.random() < 0.6)
    replicates = stratum == "replicates" or (stratum != "none" and random.random() < 0.5)
    needs = frozenset(cause.needs for cause in causes if cause.needs)
    design = draw_design(random, needs, clip_on=clip_on, replicates=replicates)
    conditions = [each for each in design.conditions for _ in range(each.repeats)]
    order = random.permutation(len(conditions))
    conditions = [conditions[k] for k in order]
    instruments = draw_instruments(random, design.scales.force, clip_on=clip_on)
    tests, programmes, starts = [], [], []
    for k, condition in enumerate(conditions):
        programme, start = draw_programme(random, design, condition, k)
        tests.append(programme)
        programmes.append(_cut(programme, design, instruments) if start == "cut" else programme)
        starts.append(start)
    held_out = int(random.integers(len(conditions))) if len(conditions) >= 4 and random.random() < 0.4 else None
    spread = [float(each) for each in random.uniform(0.02, 0.04, 3)]
    scatter = (spread[0], spread[1], spread[2], 0.01) if replicates else None
    return _Series(
        design, tuple(conditions), tuple(tests), tuple(programmes), tuple(starts), held_out, instruments, scatter
    )


def _cut(programme: Programme, design: Design, instruments: Instruments) -> Programme:
    """The record begins when the force has left the noise."""
    force = base_stress(programme, design.law, design.scales, programme.travel) / (1.0 + programme.travel)
    first = int(np.argmax(force > instruments.force_noise))
    first = min(first, max(len(force) // 50, 1))
    return replace(programme, time=programme.time[first:] - programme.time[first], travel=programme.travel[first:])


def _look(series: _Series) -> Sight | None:
    """None where sampling alone would be seen."""
    design, chosen = series.design, [series.programmes[k] for k in series.identified]
    sight = Sight(chosen, design.law, design.scales, series.instruments, series.scatter)
    return sight if _lost(series, sight) < _LOST else None


def _lost(series: _Series, sight: Sight) -> float:
    chosen = series.identified
    return sight.sampling([series.tests[k] for k in chosen], [series.programmes[k] for k in chosen])


def _place(
    random: np.random.Generator, sight: Sight, causes: Sequence[Cause], *, clip_on: bool
) -> list[_Placed] | None:
    placed: list[_Placed] = []
    count = len(sight.views)
    for cause in causes:
        forms = cause.forms_seen(clip_on=clip_on)
        form = forms[int(random.integers(len(forms)))]
        shape = {name: float(np.exp(random.uniform(np.log(a), np.log(b)))) for name, (a, b) in form.shape.items()}
        everywhere = not cause.rig or count == 1 or random.random() < 0.5
        some = random.choice(count, 1 if count < 4 else int(random.integers(1, 3)), replace=False)
        places = tuple(range(count)) if everywhere else tuple(sorted(int(k) for k in some))
        sign = -1.0 if form.signed and random.random() < 0.5 else 1.0
        low, high = np.log(_TARGETS)
        amplitude = _amplitude(sight, cause.name, form, shape, places, sign, float(np.exp(random.uniform(low, high))))
        if amplitude is None:
            return None
        placed.append(_Placed(Acting(cause.name, form, amplitude, shape), everywhere, places))
    return placed


def _amplitude(
    sight: Sight, name: str, form: Form, shape: dict[str, float], places: tuple[int, ...], sign: float, target: float
) -> float | None:
    """Amplitude whose signal has the norm that is aimed at, or the largest; None where even that is not seen."""
    size = 0.02 * form.largest
    for _ in range(6):
        found = float(np.linalg.norm(_seen(sight, [(Acting(name, form, sign * size, shape), places)])))
        if not np.isfinite(found):
            return None
        if found > 0.0 and abs(found / target - 1.0) < 0.1:
            break
        better = min(size * float(np.clip(target / max(found, 1e-9), 0.02, 20.0)), form.largest)
        if better == size:
            break
        size = better
    found = float(np.linalg.norm(_seen(sight, [(Acting(name, form, sign * size, shape), places)])))
    return sign * size if np.isfinite(found) and found >= _SEEN else None


def _seen(sight: Sight, acting: Sequence[tuple[Acting, tuple[int, ...]]]) -> FloatArray:
    """Whitened signal of causes, all at once."""
    by_record = []
    for record in range(len(sight.views)):
        here = [each for each, places in acting if record in places]
        by_record.append(sight.signal(here, record) if here else np.zeros(0))
    return sight.seen(by_record)


def _bank(sight: Sight, design: Design) -> list[Column]:
    """Every cause in every form, small, with shapes in the middle; of the rig in all records and in each."""
    columns: list[Column] = []
    count = len(sight.views)
    for cause in CAUSES.values():
        if cause.name in _CLIP_ON and not design.clip_on:
            continue
        for form in cause.forms_seen(clip_on=design.clip_on):
            shape = {name: float(np.sqrt(a * b)) for name, (a, b) in form.shape.items()}
            for part in _SMALL:
                acting = Acting(cause.name, form, part * form.largest, shape)
                by_record = [sight.signal([acting], k) for k in range(count)]
                if float(np.linalg.norm(sight.seen(by_record))) > _UNSEEN:
                    break
            placings = [tuple(range(count)), *(((k,) for k in range(count)) if cause.rig and count > 1 else ())]
            for places in placings:
                seen = sight.seen([estimate if k in places else np.zeros(0) for k, estimate in enumerate(by_record)])
                norm = float(np.linalg.norm(seen))
                if np.isfinite(norm) and norm > _UNSEEN:
                    columns.append(Column(cause.name, effect(cause.name), places, seen / norm))
    return columns


def _finish(
    random: np.random.Generator,
    series: _Series,
    sight: Sight,
    placed: Sequence[_Placed],
    made_from: tuple[int, int, str, str],
) -> Made:
    seed, index, split, stratum = made_from
    design, name = series.design, f"{split}-{index:04d}"
    everything = [(each.acting, each.places) for each in placed]
    clean = _seen(sight, everything)
    bank = _bank(sight, design)
    own = [_column(sight, each) for each in placed]
    explanation = tuple(sorted({effect(each.acting.cause) for each in placed}))
    columns = [*bank, *own]
    oracle = consult(random, columns, clean, explanation, len(own))
    records, errors = _record(random, series, placed)
    ids = [record.id for record in records]
    identified = [ids[k] for k in series.identified]
    content: dict[str, object] = {
        "schema": _SCHEMA,
        "name": name,
        "laboratory": "industry",
        "split": split,
        "seed": seed,
        "index": index,
        "stratum": stratum,
        "target": 0.0,
        "causes": [
            _withheld(sight, each, column, bank, design, identified) for each, column in zip(placed, own, strict=True)
        ],
        "mimics": "",
        "explanation": list(explanation),
        "detectability": float(np.linalg.norm(clean)),
        "base": _base(design.law),
        "noise_MPa": {
            record_id: float(series.instruments.force_white * np.sqrt(np.mean((1.0 + programme.travel) ** 2)))
            for record_id, programme in zip(ids, series.programmes, strict=True)
        },
        "noise": {
            "force_MPa": series.instruments.force_white,
            "slow_force_MPa": series.instruments.slow_noise,
            "strain": series.instruments.strain_white,
            "clip_on": float(design.clip_on),
            "replicates": float(design.replicates),
            **dict(zip(("scatter_E", "scatter_tau", "scatter_G", "scatter_area"), series.scatter or (), strict=False)),
        },
        "records": {
            each: {
                "kind": condition.kind,
                "begins": start,
                "role": "held-out" if k == series.held_out else "identify",
                "duration_s": float(programme.time[-1]),
                "samples": len(programme.time),
            }
            for k, (each, condition, start, programme) in enumerate(
                zip(ids, series.conditions, series.starts, series.programmes, strict=True)
            )
        },
        "sampling_detectability": _lost(series, sight),
        "drift_detectability": 0.0,
        "oracle": oracle,
        "added_MPa": _added(series, placed, ids),
        "noise_drawn_MPa": {},
        "left_when_told_MPa": dict(zip(ids, left_when_told(sight, _tested(series, placed, errors)), strict=True)),
    }
    room = random.uniform(20.0, 25.0)
    notes = [
        f"room: {room + 0.3 * random.standard_normal():.1f} C at the first test, "
        f"{room + 0.3 * random.standard_normal():.1f} C at the last",
        "strain: " + ("clip-on extensometer" if design.clip_on else "crosshead travel over the gauge length"),
    ]
    return Made(name, records, design.law, tuple(notes), design.replicates, Truth(content))


def _column(sight: Sight, placed: _Placed) -> Column:
    seen = _seen(sight, [(placed.acting, placed.places)])
    return Column(placed.acting.cause, effect(placed.acting.cause), placed.places, seen / np.linalg.norm(seen))


def _withheld(
    sight: Sight, placed: _Placed, own: Column, bank: Sequence[Column], design: Design, ids: Sequence[str]
) -> dict[str, object]:
    acting = placed.acting
    seen = _seen(sight, [(acting, placed.places)])
    size = float(np.linalg.norm(seen))
    alike: dict[str, float] = {}
    for each in bank:
        if each.cause != acting.cause:
            alike[each.cause] = max(alike.get(each.cause, 0.0), abs(float(each.signal @ own.signal)))
    others = [each for each in bank if each.effect not in ("unknown", own.effect)]
    groups: dict[object, list[Column]] = {}
    for each in others:
        groups.setdefault(each.place, []).append(each)
    left = sorted(((left_by(group, seen), place) for place, group in groups.items()), key=lambda pair: pair[0])
    nearest = [groups[place] for _, place in left[:8]]
    unit = 1.0 if acting.form.unit is None else acting.form.unit(design.scales)
    return {
        "effect": own.effect,
        "kind": acting.cause,
        "form": acting.form.name,
        "everywhere": placed.everywhere,
        "records": [ids[k] for k in placed.places],
        "amplitude": acting.amplitude * unit,
        "scale": acting.form.largest * unit,
        "shape": dict(acting.shape),
        "detectability": size,
        "localised": False,
        "windows": [],
        "alike": alike,
        "beats": {name: beats(size, cosine) for name, cosine in alike.items()},
        "left_by_best_other": left[0][0] if left else size,
        "left_by_best_pair": min((left_by([*a, *b], seen) for a, b in combinations(nearest, 2)), default=size),
    } | _windows(sight, placed, ids)


def _windows(sight: Sight, placed: _Placed, ids: Sequence[str]) -> dict[str, object]:
    """Shortest part of every record with nine tenths of the squared signal."""
    found, shares = [], []
    for k in placed.places:
        thin = sight.views[k].thin
        signal = residual(thin, sight.law, sight.scales, [placed.acting])
        through = np.concatenate([[0.0], np.cumsum(0.5 * (signal[1:] ** 2 + signal[:-1] ** 2) * np.diff(thin.time))])
        if through[-1] <= 0.0:
            continue
        ends = np.searchsorted(through, through + 0.9 * through[-1])
        spans = [(thin.time[b] - thin.time[a], a, int(b)) for a, b in enumerate(ends) if b < len(thin.time)]
        span, a, b = min(spans)
        strain = np.log1p(thin.travel[a : b + 1])
        shares.append(span / thin.time[-1])
        found.append(
            {
                "record": ids[k],
                "time_s": [float(thin.time[a]), float(thin.time[b])],
                "true_strain": [float(strain.min()), float(strain.max())],
            }
        )
    return {"windows": found, "localised": bool(shares and max(shares) < _LOCALISED)}


def _base(law: Law) -> dict[str, float]:
    time = "tau_max_s" if law.companion is None else "alpha"
    return {"unrelaxed_modulus_MPa": law.modulus, time: law.time, "hardening_modulus_MPa": law.hardening}


def _here(series: _Series, placed: Sequence[_Placed], record: int) -> list[Acting]:
    """What acts in a record; a held-out one has what acts everywhere."""
    if record == series.held_out:
        return [each.acting for each in placed if each.everywhere]
    place = series.identified.index(record)
    return [each.acting for each in placed if place in each.places]


def _added(series: _Series, placed: Sequence[_Placed], ids: Sequence[str]) -> dict[str, float]:
    found = {}
    for k, (name, programme) in enumerate(zip(ids, series.programmes, strict=True)):
        here = _here(series, placed, k)
        thin = programme.thinned(200)
        signal = residual(thin, series.design.law, series.design.scales, here) if here else np.zeros(1)
        found[name] = float(np.sqrt(np.mean(signal**2)))
    return found


def _record(
    random: np.random.Generator, series: _Series, placed: Sequence[_Placed]
) -> tuple[tuple[Record, ...], list[Errors]]:
    """Test every specimen and write down what the machine shows; and how far that is off."""
    design, records, errors = series.design, [], []
    stated = {"strain": series.instruments.strain_white} if random.random() < 0.3 else {}
    for k, (condition, programme, test) in enumerate(
        zip(series.conditions, series.programmes, series.tests, strict=True)
    ):
        law, section, specimen = design.law, 1.0, np.zeros(4)
        if series.scatter is not None:
            e, tau, g, area = specimen = np.array(series.scatter) * random.standard_normal(4)
            law = replace(
                law, modulus=law.modulus * (1 + e), time=law.time * (1 + tau), hardening=law.hardening * (1 + g)
            )
            section = 1.0 + float(area)
        twice = len(test.time) < _REFINED
        fine = refined(test) if twice else test
        travel, force = tested(fine, law, design.scales, _here(series, placed, k))
        if twice:
            travel, force = travel[::2], force[::2]
        kept = slice(len(test.time) - len(programme.time), None)
        true_travel, true_force = travel[kept], force[kept] * section
        travel, force = read_out(random, programme.time, true_travel, true_force, series.instruments)
        name = f"{k + 1:02d}-{condition.kind}"
        records.append(
            Record(
                id=name,
                control=CONTROL[condition.kind],
                held_out=k == series.held_out,
                specimen=f"S{k + 1}",
                time=programme.time,
                strain=np.log1p(travel),
                stress=force * (1.0 + travel),
                noise=stated,
            )
        )
        off = (force - true_force) * (1.0 + true_travel), np.log1p(travel) - np.log1p(true_travel)
        errors.append(Errors(*off, specimen))
    return tuple(records), errors


def _tested(series: _Series, placed: Sequence[_Placed], errors: Sequence[Errors]) -> list[RecordAsTested]:
    """Every record with what acts in it."""
    found = []
    for k, (programme, off) in enumerate(zip(series.programmes, errors, strict=True)):
        here = _here(series, placed, k)
        causes = tuple(each.acting if each.acting in here else None for each in placed)
        found.append(RecordAsTested(programme, k == series.held_out, causes, off))
    return found
