"""Rows of docs/laboratories.md, from what `probation blind score --json` wrote.

`python -m bench.laboratories SCORE.json…`: one row for each; intervals are exact, of 95 %.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

HEAD = (
    "laboratory", "campaigns", "seeds", "false alarms, specimens alike", "false alarms, specimens differ",
    "false alarms, strain noise to 5e-4",
    "single, resolvable: named", "P of the truth", "pairs, resolvable: named", "unknown found, √λ left of 8",
    "95 % sets that hold the gap's truth", "their size, over the oracle's", "calibration error",
)  # fmt: skip


def row(content: dict) -> list[str]:
    board = content["scores"]["answers"]
    nulls, resolvable = board["false_alarms_by_kind"], board["resolvable_by_stratum"]
    single, sets = resolvable["single"], board["gaps"]["answer_set"]
    size, least = sets["mean_size"], sets["oracle_mean_size"]
    return [
        str(content.get("laboratory", "own")),
        str(content["campaigns"]),
        ", ".join(str(seed) for seed in content["seeds"]),
        rate(nulls["alike"]),
        rate(nulls["differing"]),
        rate(nulls["strain_noise_to_5e-4"]),
        rate(single["top1"]),
        number(single["probability_on_truth"]),
        rate(resolvable["pair"]["top1"]),
        rate(board["unknown"]["found_clear"]),
        rate(sets["coverage"]),
        number(size / least if size and least else None),
        number(board["reliability"]["ece"], 3),
    ]


def rate(plain: dict) -> str:
    """Of n, with its interval."""
    if not plain["n"]:
        return "–"
    low, high = (100.0 * each for each in plain["interval95"])
    return f"{100.0 * plain['rate']:.0f} % of {plain['n']} ({low:.0f} to {high:.0f})"


def number(value: float | None, digits: int = 2) -> str:
    """With so many digits."""
    return "–" if value is None else f"{value:.{digits}f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scores", nargs="+", type=Path, help="as probation blind score --json wrote them")
    lines = [HEAD, ("---",) * len(HEAD)]
    lines += [row(json.loads(each.read_text())) for each in parser.parse_args().scores]
    print("\n".join(f"| {' | '.join(line)} |" for line in lines))


if __name__ == "__main__":
    main()
