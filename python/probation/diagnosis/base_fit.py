"""The base law on a campaign as the diagnosis needs it: best parameters, the noise, white coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import uniform_filter1d

from probation.diagnosis.substeps import enough_substeps, predicted
from probation.effects.record_view import views_of
from probation.identify.fit import fit
from probation.identify.given import given
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
from probation.noise.stretches import leftover
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.smoothing.excitation import excite

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect
    from probation.effects.record_view import RecordView
    from probation.identify.result import Fit
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

PARAMETERS = 3

FIRST, STIFFER, FAR = 20, 1.3, 3.0
"""Samples whose slope tells E_u from below, by how much, and the factor from which on a fitted E_u is far from it."""

PARTS = 8
"""Parts of a record in which the local noise variance is estimated where strains are chosen ..."""

QUIETEST = 0.01
"""... and the least of it, over the mean."""


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
        Of the effects that are considered, by `gap.screen`.
    """

    law: GapLaw
    views: tuple[RecordView, ...]
    refit: Refit
    whitened: Whitened
    other_starts: tuple[FloatArray, ...] = ()
    signals: tuple[Column, ...] = ()

    @property
    def model(self) -> CampaignModel:
        """The base law on the identify records."""
        return self.refit.model

    @property
    def parameters(self) -> FloatArray:
        """Shape (n_base,)."""
        return self.refit.parameters

    @cached_property
    def discrepancy(self) -> Discrepancy:
        """Smooth waves over the identify records, along which a form may be wrong."""
        return Discrepancy.of(self.whitened, self.columns.smooth)

    @cached_property
    def columns(self) -> WhitenedColumns:
        """The signals in white coordinates."""
        return WhitenedColumns.of(self.signals, self.whitener, len(self.whitened))

    def screened(self, effects: Sequence[Effect], threads: int = 2) -> BaseFit:
        """The same with the signals of these effects."""
        return replace(self, signals=tuple(screen(self.model, self.parameters, effects, threads=threads)))

    def columns_with_starts(self, effects: Sequence[Effect], threads: int = 2) -> WhitenedColumns:
        """The signals, and those whose shapes begin where the residual says.

        For a search only: in a gap test they would find what chance put there.
        """
        started = [each for each in effects if any(form.starts is not None for form in each.forms)]
        residual = self.model.residual(self.parameters)
        more = screen(self.model, self.parameters, started, residual=residual, threads=threads)
        return self.columns.and_(WhitenedColumns.of(more, self.whitener, len(self.whitened)))

    @property
    def whitener(self) -> Whitener:
        """Of the identify records."""
        return Whitener(self.whitened.noises)


def base_fit(campaign: Campaign, scheme: SchemeName = "sa3", hold: Mapping[str, float] | None = None) -> BaseFit:
    """Fit the engine's law to the identify records of a campaign.

    Parameters
    ----------
    campaign : Campaign
    scheme : {"be2", "sa2", "sa3"}
    hold : dict of str to float, optional
        Parameters that are not identified, on top of the campaign's own.

    Raises
    ------
    InputError
        As `probation.fit`.
    """
    if len(campaign.law.fixed) == PARAMETERS and not hold:
        found = given(campaign, scheme)
    else:
        found = fit(campaign, scheme, hold=hold, weighting="plain", method="variable-projection")
    samples = _excitations(campaign, found)
    steps = enough_substeps(campaign, found, samples)
    views = views_of(campaign, excitations=samples, scheme=scheme, substeps=steps)
    law = DnlrLaw(found.law, held=[name for name in found.law.parameter_names if name not in found.names])
    base = fit_views(law, views, campaign.records, samples)
    return replace(base, other_starts=_other_starts(base))


def _other_starts(base: BaseFit) -> tuple[FloatArray, ...]:
    """With E_u by the records' first slope, and tau_max by what is known best, E_u tau_max; where that is far away."""
    names = list(base.law.parameter_names)
    if "unrelaxed_modulus_MPa" not in names:
        return ()
    at = names.index("unrelaxed_modulus_MPa")
    time = next((index for index, name in enumerate(names) if name in ("tau_max_s", "alpha")), None)
    slope = STIFFER * max(_first_slope(view) for view in base.model.views)
    ratio = base.parameters[at] / slope if slope > 0.0 else 1.0
    if 1.0 / FAR < ratio < FAR:
        return ()
    moved = base.parameters.copy()
    moved[at] = slope
    if time is not None:
        moved[time] *= ratio
    return (np.clip(moved, *base.law.bounds),)


def _first_slope(view: RecordView) -> float:
    """Steepest secant from the first sample to one of the next few [MPa]."""
    strain = view.sampled(view.true_strain)[1:FIRST] - view.true_strain[0]
    stress = view.data[1:FIRST] - view.data[0]
    moving = np.abs(strain) > 0.1 * float(np.max(np.abs(strain), initial=0.0))
    return float(np.max(np.abs(stress[moving] / strain[moving]), initial=0.0)) if moving.any() else 0.0


def _excitations(campaign: Campaign, found: Fit) -> dict[str, Excitation]:
    """What drives the law: the smoothed strains, or the recorded ones if the stress shows their wiggles to be real.

    What a smoother takes off a strain is noise of its record, which the specimen never saw, or the test's own restless
    control, which it did. The strain does not tell; the stress does, of all smoothed records together, by what is
    rougher than any effect that the law may lack.
    """
    chosen = {record.id: excite(record) for record in campaign.records}
    raw = {record.id: excite(record, "raw") for record in campaign.records if chosen[record.id].operators is not None}
    favours_raw = 0.0
    for record in campaign.identify:
        if record.id in raw:
            smooth, recorded = (
                predicted(found, way[record.id], found.substeps) - record.true_stress for way in (chosen, raw)
            )
            rough = [leftover(residual, chosen[record.id].jumps) for residual in (smooth, recorded)]
            favours_raw += float(np.sum((rough[0] ** 2 - rough[1] ** 2) / _local_noise_variance(smooth)))
    return chosen | raw if favours_raw > 0.0 else chosen


def _local_noise_variance(residual: FloatArray) -> FloatArray:
    """Variance of the rough part of a residual along its record, shape (n,): a force's noise grows with the stretch."""
    rough = np.pad(np.diff(residual, 2), 1, mode="edge") ** 2
    power = uniform_filter1d(rough, max(len(rough) // PARTS, 1), mode="nearest")
    return np.asarray(np.maximum(power, QUIETEST * float(np.mean(power)) + 1e-300), dtype=np.float64)


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
    residuals = [
        residual_of(
            view,
            raw[part],
            jacobian[part],
            given_noise=known[view.id].noise.stress_MPa,
            carried=propagated_noise(law, view, excitations[view.id], parameters),
        )
        for view, part in model.parts
    ]
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
    return BaseFit(law, quiet, replace(found, model=fitted), Whitened.of(residuals, noises))


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
