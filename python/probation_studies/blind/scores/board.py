"""All scores of a set of answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, cast

import numpy as np

from probation_studies.blind.scores.case import DETECTABILITIES, UNKNOWN, oracle_answer
from probation_studies.blind.scores.closure import closure
from probation_studies.blind.scores.confusion import confusion, confusion_matrix
from probation_studies.blind.scores.held import amplitudes, base_parameters
from probation_studies.blind.scores.intervals import Average, Rate
from probation_studies.blind.scores.probabilities import area_under_curve, brier_score, log_score, reliability
from probation_studies.blind.scores.where import overlap

if TYPE_CHECKING:
    from probation_studies.blind.scores.case import Case

_STRATA = ("none", "single", "pair", "outside", "mimic")
_FALSE_ALARMS = 0.05
_GOOD_OVERLAP = 0.6
_USUAL_STRAIN = 5e-4

STRAIN_NOISES = {"to 2e-5": 2e-5, "to 2e-4": 2e-4, "above": np.inf}
"""Classes of the recorded strain's standard deviation, and the most of each."""

STRENGTHS = {"to 10": 10.0, "to 30": 30.0, "above": np.inf}
"""Classes of √λ of all that acts, and the most of each; from 30 on an effect is plain."""


def board(cases: Sequence[Case]) -> dict[str, object]:
    """Every score, by stratum and by detectability; rates carry exact intervals."""
    resolvable, nulls = [case for case in cases if case.resolvable], [case for case in cases if case.stratum == "none"]
    return {
        "by_stratum": _grouped(cases, lambda case: case.stratum, _STRATA),
        "by_detectability": _grouped(
            [case for case in cases if case.stratum in ("single", "pair")],
            lambda case: case.detectability_class,
            [name for name, _, _ in DETECTABILITIES],
        ),
        "gaps": _group([case for case in cases if case.causes]),
        "resolvable": _group([case for case in resolvable if case.stratum not in ("none", "mimic")]),
        "resolvable_by_stratum": _grouped(
            [case for case in cases if case.resolvable], lambda case: case.stratum, _STRATA
        ),
        "false_alarms": Rate.of(case.answer.gap for case in nulls).plain(),
        "false_alarms_by_kind": false_alarms(nulls),
        "by_strain_noise": {name: _quality(each) for name, each in by_strain_noise(cases, STRAIN_NOISES).items()},
        "by_strength": {name: _quality(each) for name, each in by_strength(cases, STRENGTHS).items()},
        "detection": {
            name: Rate.of(case.answer.gap for case in cases if case.causes and case.detectability_class == name).plain()
            for name, _, _ in DETECTABILITIES
        },
        "exact_pairs": Rate.of(case.right for case in cases if case.stratum == "pair" and case.resolvable).plain(),
        "reliability": reliability([case for case in cases if case.stratum != "mimic"]),
        "confusion": confusion(cases),
        "confusion_matrix": confusion_matrix(cases),
        "unknown": _unknown(cases),
        "where": _where(cases),
        "base_parameters": base_parameters(cases),
        "amplitudes": amplitudes(cases),
        "closure": closure(cases),
    }


def false_alarms(nulls: Sequence[Case]) -> dict[str, object]:
    """Of alike and of differing specimens, of those whose replicates show it, and of strains as usually measured."""
    quiet = [case for case in nulls if case.strain_noise <= _USUAL_STRAIN]
    return {
        "alike": Rate.of(case.answer.gap for case in nulls if not case.specimens_differ).plain(),
        "differing": Rate.of(case.answer.gap for case in nulls if case.specimens_differ).plain(),
        "replicates": Rate.of(case.answer.gap for case in nulls if case.answer.scatter == "replicates").plain(),
        "strain_noise_to_5e-4": Rate.of(case.answer.gap for case in quiet).plain(),
    }


def in_classes(
    most: Mapping[str, float], cases: Sequence[Case], size: Callable[[Case], float]
) -> dict[str, list[Case]]:
    """The cases of every class of a size, by name; `most` of each, rising."""
    classes = np.searchsorted(list(most.values()), [size(case) for case in cases])
    return {name: [case for case, of in zip(cases, classes, strict=True) if of == k] for k, name in enumerate(most)}


def by_strain_noise(cases: Sequence[Case], most: Mapping[str, float]) -> dict[str, list[Case]]:
    """The cases of every class of the strain's noise."""
    return in_classes(most, cases, lambda case: case.strain_noise)


def by_strength(cases: Sequence[Case], most: Mapping[str, float]) -> dict[str, list[Case]]:
    """Those with causes, of every class of √λ."""
    return in_classes(most, [case for case in cases if case.causes], lambda case: case.detectability)


def _quality(cases: Sequence[Case]) -> dict[str, object]:
    """False alarms, resolvable single causes named, and gaps that the answer set holds."""
    return {
        "false_alarms": Rate.of(case.answer.gap for case in cases if case.stratum == "none").plain(),
        "single_named": Rate.of(case.right for case in cases if case.stratum == "single" and case.resolvable).plain(),
        "sets_hold": Rate.of(case.covered for case in cases if case.causes).plain(),
    }


def _grouped(cases: Sequence[Case], key: Callable[[Case], str], names: Sequence[str]) -> dict[str, dict[str, object]]:
    return {name: _group([case for case in cases if key(case) == name]) for name in names}


def _group(cases: Sequence[Case]) -> dict[str, object]:
    """Scores of one group."""
    on_truth = Average.mean([case.probability for case in cases])
    size = [len(case.answer.answer_set) for case in cases]
    oracle_size = [len(oracle_answer(case.truth).answer_set) for case in cases]
    return {
        "n": len(cases),
        "top1": Rate.of(case.right for case in cases).plain(),
        "oracle_expected": _mean([float(cast("float", case.oracle["right"])) for case in cases]),
        "probability_on_truth": on_truth.value,
        "probability_on_truth_interval95": on_truth.ends,
        "answer_set": {
            "coverage": Rate.of(case.covered for case in cases).plain(),
            "mean_size": _mean(size),
            "oracle_mean_size": _mean(oracle_size),
            "over_oracle": Average.ratio(size, oracle_size).plain(),
        },
        "log_score": log_score(cases),
        "brier_score": brier_score(cases),
    }


def _unknown(cases: Sequence[Case]) -> dict[str, object]:
    """Whether what is outside the catalogue is discriminated from what is in it."""
    within = [case.answer.unknown for case in cases if case.stratum in ("none", "single", "pair")]
    outside = [case for case in cases if case.stratum == "outside" and UNKNOWN in case.explanation]
    clear = [case for case in outside if case.clear]
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
    mean = Average.mean(overlaps)
    one_record = [
        (case.answer.records.get(case.answer.top, frozenset()), frozenset(cast("list[str]", case.causes[0]["records"])))
        for case in right
        if case.stratum == "single" and not case.causes[0]["everywhere"]
    ]
    return {
        "mean_overlap": mean.value,
        "mean_overlap_interval95": mean.ends,
        "overlap_of_0.6": Rate.of(each >= _GOOD_OVERLAP for each in overlaps).plain(),
        "right_record": Rate.of(found == true for found, true in one_record).plain(),
    }


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if len(values) else None
