"""From the law that was found to what is reported of it: errors, intervals, warnings."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from probation.identify.bias import bias_of
from probation.identify.covariance import Covariance
from probation.identify.ends import ends_of
from probation.identify.errors_by_strain_noise import strain_noise_warnings
from probation.identify.record_fit import RecordFit
from probation.identify.result import Fit
from probation.identify.scheme_error import scheme_error
from probation.identify.weighting import known_of
from probation.inference.information import correlation, estimated
from probation.inference.likelihood import log_likelihood, noise_parameters
from probation.inference.modal_law import DnlrLaw
from probation.inference.parameter import SYMBOLS, UNITS, Parameter, outside_name
from probation.noise.whiteness import correlation_lags
from probation.records.noise import noise_level
from probation.records.unlike_others import unlike_others
from probation.results.labelled import LabelledMatrix
from probation.settings.identification import IDENTIFICATION

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from probation.effects.record_view import RecordView
    from probation.identify.result import Intervals, Method
    from probation.identify.weighting import Weighted, Weighting
    from probation.inference.problem import Problem
    from probation.law.modal import Law
    from probation.law.schemes import Scheme
    from probation.noise.model import NoiseModel
    from probation.records.campaign import Campaign


def describe(
    campaign: Campaign,
    weighted: Weighted,
    scheme: Scheme,
    method: Method,
    weighting: Weighting,
    limits: Mapping[str, tuple[float, float]],
    intervals: Intervals,
) -> Fit:
    """What is known about the law that was found.

    Parameters
    ----------
    weighted : Weighted
        The law, and the noise that it was found with.
    method, weighting, intervals : str
        As the fit was asked for.
    limits : mapping of str to (float, float)
        Bounds of the parameters.
    """
    problem, law = weighted.problem, weighted.law
    known, jacobian = known_of(weighted)
    noises = problem.noises_at(weighted.parameters)
    free, names, values = problem.engine_law().free, law.parameter_names, law.parameters
    degrees = max(sum(problem.lengths) - len(free), 1)
    ends = ends_of(problem, weighted.parameters, limits)
    profiles = {}
    if intervals == "profile":
        from probation.identify.profile import profile  # noqa: PLC0415 - interpolation is slow to load

        quantile = float(stdtrit(degrees, 0.975))
        determined = [int(i) for i in free if names[i] not in ends.withdrawn]
        profiles = {names[i]: profile(weighted, known, i, quantile, limits) for i in determined}
    parameters: dict[str, Parameter] = {}
    warnings = [*campaign.warnings, *unlike_others(campaign.records)]
    for index, name in enumerate(names):
        value = float(values[index])
        if index not in free:
            parameters[name] = Parameter(name, value, None, None, "held", UNITS[name])
            continue
        position = int(np.flatnonzero(free == index)[0])
        error = None if name in ends.withdrawn else known.standard_error(position)
        relative = float(known.relative_error[position])
        parameter = estimated(name, value, error, relative, degrees, UNITS[name])
        if name in profiles:
            parameter = replace(parameter, interval95=profiles[name].interval95)
        parameters[name] = parameter
    warnings += ends.warnings
    if law.companion is not None:
        warned = ((view.id, law.companion.extrapolation(view.excitation.rate)) for view in problem.views)
        warnings += [f"{record}: {text}" for record, text in warned if text]
    warnings += _modulus_warnings(problem, law)
    if weighting == "plain":
        warnings += strain_noise_warnings(problem.views, law)
    largest_error, shift = scheme_error(problem, problem.views, weighted.parameters, jacobian, known)
    return Fit(
        campaign=campaign.name,
        law=law,
        scheme=scheme.name,
        start=scheme.start,
        substeps=problem.views[0].stride,
        method=method,
        weighting=_used(weighted),
        parameters=parameters,
        product=_product(known, problem, law, degrees, withdrawn=ends.product),
        names=tuple(names[i] for i in free),
        correlation=correlation(known.matrix),
        condition_number=known.condition_number,
        records={view.id: _record_fit(view, law, noise) for view, noise in zip(problem.views, noises, strict=True)},
        autocorrelated=known.correlated or any(noise.correlation != 0.0 for noise in noises),
        newey_west=known.correlated,
        scheme_error_MPa=largest_error,
        scheme_shift={names[index]: float(moved) for index, moved in zip(free, shift, strict=True)},
        profiles=profiles,
        covariance=_labelled(known, [names[i] for i in free], ends.withdrawn),
        log_likelihood=log_likelihood(problem, weighted.parameters),
        noise_parameters=noise_parameters(problem),
        warnings=tuple(warnings),
        data_sha256=campaign.data_hash,
    )


def _labelled(known: Covariance, names: Sequence[str], withdrawn: Collection[str]) -> LabelledMatrix:
    """The covariance by outside names; NaN for what has no standard error."""
    unknown = ~np.isfinite(known.relative_error) | np.array([name in withdrawn for name in names], dtype=bool)
    matrix = known.matrix.copy()
    matrix[unknown, :] = matrix[:, unknown] = np.nan
    return LabelledMatrix(tuple(outside_name(name) for name in names), matrix)


def _used(weighted: Weighted) -> str:
    problem = weighted.problem
    if problem.carries_strain_noise:
        return "strain-noise-frozen" if problem.moving is None else "strain-noise"
    if weighted.resampled is not None:
        return "plain, strain noise resampled"
    noises = problem.whitener.noises
    if all(noise.plain for noise in noises):
        return "plain"
    return "autocorrelated" if any(noise.correlation != 0.0 for noise in noises) else "varying"


def _record_fit(view: RecordView, law: Law, noise: NoiseModel) -> RecordFit:
    stress, sensitivity = (view.sampled(values) for values in DnlrLaw(law).sensitivity(view, law.parameters))
    record = view.record
    residual = stress - record.true_stress
    deviation = noise_level(record.time, residual)
    if not noise.plain and correlation_lags(noise.whiten(residual)) == 0:  # the noise model accounts for all of it
        deviation = float(np.sqrt(np.mean(residual**2)))
    long_run = deviation if noise.plain else noise.long_run
    bias = bias_of(residual, record.time, record.true_strain, long_run, noise.propagated)
    return RecordFit(
        record.id,
        record.time,
        record.true_strain,
        record.true_stress,
        view.excitation,
        stress,
        deviation,
        sensitivity,
        bias,
        noise.correlation,
        noise.carries_strain,
    )


def _product(known: Covariance, problem: Problem, law: Law, degrees: int, *, withdrawn: bool) -> Parameter:
    """E_u tau_max (or E_u alpha) and its standard error, to first order."""
    values = law.parameters
    free = problem.engine_law().free
    gradient = np.array([values[1], values[0], 0.0])[free]
    value = float(values[0] * values[1])
    variance = float(gradient @ known.matrix @ gradient)
    unit = "MPa·s" if law.companion is None else "MPa"
    moved = [p for p, index in enumerate(free) if index < 2]
    if not moved:
        return Parameter("product", value, None, None, "held", unit)
    if withdrawn or not np.all(np.isfinite(known.relative_error[moved])):
        return Parameter("product", value, None, None, "not_identifiable", unit)
    se = float(np.sqrt(max(variance, 0.0)))
    return estimated("product", value, se, se / abs(value) if value else np.inf, degrees, unit)


def _modulus_warnings(problem: Problem, law: Law) -> list[str]:
    """No solid is softer or stiffer: a slip of the units is likelier."""
    low, high = IDENTIFICATION.likely_moduli
    if 0 not in problem.engine_law().free or low <= law.unrelaxed_modulus <= high:
        return []
    return [
        f"{SYMBOLS['unrelaxed_modulus']} = {law.unrelaxed_modulus:.3g} MPa lies outside 1 kPa to 1 TPa: "
        "are the units of stress and strain right? probation preview shows how a file is read"
    ]
