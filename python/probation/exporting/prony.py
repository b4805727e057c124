r"""The kind of export that keeps the linear part: a Prony series of the shear modulus at one strain rate.

At small strains e_HT = 3 e, and eq. (6) with a constant tau_max has the relaxation modulus
:math:`E(t) = 3 G + (E_u - 3 G) \sum_j p_j e^{-t/\tau_j}`; incompressible, the shear modulus is a third of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.exporting.check import Check, compared, ramp, ramp_jump_unload
from probation.exporting.kind import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.exporting.request import Request
    from probation.law.modal import Law

SMALL_STRAIN = 1e-6
"""Where the law is as good as linear [-]."""

_STRAINS = (0.005, 0.02, 0.05, 0.2, 0.5, 1.0)  # at which the table is compared with the whole law


@dataclass(frozen=True, eq=False)
class PronySeries:
    """Shear relaxation modulus: relaxed + sum of modulus_j exp(-t / time_j).

    Attributes
    ----------
    modulus : ndarray, shape (modes,) [MPa]
    time : ndarray, shape (modes,) [s]
    relaxed : float [MPa]
    bulk : float [MPa]
    """

    modulus: FloatArray
    time: FloatArray
    relaxed: float
    bulk: float

    @property
    def instantaneous(self) -> float:
        """Shear modulus at t = 0 [MPa]."""
        return float(self.relaxed + self.modulus.sum())

    @property
    def young(self) -> float:
        """Young's modulus at t = 0 with this bulk modulus [MPa]."""
        return 9.0 * self.bulk * self.instantaneous / (3.0 * self.bulk + self.instantaneous)

    @property
    def poisson_ratio(self) -> float:
        """At t = 0 [-]."""
        return (3.0 * self.bulk - 2.0 * self.instantaneous) / (2.0 * (3.0 * self.bulk + self.instantaneous))

    @classmethod
    def of_fractions(cls, young: float, poisson_ratio: float, fraction: FloatArray, time: FloatArray) -> PronySeries:
        """From instantaneous constants and fractions g_j of the shear modulus."""
        shear = young / (2.0 * (1.0 + poisson_ratio))
        bulk = young / (3.0 * (1.0 - 2.0 * poisson_ratio))
        return cls(shear * fraction, time, float(shear * (1.0 - fraction.sum())), bulk)

    def tension(self, time: FloatArray, strain: FloatArray) -> FloatArray:
        """Stress of incompressible tension along a piecewise-linear history [MPa]; shape (n_times,)."""
        stress = np.zeros(len(time))
        modal = np.zeros(len(self.time))
        for n in range(1, len(time)):
            step = time[n] - time[n - 1]
            fading = np.exp(-step / self.time)
            speed = (strain[n] - strain[n - 1]) / step
            modal = fading * modal - 3.0 * self.modulus * self.time * speed * np.expm1(-step / self.time)
            stress[n] = modal.sum() + 3.0 * self.relaxed * strain[n]
        return stress


def _make(request: Request) -> PronySeries:
    law = request.law
    assert law.spectrum is not None
    tau_max = _tau_max(law, request.rate)
    if 3.0 * law.hardening_modulus >= law.unrelaxed_modulus:
        raise InputError(
            f"hardening_modulus: found {law.hardening_modulus:g} MPa, expected less than a third of E_u "
            f"({law.unrelaxed_modulus:g} MPa); a Prony series cannot rise"
        )
    viscous = law.unrelaxed_modulus / 3.0 - law.hardening_modulus
    active = law.spectrum.modal_weight > 0.0
    weight = law.spectrum.modal_weight[active] / law.spectrum.modal_weight.sum()
    return PronySeries(
        viscous * weight, tau_max * law.spectrum.relaxation_ratio[active], law.hardening_modulus, request.bulk_modulus
    )


def _tau_max(law: Law, rate: float | None) -> float:
    if law.companion is None:
        assert law.tau_max is not None
        return law.tau_max
    if rate is None:
        raise InputError("rate: found none, expected the strain rate at which tau_max is taken; add --rate")
    assert law.alpha is not None
    return float(law.alpha * law.companion.relaxation_time([rate])[0])


def _rate(request: Request) -> float:
    return float(request.check_rates[len(request.check_rates) // 2]) if request.rate is None else request.rate


def _check(request: Request, read: PronySeries) -> Sequence[Check]:
    rate, original = _rate(request), request.original
    linear = replace(original, companion=None, alpha=None, tau_max=_tau_max(original, request.rate))
    scale = request.strain / SMALL_STRAIN  # the same times, so that every mode is asked for
    time, strain = ramp_jump_unload(rate, request.strain)
    small = strain / scale
    expected = scale * linear.stress(time, small, "exact")
    what = (
        "the table read back from this file, solved on its own, against the linear part of the identified law, "
        "incompressible tension with a tenfold jump of the rate and an unloading"
    )
    checks = [compared("round_trip", what, [read.tension(time, strain)], [expected])]
    for name, factor in (("at_this_rate", 1.0), ("ten_times_slower", 0.1), ("ten_times_faster", 10.0)):
        time, strain = ramp(factor * rate, request.strain)
        words = f"left out, on a ramp to strain {request.strain:g} at {factor * rate:.2g} 1/s, against the whole law"
        checks.append(compared(name, words, [read.tension(time, strain)], [original.stress(time, strain, "exact")]))
    return checks


def _say(request: Request, content: PronySeries) -> Sequence[str]:
    rate = _rate(request)
    lines = [
        f"shear modulus {content.instantaneous:.6g} MPa at once, {content.relaxed:.6g} MPa relaxed; "
        f"{len(content.time)} terms from {content.time.min():.3g} to {content.time.max():.3g} s; bulk modulus "
        f"{content.bulk:.6g} MPa, elastic"
    ]
    if request.law.companion is not None:
        lines.append(f"tau_max is that of the strain rate {rate:.4g} 1/s: the table holds at this rate only")
    lines += [
        "left out: the nonlinearity of the hardening network (G e_HT grows like exp(2 e), here 3 G e), and that "
        "tau_max follows the strain rate (jumps, holds, unloading, necks)",
        "stress on a ramp at that rate, table / law [MPa]: " + _beside(request, content, rate),
    ]
    return lines


def _beside(request: Request, content: PronySeries, rate: float) -> str:
    strains = [strain for strain in _STRAINS if strain <= request.strain] or [request.strain]
    time, strain = ramp(rate, strains[-1])
    strain = np.union1d(strain, strains)
    time = strain / rate
    pair = content.tension(time, strain), request.original.stress(time, strain, "exact")
    at = np.searchsorted(strain, strains)
    return "; ".join(f"{pair[0][i]:.4g} / {pair[1][i]:.4g} at strain {strain[i]:g}" for i in at)


PRONY = Kind(_make, _check, _say)
