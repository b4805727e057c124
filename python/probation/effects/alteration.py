"""What an effect changes in a law, said so that any law with these capabilities can follow."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from probation.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation import _core

_FACTORS = ("relaxation_time_factor", "unrelaxed_modulus_factor", "hardening_factor", "load_bearing_area")
ONCE = frozenset({"rate_shift", "initial_stress"})
"""What only one effect at a time can change."""


class RateShift(NamedTuple):
    """tau_max by a factor of the strain rate alone; see `probation._core.RateShift`."""

    exponent: float
    curvature: float
    reference_rate: float


class InitialStress(NamedTuple):
    """A stress at the start [MPa] carried by the modes: by their weights, times e^(-cut tau_max / tau_j)."""

    stress: float
    cut: float = 0.0


@dataclass(frozen=True, eq=False)
class Alteration:
    """What an effect changes in the law along one record; whatever is left out stays as it is.

    Sampled quantities are one number or have the shape (n,). A law says which of these it understands.

    Parameters
    ----------
    relaxation_time_factor, unrelaxed_modulus_factor, hardening_factor : array_like [-]
        Of tau_max, E_u and G e_HT.
    load_bearing_area : array_like [-]
        Fraction of the section that carries the stress.
    rate_shift : RateShift
        tau_max follows the strain rate.
    weight_exponent : float [-]
        Weights of the modes times tau_j to this power.
    initial_stress : InitialStress
        The record starts under stress.
    extra_modulus, extra_relaxation_time : tuple of float [MPa], [s]
        Maxwell elements beside the spectrum.
    feedbacks : tuple of Feedback
        Dependences on the current stress or plastic work, `probation.law.change`.
    """

    relaxation_time_factor: ArrayLike | None = None
    unrelaxed_modulus_factor: ArrayLike | None = None
    hardening_factor: ArrayLike | None = None
    load_bearing_area: ArrayLike | None = None
    rate_shift: RateShift | None = None
    weight_exponent: float | None = None
    initial_stress: InitialStress | None = None
    extra_modulus: tuple[float, ...] | None = None
    extra_relaxation_time: tuple[float, ...] | None = None
    feedbacks: tuple[_core.Feedback, ...] | None = None

    @property
    def notions(self) -> frozenset[str]:
        """Names of what it changes."""
        return frozenset(each.name for each in fields(self) if getattr(self, each.name) is not None)

    def and_(self, other: Alteration) -> Alteration:
        """Both at once: factors multiply, exponents add, modes and feedbacks stand side by side.

        Raises
        ------
        InputError
            If both shift tau_max with the rate, or both start under stress.
        """
        both: dict[str, object] = {}
        for name in (each.name for each in fields(self)):
            mine, theirs = getattr(self, name), getattr(other, name)
            if mine is None or theirs is None:
                both[name] = theirs if mine is None else mine
            elif name in ONCE:
                raise InputError(f"both effects give {name}; a law can follow one only")
            elif name in _FACTORS:
                both[name] = np.multiply(mine, theirs)
            else:  # exponents as numbers, modes and feedbacks as tuples
                both[name] = mine + theirs
        return Alteration(**both)  # type: ignore[arg-type]


NOTIONS: frozenset[str] = frozenset(each.name for each in fields(Alteration))
"""All that an alteration can say."""
