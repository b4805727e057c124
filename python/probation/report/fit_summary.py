"""A fit in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.parameter import SYMBOLS, Parameter
from probation.wording import percentage

if TYPE_CHECKING:
    from probation.identify.result import Fit


def fit_summary(fit: Fit) -> str:
    """Verdict first, then numbers, then details."""
    lines = [f"{fit.campaign}: {fit.verdict}", ""]
    width = max(len(f"{SYMBOLS[n]} [{p.unit}]" if p.unit else SYMBOLS[n]) for n, p in fit.parameters.items())
    for name, parameter in fit.parameters.items():
        label = f"{SYMBOLS[name]} [{parameter.unit}]" if parameter.unit else SYMBOLS[name]
        lines.append(f"  {label:<{width}}  {estimate_text(parameter)}, {parameter.status.replace('_', ' ')}")
    second = fit.law.parameter_names[1]
    label = f"E_u·{SYMBOLS[second]}" + (f" [{fit.product.unit}]" if fit.product.unit else "")
    lines.append(f"  {label}  {estimate_text(fit.product)}, {fit.product.status.replace('_', ' ')}")
    if len(fit.names) > 1:
        lines += ["", "  correlations: " + ", ".join(_correlations(fit))]
    lines.append(f"  condition number of the scaled Jacobian: {fit.condition_number:.3g}")
    lines += [
        "",
        f"  fit residual [MPa]: rms {fit.rms_MPa:.4g}, noise {fit.noise_MPa:.4g}, bias {fit.bias_MPa:.4g}",
    ]
    for record in fit.records.values():
        lines.append(
            f"    {record.id}: rms {record.rms_MPa:.4g}, largest {record.max_MPa:.4g}, noise "
            f"{record.noise_MPa:.4g} MPa; rate: {record.excitation.differentiator}"
        )
        lines.append(f"      {record.bias.text}")
    if fit.scheme_shift:
        worst = max(fit.scheme_shift, key=lambda name: abs(fit.scheme_shift[name]))
        shift = fit.scheme_shift[worst]
        lines.append(
            f"  error of the scheme itself: up to {fit.scheme_error_MPa:.2g} MPa, "
            f"shifts {SYMBOLS[worst]} by {shift:+.2g} standard errors"
            + ("; use sa3, or sample more finely" if abs(shift) > 0.5 else "")
        )
    steps = f", {fit.substeps} steps from sample to sample" if fit.substeps > 1 else ""
    lines += ["", f"  {fit.method}, scheme {fit.scheme}{steps}, start {fit.start}", f"  {noise_text(fit)}"]
    if whose := errors_text(fit):
        lines.append(f"  {whose}")
    lines += [f"  warning: {warning}" for warning in fit.warnings]
    return "\n".join(lines)


def noise_text(fit: Fit) -> str:
    """What the standard errors take the noise for, in words."""
    what = {
        "plain": "white noise of the stress",
        "autocorrelated": "autocorrelated noise of the stress",
        "varying": "noise of the stress whose size varies along a record",
        "strain-noise": "noise of the stress, and of the strain propagated to it",
        "strain-noise-frozen": "noise of the stress and, at the plain estimate, of the strain",
        "plain, strain noise resampled": "white noise of the stress, and that of the strain drawn again",
    }[fit.weighting]
    correlated = [record for record in fit.records.values() if record.noise_correlation != 0.0]
    if correlated:
        sizes = ", ".join(f"{record.noise_correlation:.2f} ({record.id})" for record in correlated)
        what += f", correlation of neighbours {sizes}"
    if fit.newey_west:
        what += "; autocorrelated fit residuals (Newey-West)"
    intervals = "; intervals from the profile likelihood" if fit.profiles else ""
    return f"standard errors for {what}{intervals}"


def errors_text(fit: Fit) -> str:
    """Whose parameters the errors are of, where specimens may differ; empty where that was not looked at."""
    if fit.gap is None or not fit.gap.scatter.any:
        return ""
    if fit.errors_of == "material":
        return f"they are of the material's mean: {fit.gap.scatter.text}"
    return "they are of the specimens that were tested; how far others differ is not known"


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


def _correlations(fit: Fit) -> list[str]:
    return [
        f"{SYMBOLS[fit.names[i]]}–{SYMBOLS[fit.names[j]]} {fit.correlation[i, j]:+.3f}"
        for i in range(len(fit.names))
        for j in range(i)
    ]
