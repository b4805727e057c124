"""Which effects tests could discriminate: the answer, and what it says to a person."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.settings.design import DESIGN
from probation.wording import listed, percentage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.design.effect_design import OmissionBias

Status = Literal["named", "ambiguous", "too_small", "absorbed", "without_signal"]

_NAMED = 3
"""Rivals that a sentence names."""


@dataclass(frozen=True)
class EffectIsolability:
    """What these tests could say of one effect.

    Attributes
    ----------
    form : str
        Whose signal was taken: the effect's first.
    records : tuple of str, or None
        The record in which it shows best, where it can only sit in one; None: all.
    values : dict of str to float
        Parameters of the signal, at the effect's usual size; the amplitude first.
    signal : float
        Length of the signal in standard deviations, before the base parameters are refitted.
    detectability : float
        sqrt(lambda): length of the signal in standard deviations, the base parameters refitted.
    seen_from, named_from : float or None
        Smallest amplitudes that would be seen (sqrt(lambda) = 5), and discriminated from every rival (19 times of 20);
        None: not within the bounds of the amplitude.
    absorbable : float
        Part of the signal (its square) that refitted base parameters take up.
    biases : tuple of OmissionBias
        Of the base parameters, if the effect is left out; the largest first.
    rivals : dict of str to float
        Effects with which it would be confused in more than one of twenty cases, with the probability of naming the
        right one of the two; the likest first.
    one_sided : bool
        The amplitude can have one sign only.
    """

    name: str
    title: str
    form: str
    records: tuple[str, ...] | None
    values: dict[str, float]
    signal: float
    detectability: float
    seen_from: float | None
    named_from: float | None
    absorbable: float
    biases: tuple[OmissionBias, ...]
    rivals: dict[str, float]
    one_sided: bool

    @property
    def status(self) -> Status:
        """What these tests would make of it at its usual size.

        "named": seen, no rival; "ambiguous": seen, but with rivals. Not seen: "without_signal", it does
        nothing in these records; "absorbed", the base parameters take it up; "too_small", it drowns in the noise.
        """
        if self.detectability < DESIGN.detected:
            if self.signal < DESIGN.no_signal:
                return "without_signal"
            return "absorbed" if self.absorbable > DESIGN.absorbed else "too_small"
        return "ambiguous" if self.rivals else "named"

    @property
    def sentence(self) -> str:
        """For people."""
        return _sentence(self)

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            "effect": self.name,
            "status": self.status,
            "form": self.form,
            "records": self.records,
            "parameters": self.values,
            "detectability": self.detectability,
            "seen_from": self.seen_from,
            "named_from": self.named_from,
            "absorbable": self.absorbable,
            "biases": [bias.to_dict() for bias in self.biases],
            "rivals": self.rivals,
            "sentence": self.sentence,
        }


@dataclass(frozen=True, eq=False)
class Isolability:
    """What these tests could discriminate.

    Attributes
    ----------
    records : tuple of str
    effects : tuple of EffectIsolability
    cosine : ndarray, shape (k, k)
        Of the angle between the signal of the effect of the row, which is there, and the likest signal of the one of
        the column, whatever its form and start; negative where the amplitude would need the sign it cannot have.
    probability : ndarray, shape (k, k)
        Of finding the effect of the row, which is there, more likely than the one of the column; 1 on the diagonal.
    left_out : tuple of (str, str)
        Effects that were not considered, and why.
    """

    records: tuple[str, ...]
    effects: tuple[EffectIsolability, ...]
    cosine: FloatArray
    probability: FloatArray
    left_out: tuple[tuple[str, str], ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Of the effects: rows and columns of the matrices."""
        return tuple(effect.name for effect in self.effects)

    @property
    def angle(self) -> FloatArray:
        """The angle of `cosine` [degrees], shape (k, k)."""
        return np.degrees(np.arccos(np.clip(self.cosine, -1.0, 1.0)))

    @cached_property
    def groups(self) -> tuple[tuple[str, ...], ...]:
        """Effects that cannot be discriminated, as connected sets; all others stand in none."""
        names = self.names
        friends: dict[str, set[str]] = {name: {name} for name in names}
        for effect in self.effects:
            for rival in effect.rivals:
                joined = friends[effect.name] | friends[rival]
                for name in joined:
                    friends[name] = joined
        groups = {tuple(sorted(friends[name], key=names.index)): None for name in names if len(friends[name]) > 1}
        return tuple(groups)

    def with_status(self, *wanted: Status) -> tuple[EffectIsolability, ...]:
        """The effects with one of these statuses."""
        return tuple(effect for effect in self.effects if effect.status in wanted)

    @property
    def headline(self) -> str:
        """One sentence for the campaign."""
        return _headline(self)

    def to_dict(self) -> dict[str, object]:
        """For JSON; rows and columns of the matrices in the order of the effects."""
        return {
            "headline": self.headline,
            "records": self.records,
            "effects": [effect.to_dict() for effect in self.effects],
            "groups": self.groups,
            "angle_deg": self.angle,
            "probability": self.probability,
            "left_out": [{"effect": name, "why": why} for name, why in self.left_out],
        }


def _headline(isolability: Isolability) -> str:
    """One sentence for the campaign: "These 4 records can name 14 of 22 effects; …"."""
    records, effects = len(isolability.records), len(isolability.effects)
    which = "This record" if records == 1 else f"These {records} records"
    parts = [f"{which} can name {len(isolability.with_status('named'))} of {effects} effects"]
    ambiguous = isolability.with_status("ambiguous")
    if ambiguous:
        taken = "; ".join(f"{effect.name} for {listed(_likest(effect), 'or')}" for effect in ambiguous)
        parts.append(f"{len(ambiguous)} would be seen but could be taken for another ({taken})")
    if hidden := isolability.with_status("absorbed"):
        parts.append(f"{listed([effect.name for effect in hidden], 'and')} would hide in the base parameters")
    if small := isolability.with_status("too_small"):
        parts.append(f"{listed([effect.name for effect in small], 'and')} would drown in the noise at usual size")
    if silent := isolability.with_status("without_signal"):
        parts.append(f"{listed([effect.name for effect in silent], 'and')} would do nothing in them")
    return "; ".join(parts) + "."


def _sentence(effect: EffectIsolability) -> str:
    """What these tests could say of one effect at its usual size."""
    name, size = next(iter(effect.values.items()))
    there = f" in {effect.records[0]}, where it shows best," if effect.records else ""
    title = f"{effect.title[0].upper()}{effect.title[1:]} of usual size ({name} = {size:.3g}){there}"
    seen = f"{_count(effect.detectability)} standard deviations"
    if effect.status == "without_signal":
        return f"{title} does nothing in these records that the base law does not do."
    if effect.status == "absorbed":
        return (
            f"{title} would hide: {_percent(effect.absorbable)} of it is taken up by the base parameters, "
            f"which it biases ({_biased(effect.biases)}); {_from(effect)}."
        )
    if effect.status == "too_small":
        return f"{title} would drown in the noise: {seen} where {DESIGN.detected:g} are needed; {_from(effect)}."
    if effect.status == "named":
        return f"{title} would be seen ({seen}) and discriminated from every other effect; {_from(effect)}."
    right = {rival: f"{rival} ({100 * chance:.0f} % right)" for rival, chance in effect.rivals.items()}
    others = listed([right.get(rival, rival) for rival in _likest(effect)])
    return f"{title} would be seen ({seen}) but could be taken for {others}; {_from(effect)}."


def _likest(effect: EffectIsolability) -> list[str]:
    """What it may be taken for, the first few by name."""
    likest = list(effect.rivals)[:_NAMED]
    more = len(effect.rivals) - len(likest)
    return [*likest, f"{more} more"] if more else likest


def _from(effect: EffectIsolability) -> str:
    """From which amplitude on it is seen, and named."""
    if effect.seen_from is None:
        return "it is seen at no size within its bounds"
    seen = f"it is seen from {effect.seen_from:.2g} on"
    if effect.named_from is None:
        return f"{seen}, named at no size within its bounds"
    return f"{seen}, named from {effect.named_from:.2g} on"


def _count(size: float) -> str:
    return f"{size:,.0f}" if size >= 100.0 else f"{size:.2g}"


def _biased(biases: Sequence[OmissionBias]) -> str:
    """The biases that matter: "hardening_modulus_MPa by +3.1 %"."""
    worst = max((abs(bias.percent) for bias in biases), default=0.0)
    named = [bias for bias in biases if abs(bias.percent) >= DESIGN.bias_worth_naming * worst]
    return listed([f"{bias.parameter} by {percentage(0.01 * bias.percent, '+')} %" for bias in named], "and")


def _percent(share: float) -> str:
    """A share near 1 with the digits that tell it from 1."""
    text = f"{100.0 * share:.4g} %"
    return "all" if text == "100 %" else text
