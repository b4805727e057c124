"""To which power should evidence count? Asked of a solved split of sealed campaigns that is for it.

`python -m bench.blind_tempering DIR` after `probation blind make --split calibrate` and `solve`: seconds. For the
campaigns where a gap was seen, the evidence behind the answers' probabilities is taken to other powers; the one with
the best mean log score, and whose probabilities come true, is `TEMPERED` of diagnosis/probabilities.py. Explanations
that an answer does not list count as 1e-4; look-alikes from outside are left out, as in the calibration error.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from probation.blind.layout import Layout
from probation.blind.scores.answer import read_answer
from probation.blind.scores.case import Case
from probation.blind.seal import open_truth, read_json
from probation.diagnosis.probabilities import TEMPERED, log_prior

POWERS = (1.0, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
EFFECTS = 22
LEAST = 1e-4


def cases(folder):
    """Probabilities by explanation, and the true explanation, of every campaign where a gap was seen."""
    layout = Layout(folder)
    for name, seal in layout.published()[1].items():
        path = layout.answers / f"{name}.json"
        answer = read_answer(read_json(path)["diagnosis"], str(path))
        case = Case(name, open_truth(layout.truths / f"{name}.json", seal), answer)
        if answer.gap and case.stratum != "mimic":
            yield answer.probability, case.explanation


def scored(found, truth, power):
    """Log score, probability of the leading explanation, and whether it is right."""
    names = sorted({*found, truth})
    prior = np.array([log_prior(each, EFFECTS) for each in names])
    evidence = (np.log([max(found.get(each, 0.0), LEAST) for each in names]) - prior) / TEMPERED
    score = power * evidence + prior
    chance = np.exp(score - score.max())
    chance /= chance.sum()
    best = int(np.argmax(chance))
    return np.log(max(chance[names.index(truth)], LEAST)), chance[best], names[best] == truth


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="a split with answers and truths")
    known = list(cases(parser.parse_args().folder))
    print(f"{len(known)} campaigns with a gap\npower  mean log score  said  right")
    for power in POWERS:
        logs, said, right = (np.mean(column) for column in zip(*(scored(*case, power) for case in known), strict=True))
        print(f"{power:5.1f}  {logs:14.3f}  {said:.2f}  {right:.2f}")


if __name__ == "__main__":
    main()
