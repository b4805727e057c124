"""The only place where shapes and dtypes are checked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

FloatArray: TypeAlias = NDArray[np.float64]
Rows: TypeAlias = NDArray[np.float32] | NDArray[np.float64]


_FLOAT64 = np.dtype(np.float64)


def as_samples(values: ArrayLike, name: str, length: int | None = None) -> FloatArray:
    """`values` as a contiguous, finite, one-dimensional array of float64.

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    """
    samples = held_samples(values, name, length)
    if not np.isfinite(samples).all():
        first = int(np.flatnonzero(~np.isfinite(samples))[0])
        raise InputError(f"{name}[{first}] is {samples[first]}; a finite number is needed")
    return samples


def held_samples(values: ArrayLike, name: str, length: int | None = None) -> FloatArray:
    """The same for an engine that itself refuses what is not finite; what it can take as it is stays untouched.

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    """
    if type(values) is np.ndarray and values.dtype is _FLOAT64 and values.ndim == 1 and values.flags.c_contiguous:
        return values if length is None or len(values) == length else _refuse_length(values, name, length)
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "biufO":  # text, dates and complex numbers would turn into floats without a word
            raise InputError(f"{name} holds {given.dtype}; real numbers are needed")
        if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
            raise InputError(f"{name} has masked samples; leave them out")
        samples = np.ascontiguousarray(given, dtype=np.float64)
    except InputError:
        raise
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{name} is not an array of numbers: {error}") from None
    if samples.ndim != 1 or given.ndim == 0:
        raise InputError(f"{name} has the shape {given.shape}; expected (n_times,)")
    if length is not None and len(samples) != length:
        _refuse_length(samples, name, length)
    return samples


def _refuse_length(samples: FloatArray, name: str, length: int) -> NoReturn:
    raise InputError(f"{name} has {len(samples)} samples; expected {length}, as in time")


def as_rows(values: ArrayLike, name: str) -> Rows:
    """One or many contiguous rows of float32 or float64, not copied if they are; masked samples are NaN.

    What the rows hold is not looked at.

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    """
    try:
        if isinstance(values, np.ma.MaskedArray):
            values = np.ma.filled(values.astype(np.float64), np.nan)
        given = np.asarray(values)
        if given.dtype.kind not in "biufO":
            raise InputError(f"{name} holds {given.dtype}; real numbers are needed")
        kept = given.dtype if given.dtype in (np.float32, np.float64) else np.float64
        rows: Rows = np.ascontiguousarray(given, dtype=kept)
    except InputError:
        raise
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{name} is not an array of numbers: {error}") from None
    if given.ndim not in (1, 2) or rows.shape[-1] == 0:
        raise InputError(f"{name} has the shape {given.shape}; expected (n_times,) or (records, n_times)")
    return rows


def as_number(value: object, name: str) -> float:
    """`value` as a float.

    Raises
    ------
    InputError
        If it is not a real number.
    """
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        raise InputError(f"{name} is {value!r}; a number is needed")
    try:
        return float(value)
    except OverflowError:
        raise InputError(f"{name} is too large for a number of double precision") from None


def as_whole_number(value: object, name: str) -> int:
    """`value` as an int that the engine can take.

    Raises
    ------
    InputError
        If it is not a whole number, or beyond 2^31.
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or abs(int(value)) >= 2**31:
        raise InputError(f"{name} is {value!r}; a whole number (below 2^31) is needed")
    return int(value)


def as_threads(value: object) -> int:
    """A number of threads; 0, which the engine takes for all cores, where none is given.

    Raises
    ------
    InputError
        If it is neither None nor a whole number of at least 1.
    """
    if value is None:
        return 0
    count = as_whole_number(value, "threads")
    if count < 1:
        raise InputError(f"threads is {count}; expected at least 1, or None for the usual number")
    return count


def one_of(value: str, name: str, choices: Sequence[str]) -> str:
    """`value` if it is among the `choices`.

    Raises
    ------
    InputError
        Listing the choices.
    """
    if value not in choices:
        raise InputError(f"{name} is {value!r}; expected one of {', '.join(choices)}")
    return value


Array = TypeVar("Array", bound=NDArray[Any])


def kept_apart(values: Array, *outputs: NDArray[Any] | None) -> Array:
    """`values`, or a copy where an output may share its memory: all is read before anything is written, as in NumPy."""
    overlap = any(out is not None and np.may_share_memory(values, out) for out in outputs)
    return values.copy() if overlap else values


def as_output(out: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """`out` if the engine can write to it as it is, a new array if it is None.

    Raises
    ------
    InputError
        If it has another shape or dtype, is not contiguous, or not writeable.
    """
    if out is None:
        return np.empty(shape)
    check_output(out, "out", shape)
    return out


def check_output(out: object, name: str, shape: tuple[int, ...], dtype: np.dtype[Any] = _FLOAT64) -> None:
    """Refuse what the engine cannot write to as it is.

    Raises
    ------
    InputError
        As `as_output` does.
    """
    fits = isinstance(out, np.ndarray) and (out.shape, out.dtype) == (shape, dtype) and out.flags.carray
    if not fits:
        raise InputError(f"{name} must be a writeable, contiguous {dtype} array of shape {shape}")


def running_integral(values: FloatArray, along: FloatArray) -> FloatArray:
    """Of samples (n,) along another quantity (n,), by trapezia: from the first sample up to each; shape (n,)."""
    return np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(along)))
