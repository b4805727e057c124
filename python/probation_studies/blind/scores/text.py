"""Scores for people."""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast

from probation.report.table import Table
from probation_studies.blind.scores.intervals import Rate

_COUNTS = ("yes", "no", "too few")


def aims_sentence(content: Mapping[str, object]) -> str:
    """How many aims are met."""
    verdicts = [str(each["verdict"]) for each in cast("list[Mapping[str, object]]", content["aims"])]
    met, missed, few = (sum(verdict.startswith(each) for verdict in verdicts) for each in _COUNTS)
    return f"{met} of {len(verdicts)} aims met, {missed} missed, {few} not decided by so few campaigns"


def aims_table(content: Mapping[str, object]) -> Table:
    """Aim, what was reached, whether it is met."""
    rows = tuple(
        (str(each["aim"]), str(each["wanted"]), str(each["reached"]), str(each["n"]), str(each["verdict"]))
        for each in cast("list[Mapping[str, object]]", content["aims"])
    )
    return Table(("aim", "wanted", "reached (interval)", "cases", "met?"), rows, left=3)


def score_text(content: Mapping[str, object]) -> str:
    """The aims, the main scores, the baselines beside them."""
    boards = cast("Mapping[str, Mapping[str, object]]", content["scores"])
    answers = boards["answers"]
    lines = [
        f"{aims_sentence(content)}.",
        f"{content['split']}: {content['campaigns']} campaigns, seeds {_list(content['seeds'])}; answered by "
        f"{_list(content['answered_by'])}; {len(cast('dict[str, str]', content['failed']))} failed; "
        f"{content['answers_after_opening']} after the opening",
        *([str(content["too_small"])] if content.get("too_small") else []),
        "",
        aims_table(content).text(),
        "",
        f"false alarms on nulls       {_rate(answers['false_alarms'])}",
    ]
    detection = cast("Mapping[str, object]", answers["detection"])
    lines += [f"gap found at about {name:>4}     {_rate(each)}" for name, each in detection.items()]
    where = cast("Mapping[str, object]", answers["where"])
    unknown = cast("Mapping[str, object]", answers["unknown"])
    curve = cast("Mapping[str, object]", answers["reliability"])
    lines += [
        f"exact pairs, resolvable     {_rate(answers['exact_pairs'])}",
        f"unknown found (left >= 8)   {_rate(unknown['found_clear'])}, AUROC {_number(unknown['auroc_clear'])}",
        f"calibration error           {_number(curve['ece'])}; calibrated stays below {_number(curve['ece_limit95'])}",
        f"overlap of at least 0.6     {_rate(where['overlap_of_0.6'])}",
        f"right record                {_rate(where['right_record'])}",
        f"amplitude in its interval   {_rate(answers['amplitudes'])}",
        "",
    ]
    lines += [f"{_board(name, board).text(indent='')}\n" for name, board in boards.items()]
    return "\n".join(lines).rstrip() + "\n"


def _board(name: str, board: Mapping[str, object]) -> Table:
    """The scores of one method, a row for each stratum."""
    strata = cast("Mapping[str, Mapping[str, object]]", board["by_stratum"])
    groups = {**strata, "resolvable": cast("Mapping[str, object]", board["resolvable"])}
    return Table(
        (name, "n", "top-1", "oracle", "P(truth)", "covered", "size", "ln P", "Brier"),
        tuple(_row(group, each) for group, each in groups.items() if each["n"]),
    )


def _row(name: str, group: Mapping[str, object]) -> tuple[str, ...]:
    answer_set = cast("Mapping[str, object]", group["answer_set"])
    covered = cast("Mapping[str, object]", answer_set["coverage"])
    top = cast("Mapping[str, object]", group["top1"])
    values = (
        *(top["rate"], group["oracle_expected"], group["probability_on_truth"], covered["rate"]),
        *(answer_set["mean_size"], group["log_score"], group["brier_score"]),
    )
    return (name, str(group["n"]), *map(_number, values))


def _number(value: object) -> str:
    return "-" if value is None else f"{cast('float', value):.3f}"


def _rate(plain: object) -> str:
    rate = cast("Mapping[str, int]", plain)
    return str(Rate(rate["k"], rate["n"]))


def _list(value: object) -> str:
    return ", ".join(str(each) for each in cast("list[object]", value))
