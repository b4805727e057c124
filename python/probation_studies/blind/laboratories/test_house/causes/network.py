"""What changes the network, and what the specimen carries: limits of chains, late networks, back stress, damage."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erf

from probation_studies.blind.laboratories.test_house.causes.form import (
    Change,
    Form,
    Shape,
    at_instants,
    largest,
    mid,
)
from probation_studies.blind.laboratories.test_house.draws import Even, LogEven, OneOf

if TYPE_CHECKING:
    from probation_studies.blind.laboratories.test_house.modal import FloatArray
    from probation_studies.blind.laboratories.test_house.trial import Run, Test

_RATE = 1e-3
"""At which a hardening that depends on the rate is what it is without [1/s]."""


def _invariant(strain: FloatArray) -> FloatArray:
    """The first one of the Cauchy-Green tensors."""
    return np.asarray(np.exp(2.0 * strain) + 2.0 * np.exp(-strain))


def _speed(run: Run) -> FloatArray:
    """At instants [1/s]."""
    return at_instants(np.abs(run.rate))


def _eight_chain(a: float, q: Shape, test: Test) -> Change:
    """Arruda and Boyce 1993, the inverse Langevin function after Cohen 1991; the amount is 1/N."""

    def cohen(y: FloatArray) -> FloatArray:
        return np.asarray((3.0 - y * y) / (1.0 - y * y))

    def relaxed(run: Run, before: FloatArray) -> FloatArray:
        y = np.minimum(np.sqrt(_invariant(run.strain) / 3.0 * a), 0.98)
        return np.asarray(before * cohen(y) / cohen(np.sqrt(a)))

    return Change(relaxed=relaxed)


def _gent(a: float, q: Shape, test: Test) -> Change:
    """Gent 1996; the amount is 1/J_m."""
    return Change(relaxed=lambda run, before: before / np.maximum(1.0 - a * (_invariant(run.strain) - 3.0), 0.05))


def _logarithmic(a: float, q: Shape, test: Test) -> Change:
    """Johnson and Cook 1983: G (1 + C ln(rate/rate_0))."""

    def relaxed(run: Run, before: FloatArray) -> FloatArray:
        factor = 1.0 + q["sign"] * a * np.log(np.maximum(_speed(run), 1e-7) / _RATE)
        return np.asarray(before * np.maximum(factor, 0.05))

    return Change(relaxed=relaxed)


def _cowper_symonds(a: float, q: Shape, test: Test) -> Change:
    """Viscous hardening (Wendlandt and others 2005) after Cowper and Symonds 1957: G (1 + a (rate/rate_0)^(1/p))."""
    return Change(relaxed=lambda run, before: before * (1.0 + a * (_speed(run) / _RATE) ** (1.0 / q["p"])))


def _transition(a: float, q: Shape, test: Test) -> Change:
    """Farge and others 2015: the network is built with the fibrils, a part of G by a smooth step in strain."""

    def built(strain: FloatArray) -> FloatArray:
        return np.asarray(0.5 * (1.0 + np.tanh((strain - q["centre"]) / (2.0 * q["width"]))))

    return Change(relaxed=lambda run, before: before * (1.0 - a + a * built(largest(run.strain))))


def _first_order(a: float, q: Shape, test: Test) -> Change:
    """Avrami 1939, of the first order: fibrils that the strain calls for form at their own pace."""

    def relaxed(run: Run, before: FloatArray) -> FloatArray:
        called = 1.0 - np.exp(-((largest(run.strain) / q["reach"]) ** 2))
        formed = np.zeros(len(called))
        for n, kept in enumerate(np.exp(-np.diff(run.time) / (q["part"] * test.longest))):
            formed[n + 1] = kept * formed[n] + (1.0 - kept) * 0.5 * (called[n] + called[n + 1])
        return np.asarray(before * (1.0 - a + a * formed))

    return Change(relaxed=relaxed)


def _armstrong_frederick(a: float, q: Shape, test: Test) -> Change:
    """Armstrong and Frederick 1966: dX = C d eps - g X |d eps|, on top of the law; the amount is C/g [MPa]."""

    def stress(run: Run, before: FloatArray) -> FloatArray:
        back = np.zeros(len(before))
        for n, change in enumerate(np.diff(run.strain)):
            limit = np.sign(change) * a
            back[n + 1] = limit + (back[n] - limit) * np.exp(-abs(change) / q["reach"])
        return np.asarray(before + back)

    return Change(stress=stress)


def _ohno_wang(a: float, q: Shape, test: Test) -> Change:
    """Ohno and Wang 1993: dX = C (d eps - (|X|/r)^m <X/r d eps>), nearly linear up to the limit r [MPa]."""

    def stress(run: Run, before: FloatArray) -> FloatArray:
        back = np.zeros(len(before))
        for n, change in enumerate(np.diff(run.strain) / 4.0 / q["reach"]):
            y = back[n] / a
            for _ in range(4):
                y += change - abs(y) ** q["m"] * max(y * change, 0.0) * np.sign(y)
            back[n + 1] = a * y
        return np.asarray(before + back)

    return Change(stress=stress)


def _ogden_roxburgh(a: float, q: Shape, test: Test) -> Change:
    """Ogden and Roxburgh 1999: 1 - (1/r) erf((W_m - W)/(m + beta W_m)) on the stress, W the network's energy over G."""

    def stress(run: Run, before: FloatArray) -> FloatArray:
        energy = 0.5 * (_invariant(run.strain) - 3.0)
        most = largest(energy)
        return np.asarray(before * (1.0 - a * erf((most - energy) / (0.1 * q["m"] + q["beta"] * most))))

    return Change(stress=stress)


def _zuniga_beatty(a: float, q: Shape, test: Test) -> Change:
    """Zuniga and Beatty 2002: exp(-b sqrt(M - m)) on the stress, m the magnitude of the left Cauchy-Green tensor."""

    def stress(run: Run, before: FloatArray) -> FloatArray:
        m = np.sqrt(np.exp(4.0 * run.strain) + 2.0 * np.exp(-2.0 * run.strain)) - np.sqrt(3.0)
        return np.asarray(before * np.exp(-a * np.sqrt(largest(m) - m)))

    return Change(stress=stress)


def _weibull(a: float, q: Shape, test: Test) -> Change:
    """Bundles that break (Krajcinovic and Silva 1982): D = a (1 - exp(-((eps - eps_0)/k)^n)) of the largest strain."""

    def stress(run: Run, before: FloatArray) -> FloatArray:
        beyond = np.maximum(largest(run.strain) - q["start"], 0.0) / q["scale"]
        return np.asarray(before * (1.0 - a * (1.0 - np.exp(-(beyond ** q["power"])))))

    return Change(stress=stress)


def _lemaitre(a: float, q: Shape, test: Test) -> Change:
    """Lemaitre 1985: dD/dp = (Y/S)^s beyond a threshold; the amount is D at a strain of a half or so."""

    def stress(run: Run, before: FloatArray) -> FloatArray:
        grown = np.maximum(np.diff(largest(run.strain)), 0.0) * (mid(run.strain) > q["start"])
        flow = 0.4 * run.law.modulus * run.law.alpha * test.typical
        done = np.cumsum(2.0 * a * np.abs(mid(before) / flow) ** (2.0 * q["s"]) * grown)
        return np.asarray(before * (1.0 - np.minimum(np.append(0.0, done), 0.9)))

    return Change(stress=stress)


def _volume_linear(a: float, q: Shape, test: Test) -> Change:
    """Cavitation from a strain on (G'Sell and others 2002): the section is larger by exp(volume strain)."""

    def force(run: Run, before: FloatArray) -> FloatArray:
        volume = a * 0.01 * np.logaddexp(0.0, (largest(run.strain) - q["start"]) / 0.01)
        return np.asarray(before * np.exp(volume))

    return Change(force=force)


def _volume_power(a: float, q: Shape, test: Test) -> Change:
    """Crazes (Bucknall 1977): volume strain as a power of the strain."""
    return Change(force=lambda run, before: before * np.exp(a * np.maximum(largest(run.strain), 0.0) ** q["power"]))


_LARGE, _LARGE_RATES, _BACK = frozenset({"large"}), frozenset({"large", "rates"}), frozenset({"unloading"})

NETWORK = (
    Form("finite_extensibility", "eight_chain", _eight_chain, 1e-3, 0.35, needs=_LARGE),
    Form("finite_extensibility", "gent", _gent, 1e-3, 0.3, needs=_LARGE),
    Form(
        "rate_dependent_hardening", "logarithmic", _logarithmic, 0.003, 0.3, {"sign": OneOf((1.0, 1.0, -1.0))},
        needs=_LARGE_RATES,
    ),
    Form(
        "rate_dependent_hardening", "cowper_symonds", _cowper_symonds, 0.01, 2.0, {"p": Even(1.5, 5.0)},
        needs=_LARGE_RATES,
    ),
    Form(
        "delayed_hardening", "transition", _transition, 0.05, 1.0,
        {"centre": Even(0.12, 0.35), "width": Even(0.03, 0.09)}, needs=_LARGE,
    ),
    Form(
        "delayed_hardening", "first_order", _first_order, 0.05, 1.0,
        {"part": LogEven(0.01, 0.2), "reach": Even(0.1, 0.3)}, needs=_LARGE,
    ),
    Form(
        "back_stress", "armstrong_frederick", _armstrong_frederick, 0.05, 8.0, {"reach": LogEven(0.01, 0.08)},
        needs=_BACK,
    ),
    Form(
        "back_stress", "ohno_wang", _ohno_wang, 0.05, 8.0, {"reach": LogEven(0.01, 0.06), "m": Even(2.0, 6.0)},
        needs=_BACK,
    ),
    Form(
        "mullins_softening", "ogden_roxburgh", _ogden_roxburgh, 0.02, 0.8,
        {"m": LogEven(0.05, 1.0), "beta": Even(0.0, 0.3)}, needs=_BACK,
    ),
    Form("mullins_softening", "zuniga_beatty", _zuniga_beatty, 0.02, 2.0, needs=_BACK),
    Form(
        "damage", "weibull", _weibull, 0.005, 0.5,
        {"start": Even(0.0, 0.15), "scale": Even(0.2, 0.6), "power": Even(1.2, 2.5)},
    ),
    Form("damage", "lemaitre", _lemaitre, 0.005, 0.6, {"start": Even(0.02, 0.2), "s": Even(0.6, 1.5)}),
    Form("volume_change", "linear", _volume_linear, 0.002, 0.4, {"start": Even(0.0, 0.15)}),
    Form("volume_change", "power", _volume_power, 0.002, 0.5, {"power": Even(1.3, 2.2)}),
)  # fmt: skip
"""Of the network and of the section that carries."""
