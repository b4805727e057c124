"""The engine's law as the diagnosis sees it."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from probation import _core
from probation._complaint import suggestion
from probation.effects.alteration import NOTIONS, Alteration
from probation.errors import InputError
from probation.inference.parameter import outside_name
from probation.law.modal import Law
from probation.law.schemes import make_solver

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_BOUNDS = {
    "unrelaxed_modulus": (1e-6, 1e7),
    "tau_max": (1e-6, 1e9),
    "alpha": (1e-4, 1e4),
    "hardening_modulus": (0.0, 1e5),
}
_SAMPLED = ("relaxation_time_factor", "unrelaxed_modulus_factor", "hardening_factor", "load_bearing_area")


class DnlrLaw:
    """Adapts `probation.Law` to `GapLaw`.

    Parameters
    ----------
    law : Law
        The base law; its parameters are where a search begins.
    held : sequence of str
        Which of `law.parameter_names` are not identified.

    Raises
    ------
    InputError
        For an unknown name in `held`.
    """

    def __init__(self, law: Law, held: Sequence[str] = ()) -> None:
        for name in held:
            if name not in law.parameter_names:
                raise InputError(f"held: found {name!r}; {suggestion(name, law.parameter_names)}")
        self.law = law
        self._values = law.parameters
        self._free = np.array([name not in held for name in law.parameter_names])
        self._names = tuple(name for name in law.parameter_names if name not in held)
        self._companion = None if law.companion is None else law.companion._engine()
        assert law.spectrum is not None
        self._spectrum = law.spectrum._engine()
        self._own = threading.local()  # a solver keeps its arrays between calls and serves one thread at a time

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names with units of the parameters that are not held."""
        return tuple(outside_name(name) for name in self._names)

    @property
    def start(self) -> FloatArray:
        """The base law's own values, shape (n_parameters,)."""
        return np.asarray(self._values[self._free])

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, each of shape (n_parameters,)."""
        ends = np.array([_BOUNDS[name] for name in self._names]).reshape(-1, 2)
        return ends[:, 0].copy(), ends[:, 1].copy()

    @property
    def understands(self) -> frozenset[str]:
        """All that an alteration can say."""
        return NOTIONS

    def law_at(self, parameters: FloatArray) -> Law:
        """The base law with these values of its identified parameters."""
        return self.law.with_parameters(self._all(parameters))

    def stress(self, view: RecordView, parameters: FloatArray, alteration: Alteration | None = None) -> FloatArray:
        """True stress along a record, shape (n,) [MPa]; as in `GapLaw`."""
        values = self._all(parameters)
        law = self._engine_law(values, alteration)
        stress = np.empty(len(view))
        self._solver(view).stress(law, self._change(law, view, alteration), stress)
        return stress

    def sensitivity(
        self, view: RecordView, parameters: FloatArray, alteration: Alteration | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """True stress (n,) [MPa] and its derivatives (n, n_parameters); as in `GapLaw`."""
        values = self._all(parameters)
        law = self._engine_law(values, alteration)
        change = self._change(law, view, alteration)
        directions = _core.parameter_directions(law, change, view.history)
        if alteration is not None and alteration.initial_stress is not None:
            # The relaxed part of the start follows G.
            relaxed = view.haward_thackray_strain[0] * np.append(change.hardening_factor, 1.0)[0]
            directions[2].initial_modal_stress = law.spectrum.modal_weight * relaxed
        stress, tangent = np.empty(len(view)), np.empty((len(view), 3))
        if not self._free.all():
            directions = [each for each, free in zip(directions, self._free, strict=True) if free]
            tangent = np.empty((len(view), len(directions)))
        self._solver(view).tangent(law, change, directions, stress, tangent)
        return stress, tangent

    def _all(self, parameters: FloatArray) -> FloatArray:
        values = self._values.copy()
        values[self._free] = parameters
        return values

    def _solver(self, view: RecordView) -> _core.Solver:
        kept: WeakKeyDictionary[RecordView, _core.Solver] | None = getattr(self._own, "solvers", None)
        if kept is None:
            kept = self._own.solvers = WeakKeyDictionary()
        solver = kept.get(view)
        if solver is None:
            solver = kept[view] = make_solver(view.history, view.scheme)
        return solver

    def _engine_law(self, values: FloatArray, alteration: Alteration | None) -> _core.Law:
        modulus, time, hardening = values.tolist()
        companion, spectrum = self._companion, self._spectrum
        if alteration is not None and alteration.rate_shift is not None:
            shift = alteration.rate_shift
            companion = _core.RateShift(companion, shift.reference_rate, shift.exponent, shift.curvature)
        if alteration is not None and alteration.weight_exponent is not None:
            ratio = spectrum.relaxation_ratio
            weight = spectrum.modal_weight * ratio**alteration.weight_exponent
            spectrum = _core.Spectrum(ratio, weight * (spectrum.modal_weight.sum() / weight.sum()))
        # With a companion relation, its own or an effect's, tau_max = alpha companion(rate).
        return _core.Law(
            modulus, hardening, 0.0 if companion else time, time if companion else 1.0, companion, spectrum
        )

    @staticmethod
    def _change(law: _core.Law, view: RecordView, alteration: Alteration | None) -> _core.LawChange:
        change = _core.LawChange()
        if alteration is None:
            return change
        for name in _SAMPLED:
            if (samples := getattr(alteration, name)) is not None:
                setattr(change, name, np.atleast_1d(np.asarray(samples, dtype=np.float64)))
        if alteration.extra_modulus is not None and alteration.extra_relaxation_time is not None:
            change.extra_modulus = np.array(alteration.extra_modulus)
            change.extra_relaxation_time = np.array(alteration.extra_relaxation_time)
        if alteration.feedbacks is not None:
            change.feedbacks = list(alteration.feedbacks)
        if (start := alteration.initial_stress) is not None:
            weight = law.spectrum.modal_weight
            carried = weight * np.exp(-start.cut / law.spectrum.relaxation_ratio)
            relaxed = law.hardening_modulus * view.haward_thackray_strain[0]
            relaxed *= np.append(change.hardening_factor, 1.0)[0]
            change.initial_modal_stress = relaxed * weight + start.stress * carried / carried.sum()
        return change
