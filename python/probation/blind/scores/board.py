"""All scores of a set of answers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, cast

import numpy as np

from probation.blind.scores.answer import UNKNOWN
from probation.blind.scores.case import DETECTABILITIES
from probation.blind.scores.intervals import Rate
from probation.blind.scores.probabilities import area_under_curve, brier_score, log_score, reliability
from probation.blind.scores.where import overlap

if TYPE_CHECKING:
    from probation.blind.scores.case import Case

_STRATA = ("none", "single", "pair", "outside", "mimic")
_FALSE_ALARMS = 0.05
_OUTSIDE_ENOUGH = 8.0
_GOOD_OVERLAP, _GOOD_CLOSURE = 0.6, 0.95


def board(cases: Sequence[Case]) -> dict[str, object]:
    """Every score, by stratum and by detectability; rates carry exact intervals."""
    return {
        "by_stratum": _grouped(cases, lambda case: case.stratum, _STRATA),
        "by_detectability": _grouped(
            [case for case in cases if case.stratum in ("single", "pair")],
            lambda case: case.detectability_class,
            [name for name, _, _ in DETECTABILITIES],
        ),
        "resolvable": _group([case for case in cases if case.resolvable and case.stratum not in ("none", "mimic")]),
        "false_alarms": Rate.of(case.answer.gap for case in cases if case.stratum == "none").plain(),
        "detection": {
            name: Rate.of(case.answer.gap for case in cases if case.causes and case.detectability_class == name).plain()
            for name, _, _ in DETECTABILITIES
        },
        "exact_pairs": Rate.of(case.right for case in cases if case.stratum == "pair" and case.resolvable).plain(),
        "reliability": reliability([case for case in cases if case.stratum != "mimic"]),
        "confusion": _confusion(cases),
        "unknown": _unknown(cases),
        "where": _where(cases),
        "base_parameters": _base(cases),
        "closure": _closure(cases),
    }


def _grouped(cases: Sequence[Case], key: Callable[[Case], str], names: Sequence[str]) -> dict[str, dict[str, object]]:
    return {name: _group([case for case in cases if key(case) == name]) for name in names}


def _group(cases: Sequence[Case]) -> dict[str, object]:
    """Scores of one group."""
    oracle_size = [len(cast("list[object]", case.oracle["answer_set"])) for case in cases]
    return {
        "n": len(cases),
        "top1": Rate.of(case.right for case in cases).plain(),
        "oracle_expected": _mean([float(cast("float", case.oracle["right"])) for case in cases]),
        "probability_on_truth": _mean([case.probability for case in cases]),
        "answer_set": {
            "coverage": Rate.of(case.covered for case in cases).plain(),
            "mean_size": _mean([len(case.answer.answer_set) for case in cases]),
            "oracle_mean_size": _mean(oracle_size),
        },
        "log_score": log_score(cases),
        "brier_score": brier_score(cases),
    }


def _confusion(cases: Sequence[Case]) -> dict[str, dict[str, int]]:
    """For every truth, how often every answer was the most probable one; most frequent first."""
    counts: dict[str, Counter[str]] = {}
    for case in cases:
        counts.setdefault(_label(case.explanation), Counter())[_label(case.answer.top)] += 1
    return {truth: dict(counts[truth].most_common()) for truth in sorted(counts)}


def _label(names: Sequence[str]) -> str:
    return "+".join(names) or "none"


def _unknown(cases: Sequence[Case]) -> dict[str, object]:
    """Whether what is outside the catalogue is told from what is in it."""
    within = [case.answer.unknown for case in cases if case.stratum in ("none", "single", "pair")]
    outside = [case for case in cases if case.stratum == "outside"]
    clear = [case for case in outside if case.left >= _OUTSIDE_ENOUGH]
    level = float(np.quantile(within, 1.0 - _FALSE_ALARMS, method="higher")) if within else 1.0
    return {
        "auroc": area_under_curve([case.answer.unknown for case in outside], within),
        "auroc_clear": area_under_curve([case.answer.unknown for case in clear], within),
        "level_at_5_percent_false_alarms": level,
        "found": Rate.of(case.answer.unknown > level for case in outside).plain(),
        "found_clear": Rate.of(case.answer.unknown > level for case in clear).plain(),
    }


def _where(cases: Sequence[Case]) -> dict[str, object]:
    """Time of localised causes, and the record of those that sit in one; where the cause itself is right."""
    right = [case for case in cases if case.right and case.causes]
    overlaps = [overlap(case.answer.where, case.windows, case.durations) for case in right if case.localised]
    one_record = [
        (case.answer.records.get(case.answer.top, frozenset()), frozenset(cast("list[str]", case.causes[0]["records"])))
        for case in right
        if case.stratum == "single" and not case.causes[0]["everywhere"]
    ]
    return {
        "mean_overlap": _mean(overlaps),
        "overlap_of_0.6": Rate.of(each >= _GOOD_OVERLAP for each in overlaps).plain(),
        "right_record": Rate.of(found == true for found, true in one_record).plain(),
    }


def _base(cases: Sequence[Case]) -> dict[str, object]:
    """How often the base law's parameters lie within their intervals of 95 %."""
    inside: dict[str, list[bool]] = {"none": [], "explained": []}
    for case in cases:
        if not case.right or UNKNOWN in case.explanation or case.answer.base is None:
            continue
        true = cast("dict[str, float]", case.truth["base"])
        for name, (value, error) in case.answer.base.items():
            if name in true:
                inside["explained" if case.causes else "none"].append(abs(value - true[name]) <= 1.96 * error)
    return {name: Rate.of(each).plain() for name, each in inside.items()}


def _closure(cases: Sequence[Case]) -> dict[str, object]:
    """Closure where something of the catalogue acts, against 1, that of the true effect refitted without noise."""
    acting = [case for case in cases if case.stratum in ("single", "pair") and case.resolvable]
    found: dict[str, object] = {}
    for name in ("identify", "held_out"):
        shrinks = [getattr(case.answer, name) for case in acting]
        known = [each for each in shrinks if each.closure is not None]
        intervals = [each.interval for each in known if each.interval is not None]
        found[name] = {
            "median": float(np.median([each.closure for each in known])) if known else None,
            "closure_of_0.95": Rate.of(each.closure >= _GOOD_CLOSURE for each in known).plain(),
            "interval_holds_1": Rate.of(low <= 1.0 <= high for low, high in intervals).plain(),
        }
    return found


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if len(values) else None
