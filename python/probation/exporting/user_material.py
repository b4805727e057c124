"""The kind of export that keeps the whole law: the constants of a user-material routine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.exporting.check import Check, compared, ramp_jump_unload
from probation.exporting.constants import NAMES, MaterialConstants, state_size
from probation.exporting.kind import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request


def _make(request: Request) -> MaterialConstants:
    return MaterialConstants.of(request.law, request.bulk_modulus, stress_tolerance=request.stress_tolerance)


def _check(request: Request, read: MaterialConstants) -> Sequence[Check]:
    law = read.law()
    histories = [ramp_jump_unload(rate, request.strain) for rate in request.check_rates]
    found = [law.stress(time, strain, "exact") for time, strain in histories]
    expected = [request.original.stress(time, strain, "exact") for time, strain in histories]
    rates = ", ".join(f"{rate:.2g}" for rate in request.check_rates)
    what = (
        f"the law of the constants read back from this file, against the identified law, in incompressible tension to "
        f"strain {request.strain:g} with a tenfold jump of the rate and an unloading, at {rates} 1/s"
    )
    return [compared("round_trip", what, found, expected)]


def _say(request: Request, content: MaterialConstants) -> Sequence[str]:
    softer = 1.0 - 1.0 / (1.0 + request.law.unrelaxed_modulus / (9.0 * request.bulk_modulus))
    lines = [f"constants, in this order: {', '.join(NAMES)}"]
    if content.named()["decades"] == 0.0:
        lines.append("decades = 0: the ratios tau_j / tau_max and the weights p_j of all modes follow, fastest first")
    if content.named()["form"] == 4:
        lines.append("a table's rates, then its tau_max, stand at the end")
    if request.stress_tolerance > 0.0:
        lines.append(f"the last constant is the stress tolerance {request.stress_tolerance:g} MPa of an increment")
    lines += [
        f"state variables: {state_size(content.modes)} (10 + 6 N), all zero at the start",
        f"the bulk modulus {request.bulk_modulus:.6g} MPa is not identified: it makes Young's modulus {softer:.1e} "
        "(relative) less than E_u",
        "known limits of the law: holds hardly relax (tau_max at rate_floor is long), unloading starts steeper than "
        "E_u, and a point that slows down may have several solutions",
    ]
    return lines


USER_MATERIAL = Kind(_make, _check, _say)
