"""What an isolability analysis says to a person."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.settings.design import DESIGN
from probation.wording import percentage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.design.effect_design import Bias
    from probation.design.isolability import EffectIsolability, Isolability

_NAMED = 3


def headline(found: Isolability) -> str:
    """One sentence for the campaign: "These 4 records can name 14 of 22 effects; …"."""
    records, effects = len(found.records), len(found.effects)
    which = "This record" if records == 1 else f"These {records} records"
    parts = [f"{which} can name {len(found.with_status('named'))} of {effects} effects"]
    ambiguous = found.with_status("ambiguous")
    if ambiguous:
        sets = "; ".join(", ".join(group) for group in found.groups)
        parts.append(f"{len(ambiguous)} would be seen but could be taken for another ({sets})")
    if hidden := found.with_status("absorbed"):
        parts.append(f"{_listed([each.name for each in hidden])} would hide in the base parameters")
    if small := found.with_status("too_small"):
        parts.append(f"{_listed([each.name for each in small])} would drown in the noise at usual size")
    if silent := found.with_status("without_signal"):
        parts.append(f"{_listed([each.name for each in silent])} would do nothing in them")
    return "; ".join(parts) + "."


def sentence(each: EffectIsolability) -> str:
    """What these tests could say of one effect at its usual size."""
    name, size = next(iter(each.values.items()))
    there = f" in {each.records[0]}, where it shows best," if each.records else ""
    title = f"{each.title[0].upper()}{each.title[1:]} of usual size ({name} = {size:.3g}){there}"
    seen = f"{_count(each.detectability)} standard deviations"
    if each.status == "without_signal":
        return f"{title} does nothing in these records that the base law does not do."
    if each.status == "absorbed":
        return (
            f"{title} would hide: {_percent(each.absorbable)} of it is taken up by the base parameters, "
            f"which it biases ({_biased(each.biases)}); {_from(each)}."
        )
    if each.status == "too_small":
        return f"{title} would drown in the noise: {seen} where {DESIGN.detected:g} are needed; {_from(each)}."
    if each.status == "named":
        return f"{title} would be seen ({seen}) and discriminated from every other effect; {_from(each)}."
    likest = [f"{rival} ({100 * chance:.0f} % right)" for rival, chance in list(each.rivals.items())[:_NAMED]]
    more = len(each.rivals) - len(likest)
    others = _listed([*likest, f"{more} more"] if more else likest, "or")
    return f"{title} would be seen ({seen}) but could be taken for {others}; {_from(each)}."


def _from(each: EffectIsolability) -> str:
    """From which amplitude on it is seen, and named."""
    if each.seen_from is None:
        return "it is seen at no size within its bounds"
    seen = f"it is seen from {each.seen_from:.2g} on"
    if each.named_from is None:
        return f"{seen}, named at no size within its bounds"
    return f"{seen}, named from {each.named_from:.2g} on"


def _count(size: float) -> str:
    return f"{size:,.0f}" if size >= 100.0 else f"{size:.2g}"


def _biased(biases: Sequence[Bias]) -> str:
    """The biases that matter: "hardening_modulus_MPa by +3.1 %"."""
    worst = max((abs(bias.percent) for bias in biases), default=0.0)
    named = [bias for bias in biases if abs(bias.percent) >= DESIGN.bias_worth_naming * worst]
    return _listed([f"{bias.parameter} by {percentage(0.01 * bias.percent, '+')} %" for bias in named])


def _percent(share: float) -> str:
    """A share near 1 with the digits that tell it from 1."""
    text = f"{100.0 * share:.4g} %"
    return "all" if text == "100 %" else text


def _listed(items: Sequence[str], word: str = "and") -> str:
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} {word} {items[-1]}" if items else ""
