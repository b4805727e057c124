"""To which power should evidence count, and how much should a p-value? Asked of a solved split that is for it.

`python -m bench.blind_tempering DIR` after `probation blind make --split calibrate` and `solve`: seconds. Where a gap
is declared, the log evidence that answers state is taken to other powers; the one with the best mean log score, and
whose probabilities come true, is `EVIDENCE.evidence_power` of settings/evidence.py. For the others the p-value of
the gap test speaks as if gaps that are not declared had other distributions of it: `EVIDENCE.undeclared_gap_power`.
Explanations that an answer does not list count as 1e-4; look-alikes from outside are left out, as in the calibration
error.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from bench.answered import answered
from bench.in_turn import LEAST, judged
from bench.one_line import one_line
from bench.reweighed import gaps_of
from probation.diagnosis.trust import Tempered
from probation.settings.evidence import EVIDENCE
from probation_studies.blind.layout import Layout

POWERS = (1.0, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)
SHYNESSES = (0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0)
LOOK_ALIKES = "mimic"


def tempered(gaps, power):
    """Log score, probability of the leading explanation, and whether it is right, of every gap."""
    return [(each.log_score, each.ranked[0][1], each.right) for each in judged(gaps, Tempered(power))]


def without_a_gap(case, p_value, shy):
    """Log score, and probability of "no effect is needed", which leads."""
    found, truth = case.answer.probability, case.explanation
    p_value = max(p_value, EVIDENCE.least_p_value)
    told = p_value ** (EVIDENCE.undeclared_gap_power - shy) * EVIDENCE.undeclared_gap_power / shy * found[()]
    whole = told + 1.0 - found[()]
    none = told / whole
    return np.log(none if truth == () else max(found.get(truth, 0.0) / whole, LEAST)), none, truth == ()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="a split with answers and truths")
    folder = parser.parse_args().folder
    with one_line(parser):
        gaps = [gap for gap in gaps_of(folder) if gap.case.stratum != LOOK_ALIKES]
    others = [
        (case, diagnosis["gap"]["p_value"])
        for case, diagnosis in answered(Layout(folder))
        if diagnosis is not None and not case.answer.gap and case.stratum != LOOK_ALIKES
    ]
    table("power", [(power, tempered(gaps, power)) for power in POWERS], "with a gap")
    singles = [gap for gap in gaps if len(gap.case.explanation) == 1 and gap.case.stratum == "single"]
    table("power", [(power, tempered(singles, power)) for power in POWERS], "with a single effect")
    table("shy", [(shy, [without_a_gap(*case, shy) for case in others]) for shy in SHYNESSES], "without")


def table(name, rows, which):
    """Mean log score, what was said of the leading explanation and how often it was right, for every setting."""
    print(f"{len(rows[0][1])} campaigns {which}\n{name:5s}  mean log score  said  right")
    for setting, scores in rows:
        logs, said, right = (np.mean(column) for column in zip(*scores, strict=True)) if scores else 3 * (np.nan,)
        print(f"{setting:5.2f}  {logs:14.3f}  {said:.2f}  {right:.2f}")


if __name__ == "__main__":
    main()
