"""Companion relations: the longest relaxation time from the strain rate, eqs. (10)-(12).

A new form is one class here with its engine part in ``cpp/include/probation/companion``, and one line in `FORMS`.
Commands, campaigns, calibration and finite elements name their forms themselves: docs/developing.md, "Adding files".
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from math import isfinite
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from probation import _core
from probation._arrays import FloatArray, as_number, as_samples
from probation.errors import InputError
from probation.limits import USABLE, is_usable

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from probation.law.settings import CompanionSettings

RATE_FLOOR = 1e-7
"""Slowest strain rate that a companion relation is asked for [1/s]."""

PAPER_RATES = (5e-5, 1e-2)
"""Strain rates of the paper's Table 2, between which (11) and (12) are calibrated [1/s]."""


class Companion:
    """A companion relation: tau_max as a function of the strain rate.

    The law asks it for r = max(\\|rate\\|, rate_floor).

    Attributes
    ----------
    rate_floor : float
        [1/s].
    calibrated : tuple of float or None
        Rates between which the relation was fitted [1/s]; None if that is not known.
    """

    form: ClassVar[str]
    rate_floor: float
    calibrated: tuple[float, float] | None

    def __post_init__(self) -> None:
        for declared in fields(self):  # type: ignore[arg-type]
            if declared.name != "calibrated":
                number = as_number(getattr(self, declared.name), declared.name)
                if not isfinite(number):
                    raise InputError(f"{declared.name} is {number}; a finite number is needed")
                object.__setattr__(self, declared.name, number)
        self._check_calibrated()
        self._engine()

    def _check_calibrated(self) -> None:
        """Refuse what is no range of rates; a range may be a single rate."""
        if self.calibrated is None:
            return
        rates = as_samples(self.calibrated, "calibrated").tolist()
        if len(rates) != 2 or not 0.0 < rates[0] <= rates[1]:
            raise InputError(f"calibrated is {self.calibrated!r}; expected two positive rates, the lower one first")
        object.__setattr__(self, "calibrated", (rates[0], rates[1]))

    def _engine(self) -> _core.CompanionRelation:
        raise NotImplementedError

    def relaxation_time(self, rate: ArrayLike) -> FloatArray:
        """Longest relaxation time.

        Parameters
        ----------
        rate : array_like, shape (n,) [1/s]

        Returns
        -------
        ndarray, shape (n,) [s]

        Raises
        ------
        InputError
            Where the relation gives no positive time.
        """
        seen = np.maximum(np.abs(np.atleast_1d(np.asarray(rate, dtype=np.float64))), self.rate_floor)
        return np.asarray(self._engine().relaxation_time(seen), dtype=np.float64)

    def weissenberg_number(self, rate: ArrayLike) -> FloatArray:
        """We = tau_max r, eq. (10); shape (n,) [-]. Raises as `relaxation_time` does."""
        seen: FloatArray = np.maximum(np.abs(np.atleast_1d(rate)), self.rate_floor)
        with np.errstate(over="ignore"):
            number: FloatArray = self.relaxation_time(rate) * seen
        if not np.isfinite(number).all():
            fastest = seen[~np.isfinite(number)][0]
            raise InputError(f"rate is {fastest} 1/s; its Weissenberg number is beyond all numbers")
        return number

    def outside(self, rate: ArrayLike) -> tuple[float, float] | None:
        """The range of the given rates [1/s] if it leaves the calibrated one, else None.

        Rates up to the floor are those of holds and of standing starts, unless all are.
        """
        rates = np.abs(np.atleast_1d(np.asarray(rate, dtype=np.float64)))
        rates = rates[rates > 0.0]
        if self.calibrated is None or rates.size == 0:
            return None
        if np.any(rates > self.rate_floor):
            rates = rates[rates > self.rate_floor]
        low, high = float(rates.min()), float(rates.max())
        tolerance = 1 + 1e-9
        inside = low * tolerance >= self.calibrated[0] and high <= self.calibrated[1] * tolerance
        return None if inside else (low, high)

    def extrapolation(self, rate: ArrayLike) -> str | None:
        """What to warn of where the given rates [1/s] leave the calibrated range, else None."""
        outside = self.outside(rate)
        if outside is None or self.calibrated is None:
            return None
        low, high = self.calibrated
        decades = max(np.log10(low / max(outside[0], self.rate_floor)), np.log10(outside[1] / high))
        return (
            f"strain rates {outside[0]:.2g} to {outside[1]:.2g} 1/s leave the range in which the companion relation "
            f"({self.form}) is calibrated, {low:.2g} to {high:.2g} 1/s, by {decades:.2g} decades: there its form is an "
            "assumption, of which no standard error knows"
        )


@dataclass(frozen=True)
class Weissenberg(Companion):
    """The Weissenberg number is linear in log10 of the rate.

    .. math:: We = \\tau_{max} r = slope \\, \\log_{10} r + intercept

    Parameters
    ----------
    slope, intercept : float [-]
        As printed in the paper: 0.00464 and 0.0367. Regressing its own Table 2 gives 0.0046 and 0.0406.
    rate_floor : float [1/s]
    calibrated : (float, float) or None [1/s]

    References
    ----------
    André et al., eqs. (10), (11).

    Examples
    --------
    >>> Weissenberg(0.00464, 0.0367).relaxation_time([0.005]).round(3)
    array([5.205])
    """

    slope: float
    intercept: float
    rate_floor: float = RATE_FLOOR
    calibrated: tuple[float, float] | None = PAPER_RATES
    form: ClassVar[str] = "weissenberg"

    def _engine(self) -> _core.CompanionRelation:
        return _core.Weissenberg(self.slope, self.intercept, self.rate_floor)


@dataclass(frozen=True)
class Exponential(Companion):
    """tau_max is exponential in log10 of the rate.

    .. math:: \\tau_{max} = coefficient \\, \\exp(exponent \\, \\log_{10}(1000 r))

    Parameters
    ----------
    coefficient : float [s]
        27.24 in the paper.
    exponent : float [-]
        -2.1 in the paper.
    rate_floor : float [1/s]
    calibrated : (float, float) or None [1/s]

    References
    ----------
    André et al., eq. (12).
    """

    coefficient: float
    exponent: float
    rate_floor: float = RATE_FLOOR
    calibrated: tuple[float, float] | None = PAPER_RATES
    form: ClassVar[str] = "exponential"

    def _engine(self) -> _core.CompanionRelation:
        return _core.Exponential(self.coefficient, self.exponent, self.rate_floor)


@dataclass(frozen=True)
class PowerLaw(Companion):
    """tau_max is a power of the rate: coefficient r^exponent.

    Parameters
    ----------
    coefficient : float [s]
        At 1 1/s.
    exponent : float [-]
        -1 is a constant Weissenberg number.
    rate_floor : float [1/s]
    calibrated : (float, float) or None [1/s]
    """

    coefficient: float
    exponent: float
    rate_floor: float = RATE_FLOOR
    calibrated: tuple[float, float] | None = None
    form: ClassVar[str] = "power"

    def _engine(self) -> _core.CompanionRelation:
        return _core.PowerLaw(self.coefficient, self.exponent, self.rate_floor)


@dataclass(frozen=True)
class Table(Companion):
    """tau_max interpolated between points, straight in log-log axes; the end segments go on beyond.

    Parameters
    ----------
    rates : sequence of float, shape (points,) [1/s]
        Positive, increasing.
    tau_max : sequence of float, shape (points,) [s]
        Positive.
    rate_floor : float [1/s]
    calibrated : (float, float) or None [1/s]
        The table's own range if left out.
    """

    rates: tuple[float, ...]
    tau_max: tuple[float, ...]
    rate_floor: float = RATE_FLOOR
    calibrated: tuple[float, float] | None = None
    form: ClassVar[str] = "table"

    def __post_init__(self) -> None:
        object.__setattr__(self, "rates", tuple(as_samples(self.rates, "rates").tolist()))
        object.__setattr__(self, "tau_max", tuple(as_samples(self.tau_max, "tau_max").tolist()))
        object.__setattr__(self, "rate_floor", as_number(self.rate_floor, "rate_floor"))
        for name, values in (("rates", self.rates), ("tau_max", self.tau_max)):
            for place, value in enumerate(values, 1):
                if not is_usable(value):
                    raise InputError(f"{name}: found {value:g} in place {place}, expected {USABLE}")
        self._check_calibrated()
        self._engine()
        if self.calibrated is None:
            object.__setattr__(self, "calibrated", (self.rates[0], self.rates[-1]))

    def _engine(self) -> _core.CompanionRelation:
        return _core.Table(list(self.rates), list(self.tau_max), self.rate_floor)


@dataclass(frozen=True)
class RateFunction(Companion):
    """A user's own function of the strain rate.

    The function is called once, on a fine grid of rates, and interpolated in log-log axes from then on (to about
    1e-6 relative for smooth functions), so that solves stay as fast as with a built-in form.

    Parameters
    ----------
    function : callable
        Takes rates [1/s], shape (n,), returns tau_max [s], shape (n,).
    between : (float, float) [1/s]
        Rates over which it is sampled.
    """

    function: Callable[[FloatArray], ArrayLike]
    between: tuple[float, float] = (1e-8, 1e3)
    rate_floor: float = RATE_FLOOR
    calibrated: tuple[float, float] | None = None
    form: ClassVar[str] = "function"
    _table: Table = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        low, high = (as_number(rate, "between") for rate in self.between)
        if not 0.0 < low < high:
            raise InputError(f"between is ({low}, {high}); expected two positive rates, the lower one first")
        rates = np.geomspace(low, high, 4001)
        try:
            times = np.asarray(self.function(rates))
        except Exception as error:
            raise InputError(
                f"function(rates) raised {type(error).__name__}: {error}; it is called with {len(rates)} rates from "
                f"{low:g} to {high:g} 1/s and is to give tau_max [s] at each"
            ) from error
        if times.shape not in ((), rates.shape):
            raise InputError(f"function(rates) has the shape {times.shape}; expected {rates.shape}, as rates")
        times = as_samples(np.broadcast_to(times, rates.shape), "function(rates)")
        self._check_calibrated()
        object.__setattr__(self, "_table", Table(tuple(rates), tuple(times), self.rate_floor))

    def _engine(self) -> _core.CompanionRelation:
        return self._table._engine()


FORMS: dict[str, type[Companion]] = {form.form: form for form in (Weissenberg, Exponential, PowerLaw, Table)}
"""Forms that a campaign or the command line can name."""

WEISSENBERG_AS_PRINTED = Weissenberg(0.00464, 0.0367)
"""Eq. (11) as printed in the paper."""

EXPONENTIAL_AS_PRINTED = Exponential(27.24, -2.1)
"""Eq. (12) as printed in the paper."""


def from_settings(settings: CompanionSettings | None) -> Companion | None:
    """The companion relation that a campaign names."""
    if settings is None:
        return None
    values: dict[str, Any] = dict(settings.parameters)
    if settings.calibration is not None and settings.calibration.rates is not None:
        values["calibrated"] = settings.calibration.rates
    if settings.form == "table":
        values["tau_max"] = values.pop("tau_max_s")
    return FORMS[settings.form](**values)
