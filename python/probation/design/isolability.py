"""Which effects can these tests discriminate? Asked before any fit (docs/diagnosis-method.md, section 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.design.effect_design import Design
from probation.design.effect_signals import effect_signals
from probation.design.isolability_result import EffectIsolability, Isolability
from probation.design.planned_record import as_predicted
from probation.design.rivalry import Rivalry
from probation.errors import InputError
from probation.parallel import in_parallel
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.design.effect_signals import EffectSignal
    from probation.effects.effect import Effect
    from probation.inference.model import CampaignModel
    from probation.noise.model import NoiseModel


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
    they cannot take up counts. A rival may take any of its forms, on a grid of its nonlinear parameters, small or of
    usual size, at any amplitude within its bounds. The stresses of the records are not looked at.

    Parameters
    ----------
    model : CampaignModel
        Of the records, measured or planned; usually without causes. Causes it has count as part of the base.
    parameters : ndarray, shape (n_parameters,)
        Of the model.
    noises : sequence of NoiseModel
        One per record; `white_noise` makes them of standard deviations.
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
    raw = design.whitened(np.array([signal.stress for signal in signals]).T)
    left, sizes = design.left_of(raw)
    rivalry = Rivalry.of(signals, left, sizes)
    cosine, probability = (
        np.array(column) for column in zip(*map(rivalry.against, range(len(rivalry.names))), strict=True)
    )

    def described(row: int) -> EffectIsolability:
        k = rivalry.chosen[row]
        smallest = design.smallest_seen(signals[k], float(sizes[k]))
        return _described(design, rivalry, signals[k], row, raw[:, k], probability[row], smallest)

    rows = range(len(rivalry.chosen))
    isolable = in_parallel(described, rows, threads, lambda part: advance(0.5 + 0.5 * part))
    return Isolability(
        tuple(view.id for view in model.views), tuple(isolable), cosine, probability, tuple(left_out.items())
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
