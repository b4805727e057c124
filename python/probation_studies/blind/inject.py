"""Faults of the rig put into measured records: what a channel would have read, and a log of what was done.

Nothing here knows of any law, engine or catalogue: a fault of the rig changes what is recorded of a test, and not the
test, so that the recorded force, strain and time say all that is needed. Strain and stress are taken back to elongation
and force, the fault is applied there, and true stress is made of them again as the laboratory does it, by the recorded
strain and constant volume. Noise stays the record's own.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

UNITS = {
    "force_offset": "MPa",
    "force_drift": "MPa",
    "force_gain": "",
    "force_strain_lag": "s",
    "slack": "",
    "machine_compliance": "1/MPa",
}
"""Faults and the unit of their size; `slack` is elongation over gauge length, forces are over the initial section."""


@dataclass(frozen=True)
class Injection:
    """What was done to which record.

    Attributes
    ----------
    record : str
    fault : str
        One of `UNITS`.
    size : float
    seed : int
        Of the noise of samples that the record did not have: a slack is taken up before it begins.
    """

    record: str
    fault: str
    size: float
    seed: int = 0

    def to_dict(self) -> dict[str, object]:
        """For a log: record, fault, size, its unit, seed."""
        return {**asdict(self), "unit": UNITS[self.fault]}


def inject(
    time: np.ndarray, true_strain: np.ndarray, true_stress: np.ndarray, done: Injection
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, true strain and true stress as they would have been recorded with the fault.

    Parameters
    ----------
    time, true_strain, true_stress : ndarray, shape (n,) [s], [-], [MPa]
    done : Injection

    Returns
    -------
    time, true_strain, true_stress : ndarray, shape (m,)
        m = n, but for a slack: it is taken up in samples that come first.

    Raises
    ------
    ValueError
        For an unknown fault.
    """
    time, elongation = np.array(time, dtype=float), np.expm1(true_strain)
    force = np.array(true_stress, dtype=float) * np.exp(-np.asarray(true_strain))
    if done.fault == "force_offset":
        force = force + done.size
    elif done.fault == "force_drift":
        force = force + done.size * (time - time[0]) / (time[-1] - time[0])
    elif done.fault == "force_gain":
        force = force * (1.0 + done.size)
    elif done.fault == "force_strain_lag":
        force = _late(time, force, done.size)
    elif done.fault == "slack":
        time, elongation, force = _slack(time, elongation, force, done)
    elif done.fault == "machine_compliance":
        elongation = elongation + done.size * force
    else:
        raise ValueError(f"found the fault {done.fault!r}, expected one of {', '.join(UNITS)}")
    return time, np.log1p(elongation), force * (1.0 + elongation)


def _late(time: np.ndarray, force: np.ndarray, delay: float) -> np.ndarray:
    """The force of `delay` seconds ago; whole samples where the delay is so many, which keeps the noise as it is."""
    step = float(np.median(np.diff(time)))
    shift = round(delay / step)
    if shift > 0 and abs(delay - shift * step) < 1e-6 * step:
        return np.concatenate([np.full(shift, force[0]), force[:-shift]])
    return np.asarray(np.interp(time - delay, time, force))


def _slack(
    time: np.ndarray, elongation: np.ndarray, force: np.ndarray, done: Injection
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The crosshead travels by the slack before the specimen, relaxed, sees anything; the force keeps its noise.

    A record that begins under strain begins after that.
    """
    if elongation[0] > 10.0 * _scatter(elongation):
        return time, elongation + done.size, force
    step, few = float(np.median(np.diff(time))), max(len(time) // 100, 5)
    speed = (elongation[few] - elongation[0]) / (time[few] - time[0])
    count = max(round(done.size / (speed * step)), 1)
    rng = np.random.default_rng(done.seed)
    place = np.arange(count)
    before = done.size * place / count + _scatter(elongation) * rng.standard_normal(count)
    before[0] = 0.0
    empty = force[0] + _scatter(force) * rng.standard_normal(count)
    return (
        np.concatenate([time[0] + step * place, time + step * count]),
        np.concatenate([elongation[0] + before, elongation + done.size]),
        np.concatenate([empty, force]),
    )


def _scatter(values: np.ndarray) -> float:
    """Standard deviation of what neighbouring samples do not share, by the median of second differences."""
    quartile = 0.674490  # of the standard normal distribution: half of its values are nearer to 0
    return float(np.median(np.abs(np.diff(values, 2))) / quartile / np.sqrt(6.0))
