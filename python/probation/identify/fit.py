"""`probation.fit`: identify the law's parameters on a campaign."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy.special import stdtrit

from probation._arrays import FloatArray, one_of
from probation.companion import from_settings
from probation.errors import InputError
from probation.excitation import excite
from probation.identify.covariance import Covariance, correlation, covariance, status_of
from probation.identify.parameter import SYMBOLS, UNITS, Parameter, inside_name, outside_name
from probation.identify.problem import Problem, RecordProblem
from probation.identify.result import METHODS, Fit, Method, RecordFit
from probation.identify.search import by_least_squares, by_simplex, first_guess
from probation.law import SCHEMES, Law, Scheme, Start
from probation.records.noise import scatter

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from probation.excitation import Method as ExcitationMethod
    from probation.records import Campaign

START = {"unrelaxed_modulus": 1000.0, "tau_max": 1.0, "alpha": 1.0, "hardening_modulus": 1.0}
"""Placeholders: variable projection needs no start."""

NEGLIGIBLE = 0.1
"""Shift of a parameter by the scheme's own error that is let pass [standard errors]."""

CARRIED_NOISE = 0.3
"""Strain noise as stress, over the rms of the fit residual, from which on a fit warns that its errors leave it out."""

MOST_SUBSTEPS = 16
"""Most steps of the scheme from sample to sample that a fit takes by itself, on long records."""

ENOUGH_INSTANTS = 4000
"""On short records it may take more, up to this many instants in all: they cost next to nothing."""


def fit(
    campaign: Campaign,
    scheme: Scheme = "be2",
    *,
    method: Method = "least-squares",
    hold: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    excitation: ExcitationMethod = "auto",
    start: Start = "exponential",
    substeps: int | Literal["auto"] = "auto",
    progress: Callable[[float], None] | None = None,
) -> Fit:
    """Identify the law's parameters on the records with role "identify", which share them.

    Parameters
    ----------
    campaign : Campaign
    scheme : {"be2", "sa2", "sa3"}
        The schemes that have sensitivities.
    method : {"least-squares", "variable-projection", "simplex"}
        All find the same minimum; least-squares is the default.
    hold : dict of str to float, optional
        Parameters that are not identified, by name with unit ("unrelaxed_modulus_MPa"); on top of the campaign's own.
    bounds : dict of str to (float, float), optional
        By name with unit; every parameter is positive in any case.
    excitation : str
        Whether, and how, the strain is smoothed, one of `excitation.METHODS`: "auto" does so where it is noisy.
    start : {"exponential", "backward_euler"}
        bE2's first step.
    substeps : int or "auto"
        Steps of the scheme from sample to sample. 1 is the paper's; "auto" takes as many as it needs for its own error
        to shift no parameter by more than `NEGLIGIBLE` standard errors, up to `MOST_SUBSTEPS` (more on short records).
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
    one_of(scheme, "scheme", SCHEMES)
    one_of(method, "method", METHODS)
    if scheme in ("exact", "cvode"):
        raise InputError(f"scheme is {scheme!r}; identification needs sensitivities: use be2, sa2 or sa3")
    if substeps != "auto" and (not isinstance(substeps, int) or isinstance(substeps, bool) or substeps < 1):
        raise InputError(f"substeps is {substeps!r}; expected 'auto' or a whole number of at least 1")
    law, held = _base_law(campaign, hold or {})
    limits = _limits(law, bounds or {})
    prepared = []
    for index, record in enumerate(campaign.identify):
        steps = 1 if substeps == "auto" else substeps
        prepared.append(RecordProblem.prepare(record, excite(record, excitation), scheme, start, steps))
        if progress:
            progress(0.3 * (index + 1) / len(campaign.identify))
    problem = Problem(law, prepared, held)
    if problem.held.all():
        raise InputError("all parameters are held; nothing is left to identify")

    adapting = substeps == "auto" and scheme != "sa3"
    if adapting:  # a coarse record's best fit by the scheme may be far off, where its error says nothing
        problem.records = tuple(each.reference() for each in prepared)
    best = first_guess(problem, limits, None if progress is None else lambda part: progress(0.3 + 0.5 * part))
    if len(prepared) > 1:
        problem.reweigh(best)
        best = first_guess(problem, limits)
    if adapting:
        needed = _needed_substeps(problem, prepared, best)
        problem.records = tuple(each.with_substeps(needed) for each in prepared)
        best = first_guess(problem, limits)
    if method == "least-squares":
        best = by_least_squares(problem, best, limits)
    elif method == "simplex":
        best = by_simplex(problem, best, limits)
    if progress:
        progress(1.0)
    return _describe(campaign, problem, best, scheme, start, method, limits)


def _base_law(campaign: Campaign, hold: Mapping[str, float]) -> tuple[Law, tuple[bool, bool, bool]]:
    settings = campaign.law
    companion = from_settings(settings.companion)
    names = ("unrelaxed_modulus", "tau_max" if companion is None else "alpha", "hardening_modulus")
    values = {name: START[name] for name in names}
    fixed = {**settings.fixed, **hold}
    for outside, value in fixed.items():
        inside = inside_name(outside)
        if inside not in names:
            expected = ", ".join(outside_name(name) for name in names)
            raise InputError(f"hold: {outside!r} is not a parameter of this law; expected one of {expected}")
        values[inside] = float(value)
    law = Law(
        unrelaxed_modulus=values["unrelaxed_modulus"],
        hardening_modulus=values["hardening_modulus"],
        tau_max=values.get("tau_max"),
        alpha=values.get("alpha"),
        modes=settings.modes,
        decades=settings.decades,
        companion=companion,
    )
    held = tuple(outside_name(name) in fixed for name in names)
    return law, (held[0], held[1], held[2])


def _limits(law: Law, bounds: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    limits = dict.fromkeys(law.parameter_names, (0.0, np.inf))
    for outside, ends in bounds.items():
        inside = inside_name(outside)
        if inside not in limits:
            expected = ", ".join(outside_name(name) for name in limits)
            raise InputError(f"bounds: {outside!r} is not a parameter of this law; expected one of {expected}")
        low, high = float(ends[0]), float(ends[1])
        if not 0.0 <= low < high:
            raise InputError(f"bounds of {outside} are ({low}, {high}); expected 0 <= lower < upper")
        limits[inside] = (low, high)
    return limits


def _describe(
    campaign: Campaign,
    problem: Problem,
    law: Law,
    scheme: Scheme,
    start: Start,
    method: Method,
    limits: Mapping[str, tuple[float, float]],
) -> Fit:
    records = {each.record.id: _record_fit(each, law) for each in problem.records}
    residual, jacobian = problem.residual_and_jacobian(law)
    free, names = problem.free, law.parameter_names
    values = law.parameters
    known = _covariance(problem, law, residual, jacobian)
    degrees = max(len(residual) - len(free), 1)
    parameters: dict[str, Parameter] = {}
    warnings = list(campaign.warnings)
    for index, name in enumerate(names):
        if problem.held[index]:
            parameters[name] = Parameter(name, float(values[index]), None, None, "held", UNITS[name])
            continue
        position = int(np.flatnonzero(free == index)[0])
        at_bound = not limits[name][0] < values[index] * (1 + 1e-9) < limits[name][1] or values[index] == 0.0
        parameters[name] = _parameter(
            name,
            float(values[index]),
            known.standard_error(position),
            float(known.relative_error[position]),
            degrees,
            UNITS[name],
        )
        if at_bound:
            warnings.append(f"{SYMBOLS[name]} ended at its bound, {values[index]:.6g} {UNITS[name]}".rstrip())
    warnings += _rate_warnings(problem, law)
    warnings += _strain_noise_warnings(problem, law)
    scheme_error, shift = _scheme_error(problem, problem.records, law, jacobian, known)
    return Fit(
        campaign=campaign.name,
        law=law,
        scheme=scheme,
        start=start,
        substeps=problem.records[0].substeps,
        method=method,
        parameters=parameters,
        product=_product(known, problem, law, degrees),
        names=tuple(names[i] for i in free),
        correlation=correlation(known.matrix),
        condition_number=known.condition_number,
        records=records,
        autocorrelated=known.correlated,
        scheme_error_MPa=scheme_error,
        scheme_shift={names[index]: float(moved) for index, moved in zip(free, shift, strict=True)},
        warnings=tuple(warnings),
        data_sha256=campaign.data_hash,
    )


def _strain_noise_warnings(problem: Problem, law: Law) -> list[str]:
    """Where strain noise, carried to the stress by the hardening, is not small beside what else is in the residual."""
    found = []
    for each in problem.records:
        end = float(np.max(np.abs(each.record.true_strain)))
        slope = law.hardening_modulus * (2.0 * np.exp(2.0 * end) + np.exp(-end))  # G d e_HT / d e, eq. (3)
        carried = each.excitation.strain_noise * slope
        left = float(np.sqrt(np.mean((each.stress(law) - each.record.true_stress) ** 2)))
        if carried > CARRIED_NOISE * max(each.noise, left):
            found.append(
                f"{each.record.id}: strain noise of {each.excitation.strain_noise:.2g} amounts to {carried:.2g} MPa at "
                "the largest strain; the standard errors, that of G above all, do not include it"
            )
    return found


def _covariance(problem: Problem, law: Law, residual: FloatArray, jacobian: FloatArray) -> Covariance:
    free = problem.free
    lengths = [len(each.record) for each in problem.records]
    return covariance(jacobian[:, free], residual, lengths, law.parameters[free])


def _scheme_error(
    problem: Problem, records: Sequence[RecordProblem], law: Law, jacobian: FloatArray, known: Covariance
) -> tuple[float, FloatArray]:
    """How far the scheme of `records` is from SA3 [MPa], and what that does to the parameters, in standard errors."""
    free = problem.free
    errors = [each.stress(law) - each.reference().stress(law) for each in records]
    weighted = np.concatenate([weight * error for weight, error in zip(problem.weights, errors, strict=True)])
    size = np.where(law.parameters[free] != 0.0, np.abs(law.parameters[free]), 1.0)
    moved = -np.linalg.lstsq(jacobian[:, free] * size, weighted, rcond=1e-12)[0] * size
    deviation = np.sqrt(np.diag(known.matrix))
    shift = np.divide(moved, deviation, out=np.zeros_like(moved), where=deviation > 0.0)
    return max(float(np.max(np.abs(error))) for error in errors), shift


def _needed_substeps(problem: Problem, records: Sequence[RecordProblem], law: Law) -> int:
    """Steps from sample to sample that make the error of the scheme, of order 2, negligible for every parameter.

    `problem` is solved by SA3, `law` its best one: the scheme's error in the fit residual would widen the standard
    errors that it is measured in.
    """
    residual, jacobian = problem.residual_and_jacobian(law)
    known = _covariance(problem, law, residual, jacobian)
    most = max(MOST_SUBSTEPS, ENOUGH_INSTANTS // max(len(each.record) for each in records))
    steps = 1
    while True:  # once would do, were the steps always short enough for the order to show
        shift = _scheme_error(problem, [each.with_substeps(steps) for each in records], law, jacobian, known)[1]
        worst = float(np.max(np.abs(shift), initial=0.0))
        if worst <= NEGLIGIBLE or steps >= most:
            return steps
        steps = min(max(int(np.ceil(steps * np.sqrt(worst / NEGLIGIBLE))), steps + 1), most)


def _record_fit(each: RecordProblem, law: Law) -> RecordFit:
    stress, sensitivity = each.sensitivity(law)
    record = each.record
    noise = scatter(record.time, stress - record.true_stress)
    return RecordFit(
        record.id, record.time, record.true_strain, record.true_stress, each.excitation, stress, sensitivity, noise
    )


def _parameter(name: str, value: float, se: float | None, relative_error: float, degrees: int, unit: str) -> Parameter:
    if se is None:
        return Parameter(name, value, None, None, "not_identifiable", unit)
    reach = float(stdtrit(degrees, 0.975)) * se
    return Parameter(name, value, se, (value - reach, value + reach), status_of(relative_error), unit)


def _product(known: Covariance, problem: Problem, law: Law, degrees: int) -> Parameter:
    """E_u tau_max (or E_u alpha) and its standard error, to first order."""
    values = law.parameters
    gradient = np.array([values[1], values[0], 0.0])[problem.free]
    value = float(values[0] * values[1])
    variance = float(gradient @ known.matrix @ gradient)
    unit = "MPa·s" if law.companion is None else "MPa"
    moved = [p for p, index in enumerate(problem.free) if index < 2]
    if not moved:
        return Parameter("product", value, None, None, "held", unit)
    if not np.all(np.isfinite(known.relative_error[moved])):
        return Parameter("product", value, None, None, "not_identifiable", unit)
    se = float(np.sqrt(max(variance, 0.0)))
    return _parameter("product", value, se, se / abs(value) if value else np.inf, degrees, unit)


def _rate_warnings(problem: Problem, law: Law) -> list[str]:
    if law.companion is None:
        return []
    found = []
    for each in problem.records:
        outside = law.companion.outside(each.excitation.rate)
        if outside and law.companion.calibrated:
            low, high = law.companion.calibrated
            found.append(
                f"{each.record.id}: strain rates {outside[0]:.2g} to {outside[1]:.2g} 1/s leave the range in which the "
                f"companion relation is calibrated, {low:.2g} to {high:.2g} 1/s"
            )
    return found
