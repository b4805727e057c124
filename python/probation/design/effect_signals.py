"""What effects of usual size do to the recorded stress: not derivatives, since some effects are far from linear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.cause import Cause
from probation.errors import InputError
from probation.inference.unsolvable import UNSOLVABLE
from probation.parallel import in_parallel
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect, EffectParameter, Form
    from probation.effects.record_view import RecordView
    from probation.inference.model import CampaignModel, Specimen


_SMALLER = 4.0
_ATTEMPTS = 4


@dataclass(frozen=True, eq=False)
class EffectSignal:
    """What one cause of some size, at one start of its nonlinear parameters, adds to the recorded stress.

    Attributes
    ----------
    values : tuple of float
        Of the cause's parameters, amplitude first.
    stress : ndarray, shape (n_samples,) [MPa]
        With the effect less without, over all records of the model, in proportion to `values[0]` where the law could
        only be solved at a smaller amplitude.
    usual : bool
        Of usual size, at one of the form's own starts: what may stand for the effect. The others only show what else it
        can look like.
    """

    cause: Cause
    values: tuple[float, ...]
    stress: FloatArray
    usual: bool = True

    @property
    def reach(self) -> tuple[float, float]:
        """Bounds of the amplitude as multiples of this one's, the lower first."""
        amplitude, size = self.cause.form.amplitude, self.values[0]
        ends = sorted((amplitude.lower / size, amplitude.upper / size))
        return ends[0], ends[1]

    @property
    def one_sided(self) -> bool:
        """Whether the amplitude can have one sign only."""
        return 0.0 in self.reach


def effect_signals(
    model: CampaignModel,
    parameters: FloatArray,
    effects: Iterable[Effect],
    *,
    threads: int = 1,
    progress: Callable[[float], None] | None = None,
) -> tuple[list[EffectSignal], dict[str, str]]:
    """Signals of effects of usual size, on top of the model as it is: for every form and start of nonlinear parameters.

    With them the same at a fiftieth of the size and at further nonlinear parameters, as rivals may have them, where the
    starts of a form are a grid and not a function. In all records with one amplitude; a form that can sit in single
    records only: in each of them.

    Parameters
    ----------
    parameters : ndarray, shape (n_parameters,)
    threads : int
        Signals are worked out in parallel.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    signals : list of EffectSignal
        In the order of the effects.
    left_out : dict of str to str
        Names of effects without any signal, and why: the law does not know what they change, cannot be solved with
        them, or they are in the model already.
    """
    effects = tuple(effects)
    present = {cause.effect.name for cause in model.causes}
    wanted: list[tuple[Cause, tuple[float, ...], bool]] = []
    unsolvable: dict[str, str] = {}
    for effect in effects:
        if effect.name in present:
            continue
        try:
            wanted += [
                (Cause(effect, form, records), values, usual)
                for form in _placed_forms(effect)
                if form.visible_in(model.views) and not model.missing_capabilities(Cause(effect, form))
                for records, views in _places(model, effect, form)
                for values, usual in _values_tried(form, views)
            ]
        except UNSOLVABLE as error:
            unsolvable[effect.name] = str(error)
    base, active = model.split(parameters)
    still = {view.id: model.at_rest(view, base, active) for view in model.views}

    def work(item: tuple[Cause, tuple[float, ...], bool]) -> FloatArray | str:
        cause, values, _ = item
        try:
            return signal(model, parameters, cause, values, still)
        except InputError as unsolved:
            return str(unsolved)

    worked = in_parallel(work, wanted, threads, progress)
    signals = [
        EffectSignal(cause, values, stress, usual)
        for (cause, values, usual), stress in zip(wanted, worked, strict=True)
        if not isinstance(stress, str)
    ]
    shown = {signal.cause.effect.name for signal in signals if signal.usual}
    left_out = {}
    for effect in effects:
        if effect.name not in shown:
            failed = (result for item, result in zip(wanted, worked, strict=True) if item[0].effect == effect)
            known = "the law does not know what it would change"
            if effect.name in present:
                known = "it is in the model already"
            elif not any(form.visible_in(model.views) for form in effect.forms):
                known = "these records could not show it"
            reasons = (reason for reason in failed if isinstance(reason, str))
            left_out[effect.name] = unsolvable.get(effect.name) or next(reasons, known)
    return [signal for signal in signals if signal.cause.effect.name in shown], left_out


def signal(
    model: CampaignModel,
    parameters: FloatArray,
    cause: Cause,
    values: tuple[float, ...],
    still: dict[str, tuple[Specimen, FloatArray]] | None = None,
) -> FloatArray:
    """What a cause adds to the recorded stress of all records, shape (n_samples,) [MPa].

    Where the law cannot be solved at that amplitude a smaller one is taken, and its signal in proportion.

    Parameters
    ----------
    model, parameters
        Without the cause.
    values : tuple of float
        Amplitude first.
    still : dict, optional
        `CampaignModel.at_rest` of every record by id, if that is known.

    Raises
    ------
    InputError
        If a 256th of the amplitude cannot be solved either.
    """
    base, active = model.split(parameters)
    added = np.zeros(len(model.data))
    for attempt in range(_ATTEMPTS + 1):
        part = _SMALLER**-attempt
        moved = part * values[0], *values[1:]
        try:
            for view in model.views:
                if not cause.touches(view.id):
                    continue
                specimen, recorded = still[view.id] if still else model.at_rest(view, base, active)
                stress = model.with_one_more(view, base, active, cause, moved, specimen)
                added[model.rows(view.id)] = view.sampled(stress - recorded) / part
        except UNSOLVABLE:
            continue
        if np.isfinite(added).all():
            return added
    raise InputError(
        f"{cause.label}: found no solution of the law with {cause.form.amplitude.name} = {values[0]:g} "
        "nor with a 256th of it; expected one at its usual size, check the effect or the base parameters"
    )


def usual_size(amplitude: EffectParameter) -> float:
    """One scale of the prior, in the direction that the bounds allow."""
    if amplitude.upper > 0.0:
        return min(amplitude.scale if np.isfinite(amplitude.scale) else amplitude.upper, amplitude.upper)
    return max(-amplitude.scale if np.isfinite(amplitude.scale) else amplitude.lower, amplitude.lower)


def _placed_forms(effect: Effect) -> tuple[Form, ...]:
    """The forms that may sit in all records; if there are none, all forms."""
    shared = tuple(form for form in effect.forms if "all" in effect.placements(form))
    return shared or effect.forms


def _places(
    model: CampaignModel, effect: Effect, form: Form
) -> list[tuple[tuple[str, ...] | None, tuple[RecordView, ...]]]:
    if "all" in effect.placements(form):
        return [(None, model.views)]
    return [((view.id,), (view,)) for view in model.views]


def _values_tried(form: Form, views: tuple[RecordView, ...]) -> list[tuple[tuple[float, ...], bool]]:
    """Values, and whether they are of usual size at a start; a threshold's own amplitudes."""
    starts = form.nonlinear_starts(views)
    if form.threshold:
        return [(values, True) for values in starts]
    size = usual_size(form.amplitude)
    tried = [((size, *nonlinear), True) for nonlinear in starts]
    if form.starts is not None:
        return tried
    if form.needs_solve:
        tried += [((DESIGN.small_part * size, *nonlinear), False) for nonlinear in starts]
    return tried + [((size, *nonlinear), False) for nonlinear in _further_values(form) if nonlinear not in starts]


def _further_values(form: Form) -> list[tuple[float, ...]]:
    """A grid over what the priors of the nonlinear parameters expect."""
    steps = DESIGN.further_values if len(form.parameters) < 3 else DESIGN.further_values[1::2]
    grid: list[tuple[float, ...]] = [()]
    for parameter in form.parameters[1:]:
        if not np.isfinite(parameter.scale):
            return []
        centre = parameter.to_search(parameter.centre)
        values = [parameter.from_search(centre + step * parameter.scale) for step in steps]
        inside = dict.fromkeys(map(parameter.inside, values))
        grid = [(*point, value) for point in grid for value in inside]
    return grid if form.parameters[1:] else []
