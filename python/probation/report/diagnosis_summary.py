"""A diagnosis on a terminal: the headline, then where, which, how far, the next test, and what to keep in mind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.diagnosis_tables import (
    MOST,
    effects_table,
    held_out_table,
    shrink_table,
    where_table,
    which_table,
)
from probation.report.skipped_words import MOST as MOST_SKIPPED
from probation.report.skipped_words import skipped_lines
from probation.settings.certificate import CERTIFICATE
from probation.wording import percentage

if TYPE_CHECKING:
    from probation.diagnosis.result import Diagnosis
    from probation.report.table import Table

MOST_SIGNS = 4


def summary(found: Diagnosis) -> str:
    """What was found.

    Returns
    -------
    str
        The first line holds the campaign and the headline, however long.
    """
    parts = [f"{found.campaign}: {found.headline}", _gap(found), _sentence(specimens_text(found))]
    if found.held_out:
        parts.append(_shown(held_out_table(found), ""))
    if found.located:
        parts.append(_shown(*where_table(found, MOST)))
    parts.append("\n".join(_sentence(line) for line in _signs(found)))
    parts.append(_shown(*which_table(found, MOST)))
    if found.verdict != "no_gap":
        parts.append(_shown(*effects_table(found, MOST)))
    parts.append(_shown(*shrink_table(found, MOST)) + "\n" + _sentence(f"Intervals: {found.shrink.identify.how}."))
    if found.remainder is not None:
        parts.append(found.remainder.description)
    if found.next_test is not None:
        parts.append(next_test_text(found))
    parts.append("\n".join(_sentence(f"left out: {each}") for each in skipped_lines(found.skipped, MOST_SKIPPED)))
    parts.append("\n".join(_sentence(f"warning: {warning}") for warning in found.warnings))
    return "\n\n".join(part for part in parts if part)


def gap_text(found: Diagnosis) -> str:
    """How large the gap is against the noise, and whether that depends on how well the noise is known."""
    gap = found.gap
    text = (
        f"The base law misses the fitted records by {found.rms_MPa:.3g} MPa rms; the noise is {found.noise_MPa:.3g} "
        f"MPa. A gap is declared where noise alone would look like this in fewer than {100 * gap.level:g} % of all "
        f"cases; here it is {_cases(gap.p_value)}."
    )
    text += size_text(found)
    if gap.robust:
        return text
    return (
        f"{text} This hangs on how well the noise is known: {_cases(gap.p_value_low_noise)} if it were 0.8 times as "
        f"large, {_cases(gap.p_value_high_noise)} if 1.25 times."
    )


def specimens_text(found: Diagnosis) -> str:
    """How far specimens differ, and whether there would be a gap if they did not; empty where nothing is known."""
    if found.scatter is None:
        return ""
    text = found.scatter.text
    if found.scatter.any and found.verdict == "no_gap":
        text += "; if they were alike there would " + ("be a gap" if found.hangs_on_scatter else "still be no gap")
    return f"{text[:1].upper()}{text[1:]}."


def size_text(found: Diagnosis) -> str:
    """How large the gap is relative to the stress, and whether that matters; empty where nothing is known of it."""
    size = found.size
    if size is None:
        return ""
    low, high = size.interval_MPa
    if found.verdict == "no_gap":
        return (
            f" A gap of up to {high:.2g} MPa ({percentage(size.relative_interval[1])} % of the largest stress of "
            f"{size.record}) could be there unseen."
        )
    does = "" if found.matters else ", so that it does not matter"
    return (
        f" Without the noise the gap is {size.rms_MPa:.3g} MPa rms (95 %: {low:.3g} to {high:.3g}) in {size.record}: "
        f"{percentage(size.relative)} % of the largest stress there; {percentage(found.tolerance)} % are let pass"
        f"{does}, {percentage(CERTIFICATE.tolerance)} % by a certificate."
    )


def _cases(p_value: float) -> str:
    if p_value > 0.99:
        return "more than 99 %"
    return f"{percentage(p_value)} %" if p_value >= 1e-4 else "fewer than 0.01 %"


def next_test_text(found: Diagnosis) -> str:
    """The next test in one sentence; empty if there is none."""
    test = found.next_test
    if test is None:
        return ""
    cost = f" ({test.cost})" if test.cost else ""
    return f"Next test: {test.what.rstrip('.')}{cost}."


def signs(found: Diagnosis) -> list[str]:
    """What is sharp or drifts in the errors, one phrase each."""
    return [each.text.strip().rstrip(".") for each in found.signatures]


def _signs(found: Diagnosis) -> list[str]:
    every = signs(found)
    more = [f"… and {len(every) - MOST_SIGNS} more"] if len(every) > MOST_SIGNS else []
    return [f"sign: {each}" for each in every[:MOST_SIGNS]] + more


def _gap(found: Diagnosis) -> str:
    return _sentence(gap_text(found))


def _sentence(text: str) -> str:
    return f"  {text}" if text else ""


def _shown(table: Table, rest: str) -> str:
    text = table.text()
    return f"{text}\n  {rest}" if rest else text
