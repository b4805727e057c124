"""What a form of companion relation must tell to be calibrated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.law.companion import Companion

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
    reference : bool
        Shown with the others, never chosen.
    same_as : str or None
        Another form that is the same function, written otherwise: they differ only in their `measure`, and not at all
        where standard errors are known.
    relation : callable
        ``relation(parameters, table_rates, calibrated) -> Companion``.
    parameters : callable
        ``parameters(companion) -> ndarray``, the way back.
    start : callable
        ``start(rates, tau_max) -> ndarray``: a regression in closed form.
    log_gradient : callable
        ``log_gradient(companion, rates) -> ndarray, shape (n, p)``: of ln tau_max along the parameters, at rates that
        are positive.
    """

    name: str
    title: str
    parameter_names: tuple[str, ...]
    measure: Measure
    relation: Callable[[FloatArray, FloatArray, tuple[float, float] | None], Companion]
    parameters: Callable[[Companion], FloatArray]
    start: Callable[[FloatArray, FloatArray], FloatArray]
    log_gradient: Callable[[Companion, FloatArray], FloatArray]
    reference: bool = False
    same_as: str | None = None

    def count(self, rates: int) -> int:
        """Parameters that it has on so many distinct rates."""
        return len(self.parameter_names) or rates
