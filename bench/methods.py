"""Which methods are compared, and what does each need to be installed?"""

import importlib
import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from bench.cases import Case
from bench.spectrum import Array

Prepare = Callable[[Case], Callable[[], Array]]

INSTALL = "pip install probation[bench]"

PACKAGES = {"numba": "numba", "sksundae": "scikit-sundae"}
"""Modules that not everyone has, and the package that holds them."""


@dataclass(frozen=True)
class Method:
    """An alternative: `function` of the module bench.python.`module`, called with `arguments` after the case."""

    key: str
    label: str
    module: str
    function: str = "prepare"
    arguments: tuple[object, ...] = ()
    options: tuple[tuple[str, object], ...] = ()
    needs: str | None = None
    tolerance_name: str | None = None  # adaptive: the option that holds the relative tolerance

    def prepare(self, case: Case, **more: object) -> Callable[[], Array]:
        module = importlib.import_module(f"bench.python.{self.module}")
        prepare = partial(getattr(module, self.function), case, *self.arguments)
        return prepare(**{**dict(self.options), **more})


def engine(scheme: str, label: str, key: str | None = None, **options: object) -> Method:
    return Method(key or scheme, label, "engine", arguments=(scheme,), options=tuple(options.items()))


BE2 = engine("be2", "engine bE2")
BE2_PAPER = engine("be2", "engine bE2, the paper's first step", "be2_paper", start="backward_euler")
SA2 = engine("sa2", "engine SA2")
SA3 = engine("sa3", "engine SA3")
EXACT = engine("exact", "engine exact (piecewise linear)")
CVODE_C = Method(
    "cvode_c", "CVODE in C (engine cvode, CVDiag, stops at every sample), rtol 1e-8", "engine", arguments=("cvode",),
    options=(("relative_tolerance", 1e-8), ("absolute_tolerance", 1e-8)), tolerance_name="relative_tolerance",
)  # fmt: skip
LAW_BE2 = Method("law_be2", "engine bE2, law.stress from arrays", "engine", "prepare_from_arrays", ("be2",))
LAW_SA3 = Method("law_sa3", "engine SA3, law.stress from arrays", "engine", "prepare_from_arrays", ("sa3",))
ENGINE = (BE2, BE2_PAPER, SA2, SA3, LAW_BE2, LAW_SA3, EXACT, CVODE_C)

NUMBA_BE2 = Method("numba_be2", "numba bE2, eq. (9) as printed", "numba_be2", needs="numba")
NUMBA_HOISTED = Method("numba_be2_hoisted", "numba bE2, coefficients hoisted", "numba_be2_hoisted", needs="numba")
NUMBA_FASTMATH = Method("numba_be2_fastmath", "numba bE2, hoisted and fastmath", "numba_be2_fastmath", needs="numba")
NUMBA_SA2 = Method("numba_sa2", "numba SA2, hoisted and fastmath", "numba_sa2", needs="numba")
NUMBA_BE2_VARIABLE = Method("numba_be2_variable", "numba bE2, variable, fastmath", "numba_be2_variable", needs="numba")
NUMBA_SA2_VARIABLE = Method("numba_sa2_variable", "numba SA2, variable, fastmath", "numba_sa2_variable", needs="numba")
NUMPY_NAIVE = Method("numpy_be2_naive", "numpy bE2, eq. (9) as printed", "numpy_be2", "prepare_naive")
NUMPY = Method("numpy_be2", "numpy bE2, coefficients precomputed", "numpy_be2", "prepare_precomputed")
LFILTER = Method("lfilter_sa2", "scipy.signal.lfilter SA2", "scipy_lfilter")
BDF = Method("scipy_bdf", "scipy solve_ivp BDF, rtol 1e-6", "scipy_ivp", "prepare_bdf", tolerance_name="tolerance")
LSODA = Method(
    "scipy_lsoda", "scipy solve_ivp LSODA, rtol 1e-6", "scipy_ivp", "prepare_lsoda", tolerance_name="tolerance"
)
RADAU = Method(
    "scipy_radau", "scipy solve_ivp Radau, rtol 1e-6", "scipy_ivp", "prepare_radau", tolerance_name="tolerance"
)
SUNDAE = Method(
    "sundae_cvode", "scikit-sundae CVODE, rtol 1e-6", "sundae_cvode", needs="sksundae", tolerance_name="tolerance"
)

UNIFORM = (
    NUMBA_BE2, NUMBA_HOISTED, NUMBA_FASTMATH, NUMBA_SA2, NUMPY_NAIVE, NUMPY, LFILTER, BDF, LSODA, RADAU, SUNDAE,
)  # fmt: skip
"""What runs on the target table's problem beside the engine."""

VARIABLE = (NUMBA_BE2_VARIABLE, NUMBA_SA2_VARIABLE)
"""What runs on uneven steps or a varying tau_max beside the engine."""


def installed(method: Method) -> bool:
    return method.needs is None or importlib.util.find_spec(method.needs) is not None


def missing_packages() -> list[str]:
    return [package for module, package in PACKAGES.items() if importlib.util.find_spec(module) is None]
