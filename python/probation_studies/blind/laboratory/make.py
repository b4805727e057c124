"""One campaign from a seed: designed, run, disturbed, recorded, and its truth."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from probation.errors import InputError
from probation_studies.blind.laboratory.bank import Bank, Signal
from probation_studies.blind.laboratory.campaign import SealedCampaign, WrittenRecord
from probation_studies.blind.laboratory.causes import AT_TEMPERATURES, KNOWN, OUTSIDE
from probation_studies.blind.laboratory.design import Design, draw_design
from probation_studies.blind.laboratory.known_causes import left_when_told
from probation_studies.blind.laboratory.noise import draw_record_noise
from probation_studies.blind.laboratory.oracle import consult, explanation
from probation_studies.blind.laboratory.placing import (
    Planted,
    Wish,
    draw_names,
    draw_wish,
    left_by_others,
    plant,
)
from probation_studies.blind.laboratory.recording import record_all, run_undisturbed
from probation_studies.blind.laboratory.truth import Truth, campaign_name
from probation_studies.blind.laboratory.withheld import describe

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratory.bank import Bench
    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.recording import Recorded, Undisturbed

SPLITS = ("develop", "calibrate", "test")
STRATA = ("none", "single", "pair", "outside", "mimic")
_PARTS = (0.45, 0.27, 0.10, 0.10, 0.08)

SAMPLING_LIMIT = 0.7
"""Detectability that sampling and filtering alone may have."""

_MIMIC_COSINE, _MIMIC_LEFT, _MIMIC_LEAST, _MIMIC_MOST = 0.97, 1.8, 5.0, 40.0
_OUTSIDE_LEFT = 3.0
_ATTEMPTS = 60
_THERMOMETER = 0.1  # °C


def make(
    seed: int, index: int, split: str = "develop", stratum: str | None = None, *, wider: bool = False
) -> SealedCampaign:
    """Make one campaign; the same for the same arguments.

    Parameters
    ----------
    seed, index : int
        Not negative.
    split : {"develop", "calibrate", "test"}
        May be tuned on, probabilities tempered on, scored once per release.
    stratum : {"none", "single", "pair", "outside", "mimic"}, optional
        Drawn if left out.
    wider : bool
        With the errors of `laboratory.wider`.

    Raises
    ------
    InputError
        For another split or stratum, or negative numbers.
    """
    if split not in SPLITS:
        raise InputError(f"split: found {split!r}, expected one of {', '.join(SPLITS)}")
    if seed < 0 or index < 0:
        raise InputError(f"seed, index: found {seed}, {index}, expected numbers that are not negative")
    random = np.random.default_rng(np.random.SeedSequence([crc32(split.encode()), seed, index]))
    drawn = str(random.choice(STRATA, p=_PARTS))
    stratum = drawn if stratum is None else stratum
    if stratum not in STRATA:
        raise InputError(f"stratum: found {stratum!r}, expected one of {', '.join(STRATA)}")
    for _ in range(_ATTEMPTS):
        found = _attempt(random, stratum, wider)
        if found is not None:
            return _sealed(split, seed, index, stratum, found)
    raise RuntimeError(f"{campaign_name(split, index)}: no campaign of stratum {stratum} after {_ATTEMPTS} designs")


class _Run:
    """A campaign in the making."""

    def __init__(self, random: Generator, design: Design) -> None:
        self.random, self.design = random, design
        self.bench = design.bench
        self.noises = [
            draw_record_noise(
                random,
                design.noise,
                self.bench.law,
                test.time,
                test.strain,
                self.bench.scattered(k, design.scatter),
            )
            for k, test in enumerate(self.bench.tests)
        ]
        self.bank = Bank(self.bench, self.noises)


@dataclass(frozen=True)
class _Outcome:
    """A campaign that may be sealed."""

    run: _Run
    planted: list[Planted]
    target: float
    mimics: str
    undisturbed: Undisturbed
    recorded: Recorded


def _attempt(random: Generator, stratum: str, wider: bool) -> _Outcome | None:
    wishes = _wishes(random, stratum, wider)
    temperatures = _temperatures(wishes)
    design = draw_design(
        random,
        needs_unloading=any(wish.cause.needs_unloading for wish in wishes) or random.uniform() < 0.3,
        needs_reach=any(wish.cause.name == "finite_extensibility" for wish in wishes),
        wider=wider,
        temperatures=temperatures.pop() if temperatures else None,
    )
    run = _Run(random, design)
    undisturbed = run_undisturbed(run.bench, design.noise, run.bank)
    if undisturbed.sampling_detectability > SAMPLING_LIMIT:
        return None
    planted: list[Planted] = []
    for wish in wishes:
        found = plant(random, run.bank, wish)
        if found is None:
            return None
        planted.append(found)
    run.bank.add(random, [*KNOWN, *AT_TEMPERATURES, *OUTSIDE])
    mimics = ""
    if stratum == "outside" and left_by_others(run.bank.signals, planted[0].column, ())[0] < _OUTSIDE_LEFT:
        return None
    if stratum == "mimic":
        pretence = _pretence(random, run)
        if pretence is None:
            return None
        wish, found, mimics = pretence
        wishes, planted = [wish], [found]
    else:
        run.bank.signals += [_signal_of(run.bank, each) for each in planted]
    recorded = record_all(run.bench, design.noise, run.noises, run.bank, planted, undisturbed)
    if abs(recorded.drift_detectability) >= 1.0:
        return None
    target = max((wish.target for wish in wishes), default=0.0)
    return _Outcome(run, planted, target, mimics, undisturbed, recorded)


def _wishes(random: Generator, stratum: str, wider: bool) -> list[Wish]:
    if stratum == "single":
        return [draw_wish(random, draw_names(random, 1, temperatures=wider)[0])]
    if stratum == "pair":
        both = [draw_wish(random, name, least=5.0) for name in draw_names(random, 2, temperatures=wider)]
        return both if len(_temperatures(both)) < 2 else _wishes(random, stratum, wider)
    if stratum == "outside":
        return [draw_wish(random, OUTSIDE[int(random.integers(len(OUTSIDE)))].name, outside=True, least=5.0)]
    return []


def _temperatures(wishes: Sequence[Wish]) -> set[bool]:
    """Whether what is wished for needs tests at several temperatures (True) or at one (False); empty: neither."""
    return {each for wish in wishes if (each := wish.cause.temperatures) is not None}


def _pretence(random: Generator, run: _Run) -> tuple[Wish, Planted, str] | None:
    """Something outside the catalogue that looks like something in it, every kind with the same chance."""
    known = [each for each in run.bank.signals if not each.cause.outside]
    directions = np.stack([each.column / each.norm for each in known], axis=1)
    candidates: list[tuple[float, Signal]] = []
    for each in run.bank.signals:
        if each.cause.outside and 3.0 * each.norm > _MIMIC_LEAST:
            candidates.append((float(np.max(np.abs(each.column @ directions))) / each.norm, each))
    alike = [(cosine, each) for cosine, each in candidates if cosine >= _MIMIC_COSINE]
    if not alike:
        return None
    kinds = sorted({each.cause.name for _, each in alike})
    kind = kinds[int(random.integers(len(kinds)))]
    alike = [pair for pair in alike if pair[1].cause.name == kind]
    cosine, signal = alike[int(random.integers(len(alike)))]
    target = min(_MIMIC_LEFT / max(float(np.sqrt(1.0 - cosine**2)), 1e-3), _MIMIC_MOST)
    wish = Wish(signal.cause, signal.everywhere, max(target, _MIMIC_LEAST) * random.uniform(0.8, 1.0))
    found = plant(random, run.bank, wish, signal.shape, None if signal.everywhere else signal.records[0])
    if found is None or found.detectability < 0.8 * _MIMIC_LEAST:
        return None
    left, _, name = left_by_others(run.bank.signals, found.column, ())
    return (wish, found, name) if left < 2.0 else None


def _sealed(split: str, seed: int, index: int, stratum: str, outcome: _Outcome) -> SealedCampaign:
    run, planted, recorded = outcome.run, outcome.planted, outcome.recorded
    bench, bank = run.bench, run.bank
    acting = [_signal_of(bank, each) for each in planted]
    oracle = consult(run.random, bank.signals, recorded.clean, recorded.observed, acting)
    third = "tau_max_s" if bench.law.companion is None else "alpha"
    truth = Truth(
        split=split,
        seed=seed,
        index=index,
        stratum=stratum,
        target=outcome.target,
        causes=tuple(describe(bank, each) for each in planted),
        mimics=outcome.mimics,
        explanation=explanation(acting),
        detectability=float(np.linalg.norm(recorded.clean)),
        base={
            "unrelaxed_modulus_MPa": bench.law.unrelaxed_modulus,
            third: bench.law.longest_time,
            "hardening_modulus_MPa": bench.law.hardening_modulus,
        },
        noise_level={name: noise.level for name, noise in zip(bench.ids, run.noises, strict=True)},
        noise={name: float(value) for name, value in asdict(run.design.noise).items()}
        | {f"scatter_{k}": size for k, size in enumerate(run.design.scatter)},
        records={
            name: {
                "history": test.schedule.kind,
                "role": "held-out" if out else "identify",
                "duration_s": float(test.time[-1]),
                "samples": len(test.time),
            }
            | ({"temperature_C": bench.degrees[k]} if bench.degrees else {})
            for k, (name, test, out) in enumerate(zip(bench.ids, bench.tests, bench.held_out, strict=True))
        },
        sampling_detectability=outcome.undisturbed.sampling_detectability,
        drift_detectability=recorded.drift_detectability,
        oracle={
            "posterior": oracle.posterior,
            "right": oracle.right,
            "resolvable": oracle.resolvable,
            "answer_set": [list(names) for names in oracle.answer_set],
        },
        added_stress=dict(zip(bench.ids, recorded.added_rms, strict=True)),
        noise_drawn=_by_record(bench, recorded.noise),
        left_when_told=_by_record(bench, left_when_told(bank, planted, recorded.noise)),
    )
    declared = run.design.noise.strain > 0.0 and run.random.uniform() < 0.5
    noise = {"strain": float(f"{run.design.noise.strain:.2g}")} if declared else {}
    records = tuple(
        WrittenRecord(
            id=name,
            control=test.schedule.control,
            held_out=out,
            time=test.time,
            true_strain=strain,
            true_stress=stress,
            noise=noise,
            temperature=_read(run.random, bench.degrees[k], len(test.time)) if bench.degrees else None,
        )
        for k, (name, test, out, strain, stress) in enumerate(
            zip(bench.ids, bench.tests, bench.held_out, recorded.strain, recorded.stress, strict=True)
        )
    )
    return SealedCampaign(truth.name, records, bench.law.companion, truth, specimens_differ=bool(bench.specimens))


def _read(random: Generator, degrees: float, count: int) -> FloatArray:
    """What a thermometer on the specimen shows at `count` samples [°C]: off by a tenth, and noisy by another."""
    off, noisy = _THERMOMETER * random.standard_normal(), _THERMOMETER * random.standard_normal(count)
    return np.asarray(np.round(degrees + off + noisy, 2))


def _by_record(bench: Bench, samples: Sequence[FloatArray]) -> dict[str, float]:
    """Root mean squares by record."""
    return {name: float(np.sqrt(np.mean(sample**2))) for name, sample in zip(bench.ids, samples, strict=True)}


def _signal_of(bank: Bank, planted: Planted) -> Signal:
    """The signal of one usual amplitude of a planted cause, by what it adds at its own."""
    acting = planted.acting
    records = tuple(bank.bench.identified) if planted.record is None else (planted.record,)
    column = planted.column * (acting.cause.scale / acting.amplitude)
    return Signal(acting.cause, acting.shape, records, planted.record is None, column)
