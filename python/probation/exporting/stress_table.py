"""The kind of export that keeps monotonic flow: true stress over plastic strain, a curve for each strain rate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.exporting.check import Check, compared, ramp_unload
from probation.exporting.kind import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.exporting.request import Request
    from probation.law.modal import Law

YIELD_OFFSET = 1e-4
"""Plastic strain whose stress is the first yield stress [-]."""

UNLOADING = 0.01
"""Strain by which the check unloads [-]."""

_TOLERANCE = 5e-4  # of the largest stress, between the points of a curve
_MOST_POINTS = 100
_FINE = 2000
_RATES_PER_DECADE = 2


@dataclass(frozen=True, eq=False)
class StressTable:
    """Curves over common plastic strains.

    Attributes
    ----------
    rate : ndarray, shape (rates,) [1/s]
        Increasing.
    plastic_strain : ndarray, shape (points,) [-]
        From 0, increasing.
    stress : ndarray, shape (rates, points) [MPa]
        True; increasing with the rate.
    young : float
        What turns stress into elastic strain [MPa].
    poisson_ratio : float [-]
    intervals : int or None
        Even ones into which the code divides the curves anew; None if it keeps the points.

    Raises
    ------
    InputError
        If no code could use the table.
    """

    rate: FloatArray
    plastic_strain: FloatArray
    stress: FloatArray
    young: float
    poisson_ratio: float
    intervals: int | None = None

    def __post_init__(self) -> None:
        if self.plastic_strain[0] != 0.0 or not np.all(np.diff(self.plastic_strain) > 0.0):
            raise InputError("plastic strain: found no increase from 0, expected one; the law stiffens beyond E_u")
        if not np.all(np.diff(self.rate) > 0.0):
            raise InputError("rates: found two that are the same in the digits of the format, expected distinct ones")
        if not np.all(self.stress > 0.0):
            raise InputError("stress: found a yield stress that is not positive, expected positive ones")
        self._check_order()

    def _check_order(self) -> None:
        rising = np.diff(self.stress, axis=0) > 0.0
        if not np.all(rising):
            slow, point = (int(index) for index in np.argwhere(~rising)[0])
            raise InputError(
                f"rates: found less stress at {self.rate[slow + 1]:.3g} than at {self.rate[slow]:.3g} 1/s (at plastic "
                f"strain {self.plastic_strain[point]:.3g}), expected stress that increases with the rate; a table "
                "by rate cannot represent this law there, choose other rates or a smaller strain"
            )

    def tension(self, rate: float, strain: FloatArray) -> FloatArray:
        """Stress of tension at a constant rate [MPa]; between the rates linear, beyond them as at the last."""
        curve = np.array([np.interp(rate, self.rate, column) for column in self.stress.T])
        plastic = self.plastic_strain
        if self.intervals is not None:
            even = np.linspace(0.0, plastic[-1], self.intervals + 1)
            curve, plastic = np.interp(even, plastic, curve), even
        total = np.concatenate([[0.0], plastic + curve / self.young])
        answer: FloatArray = np.interp(strain, total, np.concatenate([[0.0], curve]))
        return answer


def _make(request: Request) -> StressTable:
    law, rates = request.law, _rates(request)
    fine = np.geomspace(0.01 * YIELD_OFFSET, request.strain, _FINE)
    curves = [_curve(law, rate, fine) for rate in rates]
    last = min(float(plastic[-1]) if len(plastic) else 0.0 for plastic, _ in curves)
    if last <= 2.0 * YIELD_OFFSET:
        raise InputError(f"strain: found {request.strain:g}, expected a strain with plastic flow; take a larger one")
    at = np.geomspace(YIELD_OFFSET, last, _FINE)
    stress = np.array([np.interp(at, plastic, stress) for plastic, stress in curves])
    points = _points(at, stress)
    plastic = at[points]
    plastic[0] = 0.0
    poisson_ratio = 0.5 * (1.0 - law.unrelaxed_modulus / (3.0 * request.bulk_modulus))
    if poisson_ratio <= 0.0:
        third = law.unrelaxed_modulus / 3.0
        raise InputError(f"bulk_modulus: found {request.bulk_modulus:g}, expected more than E_u / 3 = {third:g} MPa")
    return StressTable(np.array(rates), plastic, stress[:, points], law.unrelaxed_modulus, poisson_ratio)


def _rates(request: Request) -> tuple[float, ...]:
    if request.rates is not None:
        return request.rates
    companion = request.law.companion
    if companion is None or companion.calibrated is None:
        why = "a constant tau_max says nothing of" if companion is None else "the companion relation does not tell"
        raise InputError(f"rates: found none, expected the strain rates of the curves ({why} them); add --rates")
    low, high = companion.calibrated
    count = max(2, round(_RATES_PER_DECADE * np.log10(high / low)) + 1)
    return tuple(np.geomspace(low, high, count).tolist())


def _curve(law: Law, rate: float, strain: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Plastic strain and stress of a ramp; shape (n,) each."""
    whole = np.concatenate([[0.0], strain])
    stress = law.stress(whole / rate, whole, "exact")[1:]
    plastic = strain - stress / law.unrelaxed_modulus
    flowing = plastic >= 0.5 * YIELD_OFFSET
    if not np.all(np.diff(plastic[flowing]) > 0.0):
        raise InputError(
            f"strain: found a plastic strain that falls on a ramp at {rate:.3g} 1/s to {strain[-1]:g}, expected one "
            "that increases; the law stiffens beyond E_u there, take a smaller strain"
        )
    return plastic[flowing], stress[flowing]


def _points(at: FloatArray, stress: FloatArray) -> list[int]:
    """Which plastic strains a curve needs: the worst of all curves is added until straight lines between them do."""
    points, allowed = [0, len(at) - 1], _TOLERANCE * float(stress.max())
    while len(points) < _MOST_POINTS:
        missing = np.abs([np.interp(at, at[points], curve[points]) - curve for curve in stress]).max(axis=0)
        if missing.max() <= allowed:
            break
        points = sorted([*points, int(missing.argmax())])
    return points


def _check(request: Request, read: StressTable) -> Sequence[Check]:
    middles = np.sqrt(read.rate[1:] * read.rate[:-1])
    strain = np.geomspace(YIELD_OFFSET, 0.999 * request.strain, 400)
    last = read.plastic_strain[-1] + read.stress[:, -1].min() / read.young
    strain = strain[strain <= last]
    checks = [
        _beside(
            request,
            read,
            read.rate,
            strain,
            "round_trip",
            "the table read back from this file, elastic-plastic ramps at its rates, against the identified law",
        ),
    ]
    if len(middles):
        what = "the same at the rates midway, between which codes interpolate linearly"
        checks.append(_beside(request, read, middles, strain, "between_rates", what))
    rate = float(read.rate[len(read.rate) // 2])
    time, path = ramp_unload(rate, request.strain, UNLOADING)
    whole = request.original.stress(time, path, "exact")
    end = int(np.argmax(path))
    elastic = whole[end] + read.young * (path[end:] - path[end])
    what = f"left out: elastic unloading at E_u from strain {request.strain:g} by {UNLOADING:g}, against the law's"
    checks.append(compared("unloading", what, [elastic], [whole[end:]]))
    return checks


def _beside(request: Request, read: StressTable, rates: FloatArray, strain: FloatArray, name: str, what: str) -> Check:
    whole = np.concatenate([[0.0], strain])
    found = [read.tension(rate, strain) for rate in rates]
    return compared(name, what, found, [request.original.stress(whole / rate, whole, "exact")[1:] for rate in rates])


def _say(request: Request, content: StressTable) -> Sequence[str]:
    rates = ", ".join(f"{rate:.4g}" for rate in content.rate)
    return [
        f"{len(content.rate)} curves of {len(content.plastic_strain)} points to plastic strain "
        f"{content.plastic_strain[-1]:.4g}, at constant true strain rates of {rates} 1/s; elastic modulus E_u = "
        f"{content.young:.6g} MPa, Poisson's ratio {content.poisson_ratio:.6g}",
        f"the first yield stress is that at plastic strain {YIELD_OFFSET:g}, set at 0; plastic strain = strain - "
        "stress / E_u",
        "left out: everything but loading at a nearly constant rate. No recovery on unloading, no relaxation in holds, "
        "the rate acts at once; the network hardens alike in tension and compression; the strain rate is that of the "
        "total strain",
    ]


STRESS_TABLE = Kind(_make, _check, _say)
