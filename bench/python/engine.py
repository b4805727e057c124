"""How fast is the engine: the compiled call on a history it holds, and `law.stress` from arrays?"""

from collections.abc import Callable

import numpy as np

import probation
from bench.cases import COMPANION, Case
from bench.spectrum import Array
from probation import BE2, CVODE, SA2, SA3, Exact, _core
from probation.law.modified import engine_change
from probation.law.schemes import make_solver


def law_of(case: Case) -> probation.Law:
    if case.alpha is None:
        return probation.Law(
            unrelaxed_modulus=case.unrelaxed_modulus,
            tau_max=float(case.tau_max[0]),
            hardening_modulus=case.hardening_modulus,
        )
    return probation.Law(
        unrelaxed_modulus=case.unrelaxed_modulus,
        alpha=case.alpha,
        hardening_modulus=case.hardening_modulus,
        companion=probation.Weissenberg(*COMPANION),
    )


SCHEMES = {each.name: each for each in (BE2, SA2, SA3, Exact, CVODE)}


def solver_of(case: Case, scheme: str, **options: object) -> _core.Solver:
    """The solver of a scheme with its `options`."""
    rate = None if case.alpha is None else case.strain_rate
    return make_solver(
        probation.StrainHistory(case.time, case.true_strain, strain_rate=rate).engine, SCHEMES[scheme](**options)
    )


def prepare(
    case: Case, scheme: str, change: probation.Modification | None = None, **options: object
) -> Callable[[], Array]:
    """The compiled call: history held by the solver, result in `out`."""
    solver, law, change = solver_of(case, scheme, **options), law_of(case).engine, engine_change(change)
    out = np.empty(len(case.time))

    def call() -> Array:
        solver.stress(law, change, out)
        return out

    return call


def prepare_from_arrays(case: Case, scheme: str) -> Callable[[], Array]:
    """`law.stress`: checks, history and solver made anew in every call."""
    law = law_of(case)
    if case.alpha is not None:
        return lambda: law.stress(
            probation.StrainHistory(case.time, case.true_strain, strain_rate=case.strain_rate), scheme=scheme
        )
    return lambda: law.stress(case.time, case.true_strain, scheme)
