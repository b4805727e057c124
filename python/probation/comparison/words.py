"""A comparison in words."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from probation.comparison.result import ChangedParameter, ChangeExplanation, Comparison

WIDTH = 100
MOST = 6


def named(each: ChangeExplanation) -> str:
    """An explanation's name."""
    if not each.effects:
        return "nothing changed"
    words = [
        "something that no known change does" if name == "unknown" else name.replace("_", " ") for name in each.effects
    ]
    return " and ".join(sorted(words, key=lambda word: word.startswith("something")))


def headline(best: ChangeExplanation, count: int, reference: str) -> str:
    """One sentence."""
    chance = f"(probability {percent(best.probability)})"
    if not best.effects:
        return f"Nothing changed since {reference} {chance}."
    where = "all records" if len(best.records) == count and count > 1 else ", ".join(best.records)
    sizes = "; ".join(sized(each) for each in best.parameters[:3])
    return f"Since {reference}: {named(best)} in {where} {chance}" + (f": {sizes}." if sizes else ".")


def sized(each: ChangedParameter) -> str:
    """A size with its interval."""
    low, high = each.interval95
    return f"{each.name} = {each.value:.3g} (95 %: {low:.3g} to {high:.3g})"


def percent(part: float) -> str:
    """A probability."""
    return "> 99 %" if part > 0.99 else "< 1 %" if part < 0.01 else f"{100 * part:.0f} %"


def summary(found: Comparison) -> str:
    """The headline, then every explanation of the answer set and the next ones, then the records."""
    lines = [f"{found.campaign}: {found.headline}", ""]
    for each in found.explanations[:MOST]:
        star = "*" if each in found.answer_set else " "
        where = ", ".join(each.records)
        text = f"{star} {percent(each.probability):>6}  {named(each)}" + (f" in {where}" if where else "")
        lines.append(fill(text, WIDTH, subsequent_indent="            "))
        lines += [f"            {sized(parameter)}" for parameter in each.parameters]
    lines.append("")
    for name, others in found.pairs.items():
        text = (
            f"{name} against {', '.join(others)}: the change is {found.rms_MPa[name]:.3g} MPa rms, the noise "
            f"{found.noise_MPa[name]:.3g} MPa"
        )
        lines.append(fill(text, WIDTH, initial_indent="  ", subsequent_indent="    "))
    lines += [fill(f"warning: {each}", WIDTH, initial_indent="  ", subsequent_indent="    ") for each in found.warnings]
    return "\n".join(lines)
