"""A diagnosis in words that need no statistics: names, probabilities, parameters, checks."""

from __future__ import annotations

from math import floor, log10
from typing import TYPE_CHECKING

from probation.inference.unknown import UNKNOWN
from probation.settings.detection import DETECTION
from probation.settings.evidence import EVIDENCE
from probation.wording import plus_minus

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation.diagnosis.closure import Closure
    from probation.diagnosis.result import CauseParameter, Checks, Diagnosis, Explanation
    from probation.effects.effect import EffectParameter

NOTHING = "no effect is needed"
OUTSIDE = "an effect outside the catalogue"

LONGEST_ID = 30
"""Letters of a record's id that tables and figures show."""

_SMALLEST_P = 1e-4  # draws of the noise tell no less
_UNIT_WORDS = {"°C": "degC", "%": "percent"}


def name_of(effects: Sequence[str], titles: Sequence[str] = ()) -> str:
    """An explanation's name: "self-heating + damage"; `titles` where they are known."""
    known = [effect for effect in effects if effect != UNKNOWN]
    words = " + ".join(titles if len(titles) == len(known) else [effect.replace("_", " ") for effect in known])
    if UNKNOWN not in effects:
        return words or NOTHING
    return f"{words} + {OUTSIDE}" if words else OUTSIDE


def explanation_name(explanation: Explanation, diagnosis: Diagnosis) -> str:
    """The same with the record that it sits in, where it does not touch all that were fitted."""
    titles = [
        title
        for effect, title in zip(explanation.effects, explanation.titles, strict=False)
        if UNKNOWN not in (effect, title)
    ]
    name = name_of(explanation.effects, titles)
    fitted = {curves.id for curves in diagnosis.curves.values() if curves.role == "identify"}
    if not explanation.records or fitted <= set(explanation.records):
        return name
    if len(explanation.records) == 1:
        return f"{name}, in {short_ids(diagnosis.curves).get(explanation.records[0], explanation.records[0])} alone"
    return f"{name}, in {len(explanation.records)} of {len(fitted)} records"


def nowhere_text(diagnosis: Diagnosis) -> str:
    """Why no part of a record is named as the place of the gap."""
    if diagnosis.verdict == "no_gap":
        return "In no part of any record can a gap be distinguished from noise"
    causes = "noise and specimens that differ" if diagnosis.scatter is not None and diagnosis.scatter.any else "noise"
    return (
        f"No part of a record departs by more than {causes} can do there; the records as a whole depart by more than "
        "these can do"
    )


def short_ids(ids: Iterable[str], longest: int = LONGEST_ID) -> dict[str, str]:
    """Record ids with the middle of long ones left out, where they still differ then."""
    every = list(ids)
    short = [record_id if len(record_id) <= longest else _shortened(record_id, longest) for record_id in every]
    return {name: brief if short.count(brief) == 1 else name for name, brief in zip(every, short, strict=True)}


def _shortened(text: str, longest: int) -> str:
    """Its beginning and its end, cut between words where there are some."""
    head, tail = text[: longest // 2 - 1], text[-(longest // 2) :]
    front, _, _ = head.rpartition(" ")
    _, _, back = tail.partition(" ")
    head = front if len(front) > longest // 4 else head.rstrip()
    tail = back if len(back) > longest // 4 else tail.lstrip()
    return f"{head} … {tail}" if front and back else f"{head}…{tail}"


def count_text(value: float) -> str:
    """Standard deviations as one reads them: "9.3", "120"."""
    return f"{value:.0f}" if value >= 10.0 or value < 0.05 else f"{value:.1f}"


def p_text(value: float) -> str:
    """A p-value: "0.021", "< 0.0001"."""
    return f"{value:.2g}" if value >= _SMALLEST_P else f"< {_SMALLEST_P:.4f}"


def closed(closure: Closure) -> str:
    """How much of the gap is gone, with the digits that mean something: "99.7 %"."""
    return "no gap to close" if closure.closure is None else f"{_closed(closure.closure, _digits(closure))} %"


def closed_interval(closure: Closure) -> str:
    """Its interval: "99.1 to 99.9 %"."""
    return (
        ""
        if closure.interval is None
        else f"{' to '.join(_closed(end, _digits(closure)) for end in closure.interval)} %"
    )


def span_text(ends: tuple[float, float]) -> str:
    """An interval with the digits that its length deserves: "0.58 to 1.32"."""
    length = abs(ends[1] - ends[0])
    digits = max(1 - floor(log10(0.5 * length)), 0) if length > 0.0 else 3
    return " to ".join(f"{round(end, digits) + 0.0:.{digits}f}" for end in ends).replace("-", "−")  # no "-0.00"


def _digits(closure: Closure) -> int:
    if closure.interval is None or closure.interval[1] <= closure.interval[0]:
        return 1
    return min(max(-floor(log10(50.0 * (closure.interval[1] - closure.interval[0]))), 0), 2)


def _closed(part: float, digits: int = 0) -> str:
    return f"{100.0 * part:.{digits}f}".replace("-", "−")


def parameter_text(parameter: CauseParameter) -> str:
    """Such as "heating 0.48 ± 0.02 °C/MPa": the unit goes from the name to behind the value."""
    value = f"{parameter.value:.4g}" if parameter.se is None else plus_minus(parameter.value, parameter.se)
    notes = []
    if parameter.bound:
        notes.append(f"at its {parameter.bound} bound")
    elif parameter.se is None:
        notes.append("not determined")
    words = [parameter_words(parameter), value, parameter.unit, *(f"({note})" for note in notes)]
    return " ".join(words).replace("  ", " ").rstrip()


def parameter_lines(explanation: Explanation, diagnosis: Diagnosis) -> list[str]:
    """An explanation's parameters, one a line; those of a combination under the name of their effect."""
    titles = dict(zip(explanation.effects, explanation.titles, strict=False))
    causes = list(dict.fromkeys((parameter.effect, parameter.records) for parameter in explanation.parameters))
    lines = []
    for effect, records in causes:
        if len(causes) > 1:
            place = f", in {short_ids(diagnosis.curves).get(records[0], records[0])}" if len(records) == 1 else ""
            lines.append(f"{titles.get(effect, effect.replace('_', ' '))}{place}:")
        lines += [
            parameter_text(own) for own in explanation.parameters if (own.effect, own.records) == (effect, records)
        ]
    return lines


def parameter_words(parameter: CauseParameter | EffectParameter) -> str:
    """The name of a parameter without its unit: "heating" for `heating_degC_per_MPa`."""
    suffix = _suffix(parameter.unit)
    return (parameter.name.removesuffix(f"_{suffix}") if suffix else parameter.name).replace("_", " ")


def _suffix(unit: str) -> str:
    above, _, below = unit.partition("/")
    parts = [_UNIT_WORDS.get(part, part) for part in (above, below)]
    if not below:
        return parts[0]
    return f"per_{parts[1]}" if above == "1" else f"{parts[0]}_per_{parts[1]}"


def checks_text(explanation: Explanation) -> list[str]:
    """What speaks for or against an explanation in addition to its probability, one phrase each."""
    checks = explanation.checks
    if checks is None:
        return []
    phrases = [*_prediction(checks)]
    if checks.amplitude_p_value is not None:
        same = checks.amplitude_p_value >= EVIDENCE.same_amplitude
        phrases.append("one strength suits all records" if same else "each record wants another strength")
    if explanation.effects and checks.remaining_p_value < DETECTION.gap_level and explanation.effects != (UNKNOWN,):
        phrases.append("a gap is left in addition")
    elif explanation.effects and UNKNOWN not in explanation.effects:
        phrases.append("what is left may be noise and the form's error")
    return [*phrases, *(_without_names(note, explanation) for note in checks.notes)]


def _without_names(note: str, explanation: Explanation) -> str:
    for parameter in sorted(explanation.parameters, key=lambda parameter: -len(parameter.name)):
        note = note.replace(parameter.name, parameter_words(parameter))
    return note


def _prediction(checks: Checks) -> list[str]:
    if checks.left_out is None:
        return []
    if checks.left_out <= 0.0:
        return ["predicts records left out no better than the base law"]
    only = "" if checks.left_out >= 0.8 else "only "
    return [f"predicts {only}{_closed(checks.left_out)} % of the gap in records left out"]
