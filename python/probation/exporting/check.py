"""The round trip: what is read back from an exported text, solved, and compared with the law."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.wording import percentage

if TYPE_CHECKING:
    from probation._arrays import FloatArray

_SAMPLES = 40  # of each segment, denser at its start


@dataclass(frozen=True)
class Check:
    """One error that was found.

    Attributes
    ----------
    name : str
        snake_case.
    what : str
        Compared with what, in words.
    error : float
        Largest difference [MPa].
    relative : float
        The same over the largest stress [-].
    """

    name: str
    what: str
    error: float
    relative: float

    @property
    def text(self) -> str:
        """One line."""
        return f"{self.what}: {self.error:.2g} MPa at most ({percentage(self.relative)} % of the largest stress)"


def compared(name: str, what: str, found: list[FloatArray], expected: list[FloatArray]) -> Check:
    """The largest difference over several histories, each taken over its own largest stress.

    Raises
    ------
    InputError
        If a stress is not finite: nothing can be said of such an export.
    """
    if not all(np.isfinite(stress).all() for stress in (*found, *expected)):
        raise InputError(
            "law: found a stress beyond all numbers in the check, expected parameters and rates of a solid"
        )
    errors = [float(np.max(np.abs(a - b))) for a, b in zip(found, expected, strict=True)]
    scales = [float(np.max(np.abs(b))) for b in expected]
    return Check(name, what, max(errors), max(e / s if s else e for e, s in zip(errors, scales, strict=True)))


def ramp(rate: float, strain: float) -> tuple[FloatArray, FloatArray]:
    """Time [s] and true strain of a ramp, shape (n_times,) each."""
    return _segments([(rate, strain)])


def ramp_jump_unload(rate: float, strain: float) -> tuple[FloatArray, FloatArray]:
    """A ramp whose rate jumps up tenfold and back, and an unloading by a fifth of the strain."""
    return _segments([(rate, 0.4 * strain), (10.0 * rate, 0.3 * strain), (rate, 0.3 * strain), (-rate, 0.2 * strain)])


def ramp_unload(rate: float, strain: float, back: float) -> tuple[FloatArray, FloatArray]:
    """A ramp, then back by a strain at the same rate."""
    return _segments([(rate, strain), (-rate, back)])


def _segments(parts: list[tuple[float, float]]) -> tuple[FloatArray, FloatArray]:
    fractions = np.geomspace(1e-4, 1.0, _SAMPLES)
    time, strain = [np.zeros(1)], [np.zeros(1)]
    for rate, extent in parts:
        time.append(time[-1][-1] + fractions * extent / abs(rate))
        strain.append(strain[-1][-1] + fractions * extent * np.sign(rate))
    return np.concatenate(time), np.concatenate(strain)
