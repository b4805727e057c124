"""`probation.fit`: identify the law's parameters on a campaign."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from scipy import stats

from probation._arrays import FloatArray, one_of
from probation._core import __version__
from probation.companion import from_settings
from probation.errors import InputError
from probation.excitation import Excitation, excite
from probation.excitation import Method as ExcitationMethod
from probation.identify.covariance import Covariance, correlation, covariance, status_of
from probation.identify.parameter import SYMBOLS, UNITS, Parameter, inside_name, outside_name
from probation.identify.problem import Problem, RecordProblem
from probation.identify.search import by_least_squares, by_simplex, first_guess
from probation.law import SCHEMES, Law, Scheme, Start
from probation.records import Campaign
from probation.records.noise import scatter

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from os import PathLike

    from matplotlib.figure import Figure

Method = Literal["least-squares", "variable-projection", "simplex"]
METHODS: tuple[Method, ...] = ("least-squares", "variable-projection", "simplex")

START = {"unrelaxed_modulus": 1000.0, "tau_max": 1.0, "alpha": 1.0, "hardening_modulus": 1.0}
"""Placeholders: variable projection needs no start."""


@dataclass(frozen=True, eq=False)
class RecordFit:
    """One record against the identified law.

    Attributes
    ----------
    id : str
    time, true_strain, true_stress : ndarray, shape (n_times,) [s], [-], [MPa]
        As measured.
    excitation : Excitation
        What drove the law.
    model_stress : ndarray, shape (n_times,) [MPa]
    sensitivity : ndarray, shape (n_times, 3) [MPa per unit]
        Along E_u, tau_max or alpha, G.
    noise_MPa : float
        Standard deviation of the high-frequency part of the fit residual.
    """

    id: str
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    excitation: Excitation
    model_stress: FloatArray
    sensitivity: FloatArray
    noise_MPa: float  # noqa: N815 - as it leaves the program

    @property
    def fit_residual(self) -> FloatArray:
        """Model minus data, shape (n_times,) [MPa]."""
        return self.model_stress - self.true_stress

    @property
    def rms_MPa(self) -> float:
        """Root mean square of the fit residual."""
        return float(np.sqrt(np.mean(self.fit_residual**2)))

    @property
    def max_MPa(self) -> float:
        """Largest fit residual."""
        return float(np.max(np.abs(self.fit_residual)))

    @property
    def bias_MPa(self) -> float:
        """What of the fit residual is not noise."""
        return float(np.sqrt(max(self.rms_MPa**2 - self.noise_MPa**2, 0.0)))

    def to_json(self) -> dict[str, Any]:
        """Numbers only."""
        return {
            "rms_MPa": self.rms_MPa,
            "max_MPa": self.max_MPa,
            "noise_MPa": self.noise_MPa,
            "bias_MPa": self.bias_MPa,
            "differentiator": self.excitation.differentiator,
            "strain_noise": self.excitation.strain_noise,
            "rate_jumps_s": [float(self.time[jump]) for jump in self.excitation.jumps],
        }


@dataclass(frozen=True, eq=False)
class Fit:
    """Parameters identified on a campaign, and what is known about them.

    Attributes
    ----------
    campaign : str
    law : Law
        With the identified parameters.
    scheme, start, method : str
    parameters : dict of str to Parameter
        By name: unrelaxed_modulus, tau_max or alpha, hardening_modulus.
    product : Parameter
        E_u times tau_max (or alpha): known far better than either.
    names : tuple of str
        Identified parameters, in the order of `correlation`.
    correlation : ndarray, shape (free, free)
    condition_number : float
        Of the scaled Jacobian.
    records : dict of str to RecordFit
    autocorrelated : bool
        Whether the fit residual is, which widens the standard errors.
    warnings : tuple of str
    data_sha256 : str
    """

    campaign: str
    law: Law
    scheme: Scheme
    start: Start
    method: Method
    parameters: dict[str, Parameter]
    product: Parameter
    names: tuple[str, ...]
    correlation: FloatArray
    condition_number: float
    records: dict[str, RecordFit]
    autocorrelated: bool
    warnings: tuple[str, ...] = field(default=())
    data_sha256: str = ""

    @property
    def rms_MPa(self) -> float:
        """Root mean square of the fit residual over all samples."""
        return float(np.sqrt(np.mean(np.concatenate([each.fit_residual for each in self.records.values()]) ** 2)))

    @property
    def noise_MPa(self) -> float:
        """Its high-frequency part."""
        weights = [len(each.time) for each in self.records.values()]
        return float(np.sqrt(np.average([each.noise_MPa**2 for each in self.records.values()], weights=weights)))

    @property
    def bias_MPa(self) -> float:
        """Its low-frequency part: what the law does not describe."""
        return float(np.sqrt(max(self.rms_MPa**2 - self.noise_MPa**2, 0.0)))

    @property
    def verdict(self) -> str:
        """One sentence."""
        poor = [p for p in self.parameters.values() if p.status not in ("identifiable", "held")]
        if self.bias_MPa > 2.0 * self.noise_MPa:
            times = self.bias_MPa / self.noise_MPa
            quality = f"the law leaves a bias of {self.bias_MPa:.3g} MPa, {times:.0f} times the noise"
        elif self.bias_MPa > self.noise_MPa:
            quality = f"the law leaves a bias of {self.bias_MPa:.3g} MPa, comparable to the noise"
        else:
            quality = "the law describes the records to within their noise"
        if not poor:
            return f"All parameters are identifiable; {quality}."
        names = ", ".join(f"{SYMBOLS[p.name]} ({p.status.replace('_', ' ')})" for p in poor)
        return f"Not all parameters are determined by these records: {names}; {quality}."

    def summary(self) -> str:
        """Verdict first, then numbers, then details."""
        lines = [f"{self.campaign}: {self.verdict}", ""]
        width = max(len(f"{SYMBOLS[n]} [{p.unit}]" if p.unit else SYMBOLS[n]) for n, p in self.parameters.items())
        for name, parameter in self.parameters.items():
            label = f"{SYMBOLS[name]} [{parameter.unit}]" if parameter.unit else SYMBOLS[name]
            lines.append(f"  {label:<{width}}  {_estimate(parameter)}")
        second = self.law.parameter_names[1]
        label = f"E_u·{SYMBOLS[second]}" + (f" [{self.product.unit}]" if self.product.unit else "")
        lines.append(f"  {label}  {_estimate(self.product)}")
        if len(self.names) > 1:
            lines += ["", "  correlations: " + ", ".join(self._correlations())]
        lines.append(f"  condition number of the scaled Jacobian: {self.condition_number:.3g}")
        lines += [
            "",
            f"  fit residual: rms {self.rms_MPa:.4g} MPa = noise {self.noise_MPa:.4g} + bias {self.bias_MPa:.4g} MPa",
        ]
        for each in self.records.values():
            lines.append(
                f"    {each.id}: rms {each.rms_MPa:.4g}, largest {each.max_MPa:.4g}, noise {each.noise_MPa:.4g} MPa; "
                f"rate: {each.excitation.differentiator}"
            )
        how = "autocorrelated fit residuals (Newey-West)" if self.autocorrelated else "white fit residuals"
        lines += ["", f"  {self.method}, scheme {self.scheme}, start {self.start}; standard errors for {how}"]
        lines += [f"  warning: {warning}" for warning in self.warnings]
        return "\n".join(lines)

    def _correlations(self) -> list[str]:
        return [
            f"{SYMBOLS[self.names[i]]}–{SYMBOLS[self.names[j]]} {self.correlation[i, j]:+.3f}"
            for i in range(len(self.names))
            for j in range(i)
        ]

    def to_dict(self) -> dict[str, Any]:
        """The answer in the form of the contract, `probation.fit/1`."""
        second = outside_name(self.law.parameter_names[1])
        return {
            "schema": "probation.fit/1",
            "version": __version__,
            "campaign": self.campaign,
            "data_sha256": self.data_sha256,
            "verdict": self.verdict,
            "scheme": self.scheme,
            "start": self.start,
            "method": self.method,
            "parameters": {outside_name(name): p.to_json() for name, p in self.parameters.items()},
            "products": {f"unrelaxed_modulus_MPa*{second}": self.product.to_json()},
            "correlation": {
                "names": [outside_name(name) for name in self.names],
                "matrix": self.correlation.tolist(),
            },
            "condition_number": self.condition_number if np.isfinite(self.condition_number) else None,
            "autocorrelated": self.autocorrelated,
            "residual": {"rms_MPa": self.rms_MPa, "noise_MPa": self.noise_MPa, "bias_MPa": self.bias_MPa},
            "records": {name: each.to_json() for name, each in self.records.items()},
            "warnings": list(self.warnings),
        }

    def to_json(self) -> str:
        """`to_dict` as text."""
        return json.dumps(self.to_dict(), indent=2, ensure_ascii=False, allow_nan=False) + "\n"

    def plot(self) -> Figure:
        """Stress against strain with the fit residuals below, as the paper's Figure 2."""
        from probation.report.fit_page import fit_figure  # noqa: PLC0415 - plotting only when asked for

        return fit_figure(self)

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a self-contained HTML page and return its path."""
        from probation.report.fit_page import write_fit_page  # noqa: PLC0415

        return write_fit_page(self, Path(path))


def fit(
    campaign: Campaign,
    scheme: Scheme = "be2",
    *,
    method: Method = "least-squares",
    hold: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    excitation: ExcitationMethod = "auto",
    start: Start = "exponential",
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
    excitation : {"auto", "raw", "spline"}
        Whether the strain is smoothed: "auto" does so where it is noisy.
    start : {"exponential", "backward_euler"}
        bE2's first step.
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
    law, held = _base_law(campaign, hold or {})
    limits = _limits(law, bounds or {})
    prepared = []
    for index, record in enumerate(campaign.identify):
        prepared.append(RecordProblem.prepare(record, excite(record, excitation), scheme, start))
        if progress:
            progress(0.3 * (index + 1) / len(campaign.identify))
    problem = Problem(law, prepared, held)
    if problem.held.all():
        raise InputError("all parameters are held; nothing is left to identify")

    best = first_guess(problem, limits, None if progress is None else lambda part: progress(0.3 + 0.5 * part))
    if len(prepared) > 1:
        problem.reweigh(best)
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
    known = covariance(jacobian[:, free], residual, [len(each.record) for each in problem.records], values[free])
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
    return Fit(
        campaign=campaign.name,
        law=law,
        scheme=scheme,
        start=start,
        method=method,
        parameters=parameters,
        product=_product(known, problem, law, degrees),
        names=tuple(names[i] for i in free),
        correlation=correlation(known.matrix),
        condition_number=known.condition_number,
        records=records,
        autocorrelated=known.correlated,
        warnings=tuple(warnings),
        data_sha256=campaign.data_hash,
    )


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
    reach = float(stats.t.ppf(0.975, degrees)) * se
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


def _estimate(parameter: Parameter) -> str:
    if parameter.status == "held":
        return f"{parameter.value:.6g} (held)"
    if parameter.se is None or parameter.interval95 is None:
        return f"{parameter.value:.4g}, not identifiable"
    digits = max(int(np.ceil(-np.log10(parameter.se))) + 1, 0) if parameter.se > 0.0 else 6
    relative = 100.0 * parameter.se / abs(parameter.value) if parameter.value else np.inf
    low, high = parameter.interval95
    status = parameter.status.replace("_", " ")
    return (
        f"{parameter.value:.{digits}f} ± {parameter.se:.{digits}f} ({relative:.2g} %), "
        f"95 % [{low:.{digits}f}, {high:.{digits}f}], {status}"
    )
