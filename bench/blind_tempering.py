"""To which power should evidence count, and how much should a p-value? Asked of a solved split that is for it.

`python -m bench.blind_tempering DIR` after `probation blind make --split calibrate` and `solve`: seconds. For the
campaigns where a gap was seen, the evidence behind the answers' probabilities is taken to other powers; the one with
the best mean log score, and whose probabilities come true, is `EVIDENCE.evidence_power` of diagnosis/probabilities.py.
For the others the p-value of the gap test speaks as if gaps that are not declared had other distributions of it:
`EVIDENCE.undeclared_gap_power`. Explanations that an answer does not list count as 1e-4; look-alikes from outside are
left out, as in the calibration error.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from probation.diagnosis.probabilities import log_prior
from probation.effects.registry import effects
from probation.settings.evidence import EVIDENCE
from probation_studies.blind.layout import Layout
from probation_studies.blind.scores.answer import read_answer
from probation_studies.blind.scores.case import Case
from probation_studies.blind.seal import open_truth, read_object

POWERS = (1.0, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
SHYNESSES = (0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0)
EFFECTS = len(effects())
LEAST = 1e-4


def cases(folder):
    """Probabilities by explanation, the true one, and the p-value of every campaign; None where a gap is seen."""
    layout = Layout(folder)
    for name, seal in layout.published()[1].items():
        path = layout.answers / f"{name}.json"
        diagnosis = read_object(path)["diagnosis"]
        answer = read_answer(diagnosis, str(path))
        case = Case(name, open_truth(layout.truths / f"{name}.json", seal), answer)
        if case.stratum != "mimic":
            yield answer.probability, case.explanation, None if answer.gap else diagnosis["gap"]["p_value"]


def scored(found, truth, power):
    """Log score, probability of the leading explanation, and whether it is right."""
    names = sorted({*found, truth})
    prior = np.array([log_prior(each, EFFECTS) for each in names])
    evidence = (np.log([max(found.get(each, 0.0), LEAST) for each in names]) - prior) / EVIDENCE.evidence_power
    score = power * evidence + prior
    chance = np.exp(score - score.max())
    chance /= chance.sum()
    best = int(np.argmax(chance))
    return np.log(max(chance[names.index(truth)], LEAST)), chance[best], names[best] == truth


def without_a_gap(found, truth, p_value, shy):
    """Log score, and probability of "no effect is needed", which leads."""
    p_value = max(p_value, EVIDENCE.least_p_value)
    told = p_value ** (EVIDENCE.undeclared_gap_power - shy) * EVIDENCE.undeclared_gap_power / shy * found[()]
    whole = told + 1.0 - found[()]
    none = told / whole
    return np.log(none if truth == () else max(found.get(truth, 0.0) / whole, LEAST)), none, truth == ()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="a split with answers and truths")
    known = list(cases(parser.parse_args().folder))
    seen = [(found, truth) for found, truth, p_value in known if p_value is None]
    others = [case for case in known if case[2] is not None]
    table("power", [(power, [scored(*case, power) for case in seen]) for power in POWERS], "with a gap")
    table("shy", [(shy, [without_a_gap(*case, shy) for case in others]) for shy in SHYNESSES], "without")


def table(name, rows, which):
    """Mean log score, what was said of the leading explanation and how often it was right, for every setting."""
    print(f"{len(rows[0][1])} campaigns {which}\n{name:5s}  mean log score  said  right")
    for setting, scores in rows:
        logs, said, right = (np.mean(column) for column in zip(*scores, strict=True))
        print(f"{setting:5.2f}  {logs:14.3f}  {said:.2f}  {right:.2f}")


if __name__ == "__main__":
    main()
