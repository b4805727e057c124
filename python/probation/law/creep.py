"""Stress-driven tests: the stress is imposed, the strain is found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation import _core
from probation._arrays import FloatArray, as_samples, one_of
from probation.law.history import Jumps, jump_indices
from probation.law.modified import refuse
from probation.law.schemes import STARTS

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation.law.modal import Law
    from probation.law.modification import Modification
    from probation.law.schemes import Start

_NOT_FOLLOWED = frozenset(
    {"feedbacks", "extra_modulus", "extra_relaxation_time", "initial_modal_stress", "initial_stress"}
)


def creep(
    law: Law,
    time: ArrayLike,
    true_stress: ArrayLike,
    *,
    modification: Modification | None = None,
    start: Start = "exponential",
    jumps: ArrayLike | Jumps | None = "auto",
) -> FloatArray:
    """True strain under an imposed true stress, by bE2.

    Put back into `Law.stress` (scheme "be2", the same jumps) it returns the stress.

    Parameters
    ----------
    law : Law
        With a companion relation whose flow stress falls with the rate, several strains can carry one stress: the one
        nearest to the continuation of the strain so far is taken.
    time : array_like, shape (n_times,) [s]
        Increasing.
    true_stress : array_like, shape (n_times,) [MPa]
        Its first value is applied at once to the relaxed specimen: the strain starts at true_stress[0] / E_u.
    modification : Modification, optional
        Without feedbacks, extra modes and a start under stress.
    start : {"exponential", "backward_euler"}
        First step, and the step after a jump.
    jumps : "auto", None or array_like of times [s]
        Where the stress rate jumps.

    Returns
    -------
    ndarray, shape (n_times,) [-]

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    ConvergenceError
        Where no strain carries the stress, with the `time`.
    """
    times = as_samples(time, "time")
    stress = as_samples(true_stress, "true_stress", len(times))
    rule = getattr(_core.Start, one_of(start, "start", STARTS))
    at = jump_indices(jumps, times, stress)
    refuse(modification, _NOT_FOLLOWED, "creep")
    return _core.creep_strain(*law._modified(modification), times, stress, at, rule)
