"""What an effect, or a user, changes in a law along one record."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from probation import _core
from probation._arrays import as_samples
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from probation._arrays import FloatArray

StressActivation = _core.StressActivation
"""Feedback: flow activated by stress; ``StressActivation(activation_stress)`` [MPa]."""

PowerActivation = _core.PowerActivation
"""Feedback: flow activated by a power of the stress; ``PowerActivation(activation_stress, exponent)`` [MPa], [-]."""

SelfHeating = _core.SelfHeating
"""Feedback: plastic work warms; ``SelfHeating(heating, cooling_rate, softening, hardening_loss)``."""

FACTORS = ("relaxation_time_factor", "unrelaxed_modulus_factor", "hardening_factor", "load_bearing_area")
SAMPLED = (*FACTORS, "added_relaxed_stress")
MODES = ("initial_modal_stress", "extra_modulus", "extra_relaxation_time")
ONCE = frozenset({"rate_shift", "initial_stress", "initial_modal_stress", "other_spectrum"})
"""What only one effect at a time can change."""


class RateShift(NamedTuple):
    """tau_max follows the strain rate, on top of the law's own companion relation.

    Attributes
    ----------
    exponent : float [-]
        a in tau_max ~ rate^(-a) near the reference rate: faster straining shortens the times.
    curvature : float [-]
        Of that dependence: with 0 it is a power of the rate; else the Weissenberg number of a law that was without
        companion relation changes by this fraction per decade of rate, eq. (11).
    reference_rate : float [1/s]
        Where tau_max stays as it is.
    """

    exponent: float
    curvature: float
    reference_rate: float


class InitialStress(NamedTuple):
    """A stress under which a record starts.

    Attributes
    ----------
    stress : float [MPa]
        Shared by the modes in proportion to their weights times e^(-cut tau_max / tau_j) (1 - e^(-x)) / x, x = pulled
        tau_max / tau_j.
    cut : float [-]
        Modes faster than `cut` tau_max have relaxed: the specimen was held for so long.
    pulled : float [-]
        Before, it was stretched at one rate for so long, over tau_max; 0 for a sudden stretch.
    """

    stress: float
    cut: float = 0.0
    pulled: float = 0.0


class OtherSpectrum(NamedTuple):
    """A part of E_u relaxes by another distribution of times, which follow tau_max as the law's own do.

    Attributes
    ----------
    part : float [-]
        Of E_u, from 0 to 1.
    distribution : callable
        ``distribution(ratio)``: which part of it, from 0 to 1, has times up to these, over tau_max; shape (n,).
    """

    part: float
    distribution: Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)  # arrays have no single answer to ==
class Modification:
    """What changes in a law along one record; whatever is left out stays as it is.

    A law says in its `capabilities` which of these it can follow; `probation.Law` follows all. Sampled quantities are
    one number or have the shape (n_times,).

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
        Of a law with modes, fastest first; a relaxed start if neither this nor `initial_stress` is given.
    extra_modulus, extra_relaxation_time : array_like, shape (extra modes,) [MPa], [s]
        Maxwell elements in parallel to the spectrum, which no rate shifts.
    feedbacks : tuple of StressActivation, PowerActivation or SelfHeating
        Dependences of tau_max or G on the current stress or plastic work, solved within each step.
    rate_shift : RateShift
        tau_max follows the strain rate.
    weight_exponent : float [-]
        The weights of the modes are multiplied by tau_j to this power; their sum stays.
    initial_stress : InitialStress
        The record starts under this stress, on top of the relaxed one.
    other_spectrum : OtherSpectrum
        A part of the weights is distributed otherwise; their sum stays.

    Raises
    ------
    InputError
        If the start is given twice.
    """

    relaxation_time_factor: ArrayLike | None = None
    unrelaxed_modulus_factor: ArrayLike | None = None
    hardening_factor: ArrayLike | None = None
    added_relaxed_stress: ArrayLike | None = None
    load_bearing_area: ArrayLike | None = None
    initial_modal_stress: ArrayLike | None = None
    extra_modulus: ArrayLike | None = None
    extra_relaxation_time: ArrayLike | None = None
    feedbacks: tuple[_core.Feedback, ...] = ()
    rate_shift: RateShift | None = None
    weight_exponent: float | None = None
    initial_stress: InitialStress | None = None
    other_spectrum: OtherSpectrum | None = None

    def __post_init__(self) -> None:
        if self.initial_stress is not None and self.initial_modal_stress is not None:
            raise InputError("found initial_stress and initial_modal_stress; a record starts once, give one of them")

    @property
    def changed(self) -> frozenset[str]:
        """Names of what it changes."""
        given = frozenset(name for name in CAPABILITIES if getattr(self, name) is not None)
        return given if self.feedbacks else given - {"feedbacks"}

    def and_(self, other: Modification) -> Modification:
        """Both at once: factors multiply, stresses and exponents add, modes and feedbacks stand side by side.

        Raises
        ------
        InputError
            If both shift tau_max with the rate or start from stresses of their own, or their samples do not match.
        """
        both: dict[str, Any] = {}
        for name in (field.name for field in fields(self)):
            mine, theirs = getattr(self, name), getattr(other, name)
            if mine is None or theirs is None:
                both[name] = theirs if mine is None else mine
            elif name in ONCE:
                raise InputError(f"both modifications give {name}; a law can follow one only")
            elif name in SAMPLED:
                both[name] = _combined(np.multiply if name in FACTORS else np.add, mine, theirs, name)
            elif name in MODES:
                both[name] = np.concatenate([np.atleast_1d(mine), np.atleast_1d(theirs)])
            else:  # exponents are numbers, feedbacks tuples
                both[name] = mine + theirs
        return Modification(**both)

    def at(self, instants: FloatArray, time: FloatArray) -> Modification:
        """The same at other `instants` than the `time` of the samples, straight between them; both in s."""
        moved: dict[str, Any] = {}
        for name in SAMPLED:
            values = getattr(self, name)
            if values is not None and np.size(values) > 1:
                moved[name] = np.interp(instants, time, as_samples(values, name, len(time)))
        return replace(self, **moved)


CAPABILITIES: frozenset[str] = frozenset(field.name for field in fields(Modification))
"""All that a modification can change."""


def _combined(rule: np.ufunc, mine: ArrayLike, theirs: ArrayLike, name: str) -> FloatArray:
    one, other = as_samples(np.atleast_1d(mine), name), as_samples(np.atleast_1d(theirs), name)
    if len(one) != len(other) and 1 not in (len(one), len(other)):
        raise InputError(f"{name} has {len(one)} samples in one modification and {len(other)} in the other")
    return np.asarray(rule(one, other), dtype=np.float64)
