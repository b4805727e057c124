"""Rows of docs/laboratories.md, from what `probation blind score --json` wrote, or from sealed folders.

`python -m bench.laboratories SCORE.json|FOLDER…`: one row for each, and of several folders, answered, whose truths are
opened, one of all their campaigns together; `--by-strain-noise`, `--by-strength`: one row for each class of strain
noise, or of √λ of what acts, that is there; `--said`: of declared gaps, with how much what leads is said and how often
it is right, of folders alone.
Intervals are of 95 %: exact ones of rates and medians, Student's of the mean P of the truth, bootstrapped ones of the
answer sets' size; older scores hold neither these nor alarms where replicates show how far specimens differ. After the
calibration error stands what a calibrated solver with the same probabilities stays below in 95 % of repeats.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from bench.answered import answered
from bench.one_line import one_line
from probation._files import read_json
from probation_studies.blind.layout import Layout
from probation_studies.blind.scores.board import board
from probation_studies.blind.scores.intervals import Rate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.scores.case import Case

NAMED = (
    "single, resolvable: named", "P of the truth", "pairs, resolvable: named", "unknown found, √λ left of 8",
    "95 % sets that hold the gap's truth", "their size, over the oracle's",
)  # fmt: skip
HEAD = (
    "laboratory", "campaigns", "seeds", "false alarms, specimens alike", "false alarms, specimens differ",
    "false alarms, scatter from replicates", "false alarms, strain noise to 5e-4",
    *NAMED, "calibration error",
    "held-out explained fraction, over the oracle's",
)  # fmt: skip
CLASSES = {"by_strain_noise": "strain noise", "by_strength": "√λ"}
"""By what campaigns are classed, as scores and as readers call it."""
BY_CLASS = (
    "laboratory", "seeds", "false alarms", "single, resolvable: named", "95 % sets that hold the gap's truth",
)  # fmt: skip

SAID = ("folder", "seeds", "declared gaps", "said", "right")


def row(content: dict) -> list[str]:
    scores = content["scores"]["answers"]
    nulls = scores["false_alarms_by_kind"]
    held_out = scores["closure"]["held_out"]["over_oracle"]
    laboratory, seeds = source(content)
    return [
        laboratory,
        str(content["campaigns"]),
        seeds,
        rate(nulls["alike"]),
        rate(nulls["differing"]),
        rate(nulls.get("replicates")),
        rate(nulls["strain_noise_to_5e-4"]),
        *named(scores),
        calibration_error(scores["reliability"]),
        f"{between(held_out['value'], held_out['interval95'])}, n = {held_out['n']}",
    ]


def named(scores: dict) -> list[str]:
    """Which causes are named, how probable the truth is, and what the answer sets hold."""
    resolvable, sets = scores["resolvable_by_stratum"], scores["gaps"]["answer_set"]
    single, size, least = resolvable["single"], sets["mean_size"], sets["oracle_mean_size"]
    return [
        rate(single["top1"]),
        between(single["probability_on_truth"], single["probability_on_truth_interval95"]),
        rate(resolvable["pair"]["top1"]),
        rate(scores["unknown"]["found_clear"]),
        rate(sets["coverage"]),
        between(size / least if size and least else None, sets.get("over_oracle", {}).get("interval95")),
    ]


def head_by(key: str) -> tuple[str, ...]:
    """Of the rows of a key of `CLASSES`."""
    return (*BY_CLASS[:2], CLASSES[key], *BY_CLASS[2:])


def rows_by(key: str, content: dict) -> list[list[str]]:
    """One of every class of a key of `CLASSES` that has campaigns."""
    classes = content["scores"]["answers"][key]
    return [
        [*source(content), name, rate(each["false_alarms"]), rate(each["single_named"]), rate(each["sets_hold"])]
        for name, each in classes.items()
        if each["false_alarms"]["n"] or each["sets_hold"]["n"]
    ]


def said(path: Path, cases: Sequence[Case]) -> list[str]:
    """Of declared gaps of a folder: the mean probability of what leads, and how often that is right."""
    declared = [case for case in cases if case.answer.gap and case.stratum != "none"]
    leading = [case.answer.probability[case.answer.top] for case in declared]
    right = Rate.of(case.right for case in declared).plain()
    mean = sum(leading) / len(leading) if leading else None
    return [path.name, ", ".join(map(str, seeds_of(cases))), str(len(declared)), number(mean), rate(right)]


def source(content: dict) -> tuple[str, str]:
    """Laboratory and seeds."""
    return str(content.get("laboratory", "own")), ", ".join(str(seed) for seed in content["seeds"])


def rate(plain: dict | None) -> str:
    """Of n, with its interval."""
    if not plain or not plain["n"]:
        return "–"
    low, high = (100.0 * each for each in plain["interval95"])
    return f"{100.0 * plain['rate']:.0f} % of {plain['n']} ({low:.0f} to {high:.0f})"


def number(value: float | None, digits: int = 2) -> str:
    """With so many digits."""
    return "–" if value is None else f"{value:.{digits}f}"


def between(value: float | None, interval: list[float] | None) -> str:
    """With its interval, where there is one."""
    if interval is None:
        return number(value)
    low, high = (number(each) for each in interval)
    return f"{number(value)} ({low} to {high})"


def calibration_error(curve: dict) -> str:
    """With what chance alone comes to where every probability comes true."""
    if curve["ece"] is None:
        return "–"
    return f"{number(curve['ece'], 3)}; below {number(curve['ece_limit95'], 3)} if calibrated"


def seeds_of(cases: Sequence[Case]) -> list[int]:
    """Of campaigns, each once."""
    return sorted({case.truth["seed"] for case in cases})


def scored(laboratory: object, cases: Sequence[Case]) -> dict:
    """What rows are made of, as a score holds it."""
    seeds = seeds_of(cases)
    return {"laboratory": laboratory, "campaigns": len(cases), "seeds": seeds, "scores": {"answers": board(cases)}}


def cases_of(paths: Sequence[Path]) -> dict[Path, list[Case]]:
    """Answered campaigns of those that are folders."""
    return {path: [case for case, _ in answered(Layout(path))] for path in paths if path.is_dir()}


def contents_of(paths: Sequence[Path]) -> list[dict]:
    """Of scores and of folders; of several folders all together come last."""
    folders = cases_of(paths)
    contents = [
        scored(Layout(path).published()[0].get("laboratory", "own"), folders[path])
        if path in folders
        else read_json(path, "what probation blind score --json writes")
        for path in paths
    ]
    together = [case for cases in folders.values() for case in cases]
    return [*contents, scored("all", together)] if len(folders) > 1 else contents


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scores", nargs="+", type=Path, help="what probation blind score --json wrote, or folders")
    for key, name in CLASSES.items():
        parser.add_argument(
            f"--{key.replace('_', '-')}",
            dest="key",
            action="store_const",
            const=key,
            help=f"one row for each class of {name}",
        )
    parser.add_argument("--said", action="store_true", help="how sure and how right what leads is, of folders")
    chosen = parser.parse_args()
    if chosen.said and chosen.key:
        parser.error(f"--said: found --{chosen.key.replace('_', '-')}, too; expected one of the two")
    if chosen.said and (others := [str(path) for path in chosen.scores if not path.is_dir()]):
        parser.error(f"--said: found {', '.join(others)}, expected sealed folders")
    with one_line(parser):
        folders = cases_of(chosen.scores) if chosen.said else {}
        contents = [] if chosen.said else contents_of(chosen.scores)
    if chosen.said:
        together = [case for cases in folders.values() for case in cases]
        more = [(Path("all"), together)] if len(folders) > 1 else []
        head, rows = SAID, [said(path, cases) for path, cases in [*folders.items(), *more]]
    elif chosen.key:
        head, rows = head_by(chosen.key), [each for content in contents for each in rows_by(chosen.key, content)]
    else:
        head, rows = HEAD, [row(content) for content in contents]
    lines = [head, ("---",) * len(head), *rows]
    print("\n".join(f"| {' | '.join(line)} |" for line in lines))


if __name__ == "__main__":
    main()
