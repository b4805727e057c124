"""What `probation.fit` found: parameters, what is known about them, and what is left of the records."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from probation.answers import json_answer
from probation.identify.modelled_record import ModelledRecord
from probation.inference.parameter import SYMBOLS, Parameter, outside_name
from probation.law.answer import law_answer
from probation.report.estimate import percentage

if TYPE_CHECKING:
    from os import PathLike

    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.identify.bias import Bias
    from probation.identify.profile import Profile
    from probation.law.modal import Law
    from probation.law.schemes import SchemeName, Start

Method = Literal["least-squares", "variable-projection", "simplex"]
METHODS: tuple[Method, ...] = ("least-squares", "variable-projection", "simplex")


@dataclass(frozen=True, eq=False)
class RecordFit(ModelledRecord):
    """One record against the identified law.

    Its `noise_MPa` is the high-frequency part of the fit residual; all of it where the noise model (AR(1), strain
    noise) leaves nothing else.

    Attributes
    ----------
    sensitivity : ndarray, shape (n_times, 3) [MPa per unit]
        Along E_u, tau_max or alpha, G.
    bias : Bias
        The low-frequency part: size and place.
    noise_correlation : float
        Of AR(1) stress noise from sample to sample; 0 where none was found.
    strain_noise_weighed : bool
        Whether the residual was weighed for the strain's noise.
    """

    sensitivity: FloatArray
    bias: Bias
    noise_correlation: float = 0.0
    strain_noise_weighed: bool = False

    def to_json(self) -> dict[str, Any]:
        """Numbers only."""
        return {
            "rms_MPa": self.rms_MPa,
            "max_MPa": self.max_MPa,
            "noise_MPa": self.noise_MPa,
            "bias_MPa": self.bias_MPa,
            **self.bias.to_json(),
            "noise_correlation": self.noise_correlation,
            "strain_noise_weighed": self.strain_noise_weighed,
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
    substeps : int
        Steps of the scheme from sample to sample.
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
    weighting : str
        How the fit residual was weighed: "plain", "autocorrelated" (AR(1)), "strain-noise", "strain-noise-frozen", or
        "plain, strain noise resampled" on records too long for a matrix.
    autocorrelated : bool
        Whether the fit residual is, which widens the standard errors.
    newey_west : bool
        Whether what is left of that after whitening widens them.
    profiles : dict of str to Profile
        Where the intervals are those of the profile likelihood.
    scheme_error_MPa : float
        How far the scheme is from SA3 at most: its own error, not the law's.
    scheme_shift : dict of str to float
        What that error does to the identified parameters, in standard errors, to first order.
    warnings : tuple of str
    data_sha256 : str
    """

    campaign: str
    law: Law
    scheme: SchemeName
    start: Start
    substeps: int
    method: Method
    parameters: dict[str, Parameter]
    product: Parameter
    names: tuple[str, ...]
    correlation: FloatArray
    condition_number: float
    records: dict[str, RecordFit]
    autocorrelated: bool
    weighting: str = "plain"
    newey_west: bool = False
    profiles: dict[str, Profile] = field(default_factory=dict)
    scheme_error_MPa: float = 0.0  # noqa: N815 - as it leaves the program
    scheme_shift: dict[str, float] = field(default_factory=dict)
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
    def noise_text(self) -> str:
        """What the standard errors take the noise for, in words."""
        what = {
            "plain": "white noise of the stress",
            "autocorrelated": "autocorrelated noise of the stress",
            "strain-noise": "noise of the stress, and of the strain as the law carries it there",
            "strain-noise-frozen": "noise of the stress and, at the plain estimate, of the strain",
            "plain, strain noise resampled": "white noise of the stress, and that of the strain drawn again",
        }[self.weighting]
        correlated = [each for each in self.records.values() if each.noise_correlation > 0.0]
        if correlated:
            what += ", AR(1) " + ", ".join(f"{each.noise_correlation:.2f} ({each.id})" for each in correlated)
        if self.newey_west:
            what += "; autocorrelated fit residuals (Newey-West)"
        intervals = "; intervals from the profile likelihood" if self.profiles else ""
        return f"standard errors for {what}{intervals}"

    @property
    def verdict(self) -> str:
        """One sentence."""
        poor = [p for p in self.parameters.values() if p.status not in ("identifiable", "held")]
        largest = max(float(np.max(np.abs(each.true_stress))) for each in self.records.values())
        part = percentage(self.bias_MPa / largest)
        bias = f"the law leaves a bias of {self.bias_MPa:.3g} MPa ({part} % of the largest stress)"
        if self.bias_MPa > 2.0 * self.noise_MPa:
            quality = f"{bias}, {self.bias_MPa / self.noise_MPa:.0f} times the noise"
        elif self.bias_MPa > self.noise_MPa:
            quality = f"{bias}, comparable to the noise"
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
            lines.append(f"  {label:<{width}}  {estimate_text(parameter)}, {parameter.status.replace('_', ' ')}")
        second = self.law.parameter_names[1]
        label = f"E_u·{SYMBOLS[second]}" + (f" [{self.product.unit}]" if self.product.unit else "")
        lines.append(f"  {label}  {estimate_text(self.product)}, {self.product.status.replace('_', ' ')}")
        if len(self.names) > 1:
            lines += ["", "  correlations: " + ", ".join(self._correlations())]
        lines.append(f"  condition number of the scaled Jacobian: {self.condition_number:.3g}")
        lines += [
            "",
            f"  fit residual [MPa]: rms {self.rms_MPa:.4g}, noise {self.noise_MPa:.4g}, bias {self.bias_MPa:.4g}",
        ]
        for each in self.records.values():
            lines.append(
                f"    {each.id}: rms {each.rms_MPa:.4g}, largest {each.max_MPa:.4g}, noise {each.noise_MPa:.4g} MPa; "
                f"rate: {each.excitation.differentiator}"
            )
            lines.append(f"      {each.bias.text}")
        if self.scheme_shift:
            worst = max(self.scheme_shift, key=lambda name: abs(self.scheme_shift[name]))
            shift = self.scheme_shift[worst]
            lines.append(
                f"  error of the scheme itself: up to {self.scheme_error_MPa:.2g} MPa, "
                f"shifts {SYMBOLS[worst]} by {shift:+.2g} standard errors"
                + ("; use sa3, or sample more finely" if abs(shift) > 0.5 else "")
            )
        steps = f", {self.substeps} steps from sample to sample" if self.substeps > 1 else ""
        lines += ["", f"  {self.method}, scheme {self.scheme}{steps}, start {self.start}", f"  {self.noise_text}"]
        lines += [f"  warning: {warning}" for warning in self.warnings]
        return "\n".join(lines)

    def _correlations(self) -> list[str]:
        return [
            f"{SYMBOLS[self.names[i]]}–{SYMBOLS[self.names[j]]} {self.correlation[i, j]:+.3f}"
            for i in range(len(self.names))
            for j in range(i)
        ]

    def to_dict(self) -> dict[str, Any]:
        """The answer in the form of the contract, `probation.fit/1`, as Python objects."""
        second = outside_name(self.law.parameter_names[1])
        identified = {name: p for name, p in self.parameters.items() if p.status != "held"}
        return {
            "campaign": self.campaign,
            "data_sha256": self.data_sha256,
            "verdict": self.verdict,
            "scheme": self.scheme,
            "start": self.start,
            "substeps": self.substeps,
            "method": self.method,
            "parameters": {outside_name(name): p.to_json() for name, p in identified.items()},
            "law": law_answer(self.law),
            "fixed": {outside_name(n): p.value for n, p in self.parameters.items() if p.status == "held"},
            "products": {f"unrelaxed_modulus_MPa*{second}": self.product.to_json()},
            "correlation": {"names": [outside_name(name) for name in self.names], "matrix": self.correlation},
            "condition_number": self.condition_number,
            "weighting": self.weighting,
            "intervals": "profile" if self.profiles else "standard-error",
            "autocorrelated": self.autocorrelated,
            "residual": {"rms_MPa": self.rms_MPa, "noise_MPa": self.noise_MPa, "bias_MPa": self.bias_MPa},
            "scheme_error": {
                "max_MPa": self.scheme_error_MPa,
                "shift_in_se": {outside_name(name): shift for name, shift in self.scheme_shift.items()},
            },
            "records": {name: each.to_json() for name, each in self.records.items()},
            "warnings": list(self.warnings),
        }

    def to_json(self) -> str:
        """The answer as JSON text."""
        return json_answer("probation.fit/1", self.to_dict())

    def plot(self) -> Figure:
        """Stress against strain with the fit residuals below, as the paper's Figure 2."""
        from probation.report.fit_page import fit_figure  # noqa: PLC0415 - plotting only when asked for

        return fit_figure(self)

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a self-contained HTML page and return its path."""
        from probation.report.fit_page import write_fit_page  # noqa: PLC0415

        return write_fit_page(self, Path(path))


def estimate_text(parameter: Parameter) -> str:
    """Value, standard error and interval with the digits that mean something."""
    if parameter.se is None or parameter.interval95 is None:
        return f"{parameter.value:.6g}"
    digits = max(int(np.ceil(-np.log10(parameter.se))) + 1, 0) if parameter.se > 0.0 else 6
    relative = percentage(parameter.se / abs(parameter.value) if parameter.value else np.inf)
    low, high = parameter.interval95
    return (
        f"{parameter.value:.{digits}f} ± {parameter.se:.{digits}f} ({relative} %), "
        f"95 % [{low:.{digits}f}, {high:.{digits}f}]"
    )
