"""A strain history as the engine takes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from probation import _core
from probation._arrays import FloatArray, as_samples, held_samples
from probation.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

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
    return _core.History(*history_arguments(time, true_strain, strain_rate, jumps, direction))


HistoryArguments: TypeAlias = tuple[FloatArray, FloatArray, FloatArray, list[int], "NDArray[np.int32]", bool]


def history_arguments(
    time: ArrayLike,
    true_strain: ArrayLike,
    strain_rate: ArrayLike | None,
    jumps: ArrayLike | Jumps | None,
    direction: ArrayLike | None,
) -> HistoryArguments:
    """What the engine makes a history from, in its order; it refuses samples that are not finite itself."""
    times = held_samples(time, "time")
    strains = held_samples(true_strain, "true_strain", len(times))
    rates = _NO_RATES if strain_rate is None else held_samples(strain_rate, "strain_rate", len(times))
    signs = _NO_SIGNS if direction is None else _signs(direction, len(times) - 1)
    if isinstance(jumps, str) and jumps == "auto":
        return times, strains, rates, [], signs, True
    return times, strains, rates, jump_indices(jumps, times, strains), signs, False


_NO_RATES: FloatArray = np.empty(0)
_NO_SIGNS: NDArray[np.int32] = np.empty(0, dtype=np.int32)


def _signs(direction: ArrayLike, steps: int) -> NDArray[np.int32]:
    signs = np.sign(as_samples(direction, "direction")).astype(np.int32)
    if len(signs) != steps:
        raise InputError(f"direction has {len(signs)} entries; expected one per step, {steps}")
    return signs


def looks_for_jumps(jumps: Jumps | None) -> bool:
    """Whether each of many histories is searched for jumps, which have no instants in common.

    Raises
    ------
    InputError
        If `jumps` is neither "auto" nor None, times among the rest.
    """
    if jumps is None or (isinstance(jumps, str) and jumps == "auto"):
        return jumps is not None
    raise InputError(f"jumps is {jumps!r}; expected 'auto' or None: each of many histories has its own")


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
