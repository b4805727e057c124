"""Identification in bulk: one record per pixel of a field, each identified by itself in the engine."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from probation import _core
from probation._arrays import FloatArray, Rows, as_number, as_rows, as_threads, check_output, kept_apart, one_of
from probation.errors import InputError
from probation.inference.parameter import by_inside_name, outside_name
from probation.law.history import Jumps, looks_for_jumps
from probation.law.modal import Law, engine_law
from probation.law.schemes import Scheme, SchemeName, identifying

Method = Literal["variable-projection", "levenberg-marquardt"]
METHODS: tuple[Method, ...] = ("variable-projection", "levenberg-marquardt")

SUBSTEPS_LIMIT = 10_000
"""Most steps of the scheme from sample to sample."""

STATUS_WORDS: dict[int, str] = {status.value: status.name.replace("_", " ") for status in _core.IdentifyStatus}
"""What the entries of `BulkIdentification.status` mean, by number."""

SOLVED = (0, 1)
"""The statuses of records whose parameters are a minimum: converged, and at a bound."""


@dataclass(frozen=True, eq=False)
class BulkIdentification:
    """What `identify_many` found.

    Attributes
    ----------
    parameters : ndarray, shape (records, 3)
        E_u [MPa], tau_max [s] or alpha [-], G [MPa], held ones too; NaN where the record is bad.
    standard_error : ndarray, shape (records, 3)
        As the parameters, for white noise, s^2 (J^T J)^-1: 0 where held, inf where the record does not tell.
    rms_residual : ndarray, shape (records,) [MPa]
    status : ndarray of int8, shape (records,)
        A key of `STATUS_WORDS`.
    iterations : ndarray of int32, shape (records,)
        Solves of the whole record with their slopes.
    """

    parameters: FloatArray
    standard_error: FloatArray
    rms_residual: FloatArray
    status: NDArray[np.int8]
    iterations: NDArray[np.int32]

    @classmethod
    def empty(cls, records: int) -> BulkIdentification:
        """Arrays to be filled."""
        return cls(
            np.empty((records, 3)),
            np.empty((records, 3)),
            np.empty(records),
            np.empty(records, dtype=np.int8),
            np.empty(records, dtype=np.int32),
        )

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Whether each record was identified with no bound in the way, shape (records,)."""
        return np.asarray(self.status == 0)

    def counts(self) -> dict[str, int]:
        """How many records have each status, by its words."""
        numbers, times = np.unique(self.status, return_counts=True)
        return {STATUS_WORDS[int(number)]: int(count) for number, count in zip(numbers, times, strict=True)}


def identify_many(
    law: Law,
    time: ArrayLike,
    true_strain: ArrayLike,
    true_stress: ArrayLike,
    scheme: Scheme | SchemeName = "sa3",
    *,
    method: Method = "variable-projection",
    noise: ArrayLike | None = None,
    hold: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    jumps: Jumps | None = "auto",
    substeps: int = 1,
    threads: int | None = None,
    out: BulkIdentification | None = None,
) -> BulkIdentification:
    """Identify the law on many records, each by itself.

    The estimates are those of `fit` with white noise and as many steps of the scheme from sample to sample. A record
    that is bad gets a status and NaN; the others go on.

    Parameters
    ----------
    law : Law
        Gives the spectrum and the companion relation; its parameters are not looked at.
    time : array_like, shape (n_times,) or (records, n_times) [s]
        With `substeps`, at each of them: n_times is (n_samples - 1) * substeps + 1.
    true_strain : array_like, shape (n_times,) or (records, n_times) [-]
    true_stress : array_like, shape (n_samples,) or (records, n_samples) [MPa]
        These three in float32 or float64, rows contiguous, are read where they are; other types are copied. One row is
        shared by all records.
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
    method : {"variable-projection", "levenberg-marquardt"}
        Both find the same minimum, after the same coarse search over all of tau_max (or alpha).
    noise : array_like, optional
        Standard deviation of the stress [MPa], as NumPy spreads it to (records, n_samples). Only its ratios within a
        record matter: what a record's residuals scatter says how large it is.
    hold : dict of str to float, optional
        Parameters that are not identified, by name with unit ("unrelaxed_modulus_MPa").
    bounds : dict of str to (float, float), optional
        By name with unit; every parameter is positive in any case.
    jumps : "auto" or None
        Whether each record is searched for rate discontinuities, as `Law.stress` does; at samples only.
    substeps : int
        Steps of the scheme from sample to sample, unless ``SA3(substeps=4)`` says how many. More than one make the
        error of the scheme smaller, by the square of their number with be2 and sa2, where the strain between the
        samples is known.
    threads : int, optional
        All cores if left out.
    out : BulkIdentification, optional
        Where to write, each attribute in memory of its own; records that share it are copied first.

    Returns
    -------
    BulkIdentification

    Raises
    ------
    InputError
        For arguments that do not fit together; never for what a record holds.
    """
    engine, held = _law_with(law, {} if hold is None else hold)
    arrays = {
        "time": as_rows(time, "time"),
        "true_strain": as_rows(true_strain, "true_strain"),
        "true_stress": as_rows(true_stress, "true_stress"),
    }
    if not isinstance(substeps, int | np.integer) or isinstance(substeps, bool) or not 1 <= substeps <= SUBSTEPS_LIMIT:
        raise InputError(f"substeps is {substeps!r}; expected a whole number from 1 to {SUBSTEPS_LIMIT}")
    chosen, steps = identifying(scheme, "auto" if substeps == 1 else substeps)
    substeps = 1 if steps == "auto" else steps
    n_times = arrays["time"].shape[-1]
    n_samples = (n_times - 1) // substeps + 1
    lengths = {"time": n_times, "true_strain": n_times, "true_stress": n_samples}
    shapes = {len(array) for array in arrays.values() if array.ndim == 2}
    records = max(shapes) if len(shapes) == 1 else 1
    whole = (n_samples - 1) * substeps + 1 == n_times
    if len(shapes) > 1 or not whole or any(array.shape[-1] != lengths[name] for name, array in arrays.items()):
        found = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        expected = "(n_times,) or (records, n_times) each, the same for all"
        if substeps > 1:
            expected += f", n_times of time and true_strain (n_samples - 1) * {substeps} + 1, of true_stress n_samples"
        raise InputError(f"found {found}; expected {expected}")
    weights = None
    if noise is not None:
        weights = _as_noise(noise, records, n_samples)
    answer = BulkIdentification.empty(records) if out is None else _as_output(out, records)
    if out is not None:
        arrays = {name: kept_apart(array, *_outputs(out)) for name, array in arrays.items()}
        weights = None if weights is None else kept_apart(weights, *_outputs(out))
    _core.identify_many(
        engine,
        arrays["time"],
        arrays["true_strain"],
        arrays["true_stress"],
        weights,
        _options(law, chosen, method, held, {} if bounds is None else bounds, jumps, int(substeps)),
        as_threads(threads),
        answer.parameters,
        answer.standard_error,
        answer.rms_residual,
        answer.status,
        answer.iterations,
    )
    return answer


def _law_with(law: Law, hold: Mapping[str, float]) -> tuple[_core.Law, Collection[str]]:
    """The engine's law with the values that are held, and their names."""
    engine = engine_law(law)
    if not isinstance(hold, Mapping):
        raise InputError(f"hold is {hold!r}; expected values by name, such as {{'tau_max_s': 5.2}}")
    held = {
        name: as_number(value, f"hold of {outside_name(name)}")
        for name, value in by_inside_name(hold, law.parameter_names, "hold").items()
    }
    if held:
        engine = engine_law(law.with_parameters([held.get(name, getattr(law, name)) for name in law.parameter_names]))
    return engine, held.keys()


def _options(
    law: Law,
    scheme: Scheme,
    method: Method,
    held: Collection[str],
    bounds: Mapping[str, tuple[float, float]],
    jumps: Jumps | None,
    substeps: int,
) -> _core.IdentifyOptions:
    names = law.parameter_names
    if not isinstance(bounds, Mapping):
        raise InputError(
            f"bounds is {bounds!r}; expected lower and upper by name, such as {{'tau_max_s': (1.0, 10.0)}}"
        )
    lower, upper = np.zeros(3), np.full(3, np.inf)
    for name, ends in by_inside_name(bounds, names, "bounds").items():
        index = names.index(name)
        if isinstance(ends, str) or not isinstance(ends, Sequence | np.ndarray) or len(ends) != 2:
            raise InputError(f"bounds of {outside_name(name)} are {ends!r}; expected a lower and an upper one")
        lower[index], upper[index] = (as_number(end, f"bounds of {outside_name(name)}") for end in ends)
    return _core.IdentifyOptions(
        *scheme.arguments[:2],
        getattr(_core.IdentifyMethod, one_of(method, "method", METHODS).replace("-", "_")),
        [name in held for name in names],
        lower,
        upper,
        looks_for_jumps(jumps),
        substeps,
    )


def _as_noise(noise: ArrayLike, records: int, n_samples: int) -> Rows:
    try:
        shape = np.shape(noise)
    except ValueError as error:
        raise InputError(f"noise is not an array of numbers: {error}") from None
    if shape in ((n_samples,), (records, n_samples)):
        return as_rows(noise, "noise")
    try:
        return np.ascontiguousarray(np.broadcast_to(np.asarray(noise, dtype=np.float64), (records, n_samples)))
    except (TypeError, ValueError):
        raise InputError(
            f"noise has the shape {shape}; expected one that spreads to (records, n_samples), {(records, n_samples)}"
        ) from None


def _as_output(out: BulkIdentification, records: int) -> BulkIdentification:
    if not isinstance(out, BulkIdentification):
        raise InputError(f"out is {out!r}; expected a BulkIdentification, such as BulkIdentification.empty({records})")
    wanted = BulkIdentification.empty(0)
    for name, like in zip(_OUTPUTS, _outputs(wanted), strict=True):
        check_output(getattr(out, name), f"out.{name}", (records, *like.shape[1:]), like.dtype)
    for one, other in combinations(_OUTPUTS, 2):
        if np.may_share_memory(getattr(out, one), getattr(out, other)):
            raise InputError(f"out.{one} and out.{other} share memory; each needs an array of its own")
    return out


_OUTPUTS = ("parameters", "standard_error", "rms_residual", "status", "iterations")


def _outputs(out: BulkIdentification) -> tuple[NDArray[Any], ...]:
    return tuple(getattr(out, name) for name in _OUTPUTS)
