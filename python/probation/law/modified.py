"""The modal law as a modification leaves it, in the engine's terms."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from probation import _core
from probation._arrays import as_samples, held_samples
from probation.errors import InputError
from probation.law.modification import MODES, SAMPLED, Modification, OtherSpectrum

if TYPE_CHECKING:
    from collections.abc import Sequence

UNCHANGED = _core.LawChange()
"""No change, one object for all."""


SLOWER = 100.0
"""How far another spectrum reaches beyond the law's slowest mode: two decades."""

_LONE_STEP = 10.0**0.125
"""Ratio of neighbouring times where the law has one mode only."""


class ModifiedLaw(NamedTuple):
    """What the engine solves: the law, and what changes along the record.

    Attributes
    ----------
    law : _core.Law
        With its rate shift and its weights.
    """

    law: _core.Law
    change: _core.LawChange


def engine_law_of(
    parameters: Sequence[float], companion: _core.CompanionRelation | None, spectrum: _core.Spectrum
) -> _core.Law:
    """The engine's law of E_u [MPa], tau_max [s] (with a companion relation: alpha [-]) and G [MPa]."""
    modulus, time, hardening = parameters
    return _core.Law(modulus, hardening, 0.0 if companion else time, time if companion else 1.0, companion, spectrum)


def modified(
    parameters: Sequence[float],
    companion: _core.CompanionRelation | None,
    spectrum: _core.Spectrum,
    modification: Modification,
    initial_haward_thackray_strain: float = 0.0,
) -> ModifiedLaw:
    """The law and its change along one record.

    Parameters
    ----------
    parameters : sequence of 3 floats
        As in `engine_law_of`.
    companion, spectrum
        Of the law without modification.
    initial_haward_thackray_strain : float
        e_HT of the first sample [-]; only an `InitialStress` needs it.

    Raises
    ------
    InputError
        If it is no modification, or an entry of it is not possible.
    """
    checked(modification)
    if (shift := modification.rate_shift) is not None:
        companion = _core.RateShift(companion, shift.reference_rate, shift.exponent, shift.curvature)
    if (exponent := modification.weight_exponent) is not None:
        ratio = spectrum.relaxation_ratio
        weight = spectrum.modal_weight * ratio**exponent
        spectrum = _core.Spectrum(ratio, weight * (spectrum.modal_weight.sum() / weight.sum()))
    if (other := modification.other_spectrum) is not None:
        spectrum = _mixed(spectrum, other)
    law = engine_law_of(parameters, companion, spectrum)
    change = engine_change(modification)
    if (start := modification.initial_stress) is not None:
        weight = spectrum.modal_weight
        still_carried = weight * np.exp(-start.cut / spectrum.relaxation_ratio)
        if start.pulled > 0.0:
            duration = start.pulled / spectrum.relaxation_ratio
            still_carried *= -np.expm1(-duration) / duration
        relaxed = law.hardening_modulus * _initial_hardening(change, initial_haward_thackray_strain)
        relaxed += np.append(change.added_relaxed_stress, 0.0)[0]
        change.initial_modal_stress = relaxed * weight + start.stress * still_carried / still_carried.sum()
    return ModifiedLaw(law, change)


def _mixed(spectrum: _core.Spectrum, other: OtherSpectrum) -> _core.Spectrum:
    """The law's modes and further ones beyond the slowest, at the same distances; a part of the weights as `other`."""
    ratio, weight = spectrum.relaxation_ratio, spectrum.modal_weight
    step = ratio[-1] / ratio[-2] if len(ratio) > 1 else _LONE_STEP
    slower = ratio[-1] * step ** np.arange(1, int(np.log(SLOWER) / np.log(step)) + 1)
    ratio = np.append(ratio, slower)
    up_to = other.distribution(np.sqrt(ratio[1:] * ratio[:-1]))
    mixed = other.part * weight.sum() * np.diff(up_to, prepend=0.0, append=1.0)
    mixed[: len(weight)] += (1.0 - other.part) * weight
    return _core.Spectrum(ratio, mixed)


def parameter_directions(
    made: ModifiedLaw, modification: Modification | None, history: _core.History
) -> list[_core.Direction]:
    """Directions of E_u, tau_max or alpha, and G for the modified law along a history."""
    directions = _core.parameter_directions(made.law, made.change, history)
    if modification is not None and modification.initial_stress is not None:
        # The relaxed part of the start follows G.
        relaxed = _initial_hardening(made.change, history.haward_thackray_strain[0])
        directions[2].initial_modal_stress = made.law.spectrum.modal_weight * relaxed
    return directions


def engine_change(modification: Modification | None) -> _core.LawChange:
    """What the engine follows along a record without knowing the law; no modification is one object for all.

    Raises
    ------
    InputError
        If it is no modification, or an entry of it is not possible.
    """
    if modification is None:
        return UNCHANGED
    checked(modification)
    change = _core.LawChange()
    for names, checked_as in ((SAMPLED, held_samples), (MODES, as_samples)):  # the engine refuses samples by name
        for name in names:
            values = getattr(modification, name)
            if values is not None:
                setattr(change, name, checked_as(np.atleast_1d(values), name))
    for feedback in modification.feedbacks:
        if not isinstance(feedback, _core.Feedback):
            raise InputError(
                f"feedbacks holds {feedback!r}; a StressActivation, PowerActivation or SelfHeating is needed"
            )
    if modification.feedbacks:
        change.feedbacks = list(modification.feedbacks)
    return change


def checked(modification: Modification) -> Modification:
    """What an argument named `modification` was given; an `InputError` if that is none."""
    if not isinstance(modification, Modification):
        raise InputError(f"modification is {modification!r}; a Modification is needed")
    return modification


def refuse(modification: Modification | None, names: frozenset[str], where: str) -> None:
    """An `InputError` if a modification has what a caller, named `where`, cannot follow."""
    if modification is not None and (refused := sorted(checked(modification).changed & names)):
        raise InputError(f"modification: found {', '.join(refused)}, which {where} cannot follow; Law.stress can")


def _initial_hardening(change: _core.LawChange, haward_thackray_strain: float) -> float:
    """e_HT of the first sample times the hardening factor there [-]."""
    return float(haward_thackray_strain * np.append(change.hardening_factor, 1.0)[0])
