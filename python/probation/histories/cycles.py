"""Going back: one unloading, and cycles."""

from __future__ import annotations

from probation.errors import InputError
from probation.histories.imposed import ImposedHistory
from probation.histories.named import NamedHistory, Parameter, samples
from probation.histories.ramps import RATE
from probation.histories.segments import Leg, leg, piecewise_linear


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
