"""Whether intervals of parameters hold the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, cast

from probation.normal import TWO_SIDED_95
from probation_studies.blind.scores.answer import UNKNOWN
from probation_studies.blind.scores.intervals import Rate

if TYPE_CHECKING:
    from probation_studies.blind.scores.case import Case

AMPLITUDES = {
    "force_offset": "offset_MPa",
    "force_drift": "drift_MPa",
    "force_gain": "gain_error",
    "force_strain_lag": "delay_s",
}
"""Effects whose amplitude is the same quantity in the catalogue and in the laboratory, and the catalogue's name of it.

The laboratory's forms bend it by up to some per cent, which the form's own error has to cover."""


def base_parameters(cases: Sequence[Case]) -> dict[str, object]:
    """How often the base law's parameters lie within their intervals of 95 %, where the cause is named rightly."""
    inside: dict[str, list[bool]] = {"none": [], "explained": []}
    for case in cases:
        if not case.right or UNKNOWN in case.explanation or case.answer.base is None:
            continue
        true = cast("dict[str, float]", case.truth["base"])
        for name, (value, error) in case.answer.base.items():
            if name in true:
                inside["explained" if case.causes else "none"].append(abs(value - true[name]) <= TWO_SIDED_95 * error)
    return {name: Rate.of(each).plain() for name, each in inside.items()}


def amplitudes(cases: Sequence[Case]) -> dict[str, object]:
    """How often the amplitude of a rig's fault lies within its interval of 95 %, where the cause is named rightly."""
    inside = []
    for case in cases:
        if not case.right or case.stratum not in ("single", "pair"):
            continue
        for cause in case.causes:
            known = case.answer.parameters.get(AMPLITUDES.get(str(cause["effect"]), ""))
            if known is not None:
                inside.append(abs(known[0] - _amplitude(cause)) <= TWO_SIDED_95 * known[1])
    return Rate.of(inside).plain()


def _amplitude(cause: Mapping[str, object]) -> float:
    """In the catalogue's sense: a slow strain channel lets the force run ahead."""
    ahead = cause["effect"] == "force_strain_lag" and "balance" not in cast("Mapping[str, float]", cause["shape"])
    return (-1.0 if ahead else 1.0) * cast("float", cause["amplitude"])
