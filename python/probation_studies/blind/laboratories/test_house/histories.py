"""Strain histories: ramps, rate jumps, unloadings and necks, all with a little wander of the speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erf

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.random import Generator
    from numpy.typing import NDArray

    from probation_studies.blind.laboratories.test_house.modal import FloatArray

_WANDER = 0.003
"""Standard deviation of the speed's slowest wave; those of a half and of a third of its period are less by that."""
_BACK = 0.007
"""Strain of an unloading: some twenty samples, as a machine's log has it."""


@dataclass(frozen=True, eq=False)
class History:
    """Strain on fine instants, which contain the samples.

    Attributes
    ----------
    kind : str
        One of `KINDS`.
    time : ndarray, shape (n,) [s]
        Of the samples.
    fine, strain : ndarray, shape (n_fine,)
        Instants [s] and true strain.
    at : ndarray of int, shape (n,)
        Where the samples are among the fine instants.
    """

    kind: str
    time: FloatArray
    fine: FloatArray
    strain: FloatArray
    at: NDArray[np.intp]


def draw_history(kind: str, rate: float, end: float, random: Generator, count: int, substeps: int) -> History:
    """A history with drawn details.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    rate : float [1/s]
    end : float
        The last strain, or nearly.
    random : Generator
    count : int
        Of samples, about.
    substeps : int
        Between two samples; there are more behind the start and where the rate jumps.
    """
    return KINDS[kind](rate, end, random, count, substeps)


def _ramp(rate: float, end: float, random: Generator, count: int, substeps: int) -> History:
    return _segments("ramp", [(rate, end)], random, count, substeps)


def _jump(rate: float, end: float, random: Generator, count: int, substeps: int) -> History:
    """Slow, three or ten times as fast, slow again."""
    ratio = random.choice([3.0, 10.0])
    first, second = end * random.uniform(0.25, 0.4), end * random.uniform(0.3, 0.4)
    parts = [(rate, first), (rate * ratio, second), (rate, end - first - second)]
    return _segments("jump", parts, random, count, substeps)


def _unloading(rate: float, end: float, random: Generator, count: int, substeps: int) -> History:
    """Unloaded and loaded again twice: at a third and at two thirds of the way or so."""
    a, b = end * random.uniform(0.25, 0.4), end * random.uniform(0.65, 0.8)
    parts = [(rate, a), (-rate, _BACK), (rate, b - a + _BACK), (-rate, _BACK), (rate, end - b + _BACK)]
    return _segments("unloading", parts, random, count, substeps)


def _necking(rate: float, end: float, random: Generator, count: int, substeps: int) -> History:
    """The local rate rises tenfold while the neck passes, and falls again."""
    ratio, share, centre = random.uniform(7, 11), random.uniform(0.5, 0.7), random.uniform(0.4, 0.55)
    duration = end * (1 - share) / rate  # the neck brings `share` of the strain
    width = end * share / ((ratio - 1) * rate * np.sqrt(2 * np.pi))
    time = np.linspace(0, duration, count + 1)
    fine, at = _instants(time, [], substeps)
    passed = 0.5 * end * share * erf((np.append(0.0, fine) - centre * duration) / width / np.sqrt(2))
    return History("necking", time, fine, rate * fine + passed[1:] - passed[0], at)


KINDS = {"ramp": _ramp, "jump": _jump, "unloading": _unloading, "necking": _necking}
"""By name."""


def _segments(kind: str, parts: Sequence[tuple[float, float]], random: Generator, count: int, substeps: int) -> History:
    """Constant rates: rate and change of strain of each part."""
    durations = np.array([abs(change / rate) for rate, change in parts])
    step = durations.sum() / count
    lengths = np.maximum(np.round(durations / step), 2).astype(int)
    time = step * np.arange(lengths.sum() + 1)
    ends = step * np.cumsum(lengths)
    starts = np.concatenate([[0.0], ends[:-1]])
    fine, at = _instants(time, starts, substeps)
    within = [np.clip(fine - a, 0.0, b - a) for a, b in zip(starts, ends, strict=True)]
    strain = sum((rate * each for (rate, _), each in zip(parts, within, strict=True)), np.zeros(len(fine)))
    path = sum((abs(rate) * each for (rate, _), each in zip(parts, within, strict=True)), np.zeros(len(fine)))
    wave = np.zeros(len(fine))
    for order in (1, 2, 3):
        size, phase = random.normal(0, _WANDER / order), random.uniform(0, 2 * np.pi)
        omega = 2 * np.pi * order / time[-1]
        wave += size / omega * (np.sin(omega * fine + phase) - np.sin(phase))
    if len(parts) == 1:
        wander = wave * abs(parts[0][0])
    else:  # along the way that the crosshead goes
        wander = np.interp(path, fine / fine[-1] * path[-1], wave / fine[-1] * path[-1])
    return History(kind, time, fine, strain + wander, at)


def _instants(samples: FloatArray, breaks: Iterable[float], substeps: int) -> tuple[FloatArray, NDArray[np.intp]]:
    """Fine instants, and where the samples are among them."""
    step = samples[1] - samples[0]
    inner = np.arange(1, substeps) / substeps
    graded = np.unique(np.concatenate([inner, 2.0 ** -np.arange(1, 9)]))
    special = {round(each / step) for each in breaks} | {0}
    fine, at = [samples[:1]], [0]
    for n in range(len(samples) - 1):
        part = graded if n in special else inner
        fine += [samples[n] + step * part, samples[n + 1 : n + 2]]
        at.append(at[-1] + len(part) + 1)
    return np.concatenate(fine), np.array(at)
