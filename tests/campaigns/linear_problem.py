"""Small problems around an elastic bar, whose integrals and optima can be had otherwise."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

import probation
from probation.effects.effect import Effect, EffectParameter, Form
from probation.effects.record_view import RecordView, views_of
from probation.inference.callable_law import CallableLaw
from probation.inference.model import CampaignModel
from probation.inference.problem import Problem
from probation.inference.refit import Refit, refit
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.noise.record_residual import RecordResidual
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.records.record import Noise, Record

SIGMA = 0.5
MODULUS = 100.0


def bar(function=None, names=("modulus_MPa",), starts=(80.0,), lower=(0.0,), upper=(1e4,)) -> CallableLaw:
    """True stress = modulus times true strain, or another function of strain and parameters."""
    chosen = function or (lambda strain, parameters: parameters[0] * strain)
    return CallableLaw(
        lambda time, strain, parameters, modification: chosen(strain, parameters), names, starts, lower, upper
    )


def parameter(name, lower, upper, scale, **others) -> EffectParameter:
    return EffectParameter(name, "", lower, upper, scale, "for a test", **others)


def effect(shape: Callable, *parameters: EffectParameter, name="added", kind="rig", more_forms=()) -> Effect:
    """What `shape(view, values)` adds to the recorded stress, in one form or with others of the same parameters."""

    def recorded(view, values, stress):
        return stress + shape(view, values)

    forms = tuple(Form(form, parameters, recorded_stress=recorded) for form in ("first", *more_forms))
    return Effect(name, name, "For a test.\nNothing more.", "none", "all", kind, forms)


def views(stresses: Sequence[np.ndarray], strains: Sequence[float] | None = None) -> tuple[RecordView, ...]:
    """Ramps of 100 s to a strain of 1, or to those of `strains`, on which these stresses were recorded."""
    ends = [1.0] * len(stresses) if strains is None else strains
    records = []
    for index, (stress, end) in enumerate(zip(stresses, ends, strict=True)):
        time = np.linspace(0.0, 100.0, len(stress))
        strain = end * time / 100.0
        records.append(Record(f"r{index + 1}", time, strain, stress, noise=Noise(SIGMA, 0.0)))
    return views_of(probation.Campaign(name="bar", records=tuple(records)))


def white(count: int, name: str = "r1", sigma: float = SIGMA) -> NoiseModel:
    """White noise whose level is known."""
    return NoiseModel.stationary(name, Arma(innovation=sigma), count)


def whitener(seen: Sequence[RecordView]) -> Whitener:
    return Whitener(tuple(white(len(view.data), view.id) for view in seen))


def whitened(found: Refit) -> Whitened:
    """The records at a refit of the base law, as the statistics see them."""
    model = found.model
    raw, jacobian = model.residual_and_jacobian(found.parameters)
    records = [
        RecordResidual(
            view.id, view.time, view.true_strain, view.rate, raw[model.rows(view.id)], jacobian[model.rows(view.id)]
        )
        for view in model.views
    ]
    return Whitened.of(records, whitener(model.views).noises)


def solved(law, seen, causes=(), start=None, **options) -> Refit:
    """A refit to the last digit."""
    model = CampaignModel(law, seen, causes)
    begin = model.start if start is None else np.asarray(start, dtype=np.float64)
    return refit(Problem(model, whitener(seen)), begin, **{"most_steps": 200, "settled": 1e-11, **options})
