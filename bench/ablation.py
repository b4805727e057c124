"""What the constants of the statistics earn: campaigns solved and scored without them.

    probation blind make --split calibrate --seed 43 --count 60 --out DIR
    python -m bench.ablation DIR                        every group of `TAKEN_AWAY`: docs/ablation.md's table
    python -m bench.ablation DIR "drift of the noise" search.starts=1     a group and a setting, each by itself

Each row solves the campaigns once (two to three minutes of processor time for 60) into DIR/ablations; what is there
already is not solved again. Defaults of arguments that are settings keep their values.
"""

from __future__ import annotations

import argparse
import ast
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import cast

from probation.settings.page import GROUPS
from probation_studies.blind.score import score_split
from probation_studies.blind.solve import diagnosed, solve_split

NEVER = 1e9

TAKEN_AWAY: dict[str, dict[str, object]] = {
    "nothing": {},
    "directions of known effects in the gap test": {"detection.directed_share": 1e-9},
    "lines, steps, bumps and strain periods in the gap test": {"detection.sharp_share": 1e-9},
    "places left out of the base fit": {"detection.most_places_left_out": 0},
    "guards of the noise spectrum's fit": {
        "noise.least_gain_of_low_rise": 9.0,
        "noise.steep_rise": NEVER,
        "noise.fisher_excess": 1.0,
        "noise.largest_log_variance": NEVER,
        "noise.least_rise": 0.0,
    },
    "drift of the noise": {"noise.least_drift": 1e-6, "noise.drift_margin": 0.0, "noise.records_apart": 1e-9},
    "drift along an effect": {"noise.least_drift_of_effects": 1e-6, "noise.most_drift_of_effects": 1e-6},
    "nuisance drift": {"noise.nuisance_drift_size": 1e-6},
    "wander of the speed": {"noise.speed_wander": 1e-9},
    "transients left out of the noise's estimate": {"noise.transient_ratio": NEVER},
    "quiet parts of a record": {"noise.quiet_samples": NEVER},
    "noise that changes along a record": {"noise.clustered_size": NEVER, "noise.burst_ratio": NEVER},
    "agreement of the low frequencies with the noise": {"noise.agreement_level": 0.0},
    "outliers left out": {"noise.outlier_distance": NEVER},
    "errors of an effect's form": {
        "evidence.form_errors": (0.0,),
        "evidence.form_error_weights": (1.0,),
    },
    "power of the evidence": {"evidence.evidence_power": 1.0},
    "power of a gap that is not declared": {"evidence.undeclared_gap_power": 1.0},
    "rarity of the same effect in another record": {"evidence.again_in_another_record": 1.0},
    "a second effect, unseen": {"evidence.unseen_second_effect": 1e-9, "evidence.noted_with_others": 1.0},
    "choice between forms of one effect by their fit": {"evidence.about_as_probable": 0.0},
    "penalty of a worse held-out record": {"evidence.held_out_penalty": 1.0},
    "largest misfit that an explanation may leave": {"evidence.most_left": NEVER},
    "forms of the unknown: function of strain, periodic, specimen": {
        "evidence.unknown_of_the_strain": 1e-9,
        "evidence.unknown_periodic": 1e-9,
        "evidence.unknown_of_the_specimen": 1e-9,
    },
    "soft steps": {"search.soft_step_level": 0.01, "search.soft_step_lead": NEVER, "search.soft_step_ratio": NEVER},
    "several starts and places": {"search.starts": 1, "search.places": 1},
    "screening before the race": {
        "search.race_gain": NEVER,
        "search.race_fraction": 0.0,
        "search.worth_refitting": 0.0,
    },
    "judging again with the noise of the best": {"search.reconsidered": 1},
    "additions to more than the best explanation": {"search.extended_explanations": 1, "search.additions": 3},
    "an unknown in addition to more than two explanations": {"search.with_unknown": 2, "search.fewer_with_unknown": 1},
}
"""Groups of chosen or calibrated settings, with the values by which they have no say."""


@dataclass(frozen=True)
class Row:
    """What one solving of the campaigns scored."""

    name: str
    figures: dict[str, str]


def solved_with(changes: Mapping[str, object], folder: Path) -> dict[str, object]:
    """The answer to one campaign with other settings."""
    places = {name: (GROUPS[name.split(".")[0]], name.split(".")[1]) for name in changes}
    usual = {name: getattr(*place) for name, place in places.items()}
    try:
        for name, value in changes.items():
            object.__setattr__(*places[name], value)  # they are frozen for all but this
        return diagnosed(folder)
    finally:
        for name, value in usual.items():
            object.__setattr__(*places[name], value)


def changes_of(entry: str) -> dict[str, object]:
    """A group's name, or one setting as ``group.setting=value``."""
    if entry in TAKEN_AWAY:
        return TAKEN_AWAY[entry]
    name, _, value = entry.partition("=")
    group, _, setting = name.partition(".")
    if not hasattr(GROUPS.get(group), setting):
        raise SystemExit(
            f"{entry!r}: neither a group nor a setting; bench/ablation.py has the groups, docs/settings.md the settings"
        )
    return {name: ast.literal_eval(value)}


def row(name: str, folder: Path, processes: int) -> Row:
    """Solve with what `name` changes, and score."""
    changes = changes_of(name)
    place = folder / "ablations" / "".join(letter if letter.isalnum() else "-" for letter in name)
    failed = solve_split(folder, partial(solved_with, changes), answers=place, processes=processes).failed
    seconds = sum(json.loads(path.read_text(encoding="utf-8"))["seconds"] for path in place.glob("*.json"))
    score = score_split(folder, answers=place, after_opening=True).content
    reached = {
        str(aim["aim"]): str(aim["reached"]).split(" (")[0] for aim in cast("list[dict[str, object]]", score["aims"])
    }
    scores = cast("dict[str, dict[str, dict[str, object]]]", score["scores"])["answers"]
    nulls = cast("dict[str, dict[str, object]]", scores["by_stratum"])["none"]
    return Row(
        name,
        {
            "false alarms": reached["false alarms on nulls"],
            "named": reached["resolvable causes named"],
            "P(truth)": reached["probability on the truth, resolvable"],
            "ln P, nulls": f"{nulls['log_score']:.2f}",
            "ln P, gaps": f"{scores['gaps']['log_score']:.2f}",
            "sets hold gaps": reached["answer set holds the truth, gaps"],
            "set size": reached["answer set's size over the oracle's, gaps"],
            "failed": str(len(failed)),
            "seconds": f"{seconds:.0f}",
        },
    )


def main() -> None:
    """Solve, score and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="a split, as probation blind make left it")
    parser.add_argument("taken", nargs="*", metavar="GROUP", help="groups of TAKEN_AWAY, or GROUP.SETTING=VALUE")
    parser.add_argument("--processes", type=int, default=1)
    options = parser.parse_args()
    heading = False
    for name in options.taken or TAKEN_AWAY:
        scored = row(name, options.folder, options.processes)
        if not heading:
            print("| without | " + " | ".join(scored.figures) + " |", "|---|" + "---|" * len(scored.figures), sep="\n")
            heading = True
        print(f"| {name} | " + " | ".join(scored.figures.values()) + " |", flush=True)


if __name__ == "__main__":
    main()
