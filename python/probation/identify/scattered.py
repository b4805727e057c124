"""Errors of a fit where specimens differ: of the material's mean, and of the specimens that were tested.

docs/uncertainty.md, "Whose errors they are".
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtri, stdtrit

from probation.inference.parameter import status_of
from probation.noise.own_deviations import specimens_of

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.identify.result import Fit
    from probation.inference.base_fit import BaseFit
    from probation.inference.parameter import Parameter


def with_scatter(fit: Fit, base: BaseFit) -> Fit:
    """The fit with standard errors and intervals of the material's mean, where scatter is known; else as it is.

    Scatter that is assumed for want of replicates widens nothing.

    Parameters
    ----------
    base : BaseFit
        Of the same campaign.
    """
    if not (base.scatter.known and base.scatter.any):
        return fit
    moves = _moves(fit, base)
    errors = np.array([fit.parameters[name].se or 0.0 for name in fit.names])
    if not np.all(errors > 0.0):
        return fit
    total = np.outer(errors, errors) * fit.correlation + moves @ moves.T
    deviation = np.sqrt(np.diag(total))
    degrees = base.scatter.specimens - 1 if base.scatter.source == "replicates" else None
    reach = float(ndtri(0.975) if degrees is None else stdtrit(max(degrees, 1), 0.975))
    parameters = dict(fit.parameters)
    for name, error in zip(fit.names, deviation.tolist(), strict=True):
        parameters[name] = _widened(fit.parameters[name], error, reach)
    slopes = _product_slopes(fit)
    product = fit.product
    if product.se is not None:
        product = _widened(product, float(np.hypot(product.se, np.linalg.norm(slopes @ moves))), reach)
    return replace(
        fit,
        parameters=parameters,
        product=product,
        correlation=total / np.outer(deviation, deviation),
        covariance=replace(fit.covariance, matrix=total),
        errors_of="material",
    )


def _moves(fit: Fit, base: BaseFit) -> FloatArray:
    """Change of the estimates by each deviation of each specimen, of one standard deviation, shape (free, n)."""
    white = base.whitened
    weights = [max(fit.records[record.name].noise_MPa, 1e-12) ** -2.0 for record in white.records]
    normal = sum(
        (weight * record.tangent.T @ record.tangent for weight, record in zip(weights, white.records, strict=True)),
        np.zeros((len(fit.names), len(fit.names))),
    )
    columns = []
    for members in specimens_of(white.noises):
        moved = np.zeros((len(fit.names), 0))
        for index in members:
            deviations = white.noises[index].specimen
            if deviations is None:
                continue
            part = weights[index] * white.records[index].tangent.T @ deviations
            moved = part if not moved.size else moved + part
        columns.append(moved)
    size = 1.0 / np.sqrt(np.diag(normal))
    inverse = np.linalg.pinv(normal * np.outer(size, size), hermitian=True) * np.outer(size, size)
    return np.asarray(inverse @ np.hstack(columns))


def _product_slopes(fit: Fit) -> FloatArray:
    """Derivatives of E_u times tau_max or alpha by the identified parameters, shape (free,)."""
    modulus, time = fit.law.parameter_names[:2]
    values = {modulus: float(getattr(fit.law, time)), time: float(getattr(fit.law, modulus))}
    return np.array([values.get(name, 0.0) for name in fit.names])


def _widened(parameter: Parameter, error: float, reach: float) -> Parameter:
    interval = (max(parameter.value - reach * error, 0.0), parameter.value + reach * error)
    status = status_of(error / abs(parameter.value)) if parameter.value else parameter.status
    return replace(parameter, se=error, interval95=interval, status=status)
