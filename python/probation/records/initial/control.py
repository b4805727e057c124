"""How a test was driven, guessed from its strain: the default of a question, never more."""

import numpy as np

from probation.records.record import FloatArray, Record

_STRETCHES = 20
_STEADY = 0.1  # relative scatter of the rate over stretches below which a rate counts as constant
_STILL = 0.05  # of the fastest stretch: slower is a hold
_HELD = 0.5  # share of the time that stands still, from which on the test is a hold


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
    moving = rates[np.abs(rates) > _STILL * fastest]
    if len(rates) - len(moving) >= _HELD * len(rates):
        return "hold"
    if (moving > 0).any() and (moving < 0).any():
        return "cyclic"
    drives = {
        "strain-rate": _rates(record.time, record.true_strain),
        "displacement-rate": _rates(record.time, np.expm1(record.true_strain)),
    }
    scatter = {name: float(np.std(values) / abs(np.mean(values))) for name, values in drives.items() if values.mean()}
    steadiest = min(scatter, key=lambda name: scatter[name], default="other")
    return steadiest if steadiest == "other" or scatter[steadiest] < _STEADY else "other"


def _rates(time: FloatArray, strain: FloatArray) -> FloatArray:
    """Slope of the strain over each of some stretches of equal duration."""
    edges = np.linspace(time[0], time[-1], _STRETCHES + 1)
    rates: FloatArray = np.diff(np.interp(edges, time, strain)) / np.diff(edges)
    return rates
