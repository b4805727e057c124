"""The schemes that are compared, and one timed solve of each."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import ConvergenceError, InputError
from probation.law.history import StrainHistory
from probation.law.modified import UNCHANGED
from probation.law.ramp import ramp_stress
from probation.law.schemes import BE2, CVODE, SA2, SA3, Exact, make_solver

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from probation import _core
    from probation._arrays import FloatArray
    from probation.law.modal import Law
    from probation.law.schemes import Scheme


@dataclass(frozen=True)
class SchemeCandidate:
    """One way of solving eq. (6).

    Attributes
    ----------
    scheme : Scheme or None
        None for the closed form (7), which only a ramp has.
    """

    name: str
    scheme: Scheme | None


CANDIDATES = (
    SchemeCandidate("be2", BE2()),
    SchemeCandidate("be2, paper's start", BE2(start="backward_euler")),
    SchemeCandidate("sa2", SA2()),
    SchemeCandidate("sa3", SA3()),
    SchemeCandidate("exact", Exact()),
    SchemeCandidate("cvode", CVODE()),
    SchemeCandidate("eq. (7)", None),
)


@dataclass(frozen=True, eq=False)
class StrainPath:
    """The strain that every candidate gets.

    Attributes
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    strain_rate : ndarray, shape (n_times,) [1/s], or None
        Without it the samples mean the piecewise-linear history between them.
    ramp_rate : float or None [1/s]
        Where it is a ramp from zero: eq. (7) holds.
    smooth : bool
        No rate discontinuity is to be looked for.
    """

    time: FloatArray
    true_strain: FloatArray
    strain_rate: FloatArray | None = None
    ramp_rate: float | None = None
    smooth: bool = False


@dataclass(frozen=True, eq=False)
class Solve:
    """What one candidate answered.

    Attributes
    ----------
    true_stress : ndarray, shape (n_times,) [MPa], or None
        None where it failed.
    time_us : float
        Of one solve, the fastest of several [µs].
    statistics : mapping of str to int
        CVODE's.
    failure : str
        Why there is no stress.
    """

    true_stress: FloatArray | None
    time_us: float = np.nan
    statistics: Mapping[str, int] = field(default_factory=dict)
    failure: str = ""


_STATISTICS = (
    "steps",
    "rate_evaluations",
    "error_test_failures",
    "nonlinear_iterations",
    "nonlinear_failures",
    "restarts",
    "last_order",
)
_TOLERANCE = 1e-10  # of CVODE, relative, and absolute in MPa
_LONGEST_TIMING = 0.01  # s, for repeating a solve; one is always done


def solve(candidate: SchemeCandidate, law: Law, path: StrainPath) -> Solve | None:
    """Solve once and time it; None where the candidate does not apply."""
    try:
        if candidate.scheme is None:
            return _closed_form(law, path)
        scheme = candidate.scheme
        if isinstance(scheme, CVODE):
            scheme = replace(scheme, relative_tolerance=_TOLERANCE, absolute_tolerance=_TOLERANCE)
        solver = make_solver(
            StrainHistory(
                path.time, path.true_strain, strain_rate=path.strain_rate, jumps=None if path.smooth else "auto"
            ).engine,
            scheme,
        )
        stress = np.empty(len(path.time))
        time_us = _fastest(lambda: solver.stress(law.engine, UNCHANGED, stress))
    except (ConvergenceError, InputError) as error:
        return Solve(None, failure=str(error))
    return Solve(stress, time_us, _statistics(solver) if isinstance(scheme, CVODE) else {})


def _closed_form(law: Law, path: StrainPath) -> Solve | None:
    if path.ramp_rate is None or law.companion is not None:
        return None
    rate = path.ramp_rate
    return Solve(ramp_stress(law, rate, path.time), _fastest(lambda: ramp_stress(law, rate, path.time)))


def _fastest(call: Callable[[], object]) -> float:
    best, spent = np.inf, 0.0
    while spent < _LONGEST_TIMING:
        begun = time.perf_counter()
        call()
        taken = time.perf_counter() - begun
        best, spent = min(best, taken), spent + max(taken, 1e-4)
    return 1e6 * best


def _statistics(solver: _core.Solver) -> dict[str, int]:
    return {name: int(getattr(solver.cvode_statistics, name)) for name in _STATISTICS}
