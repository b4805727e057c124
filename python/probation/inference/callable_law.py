"""Another law, a Python function, put on probation by the same machinery; and a Maxwell bar as the example."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

import numpy as np

from probation._arrays import as_samples, running_integral
from probation.effects.maxwell_element import maxwell_element
from probation.errors import InputError
from probation.law.modification import CAPABILITIES, Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_STEP = 1e-5


class StressFunction(Protocol):
    """``function(time, true_strain, parameters, modification)`` gives the true stress, shape (n,) [MPa]."""

    def __call__(
        self, time: FloatArray, true_strain: FloatArray, parameters: FloatArray, modification: Modification
    ) -> FloatArray:
        """True stress along a strain history."""


@dataclass(frozen=True)
class CallableLaw:
    """A law given by a Python function; sensitivities are central differences.

    Parameters
    ----------
    function : callable
        ``function(time, true_strain, parameters, modification)``: true stress, shape (n,) [MPa]. With `threads=N` it
        is called in copies of the process.
    names : tuple of str
        Of its parameters, with units.
    starts, lower, upper : tuple of float
        One each per parameter.
    capabilities : frozenset of str
        Which fields of `Modification` the function follows; with none, only faults of the rig can be diagnosed.

    Raises
    ------
    InputError
        If numbers are missing, a start lies outside its bounds, or a capability is unknown.

    Examples
    --------
    >>> def elastic(time, true_strain, parameters, modification):
    ...     return parameters[0] * true_strain
    >>> bar = CallableLaw(elastic, names=("modulus_MPa",), starts=(1000.0,), lower=(0.0,), upper=(1e5,))
    """

    function: StressFunction
    names: tuple[str, ...]
    starts: tuple[float, ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    capabilities: frozenset[str] = field(default_factory=frozenset)

    def __post_init__(self) -> None:
        for given in ("starts", "lower", "upper"):
            if len(getattr(self, given)) != len(self.names):
                raise InputError(f"{given} has {len(getattr(self, given))} entries; expected {', '.join(self.names)}")
        for name, start, low, high in zip(self.names, self.starts, self.lower, self.upper, strict=True):
            if not low <= start <= high:
                raise InputError(f"{name}: found the start {start}, expected one between {low} and {high}")
        if unknown := self.capabilities - CAPABILITIES:
            raise InputError(
                f"capabilities: found {sorted(unknown)}, expected some of {', '.join(sorted(CAPABILITIES))}"
            )

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.names

    @property
    def start(self) -> FloatArray:
        """Where a search may begin, shape (n_parameters,)."""
        return np.array(self.starts)

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, each of shape (n_parameters,)."""
        return np.array(self.lower), np.array(self.upper)

    def stress(self, view: RecordView, parameters: FloatArray, modification: Modification | None = None) -> FloatArray:
        """True stress along a record, shape (n,) [MPa].

        Raises
        ------
        InputError
            If the function gives something else.
        """
        stress = self.function(view.time, view.true_strain, parameters, modification or Modification())
        return as_samples(stress, "function(time, true_strain, …)", len(view))

    def sensitivity(
        self, view: RecordView, parameters: FloatArray, modification: Modification | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """True stress (n,) [MPa] and its derivatives (n, n_parameters)."""
        columns = np.empty((len(view), len(parameters)))
        for index, (value, start) in enumerate(zip(parameters, self.starts, strict=True)):
            step = _STEP * (abs(value) or abs(start) or 1.0)
            up, down = parameters.copy(), parameters.copy()
            up[index], down[index] = value + step, value - step
            difference = self.stress(view, up, modification) - self.stress(view, down, modification)
            columns[:, index] = difference / (2.0 * step)
        return self.stress(view, parameters, modification), columns


def maxwell_bar(modulus: float = 1000.0, relaxation_time: float = 10.0) -> CallableLaw:
    """A Maxwell bar, s' = E e' - s / tau, as an example of another law.

    Parameters
    ----------
    modulus : float [MPa]
    relaxation_time : float [s]
    """
    return CallableLaw(
        function=_maxwell,
        names=("modulus_MPa", "relaxation_time_s"),
        starts=(modulus, relaxation_time),
        lower=(0.0, 1e-6),
        upper=(1e7, 1e9),
        capabilities=frozenset({"unrelaxed_modulus_factor", "load_bearing_area"}),
    )


def _maxwell(
    time: FloatArray, true_strain: FloatArray, parameters: FloatArray, modification: Modification
) -> FloatArray:
    modulus, relaxation_time = parameters
    strain = true_strain - true_strain[0]
    factor = modification.unrelaxed_modulus_factor
    if factor is not None:  # int factor de, trapezoidal
        factors = np.broadcast_to(np.asarray(factor, dtype=np.float64), strain.shape)
        strain = running_integral(factors, strain)
    area = 1.0 if modification.load_bearing_area is None else np.asarray(modification.load_bearing_area)
    return np.asarray(area * modulus * maxwell_element(time, strain, float(relaxation_time)))
