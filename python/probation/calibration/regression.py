"""One form regressed on relaxation times at several rates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq

from probation.calibration.rate_table import RateTable
from probation.errors import InputError
from probation.inference.least_squares import minimise

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.calibration.companion_forms import Form
    from probation.law.companion import Companion

_MOST_ROUNDS = 100
"""Of the relation and the scatter around it, in turns."""

FINAL_STEP = 1e-8
"""Step [standard errors] at which a regression ends."""


@dataclass(frozen=True, eq=False)
class Regression:
    """A form and what the table says of its parameters.

    Attributes
    ----------
    parameters : ndarray, shape (p,)
    covariance : ndarray, shape (p, p), or None
        None where it is not known: no standard errors, and no more rates than parameters.
    log_scatter : float
        Standard deviation of ln tau_max around the relation that standard errors do not explain [-].
    degrees : int
        Rows minus parameters.
    log_residual : ndarray, shape (n,)
        Relation minus table, in ln tau_max.
    r_squared : float
        In the form's own measure, as the paper's; NaN where there is nothing to explain.
    gain : ndarray, shape (p, n)
        Derivative of the parameters with respect to each ln tau_max.
    """

    form: Form
    table: RateTable
    relation: Companion
    parameters: FloatArray
    covariance: FloatArray | None
    log_scatter: float
    degrees: int
    log_residual: FloatArray
    r_squared: float
    gain: FloatArray

    @property
    def percent_residual(self) -> FloatArray:
        """Relation over table minus one, shape (n,) [%]."""
        return 100.0 * np.expm1(self.log_residual)


def regress(form: Form, table: RateTable) -> Regression:
    """Regress one form.

    With standard errors the weighted squares of the error in ln tau_max are least; scatter beyond them, if there is,
    is estimated (Paule & Mandel 1982) and widens every weight and the covariance. Without them the squares are those
    of the form's own measure (We for (11), tau_max for (12), as in the paper), and the covariance takes the errors of
    tau_max as relative and alike at all rates, of the size of the residual.

    Raises
    ------
    InputError
        If there are fewer distinct rates than parameters.
    """
    table = table if form.parameter_names else _averaged(table)
    count, needed = len(table.groups), form.count(len(table))
    if count < needed:
        raise InputError(f"{table.source}: found {count} distinct rates, expected at least {needed} for {form.name}")
    error, degrees = table.log_error, len(table) - needed
    scatter = 0.0
    if error is None:
        relation, gain = _least_squares(form, table, None)
    else:
        scatter = _fitted_scatter(form, table, error, degrees)
        relation, gain = _least_squares(form, table, np.hypot(error, scatter))
    residual = np.log(relation.relaxation_time(table.rates) / table.tau_max)
    covariance: FloatArray | None = None
    if error is not None:
        covariance = gain @ np.diag(error**2 + scatter**2) @ gain.T
    elif degrees > 0:
        scatter = float(np.sqrt(residual @ residual / degrees))
        covariance = scatter**2 * gain @ gain.T
    return Regression(
        form,
        table,
        relation,
        form.parameters(relation),
        covariance,
        scatter,
        degrees,
        residual,
        _r_squared(form, table, relation),
        gain,
    )


def measured(form: Form, rates: FloatArray, tau_max: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The form's own measure of relaxation times, and its derivative with respect to ln tau_max; shape (n,) each."""
    if form.measure == "ln τ_max":
        return np.log(tau_max), np.ones_like(tau_max)
    value: FloatArray = tau_max * rates if form.measure == "We" else tau_max
    return value, value


def _least_squares(form: Form, table: RateTable, error: FloatArray | None) -> tuple[Companion, FloatArray]:
    """The relation of least squares, and the derivative of its parameters with respect to each ln tau_max.

    Parameters
    ----------
    error : ndarray, shape (n,), or None
        Standard errors of ln tau_max; None for squares in the form's own measure.
    """
    squares = _Squares(form, table, error)
    start = form.start(table.rates, table.tau_max)
    try:
        squares.relation(start)
    except InputError:
        raise InputError(
            f"{table.source}: {form.name} gives no positive relaxation time at every rate of the table"
        ) from None
    minimum = minimise(squares, start, tolerance=FINAL_STEP)
    # d target / d ln tau_max: the measured value's own slope, or the weight.
    inward = measured(form, table.rates, table.tau_max)[1] if error is None else 1.0 / error
    return squares.relation(minimum.x), np.asarray(np.linalg.pinv(minimum.jacobian) * inward)


@dataclass(frozen=True, eq=False)
class _Squares:
    """What is to be least, along the parameters of a form; `InputError` where a relaxation time is not positive."""

    form: Form
    table: RateTable
    error: FloatArray | None

    def relation(self, values: FloatArray) -> Companion:
        relation = self.form.relation(values, self.table.rates, self.table.range)
        relation.relaxation_time(self.table.rates)
        return relation

    def residual(self, values: FloatArray) -> FloatArray:
        tau_max = self.relation(values).relaxation_time(self.table.rates)
        if self.error is not None:
            return np.asarray(np.log(tau_max / self.table.tau_max) / self.error)
        target = measured(self.form, self.table.rates, self.table.tau_max)[0]
        return measured(self.form, self.table.rates, tau_max)[0] - target

    def tangent(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        relation, rates = self.relation(values), self.table.rates
        tau_max = relation.relaxation_time(rates)
        scale = measured(self.form, rates, tau_max)[1] if self.error is None else 1.0 / self.error
        return self.residual(values), self.form.log_gradient(relation, rates) * scale[:, None]


def excess_scatter(residual: FloatArray, error: FloatArray, degrees: int) -> float:
    """Scatter beyond the standard errors that brings chi squared down to its degrees of freedom; 0 if it is there.

    Paule & Mandel (1982).

    Parameters
    ----------
    residual, error : ndarray, shape (n,)
    degrees : int
        Positive.
    """

    def excess(scatter: float) -> float:
        return float(np.sum(residual**2 / (error**2 + scatter**2))) - degrees

    if excess(0.0) <= 0.0:
        return 0.0
    high = 2.0 * float(np.sqrt(residual @ residual / degrees))  # there chi squared is below its degrees of freedom
    return float(brentq(excess, 0.0, high, rtol=1e-6))


def _fitted_scatter(form: Form, table: RateTable, error: FloatArray, degrees: int) -> float:
    """`excess_scatter` around the relation that is best with it."""
    scatter = 0.0
    for _ in range(_MOST_ROUNDS if degrees else 0):
        relation, _ = _least_squares(form, table, np.hypot(error, scatter))
        before = scatter
        scatter = excess_scatter(np.log(relation.relaxation_time(table.rates) / table.tau_max), error, degrees)
        if abs(scatter - before) <= 1e-6 * scatter:
            break
    return scatter


def _r_squared(form: Form, table: RateTable, relation: Companion) -> float:
    value = measured(form, table.rates, table.tau_max)[0]
    left = value - measured(form, table.rates, relation.relaxation_time(table.rates))[0]
    spread = float(np.sum((value - value.mean()) ** 2))
    return 1.0 - float(left @ left) / spread if spread > 0.0 else float("nan")


def _averaged(table: RateTable) -> RateTable:
    """One row per distinct rate: the (weighted) mean of ln tau_max over its replicates."""
    error = table.log_error
    weights = np.ones(len(table)) if error is None else 1.0 / error**2
    rates, tau_max, se, labels = [], [], [], []
    for group in table.groups:
        part = weights[group]
        rates.append(float(np.exp(np.average(np.log(table.rates[group]), weights=part))))
        tau_max.append(float(np.exp(np.average(np.log(table.tau_max[group]), weights=part))))
        se.append(tau_max[-1] / np.sqrt(part.sum()))
        labels.append(", ".join(table.labels[at] for at in group))
    known = None if error is None else np.array(se)
    return RateTable(np.array(rates), np.array(tau_max), known, None, tuple(labels), table.source)
