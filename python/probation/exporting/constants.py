"""The list of constants that the user-material routines take; the order is theirs and stands here once.

It is that of ``cpp/include/probation/material/constants.hpp``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import as_number
from probation.errors import InputError
from probation.law.companion import Exponential, PowerLaw, Table, Weissenberg
from probation.law.modal import Law
from probation.law.spectrum import Spectrum

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.law.companion import Companion

NAMES = (
    "unrelaxed_modulus_MPa",
    "hardening_modulus_MPa",
    "bulk_modulus_MPa",
    "form",
    "tau_max_s_or_alpha",
    "slope_or_coefficient_or_points",
    "intercept_or_exponent",
    "rate_floor_per_s",
    "rate_filter",
    "modes",
    "decades",
)
"""Constants 1 to 11; with decades = 0 the ratios tau_j / tau_max and the weights p_j follow, then a table's points.

A stress tolerance [MPa] may stand at the end.
"""

FORMS: tuple[type[Companion] | None, ...] = (None, Weissenberg, Exponential, PowerLaw, Table)
"""By form number."""

MOST_MODES = 64
MOST_DECADES = 30.0
MOST_TABLE_POINTS = 32

STATE_HEADER, STATE_PER_MODE = 10, 6
"""State variables of a point: 10 + 6 N."""


def state_size(modes: int) -> int:
    """State variables of a point with so many modes."""
    return STATE_HEADER + STATE_PER_MODE * modes


@dataclass(frozen=True)
class MaterialConstants:
    """The list, named.

    Attributes
    ----------
    values : tuple of float
        In the order of `NAMES`, then what follows.
    """

    values: tuple[float, ...]

    @classmethod
    def of(
        cls, law: Law, bulk_modulus: float, rate_filter: float = 0.0, stress_tolerance: float = 0.0
    ) -> MaterialConstants:
        """The constants of a law.

        Parameters
        ----------
        law : Law
            With at most 64 modes; its companion one of `FORMS`, a table of at most 32 points.
        bulk_modulus : float
            K [MPa]; the one-dimensional law is incompressible and does not tell it.
        rate_filter : float
            Strain over which the rate is filtered before the companion relation sees it [-]; 0: not at all.
        stress_tolerance : float
            Error of the stress [MPa] above which an increment asks for a smaller one; 0: its size is not looked at.

        Raises
        ------
        InputError
            If the routines cannot hold the law.
        """
        assert law.spectrum is not None
        bulk_modulus, rate_filter = as_number(bulk_modulus, "bulk_modulus"), as_number(rate_filter, "rate_filter")
        if not bulk_modulus > 0.0:
            raise InputError(f"bulk_modulus is {bulk_modulus}; a positive modulus in MPa is needed")
        if not rate_filter >= 0.0:
            raise InputError(f"rate_filter is {rate_filter}; a strain, not negative, is needed")
        stress_tolerance = as_number(stress_tolerance, "stress_tolerance")
        if not stress_tolerance >= 0.0:
            raise InputError(f"stress_tolerance is {stress_tolerance}; a stress in MPa, not negative, is needed")
        form, first, second, rates, times = _companion(law)
        if law.modes > MOST_MODES:
            raise InputError(
                f"modes: found {law.modes}, expected at most {MOST_MODES} in a user material; take an accuracy, as 1e-4"
            )
        log_spaced = law.spectrum == Spectrum.log_spaced(law.modes, law.decades)
        if log_spaced and law.decades > MOST_DECADES:
            raise InputError(f"decades: found {law.decades}, expected at most {MOST_DECADES} in a user material")
        modes = () if log_spaced else (*law.spectrum.relaxation_ratio.tolist(), *law.spectrum.modal_weight.tolist())
        floor = 1e-7 if law.companion is None else law.companion.rate_floor
        factor = law.tau_max if law.companion is None else law.alpha
        assert factor is not None
        return cls(
            (
                law.unrelaxed_modulus,
                law.hardening_modulus,
                bulk_modulus,
                float(form),
                factor,
                first,
                second,
                floor,
                rate_filter,
                float(law.modes),
                law.decades if log_spaced else 0.0,
                *modes,
                *rates,
                *times,
                *((stress_tolerance,) if stress_tolerance > 0.0 else ()),
            )
        )

    def named(self) -> dict[str, float]:
        """The eleven that have a name of their own."""
        return dict(zip(NAMES, self.values, strict=False))

    @property
    def modes(self) -> int:
        """N."""
        return int(self.named()["modes"])

    def law(self) -> Law:
        """The law that the list describes.

        Raises
        ------
        InputError
            If the list is none.
        """
        named = self.named()
        if len(self.values) < len(NAMES):
            raise InputError(f"constants: found {len(self.values)}, expected at least {len(NAMES)}")
        rest = list(self.values[len(NAMES) :])
        spectrum = None
        if named["decades"] == 0.0:
            ratio, weight, rest = rest[: self.modes], rest[self.modes : 2 * self.modes], rest[2 * self.modes :]
            spectrum = Spectrum(np.array(ratio), np.array(weight))
        first, second = named["slope_or_coefficient_or_points"], named["intercept_or_exponent"]
        companion = _companion_from(int(named["form"]), first, second, named["rate_floor_per_s"], rest)
        law = Law(
            unrelaxed_modulus=named["unrelaxed_modulus_MPa"],
            hardening_modulus=named["hardening_modulus_MPa"],
            tau_max=named["tau_max_s_or_alpha"] if companion is None else None,
            alpha=None if companion is None else named["tau_max_s_or_alpha"],
            modes=self.modes,
            decades=named["decades"] or 6.0,
            companion=companion,
            spectrum=spectrum,
        )
        expected = len(MaterialConstants.of(law, 1.0).values)
        if len(self.values) - expected not in (0, 1):  # the stress tolerance is no part of the law
            raise InputError(f"constants: found {len(self.values)}, expected {expected}, or one more")
        return law


def _companion(law: Law) -> tuple[int, float, float, tuple[float, ...], tuple[float, ...]]:
    """Form number, its two constants, and the rates and times of a table."""
    companion = law.companion
    if companion is None:
        return 0, 0.0, 0.0, (), ()
    if isinstance(companion, Table):
        points = len(companion.rates)
        if not 2 <= points <= MOST_TABLE_POINTS:
            raise InputError(
                f"companion: found a table of {points} points, expected 2 to {MOST_TABLE_POINTS} in a user material; "
                "thin it"
            )
        return FORMS.index(Table), float(points), 0.0, companion.rates, companion.tau_max
    if isinstance(companion, Weissenberg):
        return FORMS.index(Weissenberg), companion.slope, companion.intercept, (), ()
    if isinstance(companion, Exponential | PowerLaw):
        return FORMS.index(type(companion)), companion.coefficient, companion.exponent, (), ()
    raise InputError(
        f"companion: found the form {companion.form!r}, expected one that a user material knows: "
        f"{', '.join(form.form for form in FORMS if form is not None)}; tabulate it with probation.Table"
    )


def _companion_from(form: int, first: float, second: float, floor: float, rest: Sequence[float]) -> Companion | None:
    if form not in range(len(FORMS)):
        raise InputError(f"constants: found form = {form}, expected 0 to {len(FORMS) - 1}")
    relation = FORMS[form]
    if relation is None:
        return None
    if relation is Table:
        points = int(first)
        return Table(tuple(rest[:points]), tuple(rest[points : 2 * points]), floor)
    return relation(first, second, floor)  # type: ignore[call-arg]
