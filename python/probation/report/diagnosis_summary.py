"""A diagnosis on a terminal: the headline, then where, which, how far, the next test, and what to keep in mind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.diagnosis_tables import (
    MOST,
    effects_table,
    held_out_table,
    noise_table,
    shrink_table,
    where_table,
    which_table,
)
from probation.report.diagnosis_words import nowhere_text
from probation.report.skipped_words import MOST as MOST_SKIPPED
from probation.report.skipped_words import skipped_lines
from probation.settings.certificate import CERTIFICATE
from probation.wording import percentage

if TYPE_CHECKING:
    from probation.diagnosis.result import Diagnosis
    from probation.report.table import Table

MOST_SIGNS = 4


def summary(diagnosis: Diagnosis) -> str:
    """What was found.

    Returns
    -------
    str
        The first line holds the campaign and the headline, however long.
    """
    parts = [f"{diagnosis.campaign}: {diagnosis.headline}", _gap(diagnosis), _sentence(specimens_text(diagnosis))]
    if diagnosis.held_out:
        parts.append(_shown(held_out_table(diagnosis), ""))
    if diagnosis.located:
        parts.append(_shown(*where_table(diagnosis, MOST)))
    elif diagnosis.verdict != "no_gap":
        parts.append(_sentence(f"{nowhere_text(diagnosis)}."))
    parts.append("\n".join(_sentence(line) for line in _signs(diagnosis)))
    parts.append(_shown(*which_table(diagnosis, MOST)))
    if diagnosis.verdict != "no_gap":
        parts.append(_shown(*effects_table(diagnosis, MOST)))
    parts.append(
        _shown(*shrink_table(diagnosis, MOST)) + "\n" + _sentence(f"Intervals: {diagnosis.shrink.identify.how}.")
    )
    parts.append(_shown(*noise_table(diagnosis, MOST)))
    if diagnosis.remainder is not None:
        parts.append(diagnosis.remainder.description)
    if diagnosis.next_test is not None:
        parts.append(next_test_text(diagnosis))
    parts.append("\n".join(_sentence(f"left out: {line}") for line in skipped_lines(diagnosis.skipped, MOST_SKIPPED)))
    parts.append("\n".join(_sentence(f"warning: {warning}") for warning in diagnosis.warnings))
    return "\n\n".join(part for part in parts if part)


def gap_text(diagnosis: Diagnosis) -> str:
    """How large the gap is against the noise, and whether that depends on how well the noise is known."""
    gap = diagnosis.gap
    text = (
        f"The base law misses the fitted records by {diagnosis.rms_MPa:.3g} MPa rms; the noise is "
        f"{diagnosis.noise_MPa:.3g} MPa. A gap is declared where noise alone would look like this in fewer than "
        f"{100 * gap.level:g} % of all "
        f"cases; here it is {_cases(gap.p_value)}."
    )
    text += size_text(diagnosis)
    if gap.robust:
        return text
    return (
        f"{text} This hangs on how well the noise is known: {_cases(gap.p_value_low_noise)} if it were 0.8 times as "
        f"large, {_cases(gap.p_value_high_noise)} if 1.25 times."
    )


def specimens_text(diagnosis: Diagnosis) -> str:
    """How far specimens differ, and whether there would be a gap if they did not; empty where nothing is known."""
    if diagnosis.scatter is None:
        return ""
    text = diagnosis.scatter.text
    if diagnosis.scatter.any:
        none = diagnosis.verdict == "no_gap"
        also = "be a gap" if none else "be a gap as well (causes were not tried again)"
        text += "; if they were alike there would "
        text += also if diagnosis.gap_if_alike else "still be no gap" if none else "be no gap"
    return f"{text[:1].upper()}{text[1:]}."


def size_text(diagnosis: Diagnosis) -> str:
    """How large the gap is relative to the stress, and whether that matters; empty where nothing is known of it."""
    size = diagnosis.size
    if size is None:
        return ""
    low, high = size.interval_MPa
    if diagnosis.verdict == "no_gap":
        return (
            f" A gap of up to {high:.2g} MPa ({percentage(size.relative_interval[1])} % of the largest stress of "
            f"{size.record}) could be there unseen."
        )
    does = "" if diagnosis.matters else ", so that it does not matter"
    return (
        f" Without the noise the gap is {size.rms_MPa:.3g} MPa rms (95 %: {low:.3g} to {high:.3g}) in {size.record}: "
        f"{percentage(size.relative)} % of the largest stress there; {percentage(diagnosis.tolerance)} % are let pass"
        f"{does}, {percentage(CERTIFICATE.tolerance)} % by a certificate."
    )


def _cases(p_value: float) -> str:
    if p_value > 0.99:
        return "more than 99 %"
    return f"{percentage(p_value)} %" if p_value >= 1e-4 else "fewer than 0.01 %"


def next_test_text(diagnosis: Diagnosis) -> str:
    """The next test in one sentence; empty if there is none."""
    test = diagnosis.next_test
    if test is None:
        return ""
    cost = f" ({test.cost})" if test.cost else ""
    return f"Next test: {test.what.rstrip('.')}{cost}."


def signs(diagnosis: Diagnosis) -> list[str]:
    """What is sharp or drifts in the errors, one phrase each."""
    return [signature.text.strip().rstrip(".") for signature in diagnosis.signatures]


def _signs(diagnosis: Diagnosis) -> list[str]:
    every = signs(diagnosis)
    more = [f"… and {len(every) - MOST_SIGNS} more"] if len(every) > MOST_SIGNS else []
    return [f"sign: {sign}" for sign in every[:MOST_SIGNS]] + more


def _gap(diagnosis: Diagnosis) -> str:
    return _sentence(gap_text(diagnosis))


def _sentence(text: str) -> str:
    return f"  {text}" if text else ""


def _shown(table: Table, rest: str) -> str:
    text = table.text()
    return f"{text}\n  {rest}" if rest else text
