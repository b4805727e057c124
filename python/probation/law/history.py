"""A strain history as a law takes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias, TypeGuard, cast

import numpy as np

from probation import _core
from probation._arrays import FloatArray, as_samples, held_samples
from probation.errors import InputError
from probation.law.refinement import fine_time, refine

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

Jumps = Literal["auto"]


class StrainHistory:
    """A strain history, checked and made ready for the engine once: for many laws, or with more than two arrays.

    Parameters
    ----------
    time : array_like, shape (n_times,) [s]
        Increasing.
    true_strain : array_like, shape (n_times,) [-]
    strain_rate : array_like, shape (n_times,) [1/s], optional
        Without it the samples mean the piecewise-linear history between them, with it the cubic through strains and
        rates.
    jumps : "auto", None or array_like of times [s]
        Instants at which the strain rate jumps: the schemes start afresh there. "auto" finds those that stand out by
        thirty times from the changes around them.
    direction : array_like, shape (n_times - 1,), optional
        Commanded direction of each step, +1, -1, or 0 where it is not known: a rate against it is noise.

    Attributes
    ----------
    engine : History
        The same as the engine holds it.

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.

    Examples
    --------
    >>> history = StrainHistory([0.0, 1.0, 2.0], [0.0, 0.01, 0.02], jumps=None)
    >>> len(history)
    3
    """

    __slots__ = ("_direction", "engine")

    def __init__(
        self,
        time: ArrayLike,
        true_strain: ArrayLike,
        *,
        strain_rate: ArrayLike | None = None,
        jumps: ArrayLike | Jumps | None = "auto",
        direction: ArrayLike | None = None,
    ) -> None:
        arguments = history_arguments(time, true_strain, strain_rate, jumps, direction)
        self.engine = _core.History(*arguments)
        self._direction = arguments[4]

    def __len__(self) -> int:
        return len(self.engine)

    def __reduce__(self) -> tuple[Callable[..., StrainHistory], tuple[object, ...]]:
        made = self.time, self.true_strain, self.strain_rate, self.time[list(self.jumps)], self.direction
        return _made, tuple(None if array is None else array.copy() for array in made)

    @property
    def time(self) -> FloatArray:
        """Shape (n_times,) [s], read-only."""
        return self.engine.time

    @property
    def true_strain(self) -> FloatArray:
        """Shape (n_times,) [-], read-only."""
        return self.engine.true_strain

    @property
    def strain_rate(self) -> FloatArray | None:
        """Shape (n_times,) [1/s], read-only; None where it was not given."""
        rate = self.engine.strain_rate
        return rate if rate.size else None

    @property
    def jumps(self) -> tuple[int, ...]:
        """Indices of the instants at which the strain rate jumps, given or found."""
        return tuple(self.engine.jumps)

    @property
    def direction(self) -> NDArray[np.int32] | None:
        """Commanded direction of each step, shape (n_times - 1,); None where it was not given."""
        return self._direction if self._direction.size else None

    def refined(self, substeps: int) -> StrainHistory:
        """The same history at `substeps` times as many instants; every `substeps`-th is one of the samples."""
        begin = end = None
        if self.strain_rate is not None:
            begin, end = self.engine.rates(_core.Differentiator.backward)
        strain, rate = refine(self.time, substeps, self.true_strain, self.strain_rate, begin, end)
        return StrainHistory(
            fine_time(self.time, substeps),
            strain,
            strain_rate=rate,
            jumps=self.time[list(self.jumps)],
            direction=None if self.direction is None else np.repeat(self.direction, substeps),
        )


def _made(
    time: FloatArray,
    true_strain: FloatArray,
    strain_rate: FloatArray | None,
    jumps: FloatArray,
    direction: NDArray[np.int32] | None,
) -> StrainHistory:
    return StrainHistory(time, true_strain, strain_rate=strain_rate, jumps=jumps, direction=direction)


class HasStrainHistory(Protocol):
    """What stands for a strain history: one by name, one from a file, a smoothed record."""

    def strain_history(self) -> StrainHistory:
        """The same as a law takes it."""


AnyHistory: TypeAlias = StrainHistory | HasStrainHistory


def is_history(time: object) -> TypeGuard[AnyHistory]:
    """Whether an argument that may be time is a history (the check of a protocol takes ten times as long)."""
    return isinstance(time, StrainHistory) or hasattr(time, "strain_history")


def as_history(time: ArrayLike | AnyHistory, true_strain: ArrayLike | None = None) -> StrainHistory:
    """The history that a call was given: an object, or time [s] and true strain, both of shape (n_times,).

    Raises
    ------
    InputError
        If it is both or neither, or as `StrainHistory`.
    """
    if is_history(time):
        if true_strain is not None:
            raise InputError(
                f"true_strain is {true_strain!r} together with a {type(time).__name__}, which has its own; give a "
                "scheme by its name, scheme=..."
            )
        return time if isinstance(time, StrainHistory) else time.strain_history()
    if true_strain is None:
        raise InputError("true_strain is missing; expected time and true_strain, or a StrainHistory")
    return StrainHistory(cast("ArrayLike", time), true_strain)


HistoryArguments: TypeAlias = tuple[FloatArray, FloatArray, FloatArray, list[int], "NDArray[np.int32]", bool]


def history_arguments(
    time: ArrayLike,
    true_strain: ArrayLike,
    strain_rate: ArrayLike | None = None,
    jumps: ArrayLike | Jumps | None = "auto",
    direction: ArrayLike | None = None,
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
    """Indices of the instants at which the rate of the samples jumps; `jumps` as in `StrainHistory`."""
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
