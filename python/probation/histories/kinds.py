"""The histories themselves: pulling, holding, going back, and grips that move at a constant speed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from probation.errors import InputError
from probation.histories.imposed import ImposedHistory
from probation.histories.named import NamedHistory, Parameter, samples
from probation.histories.necking import GRIP_SPEED, NECKING_SETS
from probation.histories.segments import Leg, leg, piecewise_linear

RATE = Parameter("rate", "1/s", 0.005, "true strain rate")


def _ramp(*, rate: float, strain: float, samples: int) -> ImposedHistory:
    if strain == 0.0:
        raise InputError("history 'ramp': found strain=0, expected another strain than that of the start")
    time = np.linspace(0.0, abs(strain) / rate, samples)
    direction = 1.0 if strain > 0.0 else -1.0
    return ImposedHistory(f"ramp at {rate:g} 1/s to true strain {strain:g}", time, direction * rate * time, jumps=())


def _rate_jump(*, rate: float, factor: float, jump_at: float, strain: float, samples: int) -> ImposedHistory:
    if not jump_at < strain:
        raise InputError(f"history 'rate-jump': found jump_at={jump_at:g}, expected less than strain={strain:g}")
    legs = [leg(0.0, jump_at, rate), leg(jump_at, strain, rate * factor)]
    name = f"ramp at {rate:g} 1/s, from true strain {jump_at:g} on at {rate * factor:g} 1/s"
    return piecewise_linear(name, legs, samples)


RAMP = NamedHistory(
    "ramp",
    "constant true strain rate, as in experiment 1",
    (RATE, Parameter("strain", "-", 2.0, "true strain at the end; negative: compression", least=None), samples()),
    _ramp,
)
RATE_JUMP = NamedHistory(
    "rate-jump",
    "a ramp whose rate jumps once",
    (
        Parameter("rate", "1/s", 0.001, "true strain rate before the jump"),
        Parameter("factor", "-", 10.0, "rate after over rate before"),
        Parameter("jump_at", "-", 0.3, "true strain at the jump"),
        Parameter("strain", "-", 0.6, "true strain at the end"),
        samples(),
    ),
    _rate_jump,
)


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


def _load_unload(
    *, rate: float, strain: float, dwell: float, unload_rate: float, unload_to: float, samples: int
) -> ImposedHistory:
    if not unload_to < strain:
        raise InputError(f"history 'load-unload': found unload_to={unload_to:g}, expected less than strain={strain:g}")
    legs = [leg(0.0, strain, rate), Leg(strain, dwell), leg(strain, unload_to, unload_rate)]
    name = f"ramp at {rate:g} 1/s to true strain {strain:g}, back to {unload_to:g} at {unload_rate:g} 1/s"
    return piecewise_linear(name, legs, samples)


def _cyclic(*, rate: float, mean: float, amplitude: float, cycles: int, samples: int) -> ImposedHistory:
    top, bottom = mean + amplitude, mean - amplitude
    legs, at = [], 0.0
    for to in [top, bottom] * cycles:
        legs.append(leg(at, to, rate))
        at = to
    name = f"{cycles} triangular cycles between true strain {bottom:g} and {top:g} at {rate:g} 1/s"
    return piecewise_linear(name, legs, samples)


LOAD_UNLOAD = NamedHistory(
    "load-unload",
    "a ramp, perhaps a dwell, and back",
    (
        RATE,
        Parameter("strain", "-", 0.5, "true strain at the turn"),
        Parameter("dwell", "s", 0.0, "at the turn", least=-1e-300),
        Parameter("unload_rate", "1/s", 0.005, "true strain rate on the way back"),
        Parameter("unload_to", "-", 0.485, "true strain at the end", least=None),
        samples(),
    ),
    _load_unload,
)
CYCLIC = NamedHistory(
    "cyclic",
    "triangular cycles around a mean strain",
    (
        RATE,
        Parameter("mean", "-", 0.05, "true strain in the middle of a cycle", least=None),
        Parameter("amplitude", "-", 0.02, "half the range of true strain"),
        Parameter("cycles", "-", 5, "how many", least=1),
        samples(),
    ),
    _cyclic,
)


def _necking(*, set: str, grip_speed: float, samples: int) -> ImposedHistory:  # noqa: A002 - users write set=P2
    history = NECKING_SETS[set].slowed(GRIP_SPEED / grip_speed)
    time = np.linspace(0.0, history.duration, samples)
    return ImposedHistory(
        f"necking, (A-1) with {set}, grips at {grip_speed:g} mm/s",
        time,
        history.true_strain(time),
        strain_rate=history.strain_rate(time),
        jumps=(),
    )


NECKING = NamedHistory(
    "necking",
    "where the neck forms between grips at constant speed, (A-1); 0.02 mm/s is experiment 2, 0.08 experiment 3",
    (
        Parameter("set", "-", "P2", "parameters of (A-1)", choices=tuple(NECKING_SETS)),
        Parameter("grip_speed", "mm/s", GRIP_SPEED, "the strain rate is proportional to it"),
        samples(),
    ),
    _necking,
)

KINDS = (RAMP, RATE_JUMP, RELAXATION, LOAD_UNLOAD, CYCLIC, NECKING, CREEP)
"""In the order in which they are listed."""
