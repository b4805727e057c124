"""About how the force of a specimen behind an elastic frame answers to a change: what makes the search for it short.

The specimen is taken for a linear viscoelastic solid, whose relaxation is read off one solve of the law with a small
step of the strain. Whatever the law, the search corrects what this leaves; see `own_force`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation import _core

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray

MODES = 10
"""Relaxation times, from a step to twice the record, and an elastic part; faster ones could not be read."""

SAMPLES = 60
"""Instants at which the relaxation is read, evenly in the logarithm of time."""

STEP = 1e-6
"""Strain by which the law is probed [-]."""

MOST_GROWTH = 0.9
"""Of `ElasticFrame.growth`: far from balance the factor would do more than the stress itself."""

MOVING = 0.02
"""Part of its range that the strain has to move by until the specimen is under way; slack goes before."""


@dataclass(frozen=True, eq=False)
class ElasticFrame:
    """A viscoelastic specimen in series with an elastic frame.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
    modulus, relaxation_time : ndarray, shape (n_modes,) [MPa], [s]
        Of the specimen; infinite times are elastic.
    give : ndarray, shape (n,) [1/MPa]
        Strain that the frame takes away from the specimen per stress, negative.
    factor : ndarray, shape (n,) [-]
        The recorded stress over the specimen's: both are one force, on sections that differ.
    growth : ndarray, shape (n,) [-]
        How much of a change of the recorded stress comes back because the factor changes with it, below 1.
    """

    time: FloatArray
    modulus: FloatArray
    relaxation_time: FloatArray
    give: FloatArray
    factor: FloatArray
    growth: FloatArray

    @classmethod
    def of(
        cls,
        time: FloatArray,
        strain: FloatArray,
        give: FloatArray,
        stress_at: Callable[[FloatArray], FloatArray],
        conversion: FloatArray | None = None,
        growth: FloatArray | None = None,
    ) -> ElasticFrame:
        """Read off a law.

        Parameters
        ----------
        time, strain : ndarray, shape (n,) [s], [-]
            Of the specimen.
        give : ndarray, shape (n,) [1/MPa]
        stress_at : callable
            Stress (n,) [MPa] of the law at a change (n,) of the specimen's strain.
        conversion, growth : ndarray, shape (n,) [-], optional
            Logarithm of the factor, and what comes back through it.
        """
        from scipy.optimize import nnls  # noqa: PLC0415 - few need it

        moved = np.abs(strain - strain[0])
        begun = int(np.argmax(moved >= MOVING * max(float(moved.max()), 1e-300)))
        begun = min(begun, len(time) - 2)
        step = np.where(np.arange(len(time)) > begun, STEP, 0.0)
        relaxation = (stress_at(step) - stress_at(0.0 * step))[begun + 1 :] / STEP
        since = time[begun + 1 :] - 0.5 * (time[begun] + time[begun + 1])
        times = np.geomspace(2.0 * since[0], 2.0 * since[-1], MODES)
        read = np.unique(np.searchsorted(since, np.geomspace(since[0], since[-1], SAMPLES)).clip(0, len(since) - 1))
        columns = np.column_stack([np.exp(-since[read, None] / times), np.ones(len(read))])
        modulus = nnls(columns, relaxation[read])[0]
        kept = modulus > 0.0
        factor = np.ones_like(give) if conversion is None else np.exp(conversion)
        growth = np.zeros_like(give) if growth is None else np.minimum(growth, MOST_GROWTH)
        return cls(time, modulus[kept], np.append(times, np.inf)[kept], np.minimum(give, 0.0), factor, growth)

    def answer(self, change: FloatArray) -> FloatArray:
        """Change of the recorded stress (n,) [MPa] where it would change by so much were the strain held."""
        passed = self.factor / (1.0 - self.growth)
        behind = _core.stress_behind_frame(
            self.time, self.modulus, self.relaxation_time, self.give * passed, change / self.factor
        )
        return np.asarray(passed * behind)
