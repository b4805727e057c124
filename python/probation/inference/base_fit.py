"""A base law on the records of a campaign: best parameters, the noise, white coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.detection.noise_without_sharp import without_sharp
from probation.effects.record_view import views_of
from probation.inference.candidate import Extended, WhitenedColumns, for_a_test
from probation.inference.deviations import deviation_columns
from probation.inference.discrepancy import Discrepancy
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.problem import Problem
from probation.inference.propagated import propagated_noise
from probation.inference.refit import Refit, refit
from probation.inference.scatter import scatter_of, with_scatter
from probation.inference.screen import screen
from probation.inference.speed_wander import speed_wander
from probation.inference.unsolvable import UNSOLVABLE
from probation.inference.users_law import UsersLaw
from probation.inference.view_residual import residual_of
from probation.law.schemes import identifying
from probation.noise.drift import estimate_drift, like_an_effect, with_drift
from probation.noise.mean_square import mean_square
from probation.noise.outliers import without_outliers
from probation.noise.own_deviations import own_deviations, specimen_columns
from probation.noise.uncertain_scatter import UncertainScatter
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.records.noise import noise_level
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.effects.effect import Effect
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.inference.scatter import Scatter
    from probation.inference.screen import Column
    from probation.law.schemes import Scheme, SchemeName
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.records.campaign import Campaign
    from probation.records.specimens import Specimens

MOST_TURNS, MOST_REFIT_STEPS, SETTLED = 3, 12, 1e-5
"""Noise and parameters are found in turns, which settle within two: turns, steps of a refit, and the largest relative
change of a parameter that ends them."""

NoiseEstimator: TypeAlias = "Callable[[Sequence[RecordResidual]], tuple[NoiseModel, ...]]"
"""The noise of all records from what a fit leaves of them."""


def fitted_noises(residuals: Sequence[RecordResidual]) -> tuple[NoiseModel, ...]:
    """Every record's noise, its drift included; waves and slips in the residuals are none of it."""
    whitened = without_sharp(residuals)
    noises, drift = whitened.noises, estimate_drift(whitened)
    of_effects = like_an_effect(drift)
    return tuple(
        with_drift(noise, of_effects, drift - of_effects, record.time)
        for noise, record in zip(noises, residuals, strict=True)
    )


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
    specimens : Specimens
        What the campaign says of them.
    scatter : Scatter
        How far specimens differ; the whitened records have it in their noise.
    alike : Whitened
        The same as it would be if specimens were alike.
    other_starts : tuple of ndarray, shape (n_base,)
        Where causes are looked for, too: a law that lacks an effect may fit best far from where it is right.
    screens_other_starts : bool
        Whether causes look so different from there that they are screened there, too.
    signals : tuple of Column
        Of the effects that are considered, by `inference.screen`.
    reference : ndarray, shape (n_base,), optional
        Parameters whose predictions an explanation is compared with, where they are not those of this fit: of the law
        that knows fewer records.
    held_out : tuple of RecordResidual
        The records that were not fitted, as these parameters predict them.
    held_out_noises : tuple of NoiseModel
        Their noise, found on themselves, with their specimens' scatter apart.
    noises_of : callable
        Estimates the noise of the records from what a fit leaves of them.
    periodic : bool
        Whether an unknown effect may be periodic in the strain.
    """

    law: GapLaw
    views: tuple[RecordView, ...]
    refit: Refit
    whitened: Whitened
    specimens: Specimens
    scatter: Scatter
    alike: Whitened
    other_starts: tuple[FloatArray, ...] = ()
    screens_other_starts: bool = False
    signals: tuple[Column, ...] = ()
    held_out: tuple[RecordResidual, ...] = ()
    held_out_noises: tuple[NoiseModel, ...] = ()
    reference: FloatArray | None = None
    noises_of: NoiseEstimator = fitted_noises
    periodic: bool = True

    @property
    def model(self) -> CampaignModel:
        """The base law on the identify records."""
        return self.refit.model

    def view(self, name: str) -> RecordView:
        """Of a record, fitted or not, by its id."""
        return next(view for view in self.views if view.id == name)

    @property
    def parameters(self) -> FloatArray:
        """Shape (n_base,)."""
        return self.refit.parameters

    @property
    def before(self) -> FloatArray:
        """Parameters of the law that an explanation is compared with, shape (n_base,)."""
        return self.parameters if self.reference is None else self.reference

    @cached_property
    def errors(self) -> list[FloatArray]:
        """The identify records' residuals without outliers and their specimens' own deviations [MPa]."""
        clean = [self.whitened.clean(index) for index in range(len(self.whitened.records))]
        return [whole - own for whole, own in zip(clean, own_deviations(clean, self.whitened.noises), strict=True)]

    def residual_of(self, fit: Refit) -> list[FloatArray]:
        """What a refit of these records leaves of each, outliers set apart, shape (n_r,) [MPa]."""
        return self.without_outliers(fit.model, fit.model.residual(fit.parameters))

    def without_outliers(self, model: CampaignModel, residual: FloatArray) -> list[FloatArray]:
        """A residual of these records, shape (n_samples,) [MPa], by record and without outliers, each (n_r,) [MPa]."""
        noises = self.whitened.noises
        return [without_outliers(residual[model.rows(noise.name)], noise.outliers) for noise in noises]

    @property
    def misfit(self) -> tuple[float, float]:
        """Root mean square of the identify records' errors and of their noise, by the samples' weights [MPa]."""
        noises = self.whitened.noises
        floor = [noise.deviation for noise in noises]
        return float(np.sqrt(mean_square(self.errors, noises))), float(np.sqrt(mean_square(floor, noises)))

    @property
    def rough_MPa(self) -> float:
        """Root mean square of what the identify records scatter by from one sample to the next [MPa].

        As is stated with them, where that is more.
        """
        levels = [
            np.full(len(error), max(noise_level(view.sampled(view.time), error), view.record.noise.stress_MPa or 0.0))
            for view, error in zip(self.model.views, self.errors, strict=True)
        ]
        return float(np.sqrt(mean_square(levels, self.whitened.noises)))

    @cached_property
    def covariance(self) -> FloatArray:
        """Of the material's parameters, by noise with all of its drift and by specimens, shape (n_base, n_base)."""
        fit, whitened = self.refit, self.whitened
        solver = np.linalg.pinv(fit.jacobian)
        covariance = solver @ solver.T
        for noise, part in zip(whitened.noises, whitened.slices, strict=True):
            if noise.nuisance_drift is not None:
                moved = solver[:, part] @ noise.whiten(noise.nuisance_drift)
                covariance += moved @ moved.T
        slopes = fit.coordinates.slopes(fit.parameters)
        return np.asarray(covariance * np.outer(slopes, slopes))

    @cached_property
    def covariance_of_tested(self) -> FloatArray:
        """The same for the mean of the specimens that were tested, by noise alone, shape (n_base, n_base)."""
        fit = self.refit
        solver = np.linalg.pinv(fit.jacobian) * fit.coordinates.slopes(fit.parameters)[:, None]
        covariance = self.covariance.copy()
        for columns in self.of_specimens():
            moved = solver @ columns
            covariance -= moved @ moved.T
        return covariance

    @property
    def predicted_noises(self) -> tuple[NoiseModel, ...]:
        """`held_out_noises` with the scatter as noise: nothing is known of a specimen before it is tested."""
        return tuple(noise.with_specimen_as_noise() for noise in self.held_out_noises)

    @cached_property
    def discrepancy(self) -> Discrepancy:
        """Smooth waves over the identify records, along which a form may be wrong."""
        return Discrepancy.of(self.whitened, self.smooth_columns.matrix, periodic=self.periodic)

    @cached_property
    def columns(self) -> WhitenedColumns:
        """The signals in white coordinates."""
        return WhitenedColumns.of(self.signals, self.whitener, len(self.whitened))

    @cached_property
    def smooth_columns(self) -> WhitenedColumns:
        """The same of those that are not sharp."""
        return WhitenedColumns.of_smooth(self.signals, self.whitener, len(self.whitened))

    def screened(
        self,
        effects: Sequence[Effect],
        threads: int = 1,
        unsolved: Callable[[Cause, Exception], None] | None = None,
    ) -> BaseFit:
        """The same with the signals of these effects, without their variants; `unsolved` as in `screen`."""
        signals = screen(
            self.model,
            self.parameters,
            effects,
            threads=threads,
            unsolved=unsolved,
            only=for_a_test,
        )
        return replace(self, signals=tuple(signals))

    def extended(
        self, effects: Sequence[Effect], unsolved: Callable[[Cause, Exception], None] | None = None
    ) -> Extended:
        """Where a search for these effects may begin; `unsolved` as in `screen`."""
        return Extended(
            self.model,
            self.parameters,
            effects,
            self.whitener,
            self.refit.residual,
            self.refit.jacobian,
            unsolved=unsolved,
        )

    @property
    def uncertain_scatter(self) -> UncertainScatter | None:
        """The specimens' scatter as replicates leave it open, of the identify records; None where nothing is open."""
        ratios = self._scatter_ratios
        return None if ratios is None else UncertainScatter(tuple(self.of_specimens()), ratios)

    def uncertain_scatter_of(self, index: int, noise: NoiseModel) -> UncertainScatter | None:
        """The same of the specimen of a predicted record, whose deviations its noise holds."""
        ratios, columns = self._scatter_ratios, self.held_out[index].specimen
        return None if ratios is None or columns is None else UncertainScatter((noise.whiten(columns),), ratios)

    @property
    def _scatter_ratios(self) -> FloatArray | None:
        """Draws of the deviations over what was estimated, shape (n_draws, n_seen)."""
        if self.scatter.draws is None:
            return None
        size = np.array(self.scatter.deviations)
        return np.asarray(self.scatter.draws[:, size > 0.0] / size[size > 0.0])

    def of_specimens(self) -> list[FloatArray]:
        """What each specimen's deviations do to all identify records, of one standard deviation, white; (N, k)."""
        return _white_specimens(self.whitened.noises, self.whitener)

    @property
    def problem(self) -> Problem:
        """The base law on the identify records, without causes."""
        return self.refit.problem

    @property
    def whitener(self) -> Whitener:
        """Of the identify records."""
        return self.problem.whitener


def fit_law(law: GapLaw, campaign: Campaign, scheme: Scheme | SchemeName = "sa3") -> BaseFit:
    """Fit any law to the identify records of a campaign; `scheme` says whose difference of the strain is its rate."""
    chosen, steps = identifying(scheme)
    views = views_of(campaign, scheme=chosen, substeps=1 if steps == "auto" else steps)
    known = law if isinstance(law, DnlrLaw) else UsersLaw(law)
    return fit_views(known, views, campaign.specimens)


def fit_views(law: GapLaw, views: Sequence[RecordView], specimens: Specimens) -> BaseFit:
    """Fit any law to the views whose role is "identify": parameters, noise and the specimens' scatter in turns."""
    model = CampaignModel(law, [view for view in views if view.role == "identify"])
    parameters = law.start
    raw, jacobian = model.residual_and_jacobian(parameters)

    def residuals_of(model: CampaignModel, raw: FloatArray, jacobian: FloatArray) -> list[RecordResidual]:
        return [
            residual_of(
                view,
                raw[part],
                jacobian[part],
                given_noise=view.record.noise.stress_MPa,
                propagated=propagated_noise(law, view, parameters),
                wander=speed_wander(law, view, parameters),
            )
            for view, part in model.parts
        ]

    residuals = residuals_of(model, raw, jacobian)
    *_, (fit, noises, residuals) = _turns(model, parameters, residuals, fitted_noises(residuals))
    alike = Whitened.of(residuals, noises)
    columns = [] if specimens.alike else deviation_columns(model, fit.parameters)
    scatter = scatter_of(specimens, law, residuals, noises, columns)
    if scatter.any:
        plain, scattered = fit, with_scatter(residuals, columns, scatter)
        begun = fitted_noises(scattered)
        # Specimens that differ explain all that the law misses, or the law errs in another way. Then what they leave
        # leads the parameters astray, and the first turn that does so is the last.
        for turn in _turns(model, plain.parameters, scattered, begun):
            fit, noises, residuals = turn
            held = specimens_hold_the_gap(model, alike.noises, plain.parameters, fit.parameters)
            if held and _leaves_a_gap(fit):
                noises = begun
                fit = refit(Problem(model, Whitener(noises)), plain.parameters, most_steps=0)
                residuals = residuals_at(scattered, fit)
                break
    parameters = fit.parameters
    held_out: list[RecordResidual] = []
    if others := [view for view in views if view.role != "identify"]:
        rest = CampaignModel(law, others)
        held_out = residuals_of(rest, *rest.residual_and_jacobian(parameters))
        if scatter.any:
            held_out = with_scatter(held_out, deviation_columns(rest, parameters), scatter)
    # Effects that hand the force back to the strain must not be handed its noise.
    of_held_out = fitted_noises(held_out) if held_out else ()
    known = {noise.name: noise for noise in (*noises, *of_held_out)}
    quiet = CampaignModel(law, views).quietened(parameters, [known[view.id] for view in views]).views
    fitted = CampaignModel(law, [view for view in quiet if view.role == "identify"])
    return BaseFit(
        law=law,
        views=quiet,
        refit=replace(fit, problem=replace(fit.problem, model=fitted)),
        whitened=Whitened.of(residuals, noises),
        specimens=specimens,
        scatter=scatter,
        alike=alike,
        held_out=tuple(held_out),
        held_out_noises=of_held_out,
    )


def specimens_hold_the_gap(
    model: CampaignModel, alike: Sequence[NoiseModel], before: FloatArray, after: FloatArray
) -> bool:
    """Whether the records are missed by more after a refit in which specimens may differ.

    If that explains them, so it should be. If it leaves a gap, the law errs in another way. Deviations of many standard
    deviations cost little against a strong gap, and the misfit counts only along what they do not explain: the
    parameters follow that to values without meaning, and no search for an effect can begin there.

    Parameters
    ----------
    model : CampaignModel
    alike : sequence of NoiseModel
        By which the misfit is counted: of specimens that are alike.
    before, after : ndarray, shape (n_parameters,)
    """
    least, left = misfits(model, alike, (before, after))
    return left > NOISE.most_left_to_specimens * least


def misfits(model: CampaignModel, noises: Sequence[NoiseModel], places: Iterable[FloatArray]) -> list[float]:
    """Root of the sum of squares that each of several parameters leaves, in white coordinates [-]."""
    whitener = Whitener(tuple(noises))
    with np.errstate(over="ignore"):  # a misfit too large for a number is infinite
        return [float(np.linalg.norm(whitener.residual(model.residual(at)))) for at in places]


def _leaves_a_gap(fit: Refit) -> bool:
    """Whether more than noise and what specimens may differ by is left, as the noise weighs it."""
    return fit.chi_square > NOISE.left_beside_specimens * len(fit.residual)


def _white_specimens(noises: Sequence[NoiseModel], whitener: Whitener) -> list[FloatArray]:
    return [whitener.columns(columns) for columns in specimen_columns(noises, whitener.slices)]


def _turns(
    model: CampaignModel,
    parameters: FloatArray,
    residuals: Sequence[RecordResidual],
    noises: tuple[NoiseModel, ...],
) -> Iterator[tuple[Refit, tuple[NoiseModel, ...], list[RecordResidual]]]:
    """Parameters and noise in turns, until they settle: the refit, the noise it was made with, and the residuals there.

    They begin with parameters, and the residuals and their noise there.
    """
    for turn in range(MOST_TURNS):
        noises = fitted_noises(residuals) if turn else noises
        fit = refit(Problem(model, Whitener(noises)), parameters, most_steps=MOST_REFIT_STEPS)
        moved = np.abs(fit.parameters - parameters) / np.maximum(np.abs(parameters), 1e-300)
        parameters = fit.parameters
        residuals = residuals_at(residuals, fit)
        yield fit, noises, residuals
        if moved.size == 0 or float(moved.max()) < SETTLED:
            break


def with_joint_noise(base: BaseFit, explained: Refit) -> BaseFit:
    """The same with the noise as an explanation leaves it: a gap makes slow noise look larger than it is.

    As it is, where the law cannot be solved near the explanation.

    Parameters
    ----------
    base : BaseFit
    explained : Refit
        With the causes, on the same records.
    """
    try:
        records = residuals_at(base.whitened.records, explained)
        columns = deviation_columns(explained.model, explained.parameters) if base.scatter.any else []
    except UNSOLVABLE:
        return base
    if base.scatter.any:
        scatter = scatter_of(base.specimens, base.law, records, base.whitened.noises, columns)
        records = with_scatter(records, columns, scatter)
        base = replace(base, scatter=scatter)
    noises = base.noises_of(records)
    # With the scatter taken around an explanation the base law alone might run far away: it stays.
    steps = 0 if base.scatter.any else MOST_REFIT_STEPS
    fit = refit(replace(base.problem, whitener=Whitener(noises)), base.parameters, most_steps=steps)
    return replace(base, refit=fit, whitened=Whitened.of(residuals_at(records, fit), noises))


def residuals_at(residuals: Sequence[RecordResidual], found: Refit) -> list[RecordResidual]:
    """The same records at another fit, in the units of the data."""
    raw, jacobian = found.model.residual_and_jacobian(found.parameters)
    parts = [part for _, part in found.model.parts]
    return [
        replace(record, residual=raw[part], tangent=jacobian[part])
        for record, part in zip(residuals, parts, strict=True)
    ]
