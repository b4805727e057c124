"""Where, which, how far: the tables of a diagnosis, for the terminal and for the page."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.diagnosis.headline import title
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
from probation.wording import chance, percent, plus_minus

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


def where_table(found: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """Regions with a gap, most first, at most so many; and a line about those left out, empty if there are none."""
    names = short_ids(found.curves)
    rows = [
        (
            names[each.record],
            span_text(each.time_s),
            span_text(each.true_strain),
            f"{each.rms_MPa:.2g}",
            percent(each.share),
            p_text(each.p_value),
        )
        for each in found.located
    ]
    kept = _kept([each.share for each in found.located], most)
    headings = ("record", "time [s]", "true strain [–]", "rms error [MPa]", "share", "p")
    caption = f"Where the simulation departs (share of the squared gap; {P_VALUE})"
    return Table(headings, tuple(rows[:kept]), caption), _rest([each.share for each in found.located[kept:]], "region")


def held_out_table(found: Diagnosis) -> Table:
    """The base law's predictions of records that it was not fitted to."""
    names = short_ids([*found.curves, *found.held_out])
    rows = tuple(
        (names[record], f"{each.rms_MPa:.3g}", f"{each.expected_MPa:.3g}", p_text(each.p_value))
        for record, each in found.held_out.items()
    )
    caption = "What was only predicted (p: how often noise and the uncertainty of the parameters alone would do it)"
    return Table(("record", "rms error [MPa]", "expected [MPa]", "p"), rows, caption)


def which_table(found: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """Explanations, the most probable first; a star marks those that the data cannot tell from the best."""
    shown = list(found.explanations)
    rows = []
    for each in shown:
        star = "★" if each.effects in found.answer_set else ""
        detail = bool(star) or each.checks is not None
        rows.append(
            (
                star,
                explanation_name(each, found),
                "\n".join(parameter_lines(each, found)) if detail else "",
                "\n".join(checks_text(each)),
                chance(each.probability),
            )
        )
    empty = {at for at in (2, 3) if not any(row[at] for row in rows)}
    inside = [max(each.probability, float(bool(row[0]))) for each, row in zip(shown, rows, strict=True)]
    kept = _kept(inside, most)
    headings = ("", "explanation", "its parameters", "checks", "probability")
    caption = "Which effect explains the gap (★: the data cannot tell these apart)"
    lines = tuple(_without(row, empty) for row in rows[:kept])
    table = Table(_without(headings, empty), lines, caption, left=4 - len(empty))
    return table, _rest([each.probability for each in shown[kept:]], "explanation")


def effects_table(found: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """How probable each effect is, alone or with others, and how much of the gap it closes."""
    names = short_ids(found.curves)
    fitted = [each.id for each in found.curves.values() if each.role == "identify"]
    rows = [
        (
            title(each.name),
            chance(each.probability),
            _signed(each.share) if each.name in found.best.effects else "–",
            "" if each.alone is None else _signed(each.alone),
            "" if each.beside is None else _signed(each.beside),
            "" if set(each.records) >= {*fitted} else ", ".join(names.get(name, name) for name in each.records),
        )
        for each in found.effects
    ]
    empty = {at for at in (3, 4, 5) if not any(row[at] for row in rows)}
    kept = _kept([max(each.probability, each.share) for each in found.effects], most)
    headings = ("effect", "probability", "share of the gap", "alone", "beside the others", "only in")
    table = Table(
        _without(headings, empty),
        tuple(_without(row, empty) for row in rows[:kept]),
        "Effect by effect: how probable it is, and what it closes of the gap (–: not in the best explanation)",
    )
    return table, _rest([each.probability for each in found.effects[kept:]], "effect")


def shrink_table(found: Diagnosis, most: int | None = None) -> tuple[Table, str]:
    """How far the best explanation closes the gap, all records together and one by one."""
    shrink, names = found.shrink, short_ids(found.curves)
    lines: list[tuple[str, Closure]] = [("all fitted records", shrink.identify)]
    if shrink.held_out is not None:
        lines.append(("all held-out records", shrink.held_out))
    if shrink.ceiling is not None:
        lines.append(("(any smooth correction)", shrink.ceiling))
    if len(shrink.records) > 1:
        lines += [(names.get(record, record), each) for record, each in shrink.records.items()]
    rows = [
        (
            label,
            f"{each.before_MPa:.3g}",
            f"{each.after_MPa:.3g}",
            f"{each.noise_MPa:.3g}",
            closed(each),
            closed_interval(each),
        )
        for label, each in lines
    ]
    kept = len(rows) if most is None else min(most, len(rows))
    headings = ("records", "before", "after", floor_name(found), "gap closed", "90 % interval")
    mended = mended_by(found)
    by = f"with {mended}" if mended else "– no effect was added"
    caption = f"How far the gap shrinks {by} (rms errors in MPa)"
    left_out = len(rows) - kept
    rest = "" if not left_out else f"… and {left_out} more record{'s' if left_out > 1 else ''}"
    return Table(headings, tuple(rows[:kept]), caption), rest


def floor_name(found: Diagnosis) -> str:
    """What no model can get below: the noise, and how far specimens differ where that is allowed for."""
    return "noise and scatter" if found.scatter is not None and found.scatter.any else "noise"


def next_tests_table(found: Diagnosis) -> Table:
    """What could be done next, the most worth first."""
    rows = tuple((each.what.partition(": ")[0], each.cost, chance(each.probability_after)) for each in found.next_tests)
    return Table(
        ("test", "cost", "right answer after it"), rows, "What could be done next, the most worth first", left=2
    )


def base_table(found: Diagnosis) -> Table:
    """Parameters of the base law as fitted without any effect."""
    rows = tuple(
        (
            each.name,
            f"{each.value:.5g}" if each.se is None else plus_minus(each.value, each.se),
            _STATUS.get(each.status, each.status),
        )
        for each in found.base
    )
    headings = ("parameter", "value ± standard error", "by the data")
    return Table(headings, rows, "The base law, fitted without any effect")


def leading(found: Diagnosis) -> tuple[Explanation, ...]:
    """Those in the answer set, the most probable first."""
    return tuple(each for each in found.explanations if each.effects in found.answer_set)


def mended_by(found: Diagnosis) -> str:
    """What the curves and errors called "after" are made with; empty where nothing of the catalogue helps."""
    known = tuple(effect for effect in found.best.effects if effect != UNKNOWN)
    titles = tuple(
        title for effect, title in zip(found.best.effects, found.best.titles, strict=False) if effect in known
    )
    return explanation_name(replace(found.best, effects=known, titles=titles), found) if known else ""


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
    return f"… and {len(parts)} more {what}{'s' if len(parts) > 1 else ''} {size}"


def _signed(part: float) -> str:
    """A share, which is negative where an effect makes the misfit larger."""
    return percent(part) if part > -0.005 else f"−{percent(-part)}"
