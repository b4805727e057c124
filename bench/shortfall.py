"""Of resolvable gaps whose cause was not named: is it the form, the evidence, the search or the strength?

`python -m bench.shortfall FOLDER…`: sealed folders, answered; the truths are opened. A gap that the oracle names in
95 % of repeats and the answer does not is diagnosed again, the solver told the names of what acts, and is one of

- strength: no gap was declared;
- form: told the true effects alone, the fit does not reach the noise: the test for a gap on what it leaves rejects
  (with the error of a form let pass that every explanation is allowed), or an unknown takes so much of the probability
  that the true effects are not in the answer set;
- evidence: with them alone the fit reaches the noise, but jointly with the leader's effects another explanation is more
  probable, priors being those of the whole catalogue: one with an unknown, the true one with a further effect or
  without one of its own, or another cause;
- search: told both, the true explanation leads; the full search did not find it;
- imitation: what acts has no name in the catalogue, and something that has took its place.

Some 20 s of CPU each. Answers of another commit are set against the diagnosis of this one.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from dataclasses import dataclass
from math import exp
from pathlib import Path
from typing import TYPE_CHECKING

import probation
from bench.answered import answered
from bench.one_line import one_line
from probation.diagnosis.probabilities import effect_count, log_prior
from probation.effects.record_view import views_of
from probation.effects.registry import effects
from probation.effects.visible import visible
from probation_studies.blind.layout import Layout
from probation_studies.blind.scores.answer import UNKNOWN, read_answer
from probation_studies.blind.scores.case import Case

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from probation_studies.blind.scores.answer import Names

BEFORE = ("an unknown", "a further effect", "a part of it", "another cause")
CLASSES = ("strength", "form", *(f"evidence: {each}" for each in BEFORE), "search", "imitation")
"""What stands against a name; by evidence, what comes before the true explanation."""
HEAD = ("campaign", "cause", "√λ", "class", "what led", "told the true effects alone", "told the leader's, too")


@dataclass(frozen=True)
class Found:
    """What stands against one campaign.

    Attributes
    ----------
    case : Case
    what : str
        One of `CLASSES`.
    alone, both : str
        Of the solver told the true effects, and told the leader's, too; empty where it was not asked.
    """

    case: Case
    what: str
    alone: str = ""
    both: str = ""

    @property
    def line(self) -> list[str]:
        """Its row."""
        case = self.case
        led = f"{said(case.answer.top)} {case.answer.probability[case.answer.top]:.2f}"
        acts = " + ".join(f"{cause['effect']} ({cause['kind']})" for cause in case.causes)
        return [case.name, acts, f"{case.detectability:.0f}", self.what, led, self.alone, self.both]


def said(names: Names) -> str:
    """An explanation in words."""
    return " + ".join(names) or "no gap"


def missed(layout: Layout) -> list[Case]:
    """Resolvable gaps that were answered, and not named."""
    gaps = (case for case, _ in answered(layout) if case.causes and case.resolvable)
    return [case for case in gaps if not (case.right and case.answer.gap)]


def why(layout: Layout, case: Case) -> Found:
    """Its class."""
    if not case.answer.gap:
        return Found(case, "strength")
    if UNKNOWN in case.explanation:
        return Found(case, "imitation")
    campaign = probation.Campaign.load(layout.campaigns / case.name)
    told = _Told.of(campaign, case.explanation)
    alone = told.words(case.explanation)
    if told.diagnosis["verdict"] == "no_gap":
        return Found(case, "strength", alone)
    if not told.reaches_the_noise(case.explanation):
        return Found(case, "form", alone)
    beside = known(case.answer.top) - set(case.explanation)
    both = _Told.of(campaign, {*case.explanation, *beside}) if beside else told
    leader = both.leader
    if leader == case.explanation:
        return Found(case, "search", alone, both.words(case.explanation))
    return Found(case, f"evidence: {before(leader, case.explanation)}", alone, both.words(case.explanation))


def known(names: Iterable[str]) -> set[str]:
    """Those with a name in the catalogue."""
    return set(names) - {UNKNOWN}


def before(leader: Names, truth: Names) -> str:
    """What an explanation that comes before the true one is, compared with it: one of `BEFORE`."""
    if UNKNOWN in leader:
        return BEFORE[0]
    if set(leader) > set(truth):
        return BEFORE[1]
    return BEFORE[2] if set(leader) < set(truth) else BEFORE[3]


@dataclass(frozen=True)
class _Told:
    """A diagnosis of some effects only, its probabilities as if the whole catalogue had been there.

    Attributes
    ----------
    diagnosis : mapping
    probability : dict
        Of every explanation.
    """

    diagnosis: Mapping[str, object]
    probability: dict[Names, float]

    @classmethod
    def of(cls, campaign: probation.Campaign, names: Iterable[str]) -> _Told:
        names = sorted(names)
        diagnosis = json.loads(probation.diagnose(campaign, effects=names, threads=1, design=False).to_json())
        views = views_of(campaign)
        few, all_of_them = (effect_count(visible(each, views)) for each in (effects(names), effects()))
        weight = {
            each: value * exp(log_prior(each, all_of_them) - log_prior(each, few))
            for each, value in read_answer(diagnosis, campaign.name).probability.items()
        }
        return cls(diagnosis, {each: value / sum(weight.values()) for each, value in weight.items()})

    @property
    def leader(self) -> Names:
        return max(self.probability, key=lambda names: self.probability[names])

    def reaches_the_noise(self, truth: Names) -> bool:
        """Whether the true effects, or some of them, leave no gap."""
        return any(p_value >= self.diagnosis["gap"]["level"] for p_value in self._left(truth))

    def words(self, truth: Names) -> str:
        """Leader, probability of the truth, p-value of what the true effects leave, and their misfit over the noise."""
        text = f"{said(self.leader)} {self.probability[self.leader]:.2f}"
        if self.leader != truth:
            text += f", truth {self.probability.get(truth, 0.0):.2g}"
        if left := self._left(truth):
            text += f"; p of what is left {max(left):.2g}"
        shrink = self.diagnosis["shrink"]["identify"]
        if known(self.diagnosis["causes"][0]["effects"]) == set(truth):
            text += f"; misfit over noise {shrink['after_MPa'] / shrink['noise_MPa']:.2f}"
        return text

    def _left(self, truth: Names) -> list[float]:
        """P-values of the test for a gap after fits of true effects, with or without an unknown jointly with them."""
        return [
            each["checks"]["remaining_p_value"]
            for each in self.diagnosis["causes"]
            if each["checks"] and known(each["effects"]) and known(each["effects"]) <= set(truth)
        ]


def page(name: str, found: Sequence[Found]) -> list[str]:
    """A laboratory's table, with how many fell into each class above it."""
    counts = Counter(each.what for each in found)
    lines = [CLASSES, ("---",) * len(CLASSES), tuple(str(counts[kind]) for kind in CLASSES)]
    table = [HEAD, ("---",) * len(HEAD), *(each.line for each in found)]
    title = f"**{name}**: {len(found)} resolvable gaps that are not named"
    return [title, "", *(_row(line) for line in lines), "", *(_row(line) for line in table), ""]


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, help="sealed folders of one laboratory each, answered")
    parser.add_argument("--answers", default="answers", help="where in each of them the answers are (default: answers)")
    chosen = parser.parse_args()
    for folder in chosen.folders:
        layout = Layout(folder, answer_folder=folder / chosen.answers)
        with one_line(parser):
            layout.published()
        found = []
        for case in missed(layout):
            found.append(why(layout, case))
            print(_row(found[-1].line), file=sys.stderr, flush=True)
        print("\n".join(page(folder.resolve().name, found)), flush=True)


if __name__ == "__main__":
    main()
