"""Piecewise-linear strain: legs at constant rate and dwells, sampled so that every corner is a sample."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.histories.imposed import ImposedHistory

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


@dataclass(frozen=True)
class Leg:
    """Constant rate to a true strain (or whatever is imposed), or a dwell: then `to` is where it already is.

    Attributes
    ----------
    to : float [-]
    duration : float [s]
    graded : bool
        Steps that grow from the start of the leg on, for a dwell whose stress relaxes ever more slowly.
    """

    to: float
    duration: float
    graded: bool = False


def leg(start: float, to: float, rate: float) -> Leg:
    """A leg from one strain to another at a positive rate [1/s]."""
    if not rate > 0.0:
        raise InputError(f"rate is {rate}; expected a positive rate in 1/s")
    return Leg(to, abs(to - start) / rate)


def piecewise_linear(name: str, legs: Sequence[Leg], samples: int) -> ImposedHistory:
    """Join legs to a history.

    Parameters
    ----------
    legs : sequence of Leg
        Legs without duration are left out.
    samples : int
        In all; at least two steps for each leg.
    """
    legs = [part for part in legs if part.duration > 0.0]
    if not legs:
        raise InputError(f"{name}: the strain does not move; expected a history that lasts")
    times, strains, corners = [np.zeros(1)], [np.zeros(1)], []
    at, strain = 0.0, 0.0
    for each, steps in zip(legs, _shared_out(legs, samples - 1), strict=True):
        fraction = _graded(steps) if each.graded else np.linspace(0.0, 1.0, steps + 1)[1:]
        times.append(at + each.duration * fraction)
        strains.append(strain + (each.to - strain) * fraction)
        at, strain = at + each.duration, each.to
        corners.append(at)
    return ImposedHistory(name, np.concatenate(times), np.concatenate(strains), jumps=tuple(corners[:-1]))


def _shared_out(legs: Sequence[Leg], steps: int) -> list[int]:
    """Steps of each leg: by its duration, a graded one as an average leg, and none less than half an average."""
    if steps < 2 * len(legs):
        raise InputError(f"samples is {steps + 1}; expected at least {2 * len(legs) + 1} for {len(legs)} legs")
    total = sum(part.duration for part in legs)
    average = 1.0 / len(legs)
    weights = np.array([average if part.graded else max(part.duration / total, average / 2) for part in legs])
    ends = np.rint(np.cumsum(weights) / weights.sum() * steps).astype(int)
    return [int(count) for count in np.diff(ends, prepend=0)]


def _graded(steps: int) -> FloatArray:
    """Fractions of a leg whose steps grow geometrically, a thousandfold in all."""
    fractions: FloatArray = np.expm1(np.log(1000.0) * np.linspace(0.0, 1.0, steps + 1)[1:]) / 999.0
    return fractions
