"""Many solves at once: over parameter sets, records and pixels, on several threads, with outputs as small as needed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation._arrays import FloatArray, as_output, as_rows, as_samples, as_threads, kept_apart
from probation.errors import InputError
from probation.law.history import AnyHistory, Jumps, as_history, looks_for_jumps
from probation.law.modal import Law, engine_law
from probation.law.modified import engine_change, refuse
from probation.law.schemes import Scheme, SchemeName, at_samples, make_solver

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

    from probation.law.modification import Modification


@dataclass(frozen=True)
class Observed:
    """A measured record, ready to be held against many laws.

    Parameters
    ----------
    history : StrainHistory
    true_stress : array_like, shape (n_times,) [MPa]
    modification : Modification, optional
        What an effect changes in the law along this record; as in `stresses`.
    """

    history: AnyHistory
    true_stress: ArrayLike
    modification: Modification | None = None

    def _engine(self) -> _core.BatchRecord:
        history = as_history(self.history)
        stress = as_samples(self.true_stress, "true_stress", len(history))
        return _core.BatchRecord(history.engine, stress, _engine_change(self.modification))


def stresses(
    law: Law,
    parameters: ArrayLike,
    history: AnyHistory,
    scheme: Scheme | SchemeName = "be2",
    *,
    modification: Modification | None = None,
    threads: int | None = None,
    out: FloatArray | None = None,
) -> FloatArray:
    """True stress of many parameter sets along one history.

    Parameters
    ----------
    law : Law
        Gives the spectrum and the companion relation.
    parameters : array_like, shape (sets, 3)
        E_u [MPa], tau_max [s] or alpha [-], G [MPa] of each set.
    history : StrainHistory
    modification : Modification, optional
        What an effect changes in the law, but for `rate_shift`, `weight_exponent`, `other_spectrum` and
        `initial_stress`: these change the law itself with its parameters.
    threads : int, optional
        All cores if left out.
    out : ndarray, shape (sets, n_times), optional
        Where to write the stresses; what else it shares memory with is copied first, as everywhere in this module.

    Returns
    -------
    ndarray, shape (sets, n_times) [MPa]

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    ConvergenceError
        Where a stress is not finite, with the set and the `time`.
    """
    sets = _as_parameters(parameters)
    driven = as_history(history)
    found = as_output(out, (len(sets), len(driven)))
    sets = kept_apart(sets, out)
    _core.batch_stress(
        engine_law(law),
        sets,
        driven.engine,
        _engine_change(modification),
        at_samples(scheme).engine,
        as_threads(threads),
        found,
    )
    return found


def field_stresses(
    law: Law,
    time: ArrayLike,
    true_strain: ArrayLike,
    parameters: ArrayLike | None = None,
    scheme: Scheme | SchemeName = "be2",
    *,
    jumps: Jumps | None = "auto",
    threads: int | None = None,
    out: FloatArray | None = None,
) -> FloatArray:
    """True stress along many strain histories on one time grid: the pixels of a field.

    Parameters
    ----------
    law : Law
    time : array_like, shape (n_times,) [s]
    true_strain : array_like, shape (pixels, n_times) [-]
        float32 or float64 with contiguous rows is read where it is.
    parameters : array_like, shape (pixels, 3), optional
        E_u [MPa], tau_max [s] or alpha [-], G [MPa] of each pixel; the law's own if left out.
    scheme, threads
        As in `stresses`.
    jumps : "auto" or None
        Whether each pixel is searched for rate discontinuities.
    out : ndarray, shape (pixels, n_times), optional

    Returns
    -------
    ndarray, shape (pixels, n_times) [MPa]

    Raises
    ------
    InputError
        Naming the pixel, what was found and what was expected.
    ConvergenceError
        Where a stress is not finite, with the pixel and the `time`.
    """
    times = as_samples(time, "time")
    strains = as_rows(true_strain, "true_strain")
    if strains.ndim != 2 or strains.shape[1] != len(times):
        raise InputError(f"true_strain has the shape {strains.shape}; expected (pixels, {len(times)}), as in time")
    engine = engine_law(law)
    sets = law.parameters[None, :] if parameters is None else _as_parameters(parameters)
    found = as_output(out, strains.shape)
    times, strains, sets = kept_apart(times, out), kept_apart(strains, out), kept_apart(sets, out)
    options = at_samples(scheme).engine
    _core.field_stress(engine, sets, times, strains, looks_for_jumps(jumps), options, as_threads(threads), found)
    return found


def sums_of_squares(
    law: Law,
    parameters: ArrayLike,
    records: Sequence[Observed],
    scheme: Scheme | SchemeName = "be2",
    *,
    threads: int | None = None,
    out: FloatArray | None = None,
) -> FloatArray:
    """Sum of squared fit residuals of many parameter sets on many records; no stress is kept.

    Parameters
    ----------
    law, parameters, scheme, threads
        As in `stresses`.
    records : sequence of Observed
    out : ndarray, shape (sets, records), optional

    Returns
    -------
    ndarray, shape (sets, records) [MPa^2]

    Raises
    ------
    InputError
        Naming the argument, or the set and the record whose squares are beyond all numbers.
    ConvergenceError
        Where a stress is not finite, with the set, the record and the `time`.
    """
    sets = _as_parameters(parameters)
    found = as_output(out, (len(sets), len(records)))
    sets = kept_apart(sets, out)
    engine_records = [record._engine() for record in records]
    _core.batch_sum_of_squares(
        engine_law(law), sets, engine_records, at_samples(scheme).engine, as_threads(threads), found
    )
    return found


def many_normal_equations(
    law: Law,
    parameters: ArrayLike,
    records: Sequence[Observed],
    scheme: Scheme | SchemeName = "be2",
    *,
    threads: int | None = None,
    out: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """`normal_equations` of many parameter sets on many records; neither stresses nor sensitivities are kept.

    Parameters
    ----------
    law, parameters, records, scheme, threads
        As in `sums_of_squares`.
    out : ndarray, shape (sets, records, 13), optional
        What the answer is a view of: J^T J by rows, J^T r, r^T r.

    Returns
    -------
    matrix : ndarray, shape (sets, records, 3, 3)
    gradient : ndarray, shape (sets, records, 3)
    sum_of_squares : ndarray, shape (sets, records) [MPa^2]

    Raises
    ------
    InputError
        Naming the argument, or the set and the record whose squares are beyond all numbers.
    ConvergenceError
        Where a stress is not finite, with the set, the record and the `time`.
    """
    sets = _as_parameters(parameters)
    found = as_output(out, (len(sets), len(records), 13))
    sets = kept_apart(sets, out)
    engine_records = [record._engine() for record in records]
    rows = found.reshape(-1, 13)
    _core.batch_normal_equations(
        engine_law(law), sets, engine_records, at_samples(scheme).engine, as_threads(threads), rows
    )
    return found[..., :9].reshape(*found.shape[:2], 3, 3), found[..., 9:12], found[..., 12]


def normal_equations(
    law: Law, record: Observed, scheme: Scheme | SchemeName = "be2"
) -> tuple[FloatArray, FloatArray, float]:
    """J^T J, J^T r and r^T r of the fit residual (model - data) along the law's parameters.

    Returns
    -------
    matrix : ndarray, shape (3, 3)
    gradient : ndarray, shape (3,)
    sum_of_squares : float [MPa^2]
    """
    history = as_history(record.history)
    solver = make_solver(history.engine, scheme)
    stress = as_samples(record.true_stress, "true_stress", len(history))
    return _core.normal_equations(solver, engine_law(law), _engine_change(record.modification), stress)


_PART_OF_THE_LAW = frozenset({"rate_shift", "weight_exponent", "initial_stress", "other_spectrum"})
"""Changes that are resolved with the law's parameters, one set at a time."""


def _engine_change(modification: Modification | None) -> _core.LawChange:
    refuse(modification, _PART_OF_THE_LAW, "a batch")
    return engine_change(modification)


def _as_parameters(parameters: ArrayLike) -> FloatArray:
    sets = as_rows(parameters, "parameters").astype(np.float64, copy=False)
    if sets.ndim != 2 or sets.shape[1] != 3:
        raise InputError(f"parameters has the shape {sets.shape}; expected (sets, 3)")
    if not np.isfinite(sets).all():
        row = int(np.flatnonzero(~np.isfinite(sets).all(axis=1))[0])
        raise InputError(f"parameters[{row}] has an entry that is not finite")
    return sets
