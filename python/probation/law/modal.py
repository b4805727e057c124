"""The modal (DNLR) law of semi-crystalline polymers, eq. (6)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, cast

import numpy as np

from probation import _core
from probation._arrays import (
    FloatArray,
    as_number,
    as_output,
    as_samples,
    held_samples,
)
from probation.errors import InputError
from probation.law.companion import Companion
from probation.law.history import AnyHistory, StrainHistory, as_history, history_arguments, is_history
from probation.law.modified import (
    UNCHANGED,
    ModifiedLaw,
    checked,
    engine_law_of,
    modified,
    parameter_directions,
    refuse,
)
from probation.law.schemes import Scheme, SchemeName, as_scheme, at_samples, make_solver
from probation.law.spectrum import Spectrum
from probation.results.rendering import Displayed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

    from probation.law.direction import Direction
    from probation.law.modification import Modification

_FOLLOWS_PARAMETERS = frozenset({"initial_stress"})
"""A start that moves with G and the first strain, of which a direction says nothing; `initial_modal_stress` stays."""


@dataclass(frozen=True, kw_only=True)
class Law(Displayed):
    r"""The modal (DNLR) law.

    .. math::
        \dot\sigma_j = p_j E_u \dot\varepsilon - (\sigma_j - p_j G \varepsilon_{HT}) / \tau_j,
        \qquad \sigma = \sum_j \sigma_j

    Parameters
    ----------
    unrelaxed_modulus : float
        E_u [MPa].
    hardening_modulus : float
        G [MPa].
    tau_max : float, optional
        Longest relaxation time [s]; for a law without companion relation.
    alpha : float, optional
        Uniform correction of the companion relation [-], tau_max = alpha companion(rate); 1 if left out.
    modes, decades : int, float
        N and d of eq. (4). They are part of the definition of tau_max.
    companion : Companion, optional
        tau_max from the strain rate.
    spectrum : Spectrum, optional
        Other modes than those of `modes` and `decades`.

    Raises
    ------
    InputError
        For a parameter that is missing, superfluous or not possible.

    References
    ----------
    André et al., eqs. (3)-(6), (10)-(12).

    Examples
    --------
    >>> law = Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    >>> law.stress([0.0, 50.0, 100.0], [0.0, 0.25, 0.5], scheme="exact").round(2)
    array([ 0.  , 34.37, 37.37])
    """

    unrelaxed_modulus: float
    hardening_modulus: float
    tau_max: float | None = None
    alpha: float | None = None
    modes: int = 50
    decades: float = 6.0
    companion: Companion | None = None
    spectrum: Spectrum | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        for name, kind in (("companion", Companion), ("spectrum", Spectrum)):
            given = getattr(self, name)
            if given is not None and not isinstance(given, kind):
                raise InputError(f"{name} is {given!r}; expected a {kind.__name__}")
        if self.companion is None:
            if self.tau_max is None:
                raise InputError("tau_max is missing; a law without companion relation needs it")
            if self.alpha is not None:
                raise InputError("alpha is given without a companion relation; give tau_max, or a companion")
        else:
            if self.tau_max is not None:
                raise InputError("tau_max and companion are both given; with a companion give alpha")
            if self.alpha is None:
                object.__setattr__(self, "alpha", 1.0)
        if self.spectrum is None:
            object.__setattr__(self, "spectrum", Spectrum.log_spaced(self.modes, self.decades))
        else:
            object.__setattr__(self, "modes", len(self.spectrum.modal_weight))
            if not (isfinite(as_number(self.decades, "decades")) and self.decades > 0.0):
                raise InputError(f"decades is {self.decades}; a positive number is needed")
        for name in self.parameter_names:
            object.__setattr__(self, name, as_number(getattr(self, name), name))
        self.engine  # noqa: B018 - refuses what cannot be

    def __getstate__(self) -> dict[str, object]:
        return {name: value for name, value in self.__dict__.items() if name != "engine"}

    @cached_property
    def engine(self) -> _core.Law:
        """The law as the engine holds it."""
        return self._make_engine()

    def _make_engine(self) -> _core.Law:
        return engine_law_of(*self._engine_parts())

    def _engine_parts(self) -> tuple[list[float], _core.CompanionRelation | None, _core.Spectrum]:
        assert self.spectrum is not None
        values = [self.__dict__[name] for name in self.parameter_names]
        return values, None if self.companion is None else self.companion._engine(), self.spectrum._engine()

    def _modified(self, modification: Modification | None, history: _core.History | None = None) -> ModifiedLaw:
        if modification is None:
            return ModifiedLaw(self.engine, UNCHANGED)
        initial_strain = 0.0
        if history is not None and checked(modification).initial_stress is not None:
            initial_strain = float(history.haward_thackray_strain[0])
        return modified(*self._engine_parts(), modification, initial_strain)

    @property
    def parameter_names(self) -> tuple[str, str, str]:
        """Names of the parameters, in the order of every sensitivity."""
        return ("unrelaxed_modulus", "tau_max" if self.companion is None else "alpha", "hardening_modulus")

    @property
    def parameters(self) -> FloatArray:
        """E_u [MPa], tau_max [s] or alpha [-], G [MPa]; shape (3,)."""
        return np.array([getattr(self, name) for name in self.parameter_names])

    def with_parameters(self, values: ArrayLike) -> Law:
        """The same law with other values of `parameters`, shape (3,)."""
        numbers = held_samples(values, "values").tolist()
        if len(numbers) != len(self.parameter_names):
            raise InputError(f"values has {len(numbers)} entries; expected {', '.join(self.parameter_names)}")
        if not all(map(isfinite, numbers)):
            as_samples(values, "values")  # says which is not
        law = object.__new__(type(self))  # all else was checked when this law was made
        held = law.__dict__
        held.update(self.__dict__)
        held.update(zip(self.parameter_names, numbers, strict=True))
        held["engine"] = law._make_engine()
        return law

    def reduced(self, *, accuracy: float | None = None, modes: int | None = None) -> Law:
        """The same law with fewer modes; as in `reduce_spectrum`."""
        assert self.spectrum is not None
        return replace(self, spectrum=self.spectrum.reduced(accuracy=accuracy, modes=modes))

    def stress(
        self,
        time: ArrayLike | AnyHistory,
        true_strain: ArrayLike | None = None,
        scheme: Scheme | SchemeName = "be2",
        *,
        modification: Modification | None = None,
        out: FloatArray | None = None,
    ) -> FloatArray:
        """True stress along a strain history: ``stress(history)`` or ``stress(time, true_strain)``.

        Parameters
        ----------
        time : array_like, shape (n_times,) [s], or StrainHistory
            Increasing. A `StrainHistory` has strains of its own, perhaps rates, and says where the rate jumps; a
            history of `named_history` or `read_history` stands for one.
        true_strain : array_like, shape (n_times,) [-]
            The start is relaxed: sigma_j(0) = p_j G e_HT(true_strain[0]).
        scheme : {"be2", "sa2", "sa3", "exact", "cvode"}, `BE2`, `SA2`, `SA3`, `Exact` or `CVODE`
            A name is the scheme with default options. be2 and sa2 have order 2, sa3 order 3 on smooth histories; exact
            and cvode integrate the piecewise-linear history.
        modification : Modification, optional
            What an effect changes in the law along this record.
        out : ndarray, shape (n_times,), optional
            Where to write the stress.

        Returns
        -------
        ndarray, shape (n_times,) [MPa]

        Raises
        ------
        InputError
            Naming the argument, what was found and what was expected.
        ConvergenceError
            If CVODE or the iteration of a feedback fails, or the stress is not finite; it has `time` and
            `residual_norm`.
        """
        chosen = as_scheme(scheme)
        starts_relaxed = modification is None or checked(modification).initial_stress is None
        if chosen.substeps == 1 and true_strain is not None and starts_relaxed:
            law, change = (self.engine, UNCHANGED) if modification is None else self._modified(modification)
            stress_at_once = _core.stress_where_held(law, change, chosen.engine, out, time, true_strain)
            if stress_at_once is not None:  # None: the arrays have to be made ready first, or refused
                return stress_at_once
            if not is_history(time):
                arguments = history_arguments(cast("ArrayLike", time), true_strain)
                stress = as_output(out, arguments[0].shape)
                _core.stress(law, change, chosen.engine, stress, *arguments)
                return stress
        history = as_history(time, true_strain)
        stress = as_output(out, (len(history),))
        solver, modification = _prepared(history, chosen, modification)
        law, change = self._modified(modification, solver.history)
        if chosen.substeps == 1:
            solver.stress(law, change, stress)
        else:
            fine = np.empty(len(solver.history))
            solver.stress(law, change, fine)
            stress[:] = fine[:: chosen.substeps]
        return stress

    def sensitivity(
        self,
        time: ArrayLike | AnyHistory,
        true_strain: ArrayLike | None = None,
        scheme: Scheme | SchemeName = "be2",
        *,
        directions: Sequence[Direction] | None = None,
        modification: Modification | None = None,
    ) -> tuple[FloatArray, FloatArray]:
        """True stress and its derivatives; be2, sa2 and sa3 only.

        Parameters
        ----------
        time, true_strain, scheme, modification
            As in `stress`.
        directions : sequence of Direction, optional
            What to differentiate along; the law's three `parameters` if left out. With them no substeps.

        Returns
        -------
        stress : ndarray, shape (n_times,) [MPa]
        sensitivity : ndarray, shape (n_times, n_directions) [MPa per unit]

        Raises
        ------
        InputError, ConvergenceError
            As `stress` does; also where a derivative is not finite.
        """
        chosen = as_scheme(scheme) if directions is None else at_samples(scheme)
        solver, modification = _prepared(as_history(time, true_strain), chosen, modification)
        made = self._modified(modification, solver.history)
        if directions is None:
            engine_directions = parameter_directions(made, modification, solver.history)
        else:
            refuse(modification, _FOLLOWS_PARAMETERS, "a derivative along directions or strains")
            engine_directions = [direction._engine() for direction in directions]
        stress = np.empty(len(solver.history))
        sensitivity = np.empty((len(stress), len(engine_directions)))
        solver.tangent(made.law, made.change, engine_directions, stress, sensitivity)
        return stress[:: chosen.substeps], sensitivity[:: chosen.substeps]

    def strain_sensitivity(
        self,
        time: ArrayLike | AnyHistory,
        true_strain: ArrayLike | None = None,
        scheme: Scheme | SchemeName = "be2",
        *,
        modification: Modification | None = None,
    ) -> FloatArray:
        """Derivative of every stress with respect to every strain sample; be2, sa2 and sa3 only, without substeps.

        The differentiator is part of it: in a history without strain rates, rates and the companion relation follow
        the strain. Arguments as in `stress`.

        Returns
        -------
        ndarray, shape (n_times, n_times) [MPa]
            Lower triangular but for the central differences of sa2 and sa3, which look one sample ahead where tau_max
            depends on the rate.

        Raises
        ------
        InputError, ConvergenceError
            As `stress` does; also where a derivative is not finite.
        """
        refuse(modification, _FOLLOWS_PARAMETERS, "a derivative along directions or strains")
        solver = make_solver(as_history(time, true_strain).engine, scheme)
        return solver.strain_sensitivity(*self._modified(modification))


def _prepared(
    history: StrainHistory, scheme: Scheme, modification: Modification | None
) -> tuple[_core.Solver, Modification | None]:
    """A solver with the substeps of the scheme between its samples, and the modification at its instants."""
    if scheme.substeps == 1:
        return make_solver(history.engine, scheme), modification
    fine = history.refined(scheme.substeps)
    if modification is not None:
        modification = checked(modification).at(fine.time, history.time)
    return make_solver(fine.engine, replace(scheme, substeps=1)), modification


def engine_law(law: Law) -> _core.Law:
    """The engine's law behind what an argument named `law` was given; an `InputError` if that is none."""
    if not isinstance(law, Law):
        raise InputError(f"law is {law!r}; expected a Law")
    return law.engine
