"""What the crosshead does: constant and changed speeds, holds, growing cycles, slow ramps; and when it is sampled."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from probation_studies.blind.laboratories.industry.bench import Law, Programme, Scales, base_stress
from probation_studies.blind.laboratories.industry.memory import FloatArray

CONSTANT, TWO_SPEEDS, HOLD, CYCLES, SLOW = "constant", "two-speeds", "hold", "cycles", "slow"

_NEEDS = {"unloading": CYCLES, "hold": HOLD, "corner": TWO_SPEEDS}
CONTROL = {
    CONSTANT: "displacement-rate",
    TWO_SPEEDS: "displacement-rate",
    HOLD: "hold",
    CYCLES: "cyclic",
    SLOW: "displacement-rate",
}
_SAMPLES = 200, 2000
_SAMPLES_OF_REPLICATES = 200, 500
_STARTS = {"plain": 0.65, "loaded": 0.12, "late": 0.12, "cut": 0.11}
"""How records begin: at rest; held at a strain until relaxed; with a wait at zero; when the force is seen."""


@dataclass(frozen=True)
class Condition:
    """One way of testing, and how often it is done.

    Attributes
    ----------
    kind : str
    speed : float [1/s]
        Of the crosshead over the gauge length.
    reach : float
        Largest travel over the gauge length.
    repeats : int
    """

    kind: str
    speed: float
    reach: float
    repeats: int


@dataclass(frozen=True)
class Design:
    """A series of tests.

    Attributes
    ----------
    law : Law
    conditions : tuple of Condition
    clip_on : bool
        Whether an extensometer is worn; the crosshead's travel is taken if not.
    replicates : bool
        Whether specimens are repeated, and differ.
    scales : Scales
    """

    law: Law
    conditions: tuple[Condition, ...]
    clip_on: bool
    replicates: bool
    scales: Scales


def draw_design(random: np.random.Generator, needs: frozenset[str], *, clip_on: bool, replicates: bool) -> Design:
    """Draw a series of tests that can show what is needed."""
    cyclic = "unloading" in needs or "turns" in needs or "hold" in needs
    usual = 10.0 ** random.uniform(-3.7, -2.3)
    companion = None
    if not cyclic and random.random() < 0.4:
        number = 10.0 ** random.uniform(-1.7, -1.2)
        slope = number * random.uniform(0.03, 0.18)
        companion = slope, number - slope * float(np.log10(usual))
    kinds = [
        _NEEDS["unloading" if each == "turns" else each]
        for each in sorted(needs)
        if each in ("unloading", "turns", "hold", "corner")
    ]
    kinds = list(dict.fromkeys(kinds))
    count = int(random.integers(2, 4)) if replicates else int(random.integers(2, 7))
    if "order" in needs and not replicates:
        count = max(count, 4)
    others = [CONSTANT, TWO_SPEEDS, SLOW] if companion else [CONSTANT, TWO_SPEEDS, HOLD, CYCLES, SLOW]
    weights = np.array([4.0, 2.0, 1.0] if companion else [4.0, 2.0, 2.0, 1.5, 1.0])
    while len(kinds) < count:
        kinds.append(str(random.choice(others, p=weights / weights.sum())))
    if kinds.count(SLOW) == len(kinds):
        kinds[0] = CONSTANT
    factors = [1.0, *random.permutation([0.3, 3.0, 10.0, 0.1])]
    largest = 10.0 ** random.uniform(-1.0, -0.3) if clip_on else 10.0 ** random.uniform(-0.6, 0.5)
    conditions = []
    for k, kind in enumerate(kinds):
        factor = factors[k % 3] if "speeds" in needs or random.random() < 0.6 else 1.0
        slow = kind == SLOW
        conditions.append(
            Condition(
                kind,
                usual * factor * (0.1 if slow else 1.0),
                largest * random.uniform(0.7, 1.0) * (0.3 if slow else 1.0),
                (int(random.integers(3, 6)) if count == 2 else 3) if replicates else 1,
            )
        )
    fastest = max(each.speed for each in conditions)
    weissenberg = 10.0 ** random.uniform(-1.7, -1.1)
    law = Law(
        modulus=10.0 ** random.uniform(2.8, 3.5),
        time=random.uniform(0.8, 1.3) if companion else weissenberg / fastest,
        hardening=10.0 ** random.uniform(-0.3, 0.6),
        companion=companion,
    )
    duration = float(np.median([each.reach / each.speed for each in conditions]))
    scales = Scales(float(np.log1p(max(each.reach for each in conditions))), 1.0, 1.0, usual, duration)
    design = Design(law, tuple(conditions), clip_on, replicates, scales)
    peaks = [_peak(design, each) for each in conditions]
    stress, force = (max(values) for values in zip(*peaks, strict=True))
    return replace(design, scales=replace(scales, stress=stress, force=force))


def _peak(design: Design, condition: Condition) -> tuple[float, float]:
    travel = np.linspace(0.0, condition.reach, 200)
    programme = Programme(travel / condition.speed, travel, (0.0,), 0)
    stress = base_stress(programme, design.law, design.scales, travel)
    return float(stress.max()), float((stress / (1.0 + travel)).max())


def draw_programme(
    random: np.random.Generator, design: Design, condition: Condition, order: int
) -> tuple[Programme, str]:
    """Sample times and travels of one test, and how its record begins."""
    reach = condition.reach
    start = str(random.choice(list(_STARTS), p=list(_STARTS.values())))
    turns = _turns(random, design, condition)
    time, travel = np.array([each[0] for each in turns]), np.array([each[1] for each in turns])
    if start == "late":
        wait = random.uniform(0.02, 0.08) * time[-1]
        time, travel = np.concatenate([[0.0], time + wait]), np.concatenate([[0.0], travel])
    if start == "loaded":
        travel = travel + 10.0 ** random.uniform(-3.5, -2.2) * min(1.0, 10.0 * reach)
    least, most = _SAMPLES_OF_REPLICATES if design.replicates else _SAMPLES
    samples = int(np.exp(random.uniform(np.log(least), np.log(most))))
    even = random.random() < 0.5
    return _sampled(random, time, travel, samples, order, even=even), start


def _turns(random: np.random.Generator, design: Design, condition: Condition) -> list[tuple[float, float]]:
    """Corners of the travel over time."""
    speed, reach = condition.speed, condition.reach
    if condition.kind == TWO_SPEEDS:
        change, factor = random.uniform(0.15, 0.6) * reach, float(random.choice([0.1, 0.2, 5.0]))
        if factor > 1.0:
            speed /= factor
        return [(0.0, 0.0), (change / speed, change), (change / speed + (reach - change) / (speed * factor), reach)]
    if condition.kind == HOLD:
        at, duration = random.uniform(0.15, 0.7) * reach, reach / speed
        begin, lasting = at / speed, random.uniform(0.3, 1.5) * duration
        return [(0.0, 0.0), (begin, at), (begin + lasting, at), (begin + lasting + (reach - at) / speed, reach)]
    if condition.kind == CYCLES:
        back = 1.2 * design.scales.stress / design.law.modulus
        while True:
            turns = _cycles(reach, speed, back)
            time = np.interp(
                np.linspace(0.0, len(turns) - 1.0, 300), np.arange(len(turns)), [each[0] for each in turns]
            )
            travel = np.interp(time, [each[0] for each in turns], [each[1] for each in turns])
            stress = base_stress(Programme(time, travel, (0.0,), 0), design.law, design.scales, travel)
            if stress.min() > -1e-3 * stress.max():
                return turns
            back *= 0.7
    return [(0.0, 0.0), (reach / speed, reach)]


def _cycles(reach: float, speed: float, back: float) -> list[tuple[float, float]]:
    turns, now = [(0.0, 0.0)], 0.0
    for k in range(1, 5):
        goal = reach * k / 4.0
        for target in (goal, goal - min(back * (1.0 + goal), 0.8 * goal)) if k < 4 else (goal,):
            turns.append((turns[-1][0] + abs(target - now) / speed, target))
            now = target
    return turns


def _sampled(
    random: np.random.Generator, corner: FloatArray, travel: FloatArray, samples: int, order: int, *, even: bool
) -> Programme:
    """Even sampling, or more samples after every corner and a clock that jitters; every corner is a sample."""
    end = corner[-1]
    if even:
        time = np.linspace(0.0, end, samples)
    else:
        fine = np.linspace(0.0, end, 20001)
        since = fine - corner[np.maximum(np.searchsorted(corner, fine, side="right") - 1, 0)]
        density = 1.0 + 8.0 * np.exp(-since / (0.02 * end))
        through = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
        place = np.linspace(0.0, 1.0, samples)
        place[1:-1] += random.uniform(-0.2, 0.2, samples - 2) / samples
        time = np.interp(place * through[-1], through, fine)
    time = np.unique(np.concatenate([time, corner]))
    apart = np.concatenate([[True], np.diff(time) > 1e-3 * end / samples])
    time = time[apart | np.isin(time, corner)]
    return Programme(time, np.interp(time, corner, travel), tuple(float(each) for each in corner[:-1]), order)
