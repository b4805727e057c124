"""Types of the compiled module; a test keeps them true."""

import enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_Signs = NDArray[np.int32]
_Rows = NDArray[np.float32] | NDArray[np.float64]

__version__: str

class InputError(ValueError): ...

class ConvergenceError(RuntimeError):
    time: float
    residual_norm: float

def haward_thackray_strain(true_strain: _Array) -> _Array: ...
def stress_behind_frame(
    time: _Array, modulus: _Array, relaxation_time: _Array, give: _Array, change: _Array
) -> _Array: ...
def behind_backlash(value: _Array, width: float, begin: float = ...) -> _Array: ...
def ramp_stress(law: Law, strain_rate: float, time: _Array) -> _Array: ...
def kernel_build() -> str: ...
def build_information() -> dict[str, str]: ...
def parameter_directions(law: Law, change: LawChange, history: History) -> list[Direction]: ...
def identify_many(
    law: Law,
    time: _Rows,
    true_strain: _Rows,
    true_stress: _Rows,
    noise: _Rows | None,
    options: IdentifyOptions,
    threads: int,
    parameters: _Array,
    standard_error: _Array,
    rms_residual: _Array,
    status: NDArray[np.int8],
    iterations: NDArray[np.int32],
) -> None: ...
def creep_strain(
    law: Law, change: LawChange, time: _Array, true_stress: _Array, jumps: list[int], start: Start
) -> _Array: ...
def batch_stress(
    law: Law,
    parameters: _Array,
    history: History,
    change: LawChange,
    options: SolverOptions,
    threads: int,
    out: _Array,
) -> None: ...
def field_stress(
    law: Law,
    parameters: _Array,
    time: _Array,
    true_strain: _Rows,
    find_jumps: bool,
    options: SolverOptions,
    threads: int,
    out: _Array,
) -> None: ...
def batch_sum_of_squares(
    law: Law,
    parameters: _Array,
    records: list[BatchRecord],
    options: SolverOptions,
    threads: int,
    out: _Array,
) -> None: ...
def batch_normal_equations(
    law: Law,
    parameters: _Array,
    records: list[BatchRecord],
    options: SolverOptions,
    threads: int,
    out: _Array,
) -> None: ...
def normal_equations(
    solver: Solver, law: Law, change: LawChange, true_stress: _Array
) -> tuple[_Array, _Array, float]: ...

class Spectrum:
    def __init__(self, relaxation_ratio: _Array, modal_weight: _Array) -> None: ...
    @staticmethod
    def log_spaced(modes: int = 50, decades: float = 6.0) -> Spectrum: ...
    @property
    def relaxation_ratio(self) -> _Array: ...
    @property
    def modal_weight(self) -> _Array: ...
    @property
    def modes(self) -> int: ...

class Whitening:
    def __init__(
        self, scale: _Array, phi: float, theta: float, variance: _Array, directions: _Array, shrink: _Array
    ) -> None: ...
    def of(self, values: _Array) -> _Array: ...

class CompanionRelation:
    def __init__(self, *args: object, **kwargs: object) -> None: ...
    def relaxation_time(self, rate: _Array) -> _Array: ...
    def log_slope(self, rate: _Array) -> _Array: ...
    @property
    def rate_floor(self) -> float: ...

class Weissenberg(CompanionRelation):
    def __init__(self, slope: float, intercept: float, rate_floor: float = 1e-7) -> None: ...
    @property
    def slope(self) -> float: ...
    @property
    def intercept(self) -> float: ...

class Exponential(CompanionRelation):
    def __init__(self, coefficient: float, exponent: float, rate_floor: float = 1e-7) -> None: ...
    @property
    def coefficient(self) -> float: ...
    @property
    def exponent(self) -> float: ...

class PowerLaw(CompanionRelation):
    def __init__(self, coefficient: float, exponent: float, rate_floor: float = 1e-7) -> None: ...
    @property
    def coefficient(self) -> float: ...
    @property
    def exponent(self) -> float: ...

class Table(CompanionRelation):
    def __init__(self, rates: list[float], tau_max: list[float], rate_floor: float = 1e-7) -> None: ...
    @property
    def rates(self) -> list[float]: ...
    @property
    def tau_max(self) -> list[float]: ...

class RateShift(CompanionRelation):
    def __init__(
        self,
        base: CompanionRelation | None,
        reference_rate: float,
        exponent: float,
        curvature: float,
        rate_floor: float = 1e-7,
    ) -> None: ...

class Feedback:
    def __init__(self, *args: object, **kwargs: object) -> None: ...
    @property
    def parameters(self) -> int: ...

class StressActivation(Feedback):
    def __init__(self, activation_stress: float) -> None: ...
    @property
    def values(self) -> list[float]: ...
    def __eq__(self, arg0: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

class PowerActivation(Feedback):
    def __init__(self, activation_stress: float, exponent: float) -> None: ...
    @property
    def values(self) -> list[float]: ...
    def __eq__(self, arg0: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

class SelfHeating(Feedback):
    def __init__(self, heating: float, cooling_rate: float, softening: float, hardening_loss: float) -> None: ...
    @property
    def values(self) -> list[float]: ...
    def __eq__(self, arg0: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

class Differentiator(enum.Enum):
    secant = 0
    backward = 1
    three_point = 2

class History:
    def __init__(
        self,
        time: _Array,
        true_strain: _Array,
        strain_rate: _Array = ...,
        jumps: list[int] = ...,
        direction: _Signs = ...,
        find_jumps: bool = False,
    ) -> None: ...
    @staticmethod
    def find_rate_jumps(time: _Array, true_strain: _Array) -> list[int]: ...
    @property
    def time(self) -> _Array: ...
    @property
    def true_strain(self) -> _Array: ...
    @property
    def strain_rate(self) -> _Array: ...
    @property
    def haward_thackray_strain(self) -> _Array: ...
    @property
    def jumps(self) -> list[int]: ...
    def rates(self, differentiator: Differentiator) -> tuple[_Array, _Array]: ...
    def __len__(self) -> int: ...

class Law:
    def __init__(
        self,
        unrelaxed_modulus: float,
        hardening_modulus: float,
        tau_max: float,
        alpha: float,
        companion: CompanionRelation | None,
        spectrum: Spectrum,
    ) -> None: ...
    @property
    def unrelaxed_modulus(self) -> float: ...
    @property
    def hardening_modulus(self) -> float: ...
    @property
    def tau_max(self) -> float: ...
    @property
    def alpha(self) -> float: ...
    @property
    def spectrum(self) -> Spectrum: ...

class LawChange:
    def __init__(self) -> None: ...
    relaxation_time_factor: _Array
    unrelaxed_modulus_factor: _Array
    hardening_factor: _Array
    added_relaxed_stress: _Array
    load_bearing_area: _Array
    initial_modal_stress: _Array
    extra_modulus: _Array
    extra_relaxation_time: _Array
    feedbacks: list[Feedback]

class Direction:
    def __init__(self) -> None: ...
    unrelaxed_modulus: _Array
    log_relaxation_time: _Array
    relaxed_stress: _Array
    log_load_bearing_area: _Array
    true_strain: _Array
    strain_rate: _Array
    modal_weight: _Array
    log_relaxation_ratio: _Array
    initial_modal_stress: _Array
    extra_modulus: _Array
    log_extra_time: _Array
    feedback: int
    feedback_parameter: int

class Scheme(enum.Enum):
    be2 = 0
    sa2 = 1
    sa3 = 2
    exact = 3
    cvode = 4

class Start(enum.Enum):
    exponential = 0
    backward_euler = 1

class CvodeStatistics:
    def __init__(self, *args: object, **kwargs: object) -> None: ...
    @property
    def steps(self) -> int: ...
    @property
    def rate_evaluations(self) -> int: ...
    @property
    def error_test_failures(self) -> int: ...
    @property
    def nonlinear_iterations(self) -> int: ...
    @property
    def nonlinear_failures(self) -> int: ...
    @property
    def restarts(self) -> int: ...
    @property
    def last_order(self) -> int: ...

class Solver:
    def __init__(
        self,
        history: History,
        scheme: Scheme = ...,
        start: Start = ...,
        relative_tolerance: float = 1e-10,
        absolute_tolerance: float = 1e-10,
        max_steps: int = 200000,
    ) -> None: ...
    @property
    def history(self) -> History: ...
    def stress(self, law: Law, change: LawChange, out: _Array) -> None: ...
    def tangent(
        self, law: Law, change: LawChange, directions: list[Direction], stress: _Array, derivatives: _Array
    ) -> None: ...
    def strain_sensitivity(self, law: Law, change: LawChange) -> _Array: ...
    @property
    def cvode_statistics(self) -> CvodeStatistics: ...

class SolverOptions:
    def __init__(
        self,
        scheme: Scheme = ...,
        start: Start = ...,
        relative_tolerance: float = 1e-10,
        absolute_tolerance: float = 1e-10,
        max_steps: int = 200000,
    ) -> None: ...

def stress(
    law: Law,
    change: LawChange,
    options: SolverOptions,
    out: _Array,
    time: _Array,
    true_strain: _Array,
    strain_rate: _Array,
    jumps: list[int],
    direction: _Signs,
    find_jumps: bool,
) -> None: ...
def stress_where_held(
    law: Law, change: LawChange, options: SolverOptions, out: _Array | None, time: object, true_strain: object
) -> _Array | None: ...

class BatchRecord:
    def __init__(self, history: History, true_stress: _Array, change: LawChange) -> None: ...

class IdentifyMethod(enum.Enum):
    variable_projection = 0
    levenberg_marquardt = 1

class IdentifyStatus(enum.Enum):
    converged = 0
    at_a_bound = 1
    did_not_converge = 2
    not_determined = 3
    not_finite = 4
    times_do_not_increase = 5
    too_few_samples = 6
    impossible_rate = 7

class IdentifyOptions:
    def __init__(
        self,
        scheme: Scheme,
        start: Start,
        method: IdentifyMethod,
        held: list[bool],
        lower: _Array,
        upper: _Array,
        find_jumps: bool,
        substeps: int,
    ) -> None: ...
