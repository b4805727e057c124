"""What changes relaxation and flow: rates, stress, heat, age, the spectrum, a slow process."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.causes.form import KELVIN, ROOM, Change, Form, Shape, mid
from probation_studies.blind.laboratories.test_house.draws import Even, LogEven, OneOf
from probation_studies.blind.laboratories.test_house.modal import RATIOS, WEIGHTS, haward_thackray, solve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.test_house.draws import Free
    from probation_studies.blind.laboratories.test_house.modal import Feedback, FloatArray, Law
    from probation_studies.blind.laboratories.test_house.trial import Run, Test

_EYRING_RATE = 2e-6
"""Strain rate that an amount of one makes the reference of Eyring's process [1/s]."""


def _cross(a: float, q: Shape, test: Test) -> Change:
    """Cross 1965: tau falls beyond a characteristic rate, as 1/(1 + (rate/rate_c)^a)."""
    return Change(log_tau=lambda run: -np.log1p((np.abs(run.rate) / q["rate"]) ** a) + np.log(2.0))


def _eyring_asinh(a: float, q: Shape, test: Test) -> Change:
    """Eyring 1936: a part of tau follows asinh(y)/y; the amount sets y = rate/rate_0."""

    def log_tau(run: Run) -> FloatArray:
        y = np.maximum(np.abs(run.rate), 1e-9) * a / _EYRING_RATE
        return np.asarray(np.log(1.0 - q["share"] + q["share"] * np.arcsinh(y) / y))

    return Change(log_tau=log_tau)


def _eyring(a: float, q: Shape, test: Test) -> Change:
    """Eyring 1936, Tervoort 1996: tau (s/s0)/sinh(s/s0) of the whole stress s; the amount is 1/s0 [1/MPa]."""

    def feedback(n: int, stress: float, step: float, rate: float) -> float:
        y = min(abs(stress) * a, 50.0)
        return float(y / np.sinh(y)) if y > 1e-6 else 1.0

    return Change(feedback=lambda run: feedback)


def _cooperative(a: float, q: Shape, test: Test) -> Change:
    """Fotheringham and Cherry 1978: relaxation quickens by sinh^n of the stress above the relaxed one."""

    def feedback(run: Run) -> Feedback:
        relaxed = run.law.hardening * haward_thackray(run.strain)
        return lambda n, stress, step, rate: float(
            1.0 / (1.0 + np.sinh(min(abs(stress - relaxed[n]) * a, 8.0)) ** q["power"])
        )

    return Change(feedback=feedback)


def _heated(a: float, q: Shape, *, wlf: bool) -> Change:
    """dT/dt = beta s rate/(rho c) - T/t_loss (Taylor and Quinney 1934); the amount is -d ln tau/dT at T = 0 [1/K]."""

    def feedback(run: Run) -> Feedback:
        rise = 0.0

        def factor(n: int, stress: float, step: float, rate: float) -> float:
            nonlocal rise
            power = q["taylor_quinney"] * max(stress * rate, 0.0) / q["heat"]
            kept, before = np.exp(-step / q["loss"]), rise
            rise = before * kept + power * q["loss"] * (1.0 - kept)
            mean = 0.5 * (before + rise)
            if wlf:
                return float(np.exp(-a * mean / (1.0 + mean / q["c2"])))
            return float(np.exp(-a * KELVIN**2 * (1.0 / KELVIN - 1.0 / (KELVIN + mean))))

        return factor

    return Change(feedback=feedback)


def _heated_arrhenius(a: float, q: Shape, test: Test) -> Change:
    """Arrhenius 1889."""
    return _heated(a, q, wlf=False)


def _heated_wlf(a: float, q: Shape, test: Test) -> Change:
    """Williams, Landel and Ferry 1955."""
    return _heated(a, q, wlf=True)


def _way(run: Run) -> FloatArray:
    """That the strain has gone, forth and back, at the end of every step."""
    return np.cumsum(np.abs(np.diff(run.strain)))


def _klompen(a: float, q: Shape, test: Test) -> Change:
    """Klompen and others 2005: tau exp(S_a R), R a Carreau-Yasuda function of the plastic strain."""

    def softened(way: FloatArray | float) -> FloatArray:
        power = (q["r2"] - 1.0) / q["r1"]
        return np.asarray((1.0 + (0.965 * np.exp(np.minimum(way, 1.0))) ** q["r1"]) ** power)

    return Change(log_tau=lambda run: a * softened(_way(run)) / softened(0.0))


def _saturating(a: float, q: Shape, test: Test) -> Change:
    """Boyce, Parks and Argon 1988: ds = h (1 - s/s_ss) d eps, an exponential rejuvenation."""
    return Change(log_tau=lambda run: a * np.exp(-_way(run) / q["reach"]))


def _other_slope(a: float, q: Shape, test: Test) -> Change:
    """Weights as tau^(1/2 + n): another wedge (Tobolsky 1960)."""
    weights = RATIOS ** (0.5 + q["sign"] * a)
    return Change(weights=weights / weights.sum())


def _log_normal(a: float, q: Shape, test: Test) -> Change:
    """A log-normal process stands on the wedge (Wiechert 1893), within its six decades."""
    bump = np.exp(-0.5 * ((np.log10(RATIOS) - q["centre"]) / q["width"]) ** 2)
    return Change(weights=WEIGHTS * (1.0 - a) + a * bump / bump.sum())


def _slow(share: float, factor: float, run: Run) -> FloatArray:
    """Stress [MPa] of an element of modulus share E and time factor tau_max of the reference rate."""
    still, one = np.zeros(len(run.strain)), np.ones(1)
    tau = factor * run.law.tau(np.full(len(run.rate), run.test.reference))
    return solve(run.time, run.strain, tau, still, share * run.law.modulus, ratios=one, weights=one)


def _slow_process(a: float, q: Shape, elements: Sequence[tuple[float, float]]) -> Change:
    return Change(
        stress=lambda run, stress: (
            stress + np.sum([_slow(a * part, q["factor"] * time, run) for time, part in elements], axis=0)
        )
    )


def _maxwell(a: float, q: Shape, test: Test) -> Change:
    """Maxwell 1867: one relaxation slower than the spectrum, at a time that does not depend on the rate."""
    return _slow_process(a, q, [(1.0, 1.0)])


def _stretched(a: float, q: Shape, test: Test) -> Change:
    """Kohlrausch 1854, exponent 0.6 or so: three modes. Their times stay, else it were another spectrum."""
    return _slow_process(a, q, [(0.35, 0.3), (1.0, 0.45), (2.5, 0.25)])


def _network_factor(q: Shape, test: Test) -> float:
    return 1.0 + q["network"] * (test.temperature - ROOM) / KELVIN


def _arrhenius(a: float, q: Shape, test: Test) -> Change:
    """Arrhenius 1889 between records of declared temperatures; G is entropic (Treloar 1975), constant, or falls."""
    shift = a * KELVIN**2 * (1.0 / (KELVIN - ROOM + test.temperature) - 1.0 / KELVIN)
    return Change(law=lambda run: run.law.scaled(alpha=float(np.exp(shift)), hardening=_network_factor(q, test)))


def _wlf(a: float, q: Shape, test: Test) -> Change:
    """Williams, Landel and Ferry 1955; E falls by some tenths of a per cent per degree."""
    warmer = test.temperature - ROOM
    shift = -a * warmer / (1.0 + warmer / q["c2"])
    return Change(law=lambda run: run.law.scaled(1.0 - q["modulus"] * warmer, float(np.exp(shift))))


def _moisture(a: float, q: Shape, test: Test) -> Change:
    """Water is taken up while specimens wait (Reimschuessel 1978): E falls with the order, or rises in drying."""
    return Change(law=lambda run: run.law.scaled(float(np.exp(-q["sign"] * a * test.order))))


def _ageing(a: float, q: Shape, test: Test) -> Change:
    """Struik 1978: relaxation times grow as age^mu; every test comes one wait later."""

    def law(run: Run) -> Law:
        return run.law.scaled(alpha=(1.0 + a * test.order) ** q["mu"])

    return Change(law=law)


def _warming_room(a: float, q: Shape, test: Test) -> Change:
    """The room warms from test to test; nobody declared it."""
    return Change(law=lambda run: run.law.scaled(alpha=float(np.exp(-a * test.order))))


def _conditioning(a: float, q: Shape, test: Test) -> Change:
    """A specimen comes to the chamber's temperature during its test."""
    return Change(log_tau=lambda run: a * np.expm1(-mid(run.time) / (0.2 * run.time[-1])))


_HEAT: dict[str, Free] = {
    "taylor_quinney": Even(0.6, 0.95),
    "heat": Even(1.8, 2.2),
    "loss": LogEven(8.0, 120.0),
}  # -, MPa/K, s
_SIGN = OneOf((1.0, -1.0))
_RATES, _FAST, _ORDER, _WARM = (frozenset({each}) for each in ("rates", "fast", "order", "temperatures"))

FLOW = (
    Form("rate_dependent_relaxation", "cross", _cross, 0.01, 1.0, {"rate": LogEven(2e-4, 5e-3)}, needs=_RATES),
    Form(
        "rate_dependent_relaxation", "eyring_asinh", _eyring_asinh, 1e-5, 0.02, {"share": Even(0.05, 0.6)},
        needs=_RATES,
    ),
    Form("stress_activated_flow", "eyring", _eyring, 1e-4, 0.3),
    Form("stress_activated_flow", "cooperative", _cooperative, 1e-4, 0.3, {"power": Even(3.0, 6.0)}),
    Form("self_heating", "arrhenius", _heated_arrhenius, 0.02, 0.25, _HEAT, needs=_FAST),
    Form("self_heating", "wlf", _heated_wlf, 0.02, 0.25, {**_HEAT, "c2": Even(45, 90)}, needs=_FAST),
    Form("structural_softening", "klompen", _klompen, 0.01, 3.0, {"r1": Even(20, 60), "r2": Even(-3, -6)}),
    Form("structural_softening", "saturating", _saturating, 0.01, 3.0, {"reach": LogEven(0.02, 0.12)}),
    Form("spectrum_shape", "power", _other_slope, 0.005, 0.2, {"sign": _SIGN}),
    Form("spectrum_shape", "wiechert", _log_normal, 0.01, 0.4, {"centre": Even(-2.5, -0.7), "width": Even(0.3, 0.8)}),
    Form("slow_process", "maxwell", _maxwell, 1e-4, 0.1, {"factor": LogEven(4.0, 30.0)}),
    Form("slow_process", "stretched", _stretched, 1e-4, 0.1, {"factor": LogEven(8.0, 40.0)}),
    Form(
        "temperature_dependence", "arrhenius", _arrhenius, 0.01, 0.2, {"network": OneOf((1.0, 0.0, -1.0))},
        needs=_WARM,
    ),
    Form(
        "temperature_dependence", "wlf", _wlf, 0.01, 0.2, {"c2": Even(50, 120), "modulus": Even(0.0, 0.003)},
        needs=_WARM,
    ),
    Form("change_between_tests", "moisture", _moisture, 0.01, 0.5, {"sign": _SIGN}, needs=_ORDER),
    Form("change_between_tests", "ageing", _ageing, 0.03, 1.5, {"mu": Even(0.6, 1.0)}, needs=_ORDER),
)  # fmt: skip
"""Of the material but for its network."""

RIVALS = (
    Form("temperature_drift", "test_to_test", _warming_room, 0.01, 1.0),
    Form("temperature_drift", "conditioning", _conditioning, 0.01, 1.0, scope="either"),
)
"""Never drawn, but what is drawn must stand out from them."""
