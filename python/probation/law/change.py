"""What an effect changes in the law, eq. (6), along one record."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from probation import _core
from probation._arrays import as_samples
from probation.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation._arrays import FloatArray

StressActivation = _core.StressActivation
"""Feedback: flow activated by stress; ``StressActivation(activation_stress)`` [MPa]."""

PowerActivation = _core.PowerActivation
"""Feedback: flow activated by a power of the stress; ``PowerActivation(activation_stress, exponent)`` [MPa], [-]."""

SelfHeating = _core.SelfHeating
"""Feedback: plastic work warms; ``SelfHeating(heating, cooling_rate, softening, hardening_loss)``."""


@dataclass(frozen=True, eq=False)  # arrays have no single answer to ==
class Change:
    """What an effect changes in the law along one record; whatever is left out stays as it is.

    Sampled quantities are one number or have the shape (n_times,).

    Parameters
    ----------
    relaxation_time_factor : array_like [-]
        Of tau_max.
    unrelaxed_modulus_factor : array_like [-]
        Of E_u.
    hardening_factor : array_like [-]
        Of G e_HT.
    added_relaxed_stress : array_like [MPa]
        On top of it.
    load_bearing_area : array_like [-]
        Fraction of the section that carries the stress.
    initial_modal_stress : array_like, shape (modes,) [MPa]
        Fastest mode first; a relaxed start if left out.
    extra_modulus, extra_relaxation_time : array_like, shape (extra modes,) [MPa], [s]
        Maxwell elements beside the spectrum, which no rate shifts.
    feedbacks : tuple of Feedback
        Dependences of tau_max or G on the current stress or plastic work, solved within each step.

    Notes
    -----
    Other spectrum weights belong to the law itself: ``Law(spectrum=...)``.
    """

    relaxation_time_factor: ArrayLike | None = None
    unrelaxed_modulus_factor: ArrayLike | None = None
    hardening_factor: ArrayLike | None = None
    added_relaxed_stress: ArrayLike | None = None
    load_bearing_area: ArrayLike | None = None
    initial_modal_stress: ArrayLike | None = None
    extra_modulus: ArrayLike | None = None
    extra_relaxation_time: ArrayLike | None = None
    feedbacks: tuple[_core.Feedback, ...] = field(default=())

    _FACTORS = ("relaxation_time_factor", "unrelaxed_modulus_factor", "hardening_factor", "load_bearing_area")
    _SUMS = ("added_relaxed_stress", "initial_modal_stress")
    _LISTS = ("extra_modulus", "extra_relaxation_time")

    _SAMPLED = (*_FACTORS, "added_relaxed_stress")

    def and_(self, other: Change) -> Change:
        """Both changes at once: factors multiply, stresses add, modes and feedbacks stand side by side.

        Raises
        ------
        InputError
            If both start from stresses of their own, or their samples do not match.
        """
        if self.initial_modal_stress is not None and other.initial_modal_stress is not None:
            raise InputError("both changes give initial_modal_stress; a record starts once")
        both: dict[str, ArrayLike | None] = {}
        for name in (*self._FACTORS, *self._SUMS, *self._LISTS):
            mine, theirs = getattr(self, name), getattr(other, name)
            if mine is None or theirs is None:
                both[name] = theirs if mine is None else mine
            elif name in self._LISTS:
                both[name] = np.concatenate([np.atleast_1d(mine), np.atleast_1d(theirs)])
            else:
                both[name] = _combined(np.multiply if name in self._FACTORS else np.add, mine, theirs, name)
        return Change(feedbacks=self.feedbacks + other.feedbacks, **both)

    def at(self, instants: FloatArray, time: FloatArray) -> Change:
        """The same at other `instants` than the `time` of the samples, straight between them; both in s."""
        moved: dict[str, Any] = {}
        for name in self._SAMPLED:
            values = getattr(self, name)
            if values is not None and np.size(values) > 1:
                moved[name] = np.interp(instants, time, as_samples(values, name, len(time)))
        return replace(self, **moved)

    def _engine(self) -> _core.LawChange:
        change = _core.LawChange()
        for name in (*self._FACTORS, *self._SUMS, *self._LISTS):
            values = getattr(self, name)
            if values is not None:
                setattr(change, name, as_samples(np.atleast_1d(values), name))
        for feedback in self.feedbacks:
            if not isinstance(feedback, _core.Feedback):
                raise InputError(
                    f"feedbacks holds {feedback!r}; a StressActivation, PowerActivation or SelfHeating is needed"
                )
        change.feedbacks = list(self.feedbacks)
        return change


@dataclass(frozen=True, eq=False)  # arrays have no single answer to ==
class Direction:
    """A direction in which the inputs of the law move: what a sensitivity is taken along.

    Whatever is left out does not move. Sampled quantities are one number or have the shape (n_times,).

    Parameters
    ----------
    unrelaxed_modulus : array_like [MPa]
    log_relaxation_time : array_like [-]
        Of ln tau_max.
    relaxed_stress : array_like [MPa]
    log_load_bearing_area : array_like [-]
    true_strain : array_like, shape (n_times,) [-]
        Rates (unless the history has its own), tau_max and the relaxed stress move with it.
    strain_rate : array_like, shape (n_times,) [1/s]
        Where the history has its own rates.
    modal_weight, log_relaxation_ratio, initial_modal_stress : array_like, shape (modes,)
    extra_modulus, log_extra_time : array_like, shape (extra modes,)
    feedback : int
        Which feedback's parameter moves by one unit; -1 for none.
    feedback_parameter : int
    """

    unrelaxed_modulus: ArrayLike | None = None
    log_relaxation_time: ArrayLike | None = None
    relaxed_stress: ArrayLike | None = None
    log_load_bearing_area: ArrayLike | None = None
    true_strain: ArrayLike | None = None
    strain_rate: ArrayLike | None = None
    modal_weight: ArrayLike | None = None
    log_relaxation_ratio: ArrayLike | None = None
    initial_modal_stress: ArrayLike | None = None
    extra_modulus: ArrayLike | None = None
    log_extra_time: ArrayLike | None = None
    feedback: int = -1
    feedback_parameter: int = 0

    def _engine(self) -> _core.Direction:
        direction = _core.Direction()
        for name, values in vars(self).items():
            if name.startswith("feedback"):
                setattr(direction, name, values)
            elif values is not None:
                setattr(direction, name, _samples(values, name))
        return direction


def _combined(rule: np.ufunc, mine: ArrayLike, theirs: ArrayLike, name: str) -> FloatArray:
    one, other = as_samples(np.atleast_1d(mine), name), as_samples(np.atleast_1d(theirs), name)
    if len(one) != len(other) and 1 not in (len(one), len(other)):
        raise InputError(f"{name} has {len(one)} samples in one change and {len(other)} in the other")
    return np.asarray(rule(one, other), dtype=np.float64)


def engine_change(change: Change | None) -> _core.LawChange:
    """`change` as the engine takes it; no change is one object for all.

    Raises
    ------
    InputError
        If it is something else.
    """
    if change is None:
        return _NONE
    if not isinstance(change, Change):
        raise InputError(f"change is {change!r}; a Change is needed")
    return change._engine()


_NONE = Change()._engine()


def _samples(values: ArrayLike, name: str) -> FloatArray:
    return as_samples(np.atleast_1d(values), f"direction.{name}")
