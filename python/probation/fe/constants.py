"""A law as the list of constants that every finite-element interface takes (probation/material/constants.hpp)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import FloatArray, as_number
from probation.companion import Exponential, PowerLaw, Table, Weissenberg
from probation.errors import InputError
from probation.law import Spectrum

if TYPE_CHECKING:
    from probation.companion import Companion
    from probation.law import Law

MOST_MODES = 64
MOST_TABLE_POINTS = 32
_RATE_FLOOR_WITHOUT_COMPANION = 1e-7  # not looked at, but it must be a rate


def material_constants(law: Law, bulk_modulus: float, *, rate_filter: float = 0.0) -> FloatArray:
    """The constants of a law for the material point.

    Parameters
    ----------
    law : Law
        With at most 64 modes; its companion one of Weissenberg, Exponential, PowerLaw, Table (32 points), or none.
    bulk_modulus : float
        K [MPa]; the one-dimensional law is incompressible and does not tell it.
    rate_filter : float
        Strain over which the rate is filtered before the companion relation sees it [-]; 0: not at all.

    Returns
    -------
    ndarray, shape (constants,)
        11 numbers, then the modes where they are not log-spaced, then a companion table.

    Raises
    ------
    InputError
        For what the material point cannot hold.
    """
    bulk_modulus, rate_filter = as_number(bulk_modulus, "bulk_modulus"), as_number(rate_filter, "rate_filter")
    if not bulk_modulus > 0.0:
        raise InputError(f"bulk_modulus is {bulk_modulus}; a positive modulus in MPa is needed")
    if not rate_filter >= 0.0:
        raise InputError(f"rate_filter is {rate_filter}; a strain, not negative, is needed")
    if law.modes > MOST_MODES:
        raise InputError(f"modes is {law.modes}; the material point holds at most {MOST_MODES}")
    form, time, first, second, floor, table = _companion(law)
    spectrum = law.spectrum
    assert spectrum is not None
    log_spaced = spectrum == Spectrum.log_spaced(law.modes, law.decades)
    fixed = [law.unrelaxed_modulus, law.hardening_modulus, bulk_modulus, form, time, first, second, floor]
    fixed += [rate_filter, law.modes, law.decades if log_spaced else 0.0]
    kernel = [] if log_spaced else [spectrum.relaxation_ratio, spectrum.modal_weight]
    return np.concatenate([np.array(fixed, dtype=np.float64), *kernel, *table])


def _companion(law: Law) -> tuple[int, float, float, float, float, list[FloatArray]]:
    """Constants 4 to 8, and the table at the end."""
    companion: Companion | None = law.companion
    if companion is None:
        assert law.tau_max is not None
        return 0, law.tau_max, 0.0, 0.0, _RATE_FLOOR_WITHOUT_COMPANION, []
    assert law.alpha is not None
    match companion:
        case Weissenberg():
            return 1, law.alpha, companion.slope, companion.intercept, companion.rate_floor, []
        case Exponential():
            return 2, law.alpha, companion.coefficient, companion.exponent, companion.rate_floor, []
        case PowerLaw():
            return 3, law.alpha, companion.coefficient, companion.exponent, companion.rate_floor, []
        case Table() if len(companion.rates) <= MOST_TABLE_POINTS:
            table = [np.array(companion.rates), np.array(companion.tau_max)]
            return 4, law.alpha, float(len(companion.rates)), 0.0, companion.rate_floor, table
    raise InputError(
        f"companion is {type(companion).__name__}; the material point holds Weissenberg, Exponential, PowerLaw and "
        f"Table with at most {MOST_TABLE_POINTS} points: tabulate it"
    )
