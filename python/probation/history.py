"""A strain history as the engine takes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from probation import _core
from probation._arrays import FloatArray, as_samples
from probation.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Jumps = Literal["auto"]


def make_history(
    time: ArrayLike,
    true_strain: ArrayLike,
    *,
    strain_rate: ArrayLike | None = None,
    jumps: ArrayLike | Jumps | None = "auto",
    direction: ArrayLike | None = None,
) -> _core.History:
    """Check a strain history and hand it to the engine.

    Parameters
    ----------
    time : array_like, shape (n_times,) [s]
        Increasing.
    true_strain : array_like, shape (n_times,) [-]
    strain_rate : array_like, shape (n_times,) [1/s], optional
        Without it the samples mean the piecewise-linear history between them.
    jumps : "auto", None or array_like of times [s]
        Instants at which the strain rate jumps: the schemes start afresh there. "auto" finds those that stand out by
        thirty times from the changes around them.
    direction : array_like, shape (n_times - 1,), optional
        Commanded direction of each step, +1, -1, or 0 where it is not known: a rate against it is noise.

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    """
    times = as_samples(time, "time")
    strains = as_samples(true_strain, "true_strain", len(times))
    rates = np.empty(0) if strain_rate is None else as_samples(strain_rate, "strain_rate", len(times))
    signs = np.empty(0, dtype=np.int32)
    if direction is not None:
        signs = np.sign(as_samples(direction, "direction")).astype(np.int32)
        if len(signs) != len(times) - 1:
            raise InputError(f"direction has {len(signs)} entries; expected one per step, {len(times) - 1}")
    return _core.History(times, strains, rates, jump_indices(jumps, times, strains), signs)


def jump_indices(jumps: ArrayLike | Jumps | None, time: FloatArray, samples: FloatArray) -> list[int]:
    """Indices of the instants at which the rate of the samples jumps; `jumps` as in `make_history`."""
    if jumps is None:
        return []
    if isinstance(jumps, str):
        if jumps != "auto":
            raise InputError(f"jumps is {jumps!r}; expected 'auto', None or times in s")
        return _core.History.find_rate_jumps(time, samples)
    instants = as_samples(jumps, "jumps")
    if instants.size and (instants.min() < time[0] or instants.max() > time[-1]):
        raise InputError(f"jumps holds a time outside the record, {time[0]} to {time[-1]} s")
    return sorted({int(np.abs(time - instant).argmin()) for instant in instants})
