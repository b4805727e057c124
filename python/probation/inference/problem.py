"""A law, the records that it is compared with, effects, and the noise: residuals in coordinates in which it is white.

Every question is asked of this object: `fit`, `certify` and `companion` of one without effects, `diagnose` of many that
differ in their effects.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.moving_noise import MovingNoise
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.noise.whitener import Whitener

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.inference.strain_noise import StrainNoise
    from probation.law.modal import Law


@dataclass(frozen=True, eq=False)
class Problem:
    """Fit residuals (model - data) of all records, stacked, in coordinates in which their noise is white.

    It is never changed: what differs is another problem, from `with_causes`, `with_noises` and the like. Every answer
    is a function of the problem and of parameters, shape (n_parameters,): those of the law that are not held, then
    those of the effects.

    Attributes
    ----------
    model : CampaignModel
        Law, records and effects: stresses and derivatives in MPa, without the noise.
    whitener : Whitener
        Of the noise, as far as no parameter moves it.
    moving : MovingNoise or None
        The noise of the strain, where it follows the parameters.
    """

    model: CampaignModel
    whitener: Whitener
    moving: MovingNoise | None = None

    @classmethod
    def white(cls, law: GapLaw, views: Sequence[RecordView], levels: Sequence[float] | None = None) -> Problem:
        """A law on its records with white noise, of the size that every record has by itself, or of these [MPa]."""
        sizes = [view.stress_noise for view in views] if levels is None else levels
        noises = (_white(view, size) for view, size in zip(views, sizes, strict=True))
        return cls(CampaignModel(law, views), Whitener(tuple(noises)))

    def with_causes(self, causes: Iterable[Cause]) -> Problem:
        """The same with other effects."""
        return replace(self, model=self.model.with_causes(causes))

    def with_model(self, model: CampaignModel) -> Problem:
        """The same records and noise with a model of other effects."""
        return replace(self, model=model)

    def only(self, kept: Sequence[int]) -> Problem:
        """The same on some of the records, by number."""
        part = replace(self, model=self.model.on([self.views[at] for at in kept]))
        strain = () if self.moving is None else [self.moving.strain[at] for at in kept]
        return part.with_noises([self.whitener.noises[at] for at in kept], strain)

    def with_views(self, views: Iterable[RecordView]) -> Problem:
        """The same records solved otherwise: by another scheme, in other steps, driven by another strain."""
        return replace(self, model=self.model.on(views))

    def with_law(self, law: GapLaw) -> Problem:
        """The same records, effects and noise with another law, or with other parameters held."""
        return replace(self, model=CampaignModel(law, self.model.views, self.model.causes))

    def with_noises(self, noises: Iterable[NoiseModel], strain: Sequence[StrainNoise | None] = ()) -> Problem:
        """The same with other noise of every record's stress; and of its strain, where that matters."""
        whitener = Whitener(tuple(noises))
        moving = MovingNoise(whitener, tuple(strain)) if any(noise is not None for noise in strain) else None
        return replace(self, whitener=whitener, moving=moving)

    def reweighed(self, parameters: FloatArray) -> Problem:
        """The same, each record weighed by what really scatters it around the law: noise and bias together."""
        residual, noises = self.model.residual(parameters), []
        for view, rows in self.model.parts:
            noises.append(_white(view, max(view.stress_noise, float(np.sqrt(np.mean(residual[rows] ** 2))))))
        return self.with_noises(noises)

    def frozen_at(self, parameters: FloatArray) -> Problem:
        """The same with the noise as it is at some parameters."""
        return replace(self, whitener=self.whitener_at(parameters), moving=None)

    @property
    def law(self) -> GapLaw:
        """The law, with where a search may begin and what is held."""
        return self.model.law

    @property
    def views(self) -> tuple[RecordView, ...]:
        """The records."""
        return self.model.views

    @property
    def lengths(self) -> list[int]:
        """Samples of each record."""
        return [len(view.data) for view in self.views]

    @property
    def carries_strain_noise(self) -> bool:
        """Whether the residual of any record is weighed for the noise of its strain."""
        return self.moving is not None or any(noise.carries_strain for noise in self.whitener.noises)

    def engine_law(self) -> DnlrLaw:
        """The law where it is the engine's, as it is in a fit."""
        assert isinstance(self.law, DnlrLaw), "only a diagnosis takes other laws"
        return self.law

    def law_at(self, parameters: FloatArray) -> Law:
        """The engine's law with these values."""
        return self.engine_law().law_at(parameters)

    def whitener_at(self, parameters: FloatArray) -> Whitener:
        """Of the noise at some parameters."""
        return self.whitener if self.moving is None else self.moving.at(self.law_at(parameters))

    def noises_at(self, parameters: FloatArray) -> tuple[NoiseModel, ...]:
        """Every record's noise at some parameters."""
        return self.whitener_at(parameters).noises

    def residual(self, parameters: FloatArray) -> FloatArray:
        """Fit residual in white coordinates, shape (n_samples,) [-]."""
        return self.whitener_at(parameters).residual(self.model.residual(parameters))

    def residual_and_jacobian(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Fit residual (n_samples,), and the derivatives (n_samples, n_parameters) that make its exact gradient.

        Where strain noise moves with the law, J - (d A / d theta) delta stands in for J, delta the strain errors that
        reconcile record and law: Gauss-Newton then descends along the gradient of r^T Sigma(theta)^-1 r.
        """
        residual, jacobian = self.model.residual_and_jacobian(parameters)
        whitener = self.whitener_at(parameters)
        if self.moving is not None:
            free = self.engine_law().free.tolist()
            jacobian[:, : len(free)] -= self.moving.slopes(self.law_at(parameters), residual, free)
        both = whitener.columns(np.column_stack([residual, jacobian]))
        return both[:, 0].copy(), both[:, 1:]


def _white(view: RecordView, level: float) -> NoiseModel:
    """White stress noise of one size along a record."""
    return NoiseModel.stationary(view.id, Arma(innovation=level), len(view.data))
