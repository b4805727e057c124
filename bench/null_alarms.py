"""Rows of "Alarms" in docs/laboratories.md: how often the test for a gap takes a campaign without one for one with.

`python -m bench.null_alarms FOLDER…`: sealed folders with truths; nulls and replicates are asked, others passed over.
About two seconds of CPU each. What is found is written to `gaps.jsonl` of each folder as it comes, with the commit
that it comes from: a run that was ended goes on where it was. Intervals are exact, of 95 %. Of several folders all
together follow, and these by the noise of the strain.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bench.laboratories import rate
from bench.one_line import one_line
from probation.effects.registry import effects
from probation.effects.visible import visible
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.gap import find_gap
from probation.inference.scatter import replicates
from probation.inference.thinning import thin
from probation.origin import commit
from probation.records.campaign import Campaign
from probation_studies.blind.layout import Layout
from probation_studies.blind.scores.answer import NO_ANSWER
from probation_studies.blind.scores.board import by_strain_noise, false_alarms
from probation_studies.blind.scores.case import Case
from probation_studies.blind.scores.intervals import Rate
from probation_studies.blind.seal import read_truth

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

STRAIN_NOISES = {"to 2e-5": 2e-5, "to 2e-4": 2e-4, "to 5e-4": 5e-4, "above": np.inf}
"""Classes of the recorded strain's standard deviation, and the most of each."""

KINDS = {
    "alike": "specimens alike",
    "differing": "specimens differ",
    "replicates": "scatter from replicates",
    "strain_noise_to_5e-4": "strain noise to 5e-4",
}
"""Of nulls, and what their columns are called."""

HEAD = ("laboratory", "commit", "seed", *KINDS.values())


def gap_in(folder: Path) -> dict[str, object]:
    """Whether a campaign is said to hold a gap, and how plainly."""
    campaign, _ = thin(Campaign.load(folder))
    fitted = base_fit(campaign, plain_fit(campaign, "sa3", None))
    known = visible(effects(), fitted.model.views)
    gap = find_gap(fitted.screened(known), known)
    return {
        "gap": gap.exists,
        "p_value": min(gap.test.p_value, gap.held_out_p_value),
        "rms_MPa": gap.size.rms_MPa,
        "relative": gap.size.relative,
        "commit": commit(),
    }


def scatter_from_replicates(folder: Path) -> bool:
    """Whether it is left to replicates to show how far specimens differ, and there are some."""
    campaign = Campaign.load(folder)
    return campaign.specimens.scatter == "estimate" and bool(replicates(campaign.identify))


def asked(layout: Layout) -> list[tuple[Case, Mapping[str, object]]]:
    """Every null, and what was found in it."""
    path = layout.folder / "gaps.jsonl"
    lines = path.read_text().splitlines() if path.exists() else []
    found = {each["campaign"]: each for each in map(json.loads, lines)}
    nulls = []
    for truth in sorted(layout.truths.glob("*-[0-9]*.json")):
        case = Case(truth.stem, json.loads(read_truth(truth).text), NO_ANSWER)
        if case.causes:
            continue
        if case.name not in found:
            found[case.name] = {"campaign": case.name, **gap_in(layout.campaigns / case.name)}
            with path.open("a") as file:
                print(json.dumps(found[case.name]), file=file)
        scatter = "replicates" if scatter_from_replicates(layout.campaigns / case.name) else None
        answer = replace(NO_ANSWER, gap=bool(found[case.name]["gap"]), scatter=scatter)
        nulls.append((replace(case, answer=answer), found[case.name]))
    return nulls


def row(laboratory: str, nulls: Sequence[tuple[Case, Mapping[str, object]]]) -> str:
    """Of some nulls, and what was found in them."""
    alarms = false_alarms([case for case, _ in nulls])
    cells = (
        laboratory,
        ", ".join(sorted({str(found["commit"]) for _, found in nulls})),
        ", ".join(str(each) for each in sorted({case.truth["seed"] for case, _ in nulls})),
        *(rate(alarms[kind]) for kind in KINDS),
    )
    return f"| {' | '.join(cells)} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, help="sealed folders of one laboratory each")
    layouts = [Layout(folder) for folder in parser.parse_args().folders]
    print(f"| {' | '.join(HEAD)} |\n| {' | '.join(['---'] * len(HEAD))} |")
    together = []
    for layout in layouts:
        with one_line(parser):
            published, _ = layout.published()
        nulls = asked(layout)
        print(row(str(published.get("laboratory", "own")), nulls), flush=True)
        together += nulls
    if len(layouts) > 1:
        print(row("all", together))
        every = [case for case, _ in together]
        for name, cases in [("all", every), *by_strain_noise(every, STRAIN_NOISES).items()]:
            print(f"strain noise {name}: {rate(Rate.of(case.answer.gap for case in cases).plain())}")


if __name__ == "__main__":
    main()
