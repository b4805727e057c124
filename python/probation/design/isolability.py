"""Which effects can these tests discriminate? Asked before any fit (docs/diagnosis-method.md, section 5)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.design.effect_design import Design
from probation.design.effect_signals import effect_signals
from probation.design.isolability_words import headline, sentence
from probation.design.planned_record import as_predicted
from probation.design.rivalry import Rivalry
from probation.errors import InputError
from probation.parallel import in_parallel
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.design.effect_design import Bias
    from probation.design.effect_signals import EffectSignal
    from probation.effects.effect import Effect
    from probation.inference.model import CampaignModel
    from probation.noise.model import NoiseModel


Status = Literal["named", "ambiguous", "too_small", "absorbed", "without_signal"]


@dataclass(frozen=True)
class EffectIsolability:
    """What these tests could say of one effect.

    Attributes
    ----------
    name, title : str
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
    biases : tuple of Bias
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
    biases: tuple[Bias, ...]
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
        return sentence(self)

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
        return tuple(each.name for each in self.effects)

    @property
    def angle(self) -> FloatArray:
        """The angle of `cosine` [degrees], shape (k, k)."""
        return np.degrees(np.arccos(np.clip(self.cosine, -1.0, 1.0)))

    @cached_property
    def groups(self) -> tuple[tuple[str, ...], ...]:
        """Effects that cannot be discriminated, as connected sets; all others stand in none."""
        names = self.names
        friends: dict[str, set[str]] = {name: {name} for name in names}
        for each in self.effects:
            for rival in each.rivals:
                joined = friends[each.name] | friends[rival]
                for name in joined:
                    friends[name] = joined
        found = {tuple(sorted(friends[name], key=names.index)): None for name in names if len(friends[name]) > 1}
        return tuple(found)

    def with_status(self, *wanted: Status) -> tuple[EffectIsolability, ...]:
        """The effects with one of these statuses."""
        return tuple(each for each in self.effects if each.status in wanted)

    @property
    def headline(self) -> str:
        """One sentence for the campaign."""
        return headline(self)

    def to_dict(self) -> dict[str, object]:
        """For JSON; rows and columns of the matrices in the order of the effects."""
        return {
            "headline": self.headline,
            "records": self.records,
            "effects": [each.to_dict() for each in self.effects],
            "groups": self.groups,
            "angle_deg": self.angle,
            "probability": self.probability,
            "left_out": [{"effect": name, "why": why} for name, why in self.left_out],
        }


def isolability(
    model: CampaignModel,
    parameters: FloatArray,
    noises: Sequence[NoiseModel],
    effects: Iterable[Effect],
    *,
    threads: int = 1,
    progress: Callable[[float], None] | None = None,
) -> Isolability:
    """Which effects these tests could discriminate, seen from the strain histories, the noise and the law alone.

    Every effect is taken at its usual size (one scale of its prior, first form, a middle one of its starts), with what
    it really adds at that size, not its derivative. The base parameters are refitted (linearly), so that only what
    they cannot take up counts. A rival may take any of its forms, on a grid of its shapes, small or of usual size, at
    any amplitude within its bounds. The stresses of the records are not looked at.

    Parameters
    ----------
    model : CampaignModel
        Of the records, measured or planned; usually without causes. Causes it has count as part of the base.
    parameters : ndarray, shape (n_parameters,)
        Of the model.
    noises : sequence of NoiseModel
        One per record; `white_noise` makes them of standard deviations.
    effects : iterable of Effect
    threads : int
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Raises
    ------
    InputError
        For another number of noises than records, or no effect that the law can follow.
    """
    if len(noises) != len(model.views):
        raise InputError(f"noises: found {len(noises)}, expected one for each of {len(model.views)} records")
    design = Design.of(as_predicted(model, parameters), parameters, noises)
    advance = progress or (lambda part: None)
    signals, left_out = effect_signals(
        design.model, parameters, effects, threads=threads, progress=lambda part: advance(0.5 * part)
    )
    if not signals:
        raise InputError("effects: found none that the law can follow, expected at least one")
    raw = design.whitened(np.array([each.stress for each in signals]).T)
    left, sizes = design.left_of(raw)
    rivalry = Rivalry.of(signals, left, sizes)
    cosine, probability = (
        np.array(each) for each in zip(*map(rivalry.against, range(len(rivalry.names))), strict=True)
    )
    smallest = in_parallel(
        lambda k: design.smallest_seen(signals[k], float(sizes[k])),
        rivalry.chosen,
        threads,
        lambda part: advance(0.5 + 0.5 * part),
    )
    found = [
        _described(design, rivalry, signals[k], row, raw[:, k], probability[row], smallest[row])
        for row, k in enumerate(rivalry.chosen)
    ]
    return Isolability(
        tuple(view.id for view in model.views), tuple(found), cosine, probability, tuple(left_out.items())
    )


def _described(
    design: Design,
    rivalry: Rivalry,
    usual: EffectSignal,
    row: int,
    raw: FloatArray,
    probability: FloatArray,
    smallest: tuple[float, FloatArray] | None,
) -> EffectIsolability:
    """One effect, of its usual signal (whitened: `raw`), its row of probabilities and the smallest signal seen."""
    cause, size, full = usual.cause, float(rivalry.sizes[rivalry.chosen[row]]), float(np.linalg.norm(raw))
    rivals = {}
    if size >= DESIGN.detected:
        order = np.argsort(probability, kind="stable")
        rivals = {rivalry.names[at]: float(probability[at]) for at in order if probability[at] < DESIGN.discriminated}
    names = [parameter.name for parameter in cause.form.parameters]
    return EffectIsolability(
        name=cause.effect.name,
        title=cause.effect.title,
        form=cause.form.name,
        records=cause.records,
        values=dict(zip(names, usual.values, strict=True)),
        signal=full,
        detectability=size,
        seen_from=None if smallest is None else smallest[0],
        named_from=None if smallest is None else _named_from(rivalry, usual, row, smallest, bool(rivals)),
        absorbable=1.0 - (size / full) ** 2 if full > 0.0 else 0.0,
        biases=design.biases(raw),
        rivals=rivals,
        one_sided=usual.one_sided,
    )


def _named_from(
    rivalry: Rivalry, usual: EffectSignal, row: int, smallest: tuple[float, FloatArray], ambiguous: bool
) -> float | None:
    """Smallest amplitude that is discriminated from every rival; None beyond the bounds.

    An effect that is not named at its usual size is taken to look larger as it does there; one that is, to look as it
    does where it is just seen, and to be named at its usual size at the latest.
    """
    amplitude, truth = smallest
    typical = usual.values[0]
    if ambiguous:
        amplitude, truth = typical, rivalry.left[:, rivalry.chosen[row]]
    end = usual.cause.form.amplitude.upper if amplitude > 0.0 else usual.cause.form.amplitude.lower
    length = rivalry.length_to_name(row, truth, end / amplitude)
    named = None if length is None else amplitude * max(length / float(np.linalg.norm(truth)), 1.0)
    if not ambiguous and abs(amplitude) <= abs(typical):
        return typical if named is None or abs(named) > abs(typical) else named
    return None if named is None or abs(named) > abs(end) else named
