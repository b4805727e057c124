r"""The law of 50 modes, solved by the two-stage Radau IIA scheme.

sigma_j' = p_j E eps' - (sigma_j - p_j R)/(r_j tau), R = G (exp(2 eps) - exp(-eps)). The modes are uncoupled, so both
stages (at a third and at the end of a step) have a closed form in z = h/(r_j tau) for each of them: third order, and
modes that are much faster than the step fall to their steady state (Hairer and Wanner, Solving Ordinary Differential
Equations II, section IV.5). Where the strain rate jumps, the step is graded towards the jump.

Arrays on the *grid* hold the nodes and the point after a third of every step: 2 n - 1 values for n nodes.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

FloatArray: TypeAlias = NDArray[np.float64]

MODES, DECADES = 50, 6.0
RATIO: FloatArray = np.logspace(-DECADES, 0.0, MODES)
"""Relaxation times over the longest one."""
WEIGHT: FloatArray = np.sqrt(RATIO) / np.sqrt(RATIO).sum()
STEADY = float(WEIGHT @ RATIO)
"""Flow stress over modulus and Weissenberg number."""
SLOWEST = 1e-7
"""Of the companion relation [1/s]."""
_JUMP, _DEEPEST = 0.01, 10
"""Part of the largest rate that a step may jump by without grading, and the most halvings."""


def haward_thackray(strain: FloatArray) -> FloatArray:
    """exp(2 eps) - exp(-eps)."""
    return np.asarray(np.exp(2.0 * strain) - np.exp(-strain))


def on_grid(nodes: FloatArray) -> FloatArray:
    """Values at nodes and, linear between them, after a third of every step."""
    grid = np.empty(2 * len(nodes) - 1)
    grid[::2] = nodes
    grid[1::2] = (2.0 * nodes[:-1] + nodes[1:]) / 3.0
    return grid


def rate_on_grid(time: FloatArray, strain: FloatArray) -> FloatArray:
    """Strain rate [1/s]: that of the step which a point ends or lies in; at the first node that of the first step."""
    slope = np.diff(strain[::2]) / np.diff(time[::2])
    return np.concatenate([slope[:1], np.repeat(slope, 2)])


@dataclass(frozen=True)
class Polymer:
    """Parameters of the law.

    Attributes
    ----------
    modulus, hardening : float [MPa]
    time : float
        tau_max [s], or alpha where there is a companion relation.
    companion : tuple of float, optional
        Slope and intercept of tau_max rate = slope log10(rate) + intercept.
    """

    modulus: float
    time: float
    hardening: float
    companion: tuple[float, float] | None = None

    def log_time(self, rate: FloatArray) -> FloatArray:
        """Natural logarithm of tau_max [s]."""
        if self.companion is None:
            return np.full(np.shape(rate), np.log(self.time))
        slope, intercept = self.companion
        speed = np.maximum(np.abs(rate), SLOWEST)
        return np.asarray(np.log(self.time * (slope * np.log10(speed) + intercept) / speed))


class Feedback(Protocol):
    """What stress does to the relaxation times while the specimen is strained."""

    def shift(self, stress: float, relaxed: float) -> float:
        """Of the logarithm of tau_max, at this stress [MPa]."""

    def advance(self, stress: float, strain_step: float, time_step: float) -> None:
        """Carry inner variables over a step at its mean stress."""


@dataclass(frozen=True, eq=False)
class Course:
    """What a specimen goes through; arrays on the grid.

    Attributes
    ----------
    strain, log_time, relaxed, modulus : ndarray, shape (2 n - 1,)
        Logarithm of tau_max [s], relaxed stress and modulus [MPa].
    ratio, weight, start : ndarray, shape (50,)
        Relaxation times over tau_max, weights, modal stresses above the relaxed ones at the first node [MPa].
    feedbacks : tuple of Feedback
    """

    strain: FloatArray
    log_time: FloatArray
    relaxed: FloatArray
    modulus: FloatArray
    ratio: FloatArray = field(default_factory=lambda: RATIO)
    weight: FloatArray = field(default_factory=lambda: WEIGHT)
    start: FloatArray = field(default_factory=lambda: np.zeros(MODES))
    feedbacks: tuple[Feedback, ...] = ()


def plain(polymer: Polymer, time: FloatArray, strain: FloatArray) -> Course:
    """What the law itself says of a strain history."""
    return Course(
        strain=strain,
        log_time=polymer.log_time(rate_on_grid(time, strain)),
        relaxed=polymer.hardening * haward_thackray(strain),
        modulus=np.full(len(strain), polymer.modulus),
    )


def solve(time: FloatArray, courses: Sequence[Course], *, graded: bool = True) -> FloatArray:
    """Stress [MPa] at the nodes, shape (n_courses, n), of courses over the same grid of time.

    Steps are graded after jumps of the rate, unless `graded` is False.
    """
    log_time, relaxed = (np.array([getattr(each, name) for each in courses]) for name in ("log_time", "relaxed"))
    modulus = np.array([each.modulus for each in courses])
    weight, inverse = np.array([each.weight for each in courses]), 1.0 / np.array([each.ratio for each in courses])
    step = np.diff(time[::2])
    rate = np.diff(np.array([each.strain[::2] for each in courses]), axis=1) / step
    modal = weight * relaxed[:, :1] + np.array([each.start for each in courses])
    fed = [k for k, each in enumerate(courses) if each.feedbacks]
    stress = np.empty((len(courses), len(step) + 1))
    stress[:, 0] = modal.sum(axis=1)
    depths = _depths(rate) if graded else np.zeros(len(step), dtype=np.intp)
    for n, whole in enumerate(step):
        speed = rate[:, n, None]
        edges = _edges(int(depths[n]))
        for a, b in itertools.pairwise(edges):
            h = (b - a) * whole
            stages = []
            for x in (a + (b - a) / 3.0, b):
                far = 1.5 * (x - 1.0 / 3.0)  # 0 after a third of the step, 1 at its end
                times, rest, stiff = (
                    (1.0 - far) * each[:, 2 * n + 1] + far * each[:, 2 * n + 2] for each in (log_time, relaxed, modulus)
                )
                stages.append((times, rest, h * stiff[:, None] * speed))
            if fed:
                modal = _fed_step(h, courses, fed, modal, weight, inverse, stages, speed)
            else:
                modal = _radau(h, modal, weight, inverse, stages)
        stress[:, n + 1] = modal.sum(axis=1)
    return stress


Stage: TypeAlias = "tuple[FloatArray, FloatArray, FloatArray]"
"""Logarithm of tau_max, relaxed stress, and step of the elastic stress; one value per course."""


def _radau(h: float, modal: FloatArray, weight: FloatArray, inverse: FloatArray, stages: Sequence[Stage]) -> FloatArray:
    (time1, rest1, drive1), (time2, rest2, drive2) = stages
    z1 = (h * np.exp(-time1))[:, None] * inverse
    z2 = (h * np.exp(-time2))[:, None] * inverse
    g1 = weight * (drive1 + z1 * rest1[:, None])
    g2 = weight * (drive2 + z2 * rest2[:, None])
    first = modal + (5.0 * g1 - g2) / 12.0
    last = modal + 0.75 * g1 + 0.25 * g2
    own = 1.0 + (5.0 / 12.0) * z1
    return np.asarray((own * last - 0.75 * z1 * first) / (own * (1.0 + 0.25 * z2) + z1 * z2 / 16.0))


def _fed_step(
    h: float,
    courses: Sequence[Course],
    fed: Sequence[int],
    modal: FloatArray,
    weight: FloatArray,
    inverse: FloatArray,
    stages: Sequence[Stage],
    speed: FloatArray,
) -> FloatArray:
    """A step in which the stress acts on tau_max: with the stress at its start, then with the stress so predicted."""
    before = modal.sum(axis=1)
    after = before
    for _ in range(2):
        shifted = []
        for part, (times, rest, drive) in zip((1.0 / 3.0, 1.0), stages, strict=True):
            here = times.copy()
            for k in fed:
                now = float(before[k] + part * (after[k] - before[k]))
                here[k] += sum(each.shift(now, float(rest[k])) for each in courses[k].feedbacks)
            shifted.append((here, rest, drive))
        found = _radau(h, modal, weight, inverse, shifted)
        after = found.sum(axis=1)
    for k in fed:
        for each in courses[k].feedbacks:
            each.advance(float(0.5 * (before[k] + after[k])), float(speed[k, 0]) * h, h)
    return found


def _depths(rate: FloatArray) -> NDArray[np.intp]:
    """How often the first part of every step is halved: by how far the rate jumps there, in any course."""
    jump = np.abs(np.diff(rate, axis=1, prepend=0.0)).max(axis=0) / max(float(np.abs(rate).max()), 1e-300)
    return np.asarray(np.clip(np.ceil(np.log2(np.maximum(jump / _JUMP, 1.0))), 0, _DEEPEST), dtype=np.intp)


def _edges(depth: int) -> list[float]:
    """Ends of the parts of a step, each twice as long as the one before."""
    return [0.0, *(2.0 ** float(k - depth) for k in range(depth + 1))]
