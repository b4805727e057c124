"""Forms of companion relation that can be calibrated, one entry of `FORMS` each.

One that campaigns can name needs its class in `probation.law.companion`, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from probation.law.companion import Companion, Exponential, PowerLaw, Table, Weissenberg

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray

Measure = Literal["We", "τ_max", "ln τ_max"]
"""In which quantity residuals are squared where no standard errors are known."""


@dataclass(frozen=True)
class Form:
    """A form of companion relation.

    Attributes
    ----------
    name : str
        As in campaign.toml, or a reference's own.
    title : str
        For people.
    parameter_names : tuple of str
        As in campaign.toml; empty for the table, which has one tau_max per rate.
    measure : {"We", "τ_max", "ln τ_max"}
        What is regressed where no standard errors are known. With them every form minimises the weighted error of
        ln tau_max.
    relation : callable
        ``relation(parameters, table_rates, calibrated) -> Companion``.
    start : callable
        ``start(rates, tau_max) -> ndarray``: a regression in closed form.
    log_gradient : callable
        ``log_gradient(companion, rates) -> ndarray, shape (n, p)``: of ln tau_max along the parameters, at rates that
        are positive.
    attributes : tuple of str
        What the companion calls its parameters, where that is not `parameter_names`.
    reference : bool
        Shown with the others, never chosen.
    same_as : str or None
        Another form that is the same function, written otherwise: they differ only in their `measure`, and not at all
        where standard errors are known.
    """

    name: str
    title: str
    parameter_names: tuple[str, ...]
    measure: Measure
    relation: Callable[[FloatArray, FloatArray, tuple[float, float] | None], Companion]
    start: Callable[[FloatArray, FloatArray], FloatArray]
    log_gradient: Callable[[Any, FloatArray], FloatArray]
    attributes: tuple[str, ...] = ()
    reference: bool = False
    same_as: str | None = None

    def parameters(self, companion: Companion) -> FloatArray:
        """The parameters of a relation of this form, shape (p,): the way back from `relation`."""
        return np.ravel([getattr(companion, name) for name in self.attributes or self.parameter_names])

    def count(self, rates: int) -> int:
        """Parameters that it has on so many distinct rates."""
        return len(self.parameter_names) or rates


def _weissenberg_line(rates: FloatArray, tau_max: FloatArray) -> FloatArray:
    """Linear regression of We = tau_max r on log10 r; their mean where the line would be negative at some rate."""
    line: FloatArray = np.polyfit(np.log10(rates), rates * tau_max, 1)
    if np.any(np.polyval(line, np.log10(rates)) <= 0.0):
        return np.array([0.0, np.mean(rates * tau_max)])
    return line


def _weissenberg_gradient(companion: Weissenberg, rates: FloatArray) -> FloatArray:
    """Ln tau_max = ln(slope log10 r + intercept) - ln r."""
    return np.stack([np.log10(rates), np.ones_like(rates)], axis=1) / companion.weissenberg_number(rates)[:, None]


def _log_rate(rates: FloatArray) -> FloatArray:
    """Ln r, in which ln tau_max of a power law is linear."""
    return np.log(rates)


def _decades(rates: FloatArray) -> FloatArray:
    """log10(1000 r), in which that of eq. (12) is."""
    return np.log10(1000.0 * rates)


def _line(abscissa: Callable[[FloatArray], FloatArray], rates: FloatArray, tau_max: FloatArray) -> FloatArray:
    exponent, constant = np.polyfit(abscissa(rates), np.log(tau_max), 1)
    return np.array([np.exp(constant), exponent])


def _line_gradient(
    abscissa: Callable[[FloatArray], FloatArray], companion: PowerLaw | Exponential, rates: FloatArray
) -> FloatArray:
    return np.stack([_scale_gradient(companion, rates)[:, 0], abscissa(rates)], axis=1)


def _scale_gradient(companion: PowerLaw | Exponential, rates: FloatArray) -> FloatArray:
    return np.full((len(rates), 1), 1.0 / companion.coefficient)


def _table_gradient(table: Table, rates: FloatArray) -> FloatArray:
    """Hat functions in ln r over tau_max; beyond the ends the end segments go on."""
    knots, at = np.log(table.rates), np.log(rates)
    left = np.clip(np.searchsorted(knots, at) - 1, 0, len(knots) - 2)
    part = (at - knots[left]) / (knots[left + 1] - knots[left])
    gradient = np.zeros((len(rates), len(knots)))
    rows = np.arange(len(rates))
    gradient[rows, left] = 1.0 - part
    gradient[rows, left + 1] = part
    return np.asarray(gradient / np.array(table.tau_max))


FORMS: dict[str, Form] = {
    form.name: form
    for form in (
        Form(
            "weissenberg",
            "Weissenberg number linear in log10 of the rate, eq. (11)",
            ("slope", "intercept"),
            "We",
            lambda values, _, calibrated: Weissenberg(float(values[0]), float(values[1]), calibrated=calibrated),
            _weissenberg_line,
            _weissenberg_gradient,
        ),
        Form(
            "power",
            "power of the rate, regressed in ln τ_max",
            ("coefficient", "exponent"),
            "ln τ_max",
            lambda values, _, calibrated: PowerLaw(float(values[0]), float(values[1]), calibrated=calibrated),
            partial(_line, _log_rate),
            partial(_line_gradient, _log_rate),
        ),
        # c exp(e log10(1000 r)) = c 1000^(e / ln 10) r^(e / ln 10): the same function as a power law. What sets (12)
        # apart is how the paper fitted it, by least squares of tau_max itself, which the slowest rates decide.
        Form(
            "exponential",
            "exponential of log10 of the rate, eq. (12), regressed in τ_max",
            ("coefficient", "exponent"),
            "τ_max",
            lambda values, _, calibrated: Exponential(float(values[0]), float(values[1]), calibrated=calibrated),
            partial(_line, _decades),
            partial(_line_gradient, _decades),
            same_as="power",
        ),
        Form(
            "table",
            "interpolation, straight in log-log axes",
            (),
            "ln τ_max",
            lambda values, rates, calibrated: Table(
                tuple(rates.tolist()), tuple(values.tolist()), calibrated=calibrated
            ),
            lambda rates, tau_max: tau_max,
            _table_gradient,
            attributes=("tau_max",),
            reference=True,
        ),
        Form(
            "constant-weissenberg",
            "one Weissenberg number at every rate",
            ("weissenberg_number",),
            "ln τ_max",
            lambda values, _, calibrated: PowerLaw(float(values[0]), -1.0, calibrated=calibrated),
            lambda rates, tau_max: np.array([np.exp(np.mean(np.log(rates * tau_max)))]),
            _scale_gradient,
            attributes=("coefficient",),
            reference=True,
        ),
        Form(
            "constant",
            "one τ_max at every rate: no relation",
            ("tau_max_s",),
            "ln τ_max",
            lambda values, _, calibrated: PowerLaw(float(values[0]), 0.0, calibrated=calibrated),
            lambda rates, tau_max: np.array([np.exp(np.mean(np.log(tau_max)))]),
            _scale_gradient,
            attributes=("coefficient",),
            reference=True,
        ),
    )
}
"""By name, in order of preference where the data cannot choose."""

CHOOSABLE = tuple(form.name for form in FORMS.values() if not form.reference)
"""Forms among which the data choose."""

NAMEABLE = (*CHOOSABLE, "table")
"""Forms that a campaign can name."""
