"""Creep: the stress is imposed and the strain is found."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import probation

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.law import Law


def creep_strain(law: Law, time: FloatArray, true_stress: FloatArray) -> FloatArray:
    """True strain [-] under an imposed true stress [MPa], all of shape (n_times,)."""
    solve = cast("Callable[[Law, FloatArray, FloatArray], FloatArray] | None", getattr(probation, "creep", None))
    if solve is None:
        raise NotImplementedError("creep is not part of this build of the engine")
    return solve(law, time, true_stress)
