"""The engine's law as the diagnosis sees it."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from probation import _core
from probation._complaint import suggestion
from probation.errors import InputError
from probation.inference.parameter import outside_name
from probation.law.modal import Law
from probation.law.modification import CAPABILITIES
from probation.law.modified import UNCHANGED, ModifiedLaw, engine_law_of, modified, parameter_directions
from probation.law.schemes import make_solver
from probation.parallel import BEFORE_EACH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.law.modification import Modification

_BOUNDS = {
    "unrelaxed_modulus": (1e-6, 1e7),
    "tau_max": (1e-6, 1e9),
    "alpha": (1e-4, 1e4),
    "hardening_modulus": (0.0, 1e5),
}
"""In MPa, s, - and MPa: beyond any polymer and any test."""

_THREAD = threading.local()


class DnlrLaw:
    """Adapts `probation.Law` to `GapLaw`.

    Parameters
    ----------
    law : Law
        The base law; its parameters are where a search begins.
    held : sequence of str
        Which of `law.parameter_names` are not identified.
    times : (float, float), optional
        Range of tau_max [s] or alpha [-] that is searched, as `time_range` gives it for the records.

    Raises
    ------
    InputError
        For an unknown name in `held`.
    """

    def __init__(self, law: Law, held: Sequence[str] = (), times: tuple[float, float] | None = None) -> None:
        for name in held:
            if name not in law.parameter_names:
                raise InputError(f"held: found {name!r}; {suggestion(name, law.parameter_names)}")
        self.law = law
        self._bounds = dict(_BOUNDS) if times is None else {**_BOUNDS, "tau_max": times, "alpha": times}
        self._values = law.parameters
        self._free = np.array([name not in held for name in law.parameter_names])
        self._names = tuple(name for name in law.parameter_names if name not in held)
        self._outside_names = tuple(outside_name(name) for name in self._names)
        self._companion = None if law.companion is None else law.companion._engine()
        assert law.spectrum is not None
        self._spectrum = law.spectrum._engine()

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names with units of the parameters that are not held."""
        return self._outside_names

    @property
    def start(self) -> FloatArray:
        """The base law's own values, shape (n_parameters,)."""
        return np.asarray(self._values[self._free])

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, each of shape (n_parameters,)."""
        ends = np.array([self._bounds[name] for name in self._names]).reshape(-1, 2)
        return ends[:, 0].copy(), ends[:, 1].copy()

    @property
    def capabilities(self) -> frozenset[str]:
        """All that a modification can change."""
        return CAPABILITIES

    @property
    def free(self) -> NDArray[np.intp]:
        """Which of `law.parameters` are identified, by number."""
        return np.flatnonzero(self._free)

    @property
    def held(self) -> tuple[str, ...]:
        """Which are not, by name."""
        return tuple(name for name in self.law.parameter_names if name not in self._names)

    @property
    def names(self) -> tuple[str, ...]:
        """Names, as in `law.parameter_names`, of the parameters that are not held."""
        return self._names

    def holding(self, name: str, law: Law) -> DnlrLaw:
        """The same with one more parameter held, at its value in `law`; the others start at theirs."""
        return DnlrLaw(law, (*self.held, name))

    def law_at(self, parameters: FloatArray) -> Law:
        """The base law with these values of its identified parameters."""
        return self.law.with_parameters(self._all(parameters))

    def stress(self, view: RecordView, parameters: FloatArray, modification: Modification | None = None) -> FloatArray:
        """True stress along a record, shape (n,) [MPa]; as in `GapLaw`."""
        law, change = self._modified(view, parameters, modification)
        stress = np.empty(len(view))
        try:
            solver_of(view).stress(law, change, stress)
        except InputError as error:
            raise _named(error, view) from None
        return stress

    def sensitivity(
        self, view: RecordView, parameters: FloatArray, modification: Modification | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """True stress (n,) [MPa] and its derivatives (n, n_parameters); as in `GapLaw`."""
        made = self._modified(view, parameters, modification)
        directions = parameter_directions(made, modification, view.history)
        if not self._free.all():
            directions = [direction for direction, free in zip(directions, self._free, strict=True) if free]
        stress, tangent = np.empty(len(view)), np.empty((len(view), len(directions)))
        try:
            solver_of(view).tangent(made.law, made.change, directions, stress, tangent)
        except InputError as error:
            raise _named(error, view) from None
        return stress, tangent

    def _all(self, parameters: FloatArray) -> FloatArray:
        values = self._values.copy()
        values[self._free] = parameters
        return values

    def _modified(self, view: RecordView, parameters: FloatArray, modification: Modification | None) -> ModifiedLaw:
        values = self._all(parameters).tolist()
        if modification is None:
            return ModifiedLaw(engine_law_of(values, self._companion, self._spectrum), UNCHANGED)
        initial = view.haward_thackray_strain[0]
        return modified(values, self._companion, self._spectrum, modification, initial)


def solver_of(view: RecordView) -> _core.Solver:
    """The engine's solver for a record, made once in every thread that asks: it keeps its arrays between calls."""
    kept: WeakKeyDictionary[RecordView, _core.Solver] | None = getattr(_THREAD, "solvers", None)
    if kept is None:
        kept = _THREAD.solvers = WeakKeyDictionary()
    solver = kept.get(view)
    if solver is None:
        solver = kept[view] = make_solver(view.history, view.scheme)
    return solver


def _forget_solvers() -> None:
    """What a solver has learned of one solve moves the last digit of the next one."""
    _THREAD.solvers = WeakKeyDictionary()


BEFORE_EACH.append(_forget_solvers)


def _named(error: InputError, view: RecordView) -> InputError:
    """What the engine refuses, with the record: a companion relation that has no time at its rates."""
    return InputError(f"record {view.id!r}: {error}")
