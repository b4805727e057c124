"""One campaign: a series of tests, causes in it, records of it, and what is withheld."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING
from zlib import crc32

import numpy as np

from probation.errors import InputError
from probation_studies.blind.laboratories.test_house.causes import CAUSES, FORMS, Form
from probation_studies.blind.laboratories.test_house.handover import Made, Record, Truth, take_records
from probation_studies.blind.laboratories.test_house.machine import base_stress
from probation_studies.blind.laboratories.test_house.oracle import NONE, PAIR, SINGLE, consult
from probation_studies.blind.laboratories.test_house.planting import (
    Placed,
    Planted,
    Series,
    draw_series,
    rivals,
    signal_of,
)
from probation_studies.blind.laboratories.test_house.withheld import described

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.test_house.modal import FloatArray

SPLITS = ("develop", "calibrate", "test")
STRATA = ("none", "replicates", "single", "pair")
"""`replicates` are nulls whose specimens are repeated and differ; so do those of half of the other campaigns."""

_PARTS = (NONE / 2, NONE / 2, SINGLE, PAIR)
_TRIES = 20
_NULL_STRAIN_NOISES, _THEIR_PARTS = (1e-5, 1e-4, 5e-4), (5 / 16, 6 / 16, 5 / 16)
_IN_NO_PAIR = {"order", "temperatures"}
_RECORDED, _REPEATED = 999, 1000
"""Beside a series' attempts, what is drawn of its seed."""


def make(seed: int, index: int, split: str = "develop", stratum: str | None = None) -> Made:
    """Make one campaign; the same for the same arguments.

    Every 48 indices hold each form of each cause once, their halves each cause.

    Parameters
    ----------
    seed, index : int
        Not negative.
    split : {"develop", "calibrate", "test"}
    stratum : {"none", "replicates", "single", "pair"}, optional
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
    own = [crc32(b"test_house"), crc32(split.encode()), seed]
    random = np.random.default_rng([*own, index])
    drawn = str(random.choice(STRATA, p=_PARTS))
    stratum = drawn if stratum is None else stratum
    if stratum not in STRATA:
        raise InputError(f"stratum: found {stratum!r}, expected one of {', '.join(STRATA)}")
    for _ in range(_TRIES):
        forms, strain_noise, alike = _wanted(random, stratum, own, index)
        key = int(random.integers(2**31))
        series = draw_series(key, forms, strain_noise=strain_noise, alike=alike)
        if series is not None:
            seeds = {"split": split, "seed": seed, "index": index, "laboratory": "test_house", "stratum": stratum}
            return _finish(key, series, seeds)
    raise RuntimeError(f"{split}-{index:04d}: no campaign of stratum {stratum} in {_TRIES} series")


def _wanted(
    random: Generator, stratum: str, own: list[int], index: int
) -> tuple[list[Form], float | None, bool | None]:
    """Forms, strain noise and whether specimens are alike; None where that is drawn with the series."""
    if stratum in ("none", "replicates"):
        return [], float(random.choice(_NULL_STRAIN_NOISES, p=_THEIR_PARTS)), stratum == "none"
    if stratum == "single":
        return [form_of(own, index)], None, bool(random.integers(2))
    may_pair = [form for form in FORMS.values() if not _IN_NO_PAIR & form.needs]
    while True:
        one, other = (may_pair[int(k)] for k in random.choice(len(may_pair), 2, replace=False))
        if one.cause != other.cause:
            return [one, other], None, None


def form_of(own: list[int], index: int) -> Form:
    """The form of a single effect, in a drawn order: each of them once in 48 indices, each cause once in 24.

    Parameters
    ----------
    own : list of int
        Of which the order is drawn.
    index : int
    """
    block, place = divmod(index, len(FORMS))
    random = np.random.default_rng([*own, block, len(FORMS)])
    first = {cause: random.permutation([name for other, name in FORMS if other == cause]) for cause in CAUSES}
    order = [str(cause) for _ in range(2) for cause in random.permutation(CAUSES)]
    return FORMS[order[place], str(first[order[place]][place // len(CAUSES)])]


def _finish(key: int, series: Series, seeds: dict[str, object]) -> Made:
    plan, planted, name = series.plan, series.planted, f"{seeds['split']}-{seeds['index']:04d}"
    records = take_records(np.random.default_rng([key, _RECORDED]), plan, [each.effect for each in planted])
    base = {test.name: base_stress(test) for test in series.tests}
    candidates = [*rivals(series.tests, base, series.metric, {each.effect.form.cause for each in planted})]
    candidates += [_told(each, series) for each in planted]
    acting = np.sum([each.signal for each in planted], axis=0) if planted else np.zeros(series.metric.count)
    noise = {each.test.name: _noise(each, series) for each in records}
    seen = {each.test.name: noise[each.test.name] + _deviating(each, series) for each in records}
    truth = tuple(sorted(each.effect.form.cause for each in planted))
    oracle = consult(np.random.default_rng([key, _REPEATED]), candidates, acting, series.metric.left(seen), truth)
    before = {test.name: base_stress(test) for test in plan.coarse}
    added = [signal_of(plan.coarse, each.effect, before) for each in planted]
    content: dict[str, object] = {
        "name": name,
        **seeds,
        "target": max((each.size for each in planted), default=0.0),
        "causes": [described(each, plan.coarse, before) for each in planted],
        "mimics": "",
        "explanation": list(truth),
        "detectability": float(np.linalg.norm(acting)),
        "base": {
            "unrelaxed_modulus_MPa": plan.law.modulus,
            **({"tau_max_s": plan.law.seconds} if plan.law.companion is None else {"alpha": plan.law.alpha}),
            "hardening_modulus_MPa": plan.law.hardening,
        },
        "noise_MPa": {test.name: plan.errors.stress for test in plan.fine},
        "noise": asdict(plan.errors),
        "replicates": plan.scatter is not None,
        "scatter": None if plan.scatter is None else asdict(plan.scatter),
        "records": {
            test.name: {
                "history": test.history.kind,
                "role": "identify",
                "temperature_C": test.temperature,
                "duration_s": float(test.history.time[-1]),
                "samples": len(test.history.time),
            }
            for test in plan.fine
        },
        "oracle": oracle.said,
        "added_MPa": {
            test.name: _rms(sum((each[test.name] for each in added if test.name in each), np.zeros(1)))
            for test in plan.fine
        },
        "noise_drawn_MPa": {record: _rms(each) for record, each in noise.items()},
    }
    return Made(name, plan, records, Truth(content))


def _told(planted: Planted, series: Series) -> Placed:
    """As a candidate of the oracle, which knows that it is of this form."""
    form, record = planted.effect.form, planted.effect.record
    return Placed(form, record, form.shares([test.name for test in series.tests])[record], planted.signal)


def _noise(record: Record, series: Series) -> FloatArray:
    """What the true law leaves along the recorded strain [MPa]."""
    return record.stress_error - series.metric.responses[record.test.name] @ record.strain_error


def _deviating(record: Record, series: Series) -> FloatArray:
    """What a specimen adds that differs from the mean [MPa]."""
    own, mean = record.test.law, series.plan.law
    ratios = own.modulus / mean.modulus, own.alpha / mean.alpha, own.hardening / mean.hardening, record.test.section
    return np.asarray(series.metric.tangents[record.test.name] @ (np.array(ratios) - 1.0))


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
