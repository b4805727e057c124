"""The base law of a campaign: which spectrum, which companion relation, which parameters are held."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from probation._complaint import listed, quoted, suggestion
from probation.errors import InputError
from probation.law.calibration_settings import CalibrationSettings
from probation.law.spectrum import ACCURACIES
from probation.limits import LARGEST_DECADES, MOST_MODES, USABLE, is_usable

COMPANION_FORMS: dict[str, tuple[str, ...]] = {
    "weissenberg": ("slope", "intercept"),
    "exponential": ("coefficient", "exponent"),
    "power": ("coefficient", "exponent"),
    "table": ("rates", "tau_max_s"),
}
FIXABLE = ("unrelaxed_modulus_MPa", "tau_max_s", "alpha", "hardening_modulus_MPa")


@dataclass(frozen=True)
class CompanionSettings:
    """A companion relation, τ_max from the strain rate, as a campaign names it.

    Attributes
    ----------
    form : {"weissenberg", "exponential", "power", "table"}
    parameters : dict of str to (float or tuple of float)
        ``slope``, ``intercept`` [-]; ``coefficient`` [s], ``exponent`` [-]; or
        ``rates`` [1/s] and ``tau_max_s`` [s], both shape (n,), rates increasing.
    calibration : CalibrationSettings or None
        How well it is known.

    Raises
    ------
    InputError
        If the form or a parameter is unknown, missing or impossible.
    """

    form: str
    parameters: Mapping[str, float | tuple[float, ...]]
    calibration: CalibrationSettings | None = None

    def __post_init__(self) -> None:
        if self.form not in COMPANION_FORMS:
            raise InputError(f"companion form {quoted(self.form)}: {suggestion(self.form, COMPANION_FORMS)}")
        known = COMPANION_FORMS[self.form]
        if set(self.parameters) != set(known):
            raise InputError(
                f"companion {self.form!r}: found parameters {listed(self.parameters) or 'none'}, "
                f"expected {' and '.join(map(quoted, known))}"
            )
        frozen = {name: self._checked(name) for name in known}
        object.__setattr__(self, "parameters", frozen)
        if self.form == "table":
            self._check_table()
        elif frozen.get("coefficient", 1.0) <= 0.0:  # type: ignore[operator]
            raise InputError(f"companion {self.form!r}: found coefficient = {frozen['coefficient']}, expected > 0")
        if self.calibration is not None:
            tau_max = frozen.get("tau_max_s")
            self.calibration.check_covariance(len(tau_max) if isinstance(tau_max, tuple) else len(known))

    def _checked(self, name: str) -> float | tuple[float, ...]:
        value = self.parameters[name]
        if self.form == "table":
            values = tuple(float(entry) for entry in value) if not isinstance(value, int | float) else ()
            if len(values) < 2 or not all(math.isfinite(entry) and entry > 0 for entry in values):
                raise InputError(f"companion 'table': found {name} = {value!r}, expected two or more numbers > 0")
            if unusable := [entry for entry in values if not is_usable(entry)]:
                raise InputError(f"companion 'table': found {unusable[0]!r} in {name}, expected {USABLE}")
            return values
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise InputError(f"companion {self.form!r}: found {name} = {value!r}, expected a finite number")
        if not is_usable(value):
            raise InputError(f"companion {self.form!r}: found {name} = {value!r}, expected {USABLE}")
        return float(value)

    def _check_table(self) -> None:
        rates, tau_max = self.parameters["rates"], self.parameters["tau_max_s"]
        assert isinstance(rates, tuple)
        assert isinstance(tau_max, tuple)
        if len(rates) != len(tau_max):
            raise InputError(
                f"companion 'table': found {len(rates)} rates and {len(tau_max)} tau_max_s, expected as many"
            )
        if any(after <= before for before, after in pairwise(rates)):
            raise InputError("companion 'table': found rates that do not increase, expected increasing rates")


@dataclass(frozen=True)
class LawSettings:
    """The base law that a campaign puts to the test.

    Attributes
    ----------
    modes : int
        Number of modes N.
    decades : float
        Decades d that the relaxation times span.
    accuracy : float or None
        Relative error that the stress may have for fewer modes, refitted to those of `modes` and `decades`.
    companion : CompanionSettings or None
        None: τ_max is a constant.
    fixed : dict of str to float
        Parameters held, not identified: ``unrelaxed_modulus_MPa``, ``hardening_modulus_MPa`` and,
        without a companion, ``tau_max_s``, with one ``alpha``.

    Raises
    ------
    InputError
        If a value is impossible, or a parameter is held that the law does not have.
    """

    modes: int = 50
    decades: float = 6.0
    companion: CompanionSettings | None = None
    fixed: Mapping[str, float] = field(default_factory=dict)
    accuracy: float | None = None

    def __post_init__(self) -> None:
        if isinstance(self.modes, bool) or not isinstance(self.modes, int) or not 1 <= self.modes <= MOST_MODES:
            raise InputError(f"law: found modes = {self.modes!r}, expected a whole number from 1 to {MOST_MODES}")
        if not 0 < self.decades <= LARGEST_DECADES:
            raise InputError(
                f"law: found decades = {self.decades!r}, expected a positive number of at most {LARGEST_DECADES:g}"
            )
        finest, coarsest = ACCURACIES
        if self.accuracy is not None and not finest <= self.accuracy <= coarsest:
            raise InputError(
                f"law: found accuracy = {self.accuracy!r}, expected a number from {finest:g} to {coarsest:g}"
            )
        absent = "alpha" if self.companion is None else "tau_max_s"
        for name, value in self.fixed.items():
            if name not in FIXABLE:
                raise InputError(f"law.fixed: found the unknown key {quoted(name)}; {suggestion(name, FIXABLE)}")
            if name == absent:
                which = "without a companion" if self.companion is None else "with a companion"
                other = "tau_max_s" if self.companion is None else "alpha"
                raise InputError(f"law.fixed: found {absent}, expected {other}: the law {which} has no {absent}")
            lowest = "at least 0" if name == "hardening_modulus_MPa" else "positive"
            if not (math.isfinite(value) and (value > 0 or (value == 0 and lowest == "at least 0"))):
                raise InputError(f"law.fixed: found {name} = {value!r}, expected a number that is {lowest}")
            if not is_usable(value):
                raise InputError(f"law.fixed: found {name} = {value!r}, expected {USABLE}")
        object.__setattr__(self, "fixed", {name: float(value) for name, value in self.fixed.items()})
