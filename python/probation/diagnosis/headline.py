"""A diagnosis in one sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.remainder_words import function_name
from probation.effects.registry import effect
from probation.inference.unknown import UNKNOWN
from probation.settings.calibrated import CALIBRATED
from probation.settings.detection import DETECTION
from probation.settings.evidence import EVIDENCE
from probation.wording import chance, change, listed, percent, percentage, signed_percent

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.diagnosis.attribution import Attribution
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.held_out import Worse
    from probation.diagnosis.remainder import Remainder
    from probation.diagnosis.result import Explanation, Shrink, Verdict
    from probation.inference.gap import Gap

MOST_RIVALS = 3


def title(name: str) -> str:
    """An effect's name for people."""
    return "an effect outside the catalogue" if name == UNKNOWN else effect(name).title


def titles(effects: Sequence[str]) -> str:
    """A set of effects for people, what is known of it first."""
    known_first = sorted(effects, key=lambda name: name == UNKNOWN)
    return listed([title(name) for name in known_first], "and") if effects else "no effect"


def choices(sets: Sequence[Sequence[str]]) -> str:
    """Several sets of effects for people, each once; one of several effects stands in brackets."""
    names = [titles(effects) if len(effects) < 2 else f"({titles(effects)})" for effects in sets]
    return listed(list(dict.fromkeys(names)), "or")


def adds_little() -> str:
    """Of the effects of an explanation that a headline leaves out."""
    return f"; what else is in the explanation adds less than {percent(EVIDENCE.share_worth_naming)} of the gap"


def with_known(effects: Sequence[str], explanations: Sequence[Explanation]) -> Explanation:
    """The most probable explanation with these known effects, alone or jointly with an unknown one."""
    return next(each for each in explanations if {*each.effects} - {UNKNOWN} == {*effects})


def headline(
    verdict: Verdict,
    explanations: Sequence[Explanation],
    parts: Attribution,
    answer_set: Sequence[tuple[str, ...]],
    shrink: Shrink,
    gap: Gap,
    *,
    worse: Sequence[Worse] = (),
    judge: str | None = None,
    tolerance: float = DETECTION.tolerance,
    cut: bool = False,
    chosen: bool = False,
    rough_MPa: float = np.inf,
) -> str:
    """One sentence a person can act on; effects are named by what they close (docs/diagnosis-method.md, section 8).

    Parameters
    ----------
    verdict : {"no_gap", "explained", "unexplained"}
        Of the records that causes were fitted to.
    explanations, parts, answer_set, shrink, gap
        What was found.
    worse : sequence of Worse
        Held-out records that the best explanation, or the nearest, predicts worse than the base law.
    judge : str, optional
        The predicted record that no cause was fitted to, where others were.
    tolerance : float
        Part of the largest stress below which a gap does not matter.
    cut : bool
        Whether the budget ended the search.
    chosen : bool
        Whether only some effects were asked for.
    rough_MPa : float
        What the records scatter by from one sample to the next.
    """
    identify = shrink.identify
    fitted = len(shrink.records) - len(gap.held_out)
    records = "the one record" if fitted == 1 else f"all {fitted} records"
    if verdict == "no_gap":
        also = " and predicts those held out" if gap.held_out else ""
        p_value = min(gap.test.p_value, gap.held_out_p_value)
        certain = asked = ""
        if p_value < DETECTION.gap_level:
            certain = " that is certain"
            asked = f", where {CALIBRATED.gap_level_outside:.0g} is asked for: such noise was not among what was tried"
        described = f"to within the noise of {identify.noise_MPa:.2g} MPa"
        if identify.after_MPa > EVIDENCE.most_left * identify.noise_MPa:
            described = f"to {identify.after_MPa:.3g} MPa, the noise being {identify.noise_MPa:.2g} MPa,"
        if identify.noise_MPa > EVIDENCE.mostly_slow * rough_MPa:
            described += f" (readings scatter by {rough_MPa:.2g} MPa; what is slower is taken for noise, too)"
        if gap.hangs_on_scatter:
            certain = f" beyond what specimens may differ by{certain}"
            described += " with deviations of its own for each specimen"
        return (
            f"No gap{certain}: the law describes {records}{also} {described} (p = {p_value:.2g}{asked})"
            f"{_scatter_clause(gap)}."
        )
    if not gap.matters(tolerance):
        return _small(gap, tolerance, identify.noise_MPa)
    count = len(shrink.records) - (shrink.held_out is not None)
    nothing = f"nothing {'that was tried' if cut or chosen else 'in the catalogue'} explains it"
    clause = _cause(verdict, explanations, parts, answer_set, shrink, count, cut, nothing, worse)
    if gap.in_fitted:
        missed = f"The law misses the records by {identify.before_MPa:.3g} MPa (noise {identify.noise_MPa:.2g} MPa)"
        if identify.before_MPa <= identify.noise_MPa:
            noise = f"{identify.noise_MPa:.2g} MPa"
            missed = f"The law misses the records by no more than their noise ({noise}), but not by chance"
        if verdict == "explained":
            return f"{clause[:1].upper()}{clause[1:]}."
        return f"{missed}{' and' if clause.startswith('nothing') else ':'} {clause}."
    size = gap.held_out[gap.missed[0]]
    others = f" and {len(gap.missed) - 1} more" if len(gap.missed) > 1 else ""
    described = "the one record that was fitted" if fitted == 1 else f"the {fitted} records that were fitted"
    missed = (
        f"Not predicted: the law describes {described}, but misses {gap.missed[0]}{others}, which it only predicts, "
        f"by {size.rms_MPa:.3g} MPa (noise and uncertainty of the parameters {size.expected_MPa:.2g} MPa)"
    )
    judged = shrink.records.get(judge) if judge is not None else None
    if judged is not None and verdict == "explained":
        mended = judge not in gap.missed or judged.after_MPa < 0.5 * judged.before_MPa
        text = "is predicted to" if mended else "is still missed by"
        clause += f"; {judge}, kept apart, {text} {judged.after_MPa:.3g} instead of {judged.before_MPa:.3g} MPa"
    return f"{missed}; {clause}."


def _scatter_clause(gap: Gap) -> str:
    """How far specimens differ, where that is known or decides the verdict."""
    if not gap.hangs_on_scatter:
        return f"; {gap.scatter.text}" if gap.scatter.source == "replicates" else ""
    neither = "" if gap.scatter.is_seen else ", nor that they do not"
    order = "" if gap.trend is None else f"; but {gap.trend.text}"
    return f"; {gap.scatter.text}{neither}, and if they were alike there would be a gap{order}"


def _small(gap: Gap, tolerance: float, noise: float) -> str:
    """Of a gap that does not matter: no cause is named."""
    size = gap.size
    _, high = size.interval_MPa
    missed = ", which is only predicted" if size.record in gap.held_out else ""
    return (
        f"A gap that does not matter: {size.rms_MPa:.2g} MPa (at most {high:.2g}) in {size.record}{missed}, "
        f"{percentage(size.relative)} % of its largest stress, where {percentage(tolerance)} % are let pass; "
        f"the noise is {noise:.2g} MPa."
    )


def _cause(
    verdict: Verdict,
    explanations: Sequence[Explanation],
    parts: Attribution,
    answer_set: Sequence[tuple[str, ...]],
    shrink: Shrink,
    record_count: int,
    cut: bool,
    nothing: str,
    worse: Sequence[Worse],
) -> str:
    """What explains the gap, or does not, without a full stop."""
    best, identify = explanations[0], shrink.identify
    touched = [name for name in best.records if any(name in part.records for part in parts.effects if part.named)]
    place = _place(touched, record_count)
    fall = f"the misfit {change(identify.before_MPa, parts.after_MPa)}, the noise being {identify.noise_MPa:.2g} MPa"
    if parts.after_MPa > identify.before_MPa:  # evidence is of each sample by its noise
        fall = f"the misfit falls where each sample counts by its noise; else {fall.removeprefix('the misfit ')}"
    if worse and best.effects != (UNKNOWN,):
        return f"{nothing}; {_with(explanations, shrink, record_count, worse)}"
    if verdict == "unexplained" and not _close_some(parts, identify):
        return _nothing_near(explanations, answer_set, shrink, record_count, nothing, worse)
    if verdict == "unexplained" and cut:
        return f"{nothing}; with {titles(parts.named)}{place} {fall}"
    if verdict == "unexplained" and _hardly(best, parts, identify):
        return f"{nothing}; {_with(explanations, shrink, record_count, worse, comes_nearest=True)}"
    named, rivals = f"{_with_shares(parts)}{place}", _rivals_of(parts.named, answer_set)
    fall += _not_divided(parts, identify)
    if verdict == "unexplained":
        far = [each.effects for each in explanations if each.effects in rivals and _far_behind(each, best)]
        indistinct = _indistinct(parts.named, [effects for effects in rivals if effects not in far])
        part = _is_part(best, parts, named, fall, indistinct, identify.noise_MPa)
        return part + _not_excluded(far, "still more")
    behind = [each.effects for each in explanations if each.effects in rivals and _leaves_more(each)]
    near = [effects for effects in rivals if effects not in behind]
    others = _indistinct(parts.named, near) + _not_excluded(behind, "more than noise")
    return f"{'of what was tried, ' if cut else ''}{_explains(best, parts, named, fall, others, alone=not near)}"


def _nothing_near(
    explanations: Sequence[Explanation],
    answer_set: Sequence[tuple[str, ...]],
    shrink: Shrink,
    record_count: int,
    nothing: str,
    worse: Sequence[Worse],
) -> str:
    """Where no named effect closes a part of the gap: what may, and how far known effects come."""
    identify = shrink.identify
    if explanations[0].effects != (UNKNOWN,):
        return nothing
    if enough := _enough(explanations, answer_set):
        shown = ", ".join(choices([effects]) for effects in enough[:MOST_RIVALS])
        return f"{shown}{_more(enough)} or {title(UNKNOWN)} may explain it; these tests cannot tell which"
    closes = identify.after_MPa < identify.before_MPa and (identify.closure or 0.0) >= EVIDENCE.share_worth_naming
    return f"{nothing}; {_with(explanations, shrink, record_count, worse)}" if closes else nothing


def _place(records: Sequence[str], count: int) -> str:
    """Such as " in grip2"; empty for all records."""
    return f" in {listed(list(records), 'and')}" if 0 < len(records) < count else ""


def _explains(best: Explanation, parts: Attribution, named: str, fall: str, rivals: str, *, alone: bool) -> str:
    """Of an explanation that leaves nothing, `alone` if no other one does; else no more is said than that it may."""
    pronoun, verb = ("it", "explains") if len(parts.named) == 1 else ("them", "explain")
    if not alone:
        verb = "may explain"
    sentence = f"{named} {verb} the gap: with {pronoun} {fall}"
    if not {*best.effects} <= {*parts.named, *parts.undivided}:
        sentence += adds_little()
    return f"{sentence} (probability {chance(parts.probability)}){rivals}" if alone else sentence + rivals


def _is_part(best: Explanation, parts: Attribution, named: str, fall: str, rivals: str, noise_MPa: float) -> str:
    """Of an explanation that leaves a gap."""
    one = len(parts.named) == 1
    pronoun, verb, own = ("it", "is", "its form differs") if one else ("them", "are", "their forms differ")
    if rivals:
        verb = "may be"
    if {*best.effects} - {*parts.named} - {UNKNOWN}:  # `shrink` is with all of them
        fall = f"with {pronoun} alone {fall}"
    left = (
        "more than noise is left" if parts.after_MPa > noise_MPa else "what is left takes a course that noise does not"
    )
    other = f"{title(UNKNOWN)} acts, too" if UNKNOWN in best.effects else f"{own}, or something else acts, too"
    return f"{named} {verb} part of it ({fall}), but {left}: {other}{rivals}"


def _rivals_of(known: Sequence[str], answer_set: Sequence[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """What may act in place of the named effects."""
    return [effects for effects in answer_set if not {*known} <= {*effects}]


def _leaves_more(each: Explanation) -> bool:
    """Whether it leaves what the test for a gap sees."""
    return each.checks is not None and each.checks.remaining_p_value < DETECTION.gap_level


def _hardly(best: Explanation, parts: Attribution, identify: Closure) -> bool:
    """Whether known effects only come nearest: they close next to nothing, or less than half with less than an even
    chance.
    """
    if identify.closure is None or UNKNOWN in best.effects:
        return False
    next_to_nothing = identify.closure < EVIDENCE.least_part
    return next_to_nothing or (identify.closure < EVIDENCE.half_of_the_gap and parts.probability < EVIDENCE.even_chance)


def _far_behind(each: Explanation, best: Explanation) -> bool:
    """Whether the records say so much less of it that they do distinguish it; its form may be wrong.

    An unknown takes up what a form leaves: with it and without it explanations are not compared.
    """
    if each.log_evidence is None or best.log_evidence is None or (UNKNOWN in each.effects) != (UNKNOWN in best.effects):
        return False
    return each.log_evidence < best.log_evidence - EVIDENCE.far_behind


def _not_excluded(behind: Sequence[tuple[str, ...]], more: str) -> str:
    """What is not excluded though it leaves more, as a further clause; empty where there is none."""
    if not behind:
        return ""
    shown = choices(behind[:MOST_RIVALS])
    return f"; not excluded, though {more} would be left: {shown}{_more(behind)}"


def _indistinct(known: Sequence[str], rivals: Sequence[tuple[str, ...]]) -> str:
    """From what the tests cannot distinguish the named effects, as a further clause; empty where from nothing."""
    if not rivals:
        return ""
    pronoun = "it" if len(known) == 1 else "them"
    parts = [effects for effects in rivals if effects and {*effects} < {*known}]
    others = [effects for effects in rivals if effects not in parts][: max(MOST_RIVALS - len(parts), 1)]
    shown = [f"{titles(effects)} alone" for effects in parts] + ([choices(others)] if others else [])
    return (
        f"; these tests cannot distinguish {pronoun} from {' or '.join(shown)}{_more(rivals, len(parts) + len(others))}"
    )


def _more(rivals: Sequence[tuple[str, ...]], shown: int = MOST_RIVALS) -> str:
    """How many there are besides those that are shown."""
    return f" (and {len(rivals) - shown} more)" if len(rivals) > shown else ""


def _enough(explanations: Sequence[Explanation], answer_set: Sequence[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Known effects of the answer set that leave nothing which the test for a gap sees, without any to spare."""
    enough = [
        each.effects
        for each in explanations
        if each.effects in answer_set
        and UNKNOWN not in each.effects
        and each.checks is not None
        and each.checks.remaining_p_value >= DETECTION.gap_level
    ]
    return [effects for effects in enough if not any({*fewer} < {*effects} for fewer in enough)]


def _close_some(parts: Attribution, identify: Closure) -> bool:
    """Whether the named effects close a part of the gap that is worth naming in addition to an unknown one."""
    share = sum(part.share or 0.0 for part in parts.effects if part.named)
    return share >= EVIDENCE.share_worth_naming and parts.after_MPa < identify.before_MPa


def _with(
    explanations: Sequence[Explanation],
    shrink: Shrink,
    count: int,
    worse: Sequence[Worse],
    *,
    comes_nearest: bool = False,
) -> str:
    """How far the gap would shrink, and which held-out records contradict that."""
    identify = shrink.identify
    shown = with_known(shrink.effects, explanations)
    nearest = ""
    if comes_nearest or explanations[0].effects == (UNKNOWN,):
        nearest = f", which {'comes' if len(shrink.effects) == 1 else 'come'} nearest,"
    misfit = change(identify.before_MPa, identify.after_MPa, "would ")
    text = f"with {titles(shrink.effects)}{_place(shown.records, count)}{nearest} the misfit {misfit}"
    if not worse:
        return text
    joint = "but" if identify.after_MPa < identify.before_MPa else "and"
    return f"{text}, {joint} {' and '.join(record.text for record in worse)}"


def _with_shares(parts: Attribution) -> str:
    """What is named, and where it is more than one effect, which closes how much: "damage (81 % of the gap) and …".

    An effect that others can stand in for has no share of its own; none has one of a gap that the noise hides.
    """
    shares = {
        part.name: signed_percent(part.share)
        for part in parts.effects
        if part.share is not None and part.name not in parts.undivided
    }
    words, of_the_gap = [], " of the gap"
    for name in parts.named:
        share = ""
        if len(parts.named) > 1 and name in shares:
            share, of_the_gap = f" ({shares[name]}{of_the_gap})", ""
        words.append(title(name) + share)
    return listed(words, "and")


def _not_divided(parts: Attribution, identify: Closure) -> str:
    """That effects can stand in for each other, as a further clause; empty where each has a share of its own."""
    if not parts.undivided:
        return ""
    first = parts.undivided[0]
    alone = next(part.alone for part in parts.effects if part.name == first) or 0.0
    whole = alone if identify.closure is None else identify.closure
    weighed = ", as the noise weighs it" if alone > whole + EVIDENCE.share_worth_naming else ""
    closes, stand_ins = f"; {title(first)} alone closes {percent(alone)} of the gap{weighed}", titles(parts.undivided)
    if {*parts.undivided} <= {*parts.named}:  # none of them is enough
        if alone > whole - EVIDENCE.share_worth_naming:
            return closes
        others = titles([name for name in parts.named if name != first])
        return f"{closes}, the rest only jointly with {others}, so that {stand_ins} have no shares of their own"
    return f"{closes}, and the data cannot divide it between {stand_ins}"


def with_budget(headline: str, ended: str) -> str:
    """A headline that says that the budget ended the search, where it did."""
    return f"{headline.removesuffix('.')}; {ended}." if ended else headline


def with_remainder(headline: str, left: Remainder | None) -> str:
    """A headline that says on what the rest, or all of the gap, depends, where anything is left and that is known."""
    if left is None or not left.depends_on:
        return headline
    first = left.depends_on[0]
    return (
        f"{headline.removesuffix('.')}; {left.what} is a function of {function_name(first)} "
        f"({percent(first.explained)} of it)."
    )
