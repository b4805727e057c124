"""What each setting earns: campaigns solved and scored with other values.

    probation blind make --split calibrate --seed 43 --count 60 --out DIR
    python -m bench.ablation DIR                                    as it is
    python -m bench.ablation DIR detection.directed_share=0         without the directions of known effects
    python -m bench.ablation DIR evidence.evidence_power=1 search.most_effects=2

Every call solves the 60 campaigns once (three to six minutes of processor time) into DIR/ablations and prints the
scores beside those of the settings as they are. What changes nothing beyond chance earns nothing. Defaults of
arguments that are settings keep their values.
"""

from __future__ import annotations

import argparse
import ast
from functools import partial
from pathlib import Path

from probation.settings.page import GROUPS
from probation_studies.blind.score import score_split
from probation_studies.blind.solve import diagnosed, solve_split


def solved_with(changes: dict[str, object], folder: Path) -> dict[str, object]:
    """The answer to one campaign with other settings, which then hold in this process."""
    for name, value in changes.items():
        group, setting = name.split(".")
        object.__setattr__(GROUPS[group], setting, value)  # they are frozen for all but this
    return diagnosed(folder)


def changes_of(entries: list[str]) -> dict[str, object]:
    """Settings by name, ``group.setting=value``."""
    changes = {}
    for entry in entries:
        name, _, value = entry.partition("=")
        group, _, setting = name.partition(".")
        if not hasattr(GROUPS.get(group), setting):
            raise SystemExit(f"{entry!r}: no such setting; docs/settings.md lists them, as group.setting=value")
        changes[name] = ast.literal_eval(value)
    return changes


def main() -> None:
    """Solve, score and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="a split, as probation blind make left it")
    parser.add_argument("changes", nargs="*", metavar="GROUP.SETTING=VALUE")
    parser.add_argument("--processes", type=int, default=1)
    options = parser.parse_args()
    changes = changes_of(options.changes)
    places = {"as it is": options.folder / "ablations" / "as-it-is"}
    if changes:
        places[" ".join(options.changes)] = options.folder / "ablations" / "_".join(options.changes).replace("=", "-")
    for label, place in places.items():
        solve = partial(solved_with, changes if label != "as it is" else {})
        solve_split(options.folder, solve, answers=place, processes=options.processes)
    columns = [
        {str(aim["aim"]): aim["reached"] for aim in score.content["aims"]}  # type: ignore[attr-defined]
        for score in (score_split(options.folder, answers=place, after_opening=True) for place in places.values())
    ]
    print(f"{'':<60}" + "".join(f"  {label:>30}" for label in places))
    for name in columns[0]:
        print(f"{name:<60}" + "".join(f"  {column[name]!s:>30.30}" for column in columns))


if __name__ == "__main__":
    main()
