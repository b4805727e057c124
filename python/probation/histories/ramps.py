"""Pulling: a ramp, and a ramp whose rate jumps."""

from __future__ import annotations

import numpy as np

from probation.errors import InputError
from probation.histories.imposed import ImposedHistory
from probation.histories.named import NamedHistory, Parameter, samples
from probation.histories.segments import leg, piecewise_linear


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


RATE = Parameter("rate", "1/s", 0.005, "true strain rate")

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
