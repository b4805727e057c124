"""What a campaign may say of how its companion relation was calibrated: range, covariance, scatter, E_u."""

import math
from dataclasses import dataclass

from probation.errors import InputError

CALIBRATION_KEYS = ("calibrated_rates_per_s", "covariance", "log_scatter", "unrelaxed_modulus_MPa")
"""Optional keys of [law.companion], in addition to the form and its parameters."""


@dataclass(frozen=True)
class CalibrationSettings:
    """How well a companion relation is known.

    Attributes
    ----------
    rates : tuple of float, or None
        Slowest and fastest rate that it was calibrated on [1/s].
    covariance : tuple of tuple of float, or None
        Of the form's parameters in the order of `COMPANION_FORMS` (of tau_max_s for a table), in their own units; with
        `unrelaxed_modulus_MPa` one row and column more, that of E_u.
    log_scatter : float [-]
        Standard deviation of ln tau_max of single tests around the relation, beyond their standard errors.
    unrelaxed_modulus_MPa : float or None
        E_u that the relation was calibrated with; their product is known far better than either.

    Raises
    ------
    InputError
        If a value is not possible.
    """

    rates: tuple[float, float] | None = None
    covariance: tuple[tuple[float, ...], ...] | None = None
    log_scatter: float = 0.0
    unrelaxed_modulus_MPa: float | None = None  # noqa: N815 - as the campaign file spells it

    def __post_init__(self) -> None:
        if self.rates is not None and not (len(self.rates) == 2 and 0.0 < self.rates[0] <= self.rates[1]):
            raise InputError(
                f"companion: found calibrated_rates_per_s = {list(self.rates)}, expected two positive rates, slowest "
                "first"
            )
        if not (math.isfinite(self.log_scatter) and self.log_scatter >= 0.0):
            raise InputError(f"companion: found log_scatter = {self.log_scatter}, expected a number of at least 0")
        modulus = self.unrelaxed_modulus_MPa
        if modulus is not None and not (math.isfinite(modulus) and modulus > 0.0):
            raise InputError(f"companion: found unrelaxed_modulus_MPa = {modulus}, expected a positive number")

    def check_covariance(self, parameters: int) -> None:
        """Refuse a covariance that does not belong to so many parameters of the relation.

        Raises
        ------
        InputError
            If it is not square, symmetric and of that size, or has a negative variance.
        """
        if self.covariance is None:
            return
        size = parameters + (self.unrelaxed_modulus_MPa is not None)
        shape = [len(row) for row in self.covariance]
        if shape != [size] * size:
            raise InputError(f"companion: found a covariance with rows of {shape}, expected {size} rows of {size}")
        for at, row in enumerate(self.covariance):
            if row[at] < 0.0:
                raise InputError(f"companion: found covariance[{at}][{at}] = {row[at]}, expected a variance")
            for other in range(at):
                mirrored = self.covariance[other][at]
                if not math.isclose(row[other], mirrored, rel_tol=1e-9, abs_tol=1e-300):
                    raise InputError(
                        f"companion: found covariance[{at}][{other}] = {row[other]} and [{other}][{at}] = {mirrored}, "
                        "expected a symmetric matrix"
                    )
