"""A base law on the records of a campaign: best parameters, the noise, white coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.record_view import views_of
from probation.inference.candidate import WhitenedColumns
from probation.inference.discrepancy import Discrepancy
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.propagated import propagated_noise
from probation.inference.refit import Refit, refit
from probation.inference.screen import screen
from probation.inference.users_law import UsersLaw
from probation.inference.view_residual import residual_of
from probation.noise.drift import estimate_drift, like_an_effect, with_drift
from probation.noise.estimate import estimate_noise
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.smoothing.excitation import excite

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.effects.effect import Effect
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.inference.screen import Column
    from probation.law.schemes import SchemeName
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.records.campaign import Campaign
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

ROUNDS = 3
"""Noise and parameters are found in turns; they settle within two."""


@dataclass(frozen=True, eq=False)
class BaseFit:
    """The base law at its generalised least-squares optimum on the identify records.

    Attributes
    ----------
    law : GapLaw
    views : tuple of RecordView
        All records', in the campaign's order.
    refit : Refit
        On the identify records, without causes.
    whitened : Whitened
        The same as the statistics see it.
    other_starts : tuple of ndarray, shape (n_base,)
        Where refits with causes may begin, too: a law that lacks an effect may fit best far from where it is right.
    signals : tuple of Column
        Of the effects that are considered, by `inference.screen`.
    held_out : tuple of RecordResidual
        The records that were not fitted, as these parameters predict them.
    """

    law: GapLaw
    views: tuple[RecordView, ...]
    refit: Refit
    whitened: Whitened
    other_starts: tuple[FloatArray, ...] = ()
    signals: tuple[Column, ...] = ()
    held_out: tuple[RecordResidual, ...] = ()

    @property
    def model(self) -> CampaignModel:
        """The base law on the identify records."""
        return self.refit.model

    @property
    def parameters(self) -> FloatArray:
        """Shape (n_base,)."""
        return self.refit.parameters

    @property
    def misfit(self) -> tuple[float, float]:
        """Root mean square of the identify records' residuals and of their noise [MPa]."""
        errors = np.concatenate([self.whitened.clean(index) for index in range(len(self.whitened.records))])
        floor = np.concatenate([noise.deviation for noise in self.whitened.noises])
        return float(np.sqrt(np.mean(errors**2))), float(np.sqrt(np.mean(floor**2)))

    @cached_property
    def covariance(self) -> FloatArray:
        """Of the parameters, by noise with all of its drift, shape (n_base, n_base)."""
        found, whitened = self.refit, self.whitened
        solver = np.linalg.pinv(found.jacobian)
        covariance = solver @ solver.T
        for noise, part in zip(whitened.noises, whitened.slices, strict=True):
            if noise.nuisance_drift is not None:
                moved = solver[:, part] @ noise.whiten(noise.nuisance_drift)
                covariance += moved @ moved.T
        slopes = found.coordinates.slopes(found.parameters)
        return np.asarray(covariance * np.outer(slopes, slopes))

    @cached_property
    def held_out_noises(self) -> tuple[NoiseModel, ...]:
        """The noise of the records that were not fitted, found on themselves."""
        return _noises(self.held_out) if self.held_out else ()

    @cached_property
    def discrepancy(self) -> Discrepancy:
        """Smooth waves over the identify records, along which a form may be wrong."""
        return Discrepancy.of(self.whitened, self.columns.smooth)

    @cached_property
    def columns(self) -> WhitenedColumns:
        """The signals in white coordinates."""
        return WhitenedColumns.of(self.signals, self.whitener, len(self.whitened))

    def screened(
        self,
        effects: Sequence[Effect],
        threads: int = 2,
        unsolved: Callable[[Cause, Exception], None] | None = None,
    ) -> BaseFit:
        """The same with the signals of these effects; `unsolved` as in `screen`."""
        signals = screen(self.model, self.parameters, effects, threads=threads, unsolved=unsolved)
        return replace(self, signals=tuple(signals))

    def columns_with_starts(
        self,
        effects: Sequence[Effect],
        threads: int = 2,
        unsolved: Callable[[Cause, Exception], None] | None = None,
    ) -> WhitenedColumns:
        """The signals, and those whose shapes begin where the residual says; `unsolved` as in `screen`.

        For a search only: in a gap test they would find what chance put there.
        """
        started = [each for each in effects if any(form.starts is not None for form in each.forms)]
        residual = self.model.residual(self.parameters)
        more = screen(self.model, self.parameters, started, residual=residual, threads=threads, unsolved=unsolved)
        return self.columns.and_(WhitenedColumns.of(more, self.whitener, len(self.whitened)))

    @property
    def whitener(self) -> Whitener:
        """Of the identify records."""
        return Whitener(self.whitened.noises)


def fit_law(law: GapLaw, campaign: Campaign, scheme: SchemeName = "sa3") -> BaseFit:
    """Fit any law to the identify records of a campaign; `scheme` says whose difference of the strain is its rate."""
    excitations = {record.id: excite(record) for record in campaign.records}
    views = views_of(campaign, excitations=excitations, scheme=scheme)
    known = law if isinstance(law, DnlrLaw) else UsersLaw(law)
    return fit_views(known, views, campaign.records, excitations)


def fit_views(
    law: GapLaw, views: Sequence[RecordView], records: Sequence[Record], excitations: Mapping[str, Excitation]
) -> BaseFit:
    """Fit any law to the views whose role is "identify": parameters and noise in turns."""
    known = {record.id: record for record in records}
    model = CampaignModel(law, [view for view in views if view.role == "identify"])
    parameters = law.start
    raw, jacobian = model.residual_and_jacobian(parameters)

    def residuals_of(model: CampaignModel, raw: FloatArray, jacobian: FloatArray) -> list[RecordResidual]:
        return [
            residual_of(
                view,
                raw[part],
                jacobian[part],
                given_noise=known[view.id].noise.stress_MPa,
                carried=propagated_noise(law, view, excitations[view.id], parameters),
            )
            for view, part in model.parts
        ]

    residuals = residuals_of(model, raw, jacobian)
    for _ in range(ROUNDS):
        noises = _noises(residuals)
        found = refit(model, parameters, Whitener(noises), most_steps=12)
        moved = np.abs(found.parameters - parameters) / np.maximum(np.abs(parameters), 1e-300)
        parameters = found.parameters
        residuals = _at(residuals, found)
        if moved.size == 0 or float(moved.max()) < 1e-5:
            break
    # Effects that hand the force back to the strain must not be handed its noise.
    quiet = CampaignModel(law, views).quietened(parameters).views
    fitted = CampaignModel(law, [view for view in quiet if view.role == "identify"])
    others = [view for view in quiet if view.role != "identify"]
    held_out: list[RecordResidual] = []
    if others:
        rest = CampaignModel(law, others)
        held_out = residuals_of(rest, *rest.residual_and_jacobian(parameters))
    whitened = Whitened.of(residuals, noises)
    return BaseFit(law, quiet, replace(found, model=fitted), whitened, held_out=tuple(held_out))


def with_noise_beside(base: BaseFit, explained: Refit) -> BaseFit:
    """The same with the noise as an explanation leaves it: a gap makes slow noise look larger than it is.

    Parameters
    ----------
    base : BaseFit
    explained : Refit
        With the causes, on the same records.
    """
    noises = _noises(_at(base.whitened.records, explained))
    found = refit(base.model, base.parameters, Whitener(noises), most_steps=12)
    return replace(base, refit=found, whitened=Whitened.of(_at(base.whitened.records, found), noises))


def _at(residuals: Sequence[RecordResidual], found: Refit) -> list[RecordResidual]:
    """The same records at another fit, in the units of the data."""
    raw, jacobian = found.model.residual_and_jacobian(found.parameters)
    parts = [part for _, part in found.model.parts]
    return [
        replace(each, residual=raw[part], tangent=jacobian[part]) for each, part in zip(residuals, parts, strict=True)
    ]


def _noises(residuals: Sequence[RecordResidual]) -> tuple[NoiseModel, ...]:
    """Every record's noise, its drift included."""
    noises = estimate_noise(residuals)
    drift = estimate_drift(Whitened.of(residuals, noises))
    alike = like_an_effect(drift)
    return tuple(
        with_drift(noise, alike, drift - alike, record.time) for noise, record in zip(noises, residuals, strict=True)
    )
