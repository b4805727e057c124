"""A diagnosis as a page, for readers who know their tests and no statistics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.diagnosis.headline import titles
from probation.effects.registry import effects as known_effects
from probation.inference.unknown import UNKNOWN
from probation.provenance import provenance
from probation.report.diagnosis_figures import closure_figure, probability_figure, record_figure
from probation.report.diagnosis_summary import gap_text, next_test_text, signs, specimens_text
from probation.report.diagnosis_tables import (
    acting,
    base_table,
    effects_table,
    held_out_table,
    leading,
    mended_by,
    next_tests_table,
    noise_table,
    shrink_table,
    where_table,
    which_table,
)
from probation.report.diagnosis_words import closed, explanation_name, name_of, nowhere_text, span_text
from probation.report.isolability_figure import isolability_figure
from probation.report.isolability_page import HOW_TO_READ_THE_MAP
from probation.report.isolability_table import in_words, isolability_table
from probation.report.page import Gallery, Page, Section, picture
from probation.report.remainder_page import remainder_section
from probation.report.residual_map import residual_map
from probation.report.skipped_words import skipped_lines
from probation.report.table import Table
from probation.wording import chance, change, listed, percent, sentence

if TYPE_CHECKING:
    from pathlib import Path

    from probation.diagnosis.result import Diagnosis
    from probation.report.page import Mood, Picture

_PLACES = 4
_EXPLANATIONS = 20
_SHOWN = 6  # explanations in the summary
_MOOD: dict[str, Mood] = {"no_gap": "good", "not_predicted": "bad", "explained": "neutral", "unexplained": "bad"}


def write_diagnosis_page(diagnosis: Diagnosis, path: Path) -> None:
    """Write the page."""
    diagnosis_page(diagnosis).write(path)


def diagnosis_page(diagnosis: Diagnosis) -> Page:
    """The page: the verdict, where, before and after, which, how far, the next test, isolability, details."""
    sections = [_short(diagnosis), _where(diagnosis), _records(diagnosis), _which(diagnosis), _shrink(diagnosis)]
    sections += [remainder_section(diagnosis.remainder)] if diagnosis.remainder is not None else []
    sections += [_next_test(diagnosis)] if diagnosis.next_test is not None else []
    sections += [_isolability(diagnosis)] if diagnosis.isolability is not None else []
    return Page(
        title=f"Diagnosis of {diagnosis.campaign}: what does the simulation leave out?",
        verdict=diagnosis.headline,
        mood=_MOOD[diagnosis.verdict],
        lead=f"{gap_text(diagnosis)} {specimens_text(diagnosis)}".strip(),
        sections=(*sections, _looked_for(diagnosis), _details(diagnosis)),
        provenance=provenance(diagnosis.data_sha256, diagnosis.seed),
    )


def _short(diagnosis: Diagnosis) -> Section:
    where = nowhere_text(diagnosis)
    if diagnosis.located:
        worst = diagnosis.located[0]
        what = f"what {mended_by(diagnosis)} makes" if acting(diagnosis) else "the gap"
        where = (
            f"{percent(worst.share)} of {what} sits in {worst.record}, at {span_text(worst.time_s)} s and true "
            f"strains of {span_text(worst.true_strain)}"
        )
    best = leading(diagnosis)
    shown = [f"{explanation_name(each, diagnosis)} ({chance(each.probability)})" for each in best[:_SHOWN]]
    which = listed([*shown, *([f"{len(best) - _SHOWN} more"] if len(best) > _SHOWN else [])])
    apart = "; the data cannot discriminate between these" if len(best) > 1 else ""
    apart += _alone_or_with_others(diagnosis)
    rows = [("Where", f"{where}."), ("Which", f"{_capital(which)}{apart}.")]
    rows.append(("How far", _capital(_how_far(diagnosis))))
    if diagnosis.remainder is not None:
        rows.append(("Left", diagnosis.remainder.description))
    if diagnosis.next_test is not None:
        rows.append(("Next test", diagnosis.next_test.what))
    rows += [("Mind" if at == 0 else "", sentence(warning)) for at, warning in enumerate(diagnosis.warnings)]
    return Section("In short", (Table(("", "what was found"), tuple(rows), left=2),))


def _alone_or_with_others(diagnosis: Diagnosis) -> str:
    """The probability that a headline gives to what it names, where that is another one than of the explanation."""
    named = [effect.name for effect in diagnosis.effects if effect.named]
    together = sum(each.probability for each in diagnosis.explanations if {*named} <= {*each.effects})
    if not named or chance(together) == chance(diagnosis.best.probability):
        return ""
    return f"; {titles(named)}, alone or with others: {chance(together)}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _how_far(diagnosis: Diagnosis) -> str:
    shrink = diagnosis.shrink
    if diagnosis.verdict == "no_gap":
        return (
            f"the error of the fitted records is {shrink.identify.before_MPa:.3g} MPa rms, the noise "
            f"{shrink.identify.noise_MPa:.3g} MPa: there is no gap to close."
        )
    if not mended_by(diagnosis):
        ceiling = (
            ""
            if shrink.ceiling is None or shrink.ceiling.closure is None
            else f"; any smooth correction could close {closed(shrink.ceiling)} of it"
        )
        return f"no effect of the catalogue closes the gap{ceiling}."
    text = (
        f"with {mended_by(diagnosis)}, the error of the fitted records "
        f"{change(shrink.identify.before_MPa, shrink.identify.after_MPa)} rms; "
        f"the noise is {shrink.identify.noise_MPa:.3g} MPa"
    )
    if shrink.held_out is None:
        none = "The only record that was held out is among them" if diagnosis.held_out else "No record was held out"
        return f"{text}. {none}, so that nothing here was predicted."
    return (
        f"{text}. Records that were held out are predicted to {shrink.held_out.after_MPa:.3g} MPa rms instead of "
        f"{shrink.held_out.before_MPa:.3g} MPa (gap closed: {closed(shrink.held_out)})."
    )


def _where(diagnosis: Diagnosis) -> Section:
    mended = mended_by(diagnosis)
    thin = f" The thin strip below each shows what is left with {mended}." if mended else ""
    caption = f"Error of the base law along every record, from its start to its end.{thin}"
    parts: list[str | Table | Picture] = [
        "Each strip is one record; blue means that the simulated stress is too low, orange that it is too high, pale "
        "that it agrees within the noise. Frames mark the parts where chance cannot be the reason, with their share of "
        "the whole squared gap.",
        picture(residual_map(diagnosis), caption),
    ]
    if diagnosis.held_out:
        parts.append(held_out_table(diagnosis))
        parts.append(
            "An error that is smaller than expected counts all the same where its course is not what they make."
        )
    if diagnosis.located:
        parts.append(where_table(diagnosis)[0])
        parts.append(
            "A fit spreads a gap over places where there was none, because it bends its parameters to make up for it: "
            "a frame shows where the error is, not always where its cause acts."
        )
    if diagnosis.acts:
        places = [f"{region.record} at {span_text(region.time_s)} s" for region in diagnosis.acts[:_PLACES]]
        more = [f"{len(diagnosis.acts) - _PLACES} more places"] if len(diagnosis.acts) > _PLACES else []
        parts.append(f"What {mended_by(diagnosis)} itself contributes is certain in {listed([*places, *more], 'and')}.")
    if diagnosis.signatures:
        parts.append(f"Further signs in the errors of the base law: {'; '.join(signs(diagnosis))}.")
    return Section("Where the simulation departs", tuple(parts))


def _records(diagnosis: Diagnosis) -> Section:
    mended = mended_by(diagnosis)
    blue = f" and the law with {mended} (blue)" if mended else ""
    tinted = " Tinted parts are the framed ones from above." if diagnosis.located else ""
    text = (
        f"Above: what was measured (dots), the base law alone (orange){blue}. Below: what the law misses, as a "
        "multiple of the noise; a curve that stays in the grey band is as good as the measurement allows, but for one "
        f"sample in twenty.{tinted}"
    )
    pictures = tuple(picture(record_figure(diagnosis, name), _caption(diagnosis, name)) for name in diagnosis.curves)
    return Section("Record by record, before and after", (text, Gallery(pictures), noise_table(diagnosis)[0]))


def _caption(diagnosis: Diagnosis, record: str) -> str:
    closure = diagnosis.shrink.records.get(record)
    if closure is None or diagnosis.curves[record].explained is None:
        return f"{record}: measured, and the base law."
    return (
        f"{record}: error {closure.before_MPa:.2g} MPa rms before, {closure.after_MPa:.2g} after; "
        f"noise {closure.noise_MPa:.2g}."
    )


def _which(diagnosis: Diagnosis) -> Section:
    text = (
        "Each bar is the probability that this explanation is the right one, given the data and what is physically "
        "plausible; all together make 100 %. Starred bars are not excluded by the data: treat them as one answer with "
        "several names."
    )
    checks = (
        "Besides its probability an explanation has to pass checks: does it predict records that it was not fitted "
        "to, does it need the same strength in every record, and does it leave more than noise and its form's error?"
    )
    caption = "How probable each explanation is; “no effect is needed” and “outside the catalogue” always compete."
    table, rest = which_table(diagnosis, _EXPLANATIONS)
    parts: list[str | Table | Picture] = [text, picture(probability_figure(diagnosis), caption), checks, table]
    if rest:
        parts.append(f"{rest}.")
    if diagnosis.verdict != "no_gap" and diagnosis.effects:
        parts.append(
            "Effect by effect: the probability that it acts, alone or with others, and the part of the squared "
            "gap that it closes. What one effect closes depends on which others were added before it; its share is the "
            "mean over all orders in which those that the headline names come first. Where an effect closes nearly all "
            "of the gap alone and the others add next to nothing in addition, the headline names it alone. An effect "
            "that closes much alone and little in addition to the others is one that they can stand in for: its share "
            "says little."
        )
        parts.append(effects_table(diagnosis)[0])
    return Section("Which effect explains it", tuple(parts))


def _shrink(diagnosis: Diagnosis) -> Section:
    text = (
        "Orange dots are the errors of the base law, blue ones those with the explanation; upright ticks are the "
        "noise, below which no model can get. “Gap closed” is 100 % when the blue dot reaches the tick, 0 % when "
        "nothing is gained, and negative when it gets worse."
    )
    parts: list[str | Table | Picture] = [
        text,
        picture(closure_figure(diagnosis), "Error of each record before and after, on a logarithmic scale."),
        shrink_table(diagnosis)[0],
        _judge(diagnosis),
        "“Any smooth correction” is what an arbitrary smooth curve through the errors could close at best.",
        f"How the intervals of 90 % were made – {diagnosis.shrink.identify.how}.",
    ]
    if diagnosis.shrink.held_out is not None and diagnosis.shrink.held_out.how != diagnosis.shrink.identify.how:
        parts.append(f"Those of held-out records – {diagnosis.shrink.held_out.how}.")
    return Section("How far the gap shrinks", tuple(parts))


def _judge(diagnosis: Diagnosis) -> str:
    """Whether anything was predicted."""
    if diagnosis.shrink.held_out is not None:
        return "Held-out records are the fair judge: nothing was adjusted to them."
    if diagnosis.held_out:
        return "The only record that was held out was needed to find the cause, so that none is left to judge it by."
    what = "the explanation" if mended_by(diagnosis) else "the law"
    return f"No record was held out (--held-out ID), so that {what} was fitted to all that it is judged by."


def _next_test(diagnosis: Diagnosis) -> Section:
    text = next_test_text(diagnosis).removeprefix("Next test: ")
    how = (
        "It was picked among tests that can be run on an ordinary machine by asking for each how differently the "
        "explanations that are still open would answer. The chance is a forecast, made with the noise of your own "
        "records."
    )
    parts: list[str | Table | Picture] = [text, how]
    if len(diagnosis.next_tests) > 1:
        parts.append(next_tests_table(diagnosis))
    return Section("The next test", tuple(parts))


def _isolability(diagnosis: Diagnosis) -> Section:
    assert diagnosis.isolability is not None
    return Section(
        "What these tests can discriminate",
        (
            f"Whatever the records show: {in_words(diagnosis.isolability.headline, diagnosis.isolability)}",
            HOW_TO_READ_THE_MAP,
            picture(isolability_figure(diagnosis.isolability), "Which effects could be taken for which others."),
            isolability_table(diagnosis.isolability),
        ),
    )


def _looked_for(diagnosis: Diagnosis) -> Section:
    sought = {name for explanation in diagnosis.explanations for name in explanation.effects} | {
        name.removeprefix("effect ").partition("[")[0] for name in diagnosis.gap.p_values if name.startswith("effect ")
    }
    if diagnosis.isolability is not None:
        sought |= set(diagnosis.isolability.names)
    rows = tuple(
        (effect.title, effect.kind, effect.physics.splitlines()[0])
        for effect in known_effects()
        if effect.name in sought
    )
    text = (
        "These effects were tried, alone and combined, each with several sets of starting values. Something that no "
        "entry can imitate shows as “an effect outside the catalogue”; something that an entry imitates well is called "
        "by that entry's name, which no statistics can prevent."
    )
    parts: list[str | Table | Picture] = [text, Table(("effect", "sits in", "what it is"), rows, left=3)]
    if diagnosis.skipped:
        parts.append(
            "Left out, because the law cannot be solved with it or for want of time; a cause that stands here can be "
            "neither named nor excluded:"
        )
        parts.append(Table(("left out",), tuple((line,) for line in skipped_lines(diagnosis.skipped)), left=1))
    return Section("What was looked for", tuple(parts))


def _details(diagnosis: Diagnosis) -> Section:
    gap = diagnosis.gap
    levels = ", ".join(
        f"{value:.2g} {when}"
        for value, when in (
            (gap.p_value, "as estimated"),
            (gap.p_value_low_noise, "with 0.8 times the noise"),
            (gap.p_value_high_noise, "with 1.25 times the noise"),
        )
    )
    records = [curves.id for curves in diagnosis.curves.values()]
    held_out = [curves.id for curves in diagnosis.curves.values() if curves.role != "identify"]
    best = diagnosis.best
    acting = dict.fromkeys((each.effect, each.records) for each in best.parameters)
    named = (f"{name_of((effect,))}: {form}" for (effect, _), form in zip(acting, best.forms, strict=False))
    forms = list(dict.fromkeys(named))
    lines = [
        f"Base law: {diagnosis.law}. Scheme {diagnosis.scheme}.",
        f"Records: {', '.join(records)}." + (f" Held out: {', '.join(held_out)}." if held_out else ""),
        f"p-value of “there is nothing but noise”: {levels}; a gap is declared below {gap.level:g}.",
    ]
    if forms and diagnosis.best.effects != (UNKNOWN,):
        lines.append(f"Functional form of the best explanation: {'; '.join(forms)}.")
    return Section("Details", (base_table(diagnosis), *lines))
