"""Grips that move at a constant speed: the necking history (A-1)."""

from __future__ import annotations

import numpy as np

from probation.histories.imposed import ImposedHistory
from probation.histories.named import NamedHistory, Parameter, samples
from probation.histories.necking import GRIP_SPEED, NECKING_SETS


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
