"""The tables of docs/blind-results.md, from what `probation blind score --json` wrote.

`python -m bench.blind_tables score.json [--reasons docs/blind-results.md]`: the last column of the aims, why not more,
is for people to write; that of a page's table is taken over, aim by aim.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from bench.laboratories import calibration_error

STRATA = {
    "none": "none",
    "single": "one effect",
    "pair": "two effects",
    "outside": "outside the catalogue",
    "mimic": "look-alikes from outside",
}
LEAST_CONFUSED = 4


def reasons(path: Path | None) -> dict[str, str]:
    """The last column of a page's table of aims, by the aim."""
    rows = [line.strip("|\n ").split(" | ") for line in path.read_text().splitlines()] if path else []
    return {row[0]: row[5] for row in rows if len(row) == 6}


def aims(content: dict, why: dict[str, str]) -> list[str]:
    lines = ["| | aim | reached (95 % interval) | campaigns | met | why not more |", "|---|---|---|---|---|---|"]
    for each in content["aims"]:
        cells = (each["aim"], each["wanted"], each["reached"], each["n"], each["verdict"], why.get(each["aim"], ""))
        lines.append(f"| {' | '.join(str(cell) for cell in cells)} |")
    return lines


def detection(board: dict) -> list[str]:
    found = [f"| {name} | {part(rate)} |" for name, rate in board["detection"].items()]
    return ["| √λ about | gaps found |", "|---|---|", *found]


def strata(board: dict) -> list[str]:
    groups = {STRATA[name]: group for name, group in board["by_stratum"].items()}
    groups |= {"all gaps": board["gaps"], "resolvable gaps": board["resolvable"]}
    groups |= {f"one or two effects, √λ about {name}": each for name, each in board["by_detectability"].items()}
    head = ("stratum", "campaigns", "named (top-1)", "oracle", "probability of the truth", "answer set holds it")
    head += ("size", "oracle's size", "ln P", "Brier")
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for name, group in groups.items():
        if not group["n"]:
            continue
        answers = group["answer_set"]
        cells = (
            name, str(group["n"]), part(group["top1"]), f"{100 * group['oracle_expected']:.0f} %",
            number(group["probability_on_truth"], 2), part(answers["coverage"]), number(answers["mean_size"], 1),
            number(answers["oracle_mean_size"], 1), number(group["log_score"], 2), number(group["brier_score"], 2),
        )  # fmt: skip
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def beside(boards: dict) -> list[str]:
    head = "| answers | false alarms | resolvable gaps named | gaps named | P(truth), gaps | calibration error |"
    lines = [head, "|---|---|---|---|---|---|"]
    for name, board in boards.items():
        gaps = board["gaps"]
        cells = (
            name, part(board["false_alarms"]), part(board["resolvable"]["top1"]), part(gaps["top1"]),
            number(gaps["probability_on_truth"], 2), calibration_error(board["reliability"]),
        )  # fmt: skip
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def reliability(board: dict) -> list[str]:
    lines = ["| said | came true | of a calibrated solver |", "|---|---|---|"]
    for each in board["reliability"]["bins"]:
        low, high = each["calibrated95"]
        lines.append(f"| {each['probability']:.2f} | {part(each['right'])} | {100 * low:.0f} to {100 * high:.0f} % |")
    return lines


def confusions(board: dict) -> list[str]:
    pairs = [
        (count, truth, told)
        for truth, answers in board["confusion"].items()
        for told, count in answers.items()
        if told != truth and count >= LEAST_CONFUSED
    ]
    lines = ["| truth | told as | campaigns |", "|---|---|---|"]
    return lines + [f"| {truth} | {told} | {count} |" for count, truth, told in sorted(pairs, key=lambda row: -row[0])]


def part(rate: dict) -> str:
    """A rate and its exact interval, in per cent."""
    if not rate["n"]:
        return "–"
    low, high = (100 * end for end in rate["interval95"])
    return f"{100 * rate['rate']:.0f} % ({rate['k']} of {rate['n']}; {low:.0f} to {high:.0f})"


def number(value: float | None, digits: int) -> str:
    return "–" if value is None else f"{value:.{digits}f}".replace("-", "−")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("score", type=Path, help="what probation blind score --json wrote")
    parser.add_argument("--reasons", type=Path, help="a page whose reasons are taken over")
    given = parser.parse_args()
    content = json.loads(given.score.read_text())
    board = content["scores"]["answers"]
    tables = {
        "Aims": aims(content, reasons(given.reasons)),
        "By detectability": detection(board),
        "By stratum": strata(board),
        "Compared with other answers": beside(content["scores"]),
        "Reliability": reliability(board),
        "Confusions": confusions(board),
    }
    for title, lines in tables.items():
        print(f"## {title}\n", *lines, "", sep="\n")
    held = board["base_parameters"], board["amplitudes"]
    print("base parameters, sizes within their intervals:", json.dumps(held))


if __name__ == "__main__":
    main()
