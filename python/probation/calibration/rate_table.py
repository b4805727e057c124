"""Relaxation times at several strain rates: what a companion relation is calibrated on."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import FloatArray, as_samples
from probation.errors import InputError
from probation.limits import USABLE, is_usable
from probation.settings.companion import COMPANION

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class RateTable:
    """tau_max identified at several strain rates.

    Attributes
    ----------
    rates : ndarray, shape (n,) [1/s]
        Positive.
    tau_max : ndarray, shape (n,) [s]
        Positive.
    se : ndarray, shape (n,) [s], or None
        Standard errors of `tau_max`; None where they are not known.
    hardening_modulus : ndarray, shape (n,) [MPa], or None
    labels : tuple of str
        What to call each row: "row 3", or the id of a record.
    source : str
        Where the numbers are from.

    Raises
    ------
    InputError
        If a number is not possible, naming its row, or if there are no two rates.
    """

    rates: FloatArray
    tau_max: FloatArray
    se: FloatArray | None = None
    hardening_modulus: FloatArray | None = None
    labels: tuple[str, ...] = ()
    source: str = "table"

    def __post_init__(self) -> None:
        given = np.asarray(self.rates, dtype=object)
        if given.ndim != 1 or len(given) == 0:
            raise InputError(f"{self.source}: found no rates, expected a list of them")
        count = len(given)
        labels = tuple(self.labels) or tuple(f"row {number}" for number in range(1, count + 1))
        if len(labels) != count:
            raise InputError(f"{self.source}: found {len(labels)} labels for {count} rates, expected one each")
        object.__setattr__(self, "labels", labels)
        for name, unit in (("rates", "1/s"), ("tau_max", "s"), ("se", "s"), ("hardening_modulus", "MPa")):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, self._checked(name, unit, count))
        if len(self.groups) < 2:
            listed = ", ".join(f"{rate:.3g}" for rate in self.rates)
            raise InputError(
                f"{self.source}: found one strain rate only ({listed} 1/s in {', '.join(labels)}), expected at least "
                f"two that differ by more than {100 * (COMPANION.same_rate - 1):.0f} %; a relation needs a second rate"
            )

    def _checked(self, name: str, unit: str, count: int) -> FloatArray:
        try:
            values = as_samples(getattr(self, name), name)
        except InputError as error:
            raise InputError(f"{self.source}: {error}") from None
        if len(values) != count:
            raise InputError(f"{self.source}: found {len(values)} {name}, expected {count}, as rates")
        for label, value in zip(self.labels, values, strict=True):
            if value <= 0.0 and not (name == "hardening_modulus" and value == 0.0):
                raise InputError(f"{self.source}, {label}: found {name} = {value:g} {unit}, expected a positive number")
            if not is_usable(value):
                raise InputError(f"{self.source}, {label}: found {name} = {value:g} {unit}, expected {USABLE}")
        return values

    def __len__(self) -> int:
        return len(self.rates)

    @property
    def log_error(self) -> FloatArray | None:
        """Relative standard errors, shape (n,) [-]; None where they are not known."""
        return None if self.se is None else np.asarray(self.se / self.tau_max)

    @property
    def groups(self) -> tuple[NDArray[np.intp], ...]:
        """Indices of the rows at each distinct rate, slowest first."""
        return rate_groups(self.rates)

    @property
    def range(self) -> tuple[float, float]:
        """Slowest and fastest rate [1/s]."""
        return float(self.rates.min()), float(self.rates.max())

    def without(self, left_out: NDArray[np.intp]) -> RateTable:
        """The table without some rows.

        Raises
        ------
        InputError
            If fewer than two rates remain.
        """
        kept = np.setdiff1d(np.arange(len(self)), left_out)
        return RateTable(
            self.rates[kept],
            self.tau_max[kept],
            None if self.se is None else self.se[kept],
            None if self.hardening_modulus is None else self.hardening_modulus[kept],
            tuple(self.labels[at] for at in kept),
            self.source,
        )


def rate_groups(rates: FloatArray) -> tuple[NDArray[np.intp], ...]:
    """Indices of what runs at each distinct rate, slowest first: neighbours within a factor of `same_rate` are one."""
    order = np.argsort(rates, kind="stable")
    cuts = [at + 1 for at, (slow, fast) in enumerate(pairwise(rates[order])) if fast > slow * COMPANION.same_rate]
    return tuple(np.split(order, cuts))
