"""How a test was driven, guessed from its strain: the default of a question, never more."""

import numpy as np

from probation.records.record import FloatArray, Record
from probation.settings.reading import READING

_SEGMENTS = 20
"""Segments of equal duration whose mean rates show how a test was driven."""


def guess_control(record: Record) -> str:
    """How the test was driven, by where its strain turns, rests, or goes at a constant rate.

    Returns
    -------
    {"strain-rate", "displacement-rate", "hold", "cyclic", "other"}
    """
    rates = _rates(record.time, record.true_strain)
    fastest = float(np.abs(rates).max())
    if fastest == 0.0:
        return "other"
    moving = rates[np.abs(rates) > READING.still_rate * fastest]
    if len(rates) - len(moving) >= READING.held_share * len(rates):
        return "hold"
    if (moving > 0).any() and (moving < 0).any():
        return "cyclic"
    drives = {
        "strain-rate": _rates(record.time, record.true_strain),
        "displacement-rate": _rates(record.time, np.expm1(record.true_strain)),
    }
    scatter = {name: float(np.std(values) / abs(np.mean(values))) for name, values in drives.items() if values.mean()}
    steadiest = min(scatter, key=lambda name: scatter[name], default="other")
    return steadiest if steadiest == "other" or scatter[steadiest] < READING.steady_rate else "other"


def _rates(time: FloatArray, strain: FloatArray) -> FloatArray:
    """Slope of the strain over each of some segments of equal duration."""
    edges = np.linspace(time[0], time[-1], _SEGMENTS + 1)
    rates: FloatArray = np.diff(np.interp(edges, time, strain)) / np.diff(edges)
    return rates
