"""Holding: the strain (relaxation) or the stress (creep)."""

from __future__ import annotations

from dataclasses import replace

from probation.histories.imposed import ImposedHistory
from probation.histories.named import NamedHistory, Parameter, samples
from probation.histories.segments import Leg, leg, piecewise_linear


def _relaxation(*, rate: float, strain: float, duration: float, samples: int) -> ImposedHistory:
    name = f"ramp at {rate:g} 1/s to true strain {strain:g}, held {duration:g} s"
    return piecewise_linear(name, [leg(0.0, strain, rate), Leg(strain, duration, graded=True)], samples)


def _creep(*, stress: float, rise: float, duration: float, samples: int) -> ImposedHistory:
    name = f"true stress raised to {stress:g} MPa in {rise:g} s, held {duration:g} s"
    imposed = piecewise_linear(name, [Leg(stress, rise), Leg(stress, duration, graded=True)], samples)
    return replace(imposed, true_strain=None, true_stress=imposed.true_strain)


RELAXATION = NamedHistory(
    "relaxation",
    "a ramp, then the strain is held; steps grow along the hold",
    (
        Parameter("rate", "1/s", 0.01, "true strain rate of the ramp"),
        Parameter("strain", "-", 0.1, "true strain that is held"),
        Parameter("duration", "s", 600.0, "of the hold"),
        samples(),
    ),
    _relaxation,
)
CREEP = NamedHistory(
    "creep",
    "the true stress is raised, then held; the strain is found",
    (
        Parameter("stress", "MPa", 20.0, "true stress that is held"),
        Parameter("rise", "s", 1.0, "time in which it is raised"),
        Parameter("duration", "s", 600.0, "of the hold"),
        samples(),
    ),
    _creep,
)
