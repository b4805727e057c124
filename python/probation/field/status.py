"""What became of a pixel."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """One per pixel, in the map `status`; 0 to 7 are the engine's."""

    PENDING = -1
    IDENTIFIED = 0
    AT_A_BOUND = 1
    NOT_CONVERGED = 2
    NOT_DETERMINED = 3
    NOT_FINITE = 4
    TIMES_DO_NOT_INCREASE = 5
    TOO_FEW_SAMPLES = 6
    IMPOSSIBLE_RATE = 7
    NO_DATA = 20


MEANINGS = {
    Status.PENDING: "not done yet",
    Status.IDENTIFIED: "identified",
    Status.AT_A_BOUND: "a parameter at the end of its range",
    Status.NOT_CONVERGED: "no minimum found",
    Status.NOT_DETERMINED: "the record says nothing about a parameter",
    Status.NOT_FINITE: "a sample is no finite number",
    Status.TIMES_DO_NOT_INCREASE: "times do not increase",
    Status.TOO_FEW_SAMPLES: "too few samples before the first long gap",
    Status.IMPOSSIBLE_RATE: "no time from the companion relation at a rate of the record",
    Status.NO_DATA: "no data, or none at the first instant",
}
