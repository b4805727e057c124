"""Scores as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from probation.report.page import Page, Section, picture
from probation.report.table import Table
from probation_studies.blind.scores.aims import LEAST
from probation_studies.blind.scores.figures import confusion_figure, power_figure, reliability_figure
from probation_studies.blind.scores.intervals import Rate
from probation_studies.blind.scores.text import aims_sentence, aims_table

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

_HEADINGS = ("n", "right [%]", "oracle [%]", "P(truth)", "covered [%]", "size", "oracle's", "ln P", "Brier")


def write_score_page(content: Mapping[str, object], path: str | PathLike[str]) -> None:
    """Write the page.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    boards = cast("Mapping[str, Mapping[str, object]]", content["scores"])
    answers = boards["answers"]
    resolvable = cast("Mapping[str, object]", answers["resolvable"])
    met = [each["met"] for each in cast("list[Mapping[str, object]]", content["aims"])]
    right = cast("Mapping[str, int]", resolvable["top1"])
    causes = (
        f"right on {_rate(right)} of the causes that can be discriminated from the data"
        if right["n"]
        else "no cause is in it that can be discriminated from the data"
    )
    Page(
        title=f"Sealed benchmark, split {content['split']}",
        verdict=f"{aims_sentence(content)}: {causes}; false alarms on {_rate(answers['false_alarms'])} of the nulls.",
        mood="bad" if False in met else "good" if True in met else "neutral",
        lead=f"{content['campaigns']} campaigns whose cause was withheld, seeds {_list(content['seeds'])}; answered by "
        f"{_list(content['answered_by'])}; {len(cast('dict[str, str]', content['failed']))} failed, "
        f"{content['answers_after_opening']} answered after the truths were opened. Intervals are exact, of 95 %. "
        f"{content.get('too_small') or ''}".rstrip(),
        sections=(
            _aims(content),
            _strata(answers),
            _detectability(answers),
            _probabilities(answers),
            _single_scores(answers),
            _baselines(boards),
            _confusions(answers),
        ),
    ).write(path)


def _aims(content: Mapping[str, object]) -> Section:
    note = (
        f"Certain where the whole interval says so; of fewer than {LEAST} cases nothing is said. The oracle knows "
        "the generator's forms, priors and noise. Closures are compared with that of its own law, refitted: the "
        "noise's floor cancels."
    )
    return Section("Aims", (aims_table(content), note))


def _strata(board: Mapping[str, object]) -> Section:
    groups = {**_groups(board, "by_stratum"), "resolvable": cast("Mapping[str, object]", board["resolvable"])}
    note = (
        "Resolvable: an oracle that knows every form, prior and the noise is right in 95 % of noise draws (nulls and "
        "mimics are left out). Covered: the answer set holds the truth, or of a mimic what it looks like. Size: of the "
        "answer set, and of the oracle's. ln P: mean of the logarithm of P(truth)."
    )
    return Section("By stratum", (_table("stratum", groups), note))


def _detectability(board: Mapping[str, object]) -> Section:
    caption = "Gaps found and causes named (one or two of the catalogue) over the detectability; red: the aims at 5, 8."
    parts = (picture(power_figure(board), caption), _table("√λ about", _groups(board, "by_detectability")))
    return Section("By detectability", parts)


def _probabilities(board: Mapping[str, object]) -> Section:
    curve = cast("Mapping[str, object]", board["reliability"])
    caption = (
        "Reliability: numbers are campaigns; on the line, probabilities mean what they say. Grey: where a calibrated "
        "solver with these probabilities is found in 95 % of repeats."
    )
    text = (
        f"Expected calibration error {_number(curve['ece'])}; a calibrated solver with these probabilities stays below "
        f"{_number(curve['ece_limit95'])} in 95 % of repeats."
    )
    return Section("Probabilities", (picture(reliability_figure(board), caption), text))


def _single_scores(board: Mapping[str, object]) -> Section:
    unknown = cast("Mapping[str, object]", board["unknown"])
    where = cast("Mapping[str, object]", board["where"])
    closure = cast("Mapping[str, Mapping[str, object]]", board["closure"])
    rows = [
        ("exact pairs among the resolvable", _rate(board["exact_pairs"])),
        ("unknown found at 5 % false alarms, 8 or more left", _rate(unknown["found_clear"])),
        ("unknown: area under the curve, 8 or more left", _number(unknown["auroc_clear"])),
        ("unknown: area under the curve, all", _number(unknown["auroc"])),
        ("time of localised faults overlaps by 0.6 or more", _rate(where["overlap_of_0.6"])),
        ("mean overlap", _number(where["mean_overlap"])),
        ("right record", _rate(where["right_record"])),
    ]
    for name, label in (("identify", "fitted records"), ("held_out", "held-out records")):
        over = cast("Mapping[str, object]", closure[name]["over_oracle"])
        rows += [
            (f"closure, median, {label}", _average(closure[name]["median"])),
            (f"closure over the oracle's, median, {label}", _average(over)),
            (f"closure of 0.95 of the oracle's or more, {label}", _rate(over["good"])),
            (f"closure over the drawn noise within its 90 % interval, {label}", _rate(closure[name]["interval_holds"])),
        ]
    rows.append(("amplitude of a rig's fault within its 95 % interval", _rate(board["amplitudes"])))
    base = cast("Mapping[str, object]", board["base_parameters"])
    rows += [(f"parameters within their 95 % intervals, {name}", _rate(each)) for name, each in base.items()]
    return Section("Other scores", (Table(("score", "reached"), tuple(rows), left=2),))


def _baselines(boards: Mapping[str, Mapping[str, object]]) -> Section:
    groups = {name: cast("Mapping[str, object]", board["resolvable"]) for name, board in boards.items()}
    note = "Majority answers the same to all; shuffled gives each answer to another campaign: what is left is chance."
    return Section("Beside baselines, on the resolvable", (_table("answers", groups), note))


def _confusions(board: Mapping[str, object]) -> Section:
    confusion = cast("Mapping[str, Mapping[str, int]]", board["confusion"])
    rows = []
    for truth, counts in confusion.items():
        wrong = [f"{answer} ({count})" for answer, count in counts.items() if answer != truth]
        rows.append((truth, ", ".join(wrong) or "nothing", str(counts.get(truth, 0)), str(sum(counts.values()))))
    rows.sort(key=lambda row: int(row[2]) - int(row[3]))
    table = Table(("truth", "taken for", "right", "of"), tuple(rows), "Worst first; every campaign counts.", left=2)
    caption = "What was taken for what: numbers are campaigns, several effects together, red what is wrong."
    return Section("Confusions", (picture(confusion_figure(board), caption), table))


def _groups(board: Mapping[str, object], name: str) -> Mapping[str, Mapping[str, object]]:
    return cast("Mapping[str, Mapping[str, object]]", board[name])


def _table(heading: str, groups: Mapping[str, Mapping[str, object]]) -> Table:
    rows = []
    for name, group in groups.items():
        if not group["n"]:
            continue
        answer_set = cast("Mapping[str, object]", group["answer_set"])
        rows.append(
            (
                name,
                str(group["n"]),
                _percent(cast("Mapping[str, object]", group["top1"])),
                _number(group["oracle_expected"], 100.0, 1),
                _number(group["probability_on_truth"]),
                _percent(cast("Mapping[str, object]", answer_set["coverage"])),
                _number(answer_set["mean_size"], 1.0, 2),
                _number(answer_set["oracle_mean_size"], 1.0, 2),
                _number(group["log_score"]),
                _number(group["brier_score"]),
            )
        )
    return Table((heading, *_HEADINGS), tuple(rows))


def _percent(rate: Mapping[str, object]) -> str:
    low, high = cast("list[float]", rate["interval95"])
    return f"{100 * cast('float', rate['rate']):.1f} ({100 * low:.0f}–{100 * high:.0f})"


def _rate(plain: object) -> str:
    rate = cast("Mapping[str, int]", plain)
    return str(Rate(rate["k"], rate["n"])).replace(" %", "\u00a0%")


def _average(plain: object) -> str:
    found = cast("Mapping[str, object]", plain)
    if found["value"] is None:
        return "none to score"
    ends = cast("list[float] | None", found["interval95"])
    reach = "" if ends is None else f"; {ends[0]:.3f} to {ends[1]:.3f}"
    return f"{_number(found['value'])} (of {found['n']}{reach})"


def _number(value: object, factor: float = 1.0, digits: int = 3) -> str:
    return "–" if value is None else f"{factor * cast('float', value):.{digits}f}"


def _list(value: object) -> str:
    return ", ".join(str(each) for each in cast("list[object]", value))
