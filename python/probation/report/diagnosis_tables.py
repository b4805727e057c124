"""Where, which, how far: the tables of a diagnosis, for the terminal and for the page."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING

from probation.diagnosis.headline import title, with_known
from probation.inference.unknown import UNKNOWN
from probation.report.diagnosis_words import (
    checks_text,
    closed,
    closed_interval,
    explanation_name,
    p_text,
    parameter_lines,
    short_ids,
    span_text,
)
from probation.report.table import Table
from probation.settings.evidence import EVIDENCE
from probation.settings.smoothing import SMOOTHING
from probation.wording import chance, percent, plus_minus, signed_percent

if TYPE_CHECKING:
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.result import Diagnosis, Explanation

MOST = 8
"""Rows of a table on a terminal."""

WORTH_A_ROW = 0.01
"""Share or probability below which a row may be left out."""

P_VALUE = "p: how often noise alone would do it"

_STATUS = {
    "identifiable": "determined",
    "weakly_identifiable": "weakly determined",
    "not_identifiable": "not determined",
    "held": "held",
}


def where_table(diagnosis: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """Regions with a gap, most first, at most so many; and a line about those left out, empty if there are none."""
    names = short_ids(diagnosis.curves)
    rows = [
        (
            names[region.record],
            span_text(region.time_s),
            span_text(region.true_strain),
            f"{region.rms_MPa:.2g}",
            percent(region.share),
            p_text(region.p_value),
        )
        for region in diagnosis.located
    ]
    kept = _kept([region.share for region in diagnosis.located], most)
    headings = ("record", "time [s]", "true strain [–]", "rms error [MPa]", "share", "p")
    caption = f"Where the simulation departs (share of the squared gap{_of_which_fit(diagnosis)}; {P_VALUE})"
    if acting(diagnosis):
        caption = f"Where {mended_by(diagnosis)} acts (error it makes, share of its squared sum; {P_VALUE})"
    return Table(headings, tuple(rows[:kept]), caption), _rest(
        [region.share for region in diagnosis.located[kept:]], "region"
    )


def held_out_table(diagnosis: Diagnosis) -> Table:
    """The base law's predictions of records that it was not fitted to."""
    names = short_ids([*diagnosis.curves, *diagnosis.held_out])
    rows = tuple(
        (names[record], f"{held.rms_MPa:.3g}", f"{held.expected_MPa:.3g}", p_text(held.p_value))
        for record, held in diagnosis.held_out.items()
    )
    caption = (
        "What was only predicted (expected: by noise, uncertain parameters, specimens that differ; p: how often these "
        "alone would make an error of this course)"
    )
    return Table(("record", "rms error [MPa]", "expected [MPa]", "p"), rows, caption)


def which_table(diagnosis: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """Explanations, the most probable first; a star marks those that the data do not exclude."""
    shown = list(diagnosis.explanations)
    rows = []
    for shown_explanation in shown:
        star = "★" if shown_explanation.effects in diagnosis.answer_set else ""
        # Without a gap no cause is fitted: each is weighed from an amplitude of zero, which is no estimate.
        detail = diagnosis.verdict != "no_gap" and (bool(star) or shown_explanation.checks is not None)
        rows.append(
            (
                star,
                explanation_name(shown_explanation, diagnosis),
                "\n".join(parameter_lines(shown_explanation, diagnosis)) if detail else "",
                "\n".join(checks_text(shown_explanation)),
                chance(shown_explanation.probability),
            )
        )
    empty = {at for at in (2, 3) if not any(row[at] for row in rows)}
    inside = [max(explanation.probability, float(bool(row[0]))) for explanation, row in zip(shown, rows, strict=True)]
    kept = _kept(inside, most)
    headings = ("", "explanation", "its parameters", "checks", "probability")
    caption = "Which effect explains the gap (★: not excluded by the data)"
    lines = tuple(_without(row, empty) for row in rows[:kept])
    table = Table(_without(headings, empty), lines, caption, left=4 - len(empty))
    return table, _rest([explanation.probability for explanation in shown[kept:]], "explanation")


def effects_table(diagnosis: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """How probable each effect is, alone or with others, and how much of the gap it closes."""
    names = short_ids(diagnosis.curves)
    fitted = [curves.id for curves in diagnosis.curves.values() if curves.role == "identify"]
    rows = [
        (
            title(effect.name),
            chance(effect.probability),
            _share(effect.share) if effect.name in {*diagnosis.best.effects, *diagnosis.shrink.effects} else "–",
            _share(effect.alone),
            _share(effect.in_addition),
            "" if set(effect.records) >= {*fitted} else ", ".join(names.get(name, name) for name in effect.records),
        )
        for effect in diagnosis.effects
    ]
    empty = {at for at in (3, 4, 5) if not any(row[at] for row in rows)}
    kept = _kept([max(effect.probability, effect.share or 0.0) for effect in diagnosis.effects], most)
    allowed = diagnosis.scatter is not None and diagnosis.scatter.any
    of_the_gap = "of the gap, as the noise weighs it" if allowed else "of the gap"
    closing = f", and what it closes {of_the_gap} (–: not in the best explanation)"
    if diagnosis.best.effects == (UNKNOWN,) and diagnosis.shrink.effects:
        closing = f", and what it closes {of_the_gap} with {mended_by(diagnosis)}, the nearest of known effects"
    if any(effect.share is None for effect in diagnosis.effects):
        empty |= {2}
        closing = f"; no shares, the gap is not above {EVIDENCE.closure_gap:g} standard errors of the noise"
    headings = ("effect", "probability", "share of the gap", "alone", "in addition to the others", "only in")
    table = Table(
        _without(headings, empty),
        tuple(_without(row, empty) for row in rows[:kept]),
        f"Effect by effect: how probable it is{closing}",
    )
    return table, _rest([effect.probability for effect in diagnosis.effects[kept:]], "effect")


def shrink_table(diagnosis: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """How far known effects close the gap, all records together and one by one."""
    shrink, names = diagnosis.shrink, short_ids(diagnosis.curves)
    lines: list[tuple[str, Closure]] = [("all fitted records", shrink.identify)]
    if shrink.held_out is not None:
        lines.append(("all held-out records", shrink.held_out))
    if shrink.ceiling is not None:
        lines.append(("(any smooth correction)", shrink.ceiling))
    if len(shrink.records) > 1:
        lines += [(names.get(record, record), closure) for record, closure in shrink.records.items()]
    rows = [
        (
            label,
            f"{closure.before_MPa:.3g}",
            f"{closure.after_MPa:.3g}",
            f"{closure.noise_MPa:.3g}",
            closed(closure),
            closed_interval(closure),
        )
        for label, closure in lines
    ]
    kept = len(rows) if most is None else min(most, len(rows))
    headings = ("records", "before", "after", "noise", "gap closed", "90 % interval")
    mended = mended_by(diagnosis)
    by = f"with {mended}" if mended else "– no effect was added"
    allowed = diagnosis.scatter is not None and diagnosis.scatter.any
    apart = "; what specimens may differ by is taken off" if allowed else ""
    caption = f"How far the gap shrinks {by} (rms errors in MPa{apart})"
    return Table(headings, tuple(rows[:kept]), caption), _more(len(rows) - kept, "record")


def noise_table(diagnosis: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """The noise of every record, as it was estimated or as the campaign states it."""
    names = short_ids(diagnosis.curves)
    rows = [
        (
            names[curves.id],
            f"{curves.noise_MPa:.2g} ({_source(curves.noise_given)})",
            f"{_beyond_rounding(curves.strain_noise):.2g} ({_source(curves.strain_noise_given)})",
        )
        for curves in diagnosis.curves.values()
    ]
    kept = len(rows) if most is None else min(most, len(rows))
    headings = ("record", "noise of the stress [MPa]", "of the strain [–]")
    return Table(headings, tuple(rows[:kept]), "The noise of the records"), _more(len(rows) - kept, "record")


def next_tests_table(diagnosis: Diagnosis) -> Table:
    """What could be done next, and what it settles."""
    left = diagnosis.remainder
    variables = {dependence.variable for dependence in left.depends_on} if left else set()
    rows = tuple(
        (
            test.what.partition(": ")[0],
            f"on what {'the rest' if left is None or left.what == 'what is left' else left.what} depends"
            if {*chain(*test.separates)} <= variables
            else "which explanation is right",
            test.cost,
            chance(test.probability_after),
        )
        for test in diagnosis.next_tests
    )
    headings = ("test", "settles", "cost", "right answer after it")
    return Table(headings, rows, "What could be done next, the most worth first", left=3)


def base_table(diagnosis: Diagnosis) -> Table:
    """Parameters of the base law as fitted without any effect."""
    rows = tuple(
        (
            parameter.name,
            f"{parameter.value:.5g}" if parameter.se is None else plus_minus(parameter.value, parameter.se),
            _STATUS.get(parameter.status, parameter.status),
        )
        for parameter in diagnosis.base
    )
    headings = ("parameter", "value ± standard error", "by the data")
    return Table(headings, rows, "The base law, fitted without any effect")


def leading(diagnosis: Diagnosis) -> tuple[Explanation, ...]:
    """Those in the answer set, the most probable first."""
    return tuple(explanation for explanation in diagnosis.explanations if explanation.effects in diagnosis.answer_set)


def _of_which_fit(diagnosis: Diagnosis) -> str:
    """Of which errors the regions are, where these are not the ones that the strips show."""
    without = ", of a fit without the places that disturb it" if diagnosis.best.effects == (UNKNOWN,) else ""
    may_differ = diagnosis.scatter is not None and diagnosis.scatter.any
    return without + (", what specimens may differ by included" if may_differ else "")


def _beyond_rounding(strain_noise: float) -> float:
    return strain_noise if strain_noise > SMOOTHING.clean else 0.0


def acting(diagnosis: Diagnosis) -> bool:
    """Whether the regions shown are those in which the best explanation acts, not those of the base law's error."""
    return bool(diagnosis.located) and diagnosis.located == diagnosis.acts


def mended_by(diagnosis: Diagnosis) -> str:
    """What the curves and errors called "after" are made with; empty where nothing of the catalogue helps."""
    known = diagnosis.shrink.effects
    if not known:
        return ""
    shown = with_known(known, diagnosis.explanations)
    return explanation_name(replace(shown, effects=known, titles=tuple(title(name) for name in known)), diagnosis)


def _share(part: float | None) -> str:
    return "" if part is None else signed_percent(part)


def _without(row: tuple[str, ...], left_out: set[int]) -> tuple[str, ...]:
    return tuple(cell for at, cell in enumerate(row) if at not in left_out)


def _kept(parts: list[float], most: int | None) -> int:
    """How many rows are shown: all of them, or those worth one, at most so many."""
    if most is None:
        return len(parts)
    return min(most, max((at + 1 for at, part in enumerate(parts) if part >= WORTH_A_ROW), default=0))


def _rest(parts: list[float], what: str) -> str:
    if not parts:
        return ""
    few = max(parts)
    size = "below 1 %" if few < WORTH_A_ROW else f"of {percent(few)} at most"
    return f"{_more(len(parts), what)} {size}"


def _more(count: int, what: str) -> str:
    """How many rows are left out, as a line; empty if none are."""
    return f"… and {count} more {what}{'s' if count > 1 else ''}" if count else ""


def _source(given: bool) -> str:
    return "given" if given else "estimated"
