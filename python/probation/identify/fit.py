"""`probation.fit`: identify the law's parameters on a campaign."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation._arrays import one_of
from probation.effects.registry import effects
from probation.errors import InputError
from probation.identify.base import base_fit
from probation.identify.base_law import base_law
from probation.identify.describe import describe
from probation.identify.given import given
from probation.identify.result import INTERVALS, METHODS, Fit, Intervals, Method
from probation.identify.scattered import with_scatter
from probation.identify.scheme_error import needed_substeps
from probation.identify.search import by_least_squares, by_simplex, first_guess, search_range
from probation.identify.weighting import WEIGHTINGS, Weighted, Weighting, weigh
from probation.inference.gap import Gap, find_gap
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.parameter import by_inside_name, outside_name
from probation.inference.problem import Problem
from probation.inference.thinning import thin
from probation.inference.unsolvable import UNSOLVABLE
from probation.law.modal import Law
from probation.law.schemes import Scheme, SchemeName, identifying
from probation.progress import Part, shows_progress
from probation.records.as_tested import as_tested
from probation.smoothing.excitation import excite_each

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from probation.inference.base_fit import BaseFit
    from probation.records.campaign import Campaign
    from probation.smoothing.methods import Method as ExcitationMethod
PARAMETERS = 3
"""Of the law: E_u, tau_max or alpha, G."""


@shows_progress
def fit(
    campaign: Campaign,
    scheme: Scheme | SchemeName = "be2",
    *,
    method: Method = "least-squares",
    hold: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    excitation: ExcitationMethod = "auto",
    substeps: int | Literal["auto"] = "auto",
    weighting: Weighting = "auto",
    intervals: Intervals = "standard-error",
    gap: bool = True,
    progress: Callable[[float], None] | None = None,
) -> Fit:
    """Identify the law's parameters on the records with role "identify", which share them.

    Parameters
    ----------
    campaign : Campaign
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
        The schemes that have sensitivities. How many steps it takes is `substeps`, or said by ``SA3(substeps=4)``.
    method : {"least-squares", "variable-projection", "simplex"}
        All find the same minimum; least-squares is the default.
    hold : dict of str to float, optional
        Parameters that are not identified, by name with unit ("unrelaxed_modulus_MPa"); on top of the campaign's own.
    bounds : dict of str to (float, float), optional
        By name with unit; every parameter is positive in any case.
    excitation : str
        Whether, and how, the strain is smoothed, one of `excitation.METHODS`: "auto" does so where it is noisy.
    substeps : int or "auto"
        Steps of the scheme from sample to sample. 1 is the paper's; "auto" takes as many as it needs for its own error
        to shift no parameter by more than a tenth of its standard error, up to 16 (more on short records).
    weighting : {"auto", "plain", "strain-noise", "strain-noise-frozen"}
        How the fit residuals are weighed. "plain": white noise of the stress alone. "strain-noise": the noise of the
        strain, too, as the law propagates it to the stress, re-evaluated as the parameters move; "strain-noise-frozen"
        leaves it at the plain estimate, which is biased and here to be shown so. "auto": "strain-noise" where that
        noise is more than 0.3 of the rest of any parameter's standard error, else "plain". All but "plain" see stress
        noise that is autocorrelated or varies along a record, too. Of a record of more than 3000 samples the strain
        noise goes into the standard errors only, by drawing the strain again.
    intervals : {"standard-error", "profile"}
        Where the 95 % intervals come from; "profile": the likelihood, the other parameters profiled out.
    gap : bool
        Whether to test, too, if more than noise is left of the records, as `diagnose` and `certify` do. It is a test of
        the law: none is done with bounds, or where the strain is smoothed in a way of your own.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    Fit

    Raises
    ------
    InputError
        For an unknown name, a bound that is not possible, or nothing left to identify.
    """
    chosen, substeps = identifying(scheme, substeps)
    one_of(method, "method", METHODS)
    one_of(weighting, "weighting", WEIGHTINGS)
    one_of(intervals, "intervals", INTERVALS)
    if substeps != "auto" and (not isinstance(substeps, int) or isinstance(substeps, bool) or substeps < 1):
        raise InputError(f"substeps is {substeps!r}; expected 'auto' or a whole number of at least 1")
    campaign = as_tested(campaign)
    law, held = base_law(campaign.law, hold or {})
    limits = _limits(law, bounds or {})
    views = []
    steps = 1 if substeps == "auto" else substeps
    driven = excite_each(campaign.identify, excitation, further=campaign.held_out)
    for index, (record, drive) in enumerate(zip(campaign.identify, driven, strict=True)):
        views.append(measured_view(record, drive, chosen, steps))
        if progress:
            progress(Part(0.3 * (index + 1) / len(campaign.identify), f"smoothed {record.id}"))
    problem = Problem.white(DnlrLaw(law, held), views)
    if not problem.law.parameter_names:
        raise InputError(
            f"campaign {campaign.name!r}: found every parameter held (law.fixed, --hold), expected one left to "
            "identify; probation certify predicts with a law that is given"
        )
    searched = {**limits, law.parameter_names[1]: search_range(problem, limits)}
    adapting = substeps == "auto" and chosen.name != "sa3"
    advance = (lambda part: progress(Part(0.3 + 0.5 * part, "searching the parameters"))) if progress else None
    plain = _least_squares(problem, method, searched, adapting, advance)
    weighted = plain
    if weighting != "plain":
        weighted = weigh(plain.problem, plain.parameters, weighting, searched, excitation)
        if adapting and weighted.problem.carries_strain_noise:
            # The scheme's error weighs otherwise once the residual is whitened, and may need more substeps.
            taken = weighted.problem.views[0].stride
            needed = needed_substeps(weighted, weighted.problem.views, taken)
            if needed > taken:
                finer = plain.problem.with_views(view.with_substeps(needed) for view in plain.problem.views)
                weighted = weigh(finer, weighted.parameters, weighting, searched, excitation)
    if progress:
        progress(Part(0.9, "standard errors, the test for a gap"))
    fitted = describe(campaign, weighted, chosen, method, weighting, limits, intervals)
    if gap and not bounds and excitation == "auto":
        fitted = _judged(fitted, campaign, hold)
    if progress:
        progress(1.0)
    return fitted


def plain_fit(campaign: Campaign, scheme: Scheme | SchemeName = "sa3", hold: Mapping[str, float] | None = None) -> Fit:
    """The law fitted without weights, as it is where nothing is left to identify: where a base fit begins.

    Parameters
    ----------
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
    hold : dict of str to float, optional
        As in `fit`.
    """
    if len(campaign.law.fixed) == PARAMETERS and not hold:
        return given(campaign, scheme)
    return fit(campaign, scheme, hold=hold, weighting="plain", method="variable-projection", gap=False)


def gap_of(campaign: Campaign) -> Gap | None:
    """Whether the campaign's law departs from its records: the test of `probation.diagnose` with its defaults.

    Returns
    -------
    Gap or None
        None where the records are too few or too odd for the test.
    """
    try:
        return find_gap(_base_of(campaign), effects())
    except UNSOLVABLE:
        return None


def _judged(fitted: Fit, campaign: Campaign, hold: Mapping[str, float] | None) -> Fit:
    """The fit with the test for a gap, and its errors with what replicates show of the specimens' scatter."""
    try:
        base = _base_of(campaign, hold)
        return with_scatter(replace(fitted, gap=find_gap(base, effects(), predicted=False)), base)
    except UNSOLVABLE:
        return fitted


def _base_of(campaign: Campaign, hold: Mapping[str, float] | None = None) -> BaseFit:
    few = thin(as_tested(campaign))[0]
    return base_fit(few, plain_fit(few, hold=hold)).screened(effects())


def _least_squares(
    problem: Problem,
    method: Method,
    limits: Mapping[str, tuple[float, float]],
    adapting: bool,
    progress: Callable[[float], None] | None,
) -> Weighted:
    """The best law with white noise; `adapting` takes as many substeps as it needs."""
    views = problem.views
    if adapting:  # a coarse record's best fit by the scheme may be far off, where its error says nothing
        problem = problem.with_views(view.with_scheme("sa3") for view in views)
    best = first_guess(problem, limits, progress)
    if len(views) > 1:
        problem = problem.reweighed(best)
        best = first_guess(problem, limits)
    if adapting:
        needed = needed_substeps(Weighted(problem, best), views)
        problem = problem.with_views(view.with_substeps(needed) for view in views)
        best = first_guess(problem, limits, near=best)
    if method == "least-squares":
        best = by_least_squares(problem, best, limits)
    elif method == "simplex":
        best = by_simplex(problem, best, limits)
    return Weighted(problem, best)


def _limits(law: Law, bounds: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    limits = dict.fromkeys(law.parameter_names, (0.0, np.inf))
    for name, ends in by_inside_name(bounds, law.parameter_names, "bounds").items():
        low, high = float(ends[0]), float(ends[1])
        if not 0.0 <= low < high:
            raise InputError(f"bounds of {outside_name(name)} are ({low}, {high}); expected 0 <= lower < upper")
        limits[name] = (low, high)
    return limits
