"""Causes in the material, as they were published.

lambda (l) is the stretch e^eps, HT = lambda^2 - 1/lambda, a the amplitude. An amplitude of 0 is the base law.
"""

from __future__ import annotations

import numpy as np

from probation_studies.blind.laboratories.industry.bench import BenchTest, mid
from probation_studies.blind.laboratories.industry.causes.form import Cause, Form, Shape
from probation_studies.blind.laboratories.industry.memory import TABLE, FloatArray, Memory, haward_thackray

_GAS, _ROOM = 8.314e-3, 296.0  # kJ/(mol K), K


def _invariant(strain: FloatArray) -> FloatArray:
    return np.asarray(np.exp(2.0 * strain) + 2.0 * np.exp(-strain))


def _largest_invariant(test: BenchTest) -> float:
    return float(np.exp(2.0 * test.scales.strain) + 2.0 * np.exp(-test.scales.strain))


def _gent(test: BenchTest, a: float, shape: Shape) -> None:
    """Gent 1996: sigma = G HT J_m / (J_m - I_1 + 3). a = (I_1 - 3) / J_m at the largest strain."""
    limit = (_largest_invariant(test) - 3.0) / a
    test.network.append(lambda strain: limit / np.maximum(limit - _invariant(strain) + 3.0, 0.02 * limit))


def _three_chain(test: BenchTest, a: float, shape: Shape) -> None:
    """James & Guth 1943, Wang & Guth 1952: sigma = G sqrt(N)/3 [l L^-1(l/sqrt N) - l^-1/2 L^-1(l^-1/2/sqrt N)].

    L^-1(x) = x (3 - x^2)/(1 - x^2), Cohen 1991. a = lambda / sqrt(N) at the largest strain.
    """
    root = float(np.exp(test.scales.strain)) / a

    def chain(x: FloatArray) -> FloatArray:
        x = np.minimum(x, 0.985)
        return np.asarray(x * (3.0 - x * x) / (1.0 - x * x))

    def factor(strain: FloatArray) -> FloatArray:
        long, short = np.exp(strain), np.exp(-0.5 * strain)
        pull = root / 3.0 * (long * chain(long / root) - short * chain(short / root))
        return np.asarray(np.divide(pull, haward_thackray(strain), out=np.ones_like(pull), where=np.abs(strain) > 1e-5))

    start = float(factor(np.array([1e-4]))[0])
    test.network.append(lambda strain: factor(strain) / start)


def _slip_links(test: BenchTest, a: float, shape: Shape) -> None:
    """Edwards & Vilgis 1986, cross-links and sliding links, limited by alpha.

    2 W / G = (1 - s) [(1 - q) I/(1 - q I) + ln(1 - q I)]
            + s {sum_i [(1 + eta)(1 - q) l_i^2 / ((1 + eta l_i^2)(1 - q I)) + ln(1 + eta l_i^2)] + ln(1 - q I)},
    q = alpha^2, I = sum l_i^2; s the part of sliding links. a = q I at the largest strain; s grows with a.
    """
    q, slide, eta = a / _largest_invariant(test), min(shape["sliding"] * a, 0.8), shape["eta"]

    def pull(strain: FloatArray) -> FloatArray:
        """Derivative of W by eps, on lambda_2 = lambda_3 = e^(-eps/2)."""
        total = np.zeros_like(strain)
        step = 1e-5
        for sign in (1.0, -1.0):
            squares = np.exp(2.0 * (strain + sign * step)), np.exp(-(strain + sign * step))
            whole = squares[0] + 2.0 * squares[1]
            left = np.maximum(1.0 - q * whole, 0.02)
            fixed = (1.0 - q) * whole / left + np.log(left)
            moving = np.log(left)
            for count, square in zip((1.0, 2.0), squares, strict=True):
                moving = moving + count * (
                    (1.0 + eta) * (1.0 - q) * square / ((1.0 + eta * square) * left) + np.log1p(eta * square)
                )
            total = total + sign * 0.5 * ((1.0 - slide) * fixed + slide * moving) / (2.0 * step)
        return total

    def factor(strain: FloatArray) -> FloatArray:
        safe = np.where(np.abs(strain) < 1e-3, 1e-3, strain)
        return np.asarray(pull(safe) / haward_thackray(safe))

    start = float(factor(np.array([1e-3]))[0])
    test.network.append(lambda strain: factor(strain) / start)


def _power_flow(test: BenchTest, a: float, shape: Shape) -> None:
    """Power law of viscoplasticity (Norton 1929, Perzyna 1966): tau = tau_0 (rate/rate_0)^-a."""
    test.flow.append(lambda stress: -a * np.log(test.speed / test.scales.rate))


def _cowper_symonds(test: BenchTest, a: float, shape: Shape) -> None:
    """Cowper & Symonds 1957: flow stress 1 + (rate/D)^(1/q), here of tau_max; a = the bracket at the usual rate."""
    q = shape["q"]
    test.flow.append(lambda stress: np.log1p(a * (test.speed / test.scales.rate) ** (1.0 / q)) - np.log1p(a))


def _johnson_cook(test: BenchTest, a: float, shape: Shape) -> None:
    """Johnson & Cook 1983: 1 + C ln(rate/rate_0), of tau_max."""
    test.flow.append(lambda stress: np.log(np.maximum(1.0 + a * np.log(test.speed / test.scales.rate), 0.05)))


def _hardening_of_rate(test: BenchTest, factor: FloatArray) -> None:
    at_nodes = np.concatenate([factor[:1], factor])
    test.network.append(lambda strain: at_nodes)


def _eyring_hardening(test: BenchTest, a: float, shape: Shape) -> None:
    """Wendlandt, Tervoort & Suter 2005: the hardening modulus grows with the logarithm of the rate."""
    _hardening_of_rate(test, np.maximum(1.0 + a * np.log(_smooth_speed(test) / test.scales.rate), 0.05))


def _power_hardening(test: BenchTest, a: float, shape: Shape) -> None:
    """Hoy & Robbins 2006, van Melick et al. 2003: the hardening scales as the flow stress, here (rate/rate_0)^a."""
    _hardening_of_rate(test, (_smooth_speed(test) / test.scales.rate) ** a)


def _smooth_speed(test: BenchTest) -> FloatArray:
    """The largest rate so far, let go over a twentieth of the test: hardening does not vanish with the speed."""
    speed, step = test.speed, np.diff(test.time)
    kept = np.empty_like(speed)
    state = np.log(speed[0])
    for k, (rate, dt) in enumerate(zip(np.log(speed), step, strict=True)):
        state += (rate - state) * -np.expm1(-dt / (0.05 * test.scales.duration))
        kept[k] = state
    return np.asarray(np.exp(kept))


def _driving(test: BenchTest, stress: FloatArray) -> FloatArray:
    """Stress without the network's part, over the largest of the campaign."""
    return np.abs(stress - test.law.hardening * haward_thackray(test.strain)) / test.scales.stress


def _sinh_over(x: FloatArray) -> FloatArray:
    """ln(sinh x / x)."""
    x = np.maximum(x, 1e-4)
    return np.asarray(x + np.log(-np.expm1(-2.0 * x) / (2.0 * x)))


def _ree_eyring(test: BenchTest, a: float, shape: Shape) -> None:
    """Ree & Eyring 1955: two processes flow at once, rate = sum_i w_i sinh(x_i), x_i = V_i s/(k T); tau falls alike."""
    share, ratio = shape["second"], shape["volumes"]

    def flow(stress: FloatArray) -> FloatArray:
        x = a * mid(_driving(test, stress))
        return np.asarray(-np.logaddexp(np.log(1.0 - share) + _sinh_over(x), np.log(share) + _sinh_over(ratio * x)))

    test.flow.append(flow)


def _haward_thackray_flow(test: BenchTest, a: float, shape: Shape) -> None:
    """Haward & Thackray 1968: one Eyring dashpot, driven by the whole stress; tau = tau_0 x / sinh x."""
    test.flow.append(lambda stress: -_sinh_over(a * mid(np.abs(stress) / test.scales.stress)))


def _norton_flow(test: BenchTest, a: float, shape: Shape) -> None:
    """Norton 1929, Schapery 1969 (shift by stress): 1/tau = (1 + a (s/s_0)^(n-1)) / tau_0."""
    test.flow.append(lambda stress: -np.log1p(a * mid(_driving(test, stress)) ** (shape["n"] - 1.0)))


def _warming(test: BenchTest, a: float, shape: Shape, stress: FloatArray) -> FloatArray:
    """Lumped balance, rho c dT/dt = beta sigma d eps/dt - h (T - T_room), in K above the room.

    a = beta (Taylor & Quinney 1934) over rho c, in K/MPa: 0.3 is a beta of 0.75 at 2.5 MJ/(m^3 K). The cooling time is
    told in test durations.
    """
    cooling = shape["cooling"] * test.scales.duration
    work = a * mid(stress) * np.diff(test.strain)
    temperature, now = np.zeros(len(test.time)), 0.0
    for k, (heat, dt) in enumerate(zip(np.maximum(work, 0.0), np.diff(test.time), strict=True)):
        now = (now + 0.5 * heat) * np.exp(-dt / cooling) + 0.5 * heat
        temperature[k + 1] = now
    return temperature


def _arrhenius(test: BenchTest, a: float, shape: Shape) -> None:
    """Arrhenius 1889: ln tau = H/R (1/T - 1/T_0), H in kJ/mol."""

    def flow(stress: FloatArray) -> FloatArray:
        warm = mid(_warming(test, a, shape, stress))
        return shape["enthalpy"] / _GAS * (1.0 / (_ROOM + warm) - 1.0 / _ROOM)

    test.flow.append(flow)


def _wlf(test: BenchTest, a: float, shape: Shape) -> None:
    """Williams, Landel & Ferry 1955: log10 a_T = -C_1 dT / (C_2 + dT), C_1 = 8.86, C_2 = 101.6 K."""

    def flow(stress: FloatArray) -> FloatArray:
        warm = mid(_warming(test, a, shape, stress))
        return np.asarray(-np.log(10.0) * 8.86 * warm / (101.6 + warm))

    test.flow.append(flow)


def _thermal_softening(test: BenchTest, a: float, shape: Shape) -> None:
    """Johnson & Cook 1983, thermal factor of the whole stress: 1 - ((T - T_0)/(T_m - T_0))^m, T_m = T_0 + 110 K."""
    test.after.append(
        lambda stress: stress * np.maximum(1.0 - (_warming(test, a, shape, stress) / 110.0) ** shape["m"], 0.1)
    )


def _largest_so_far(values: FloatArray) -> FloatArray:
    return np.asarray(np.maximum.accumulate(values))


def _simo(test: BenchTest, a: float, shape: Shape) -> None:
    """Simo 1987: g = beta + (1 - beta) (1 - e^(-X/alpha))/(X/alpha), X = sqrt(2 W) at its largest; a = 1 - beta."""
    energy = np.sqrt(np.maximum(_invariant(test.strain) - 3.0, 0.0))
    x = _largest_so_far(energy) / (shape["alpha"] * np.sqrt(max(_largest_invariant(test) - 3.0, 1e-9)))
    x = np.maximum(x, 1e-6)
    test.after.append(lambda stress: stress * (1.0 - a - a * np.expm1(-x) / x))


def _network_alteration(test: BenchTest, a: float, shape: Shape) -> None:
    """Marckmann et al. 2002: chains break and grow longer with the largest chain stretch L = sqrt(I_1/3) so far.

    Density n = exp(-a u), links N = N_0 exp(a u), u = (L - 1)/(L_max - 1); eight chains (Arruda & Boyce 1993).
    """
    stretch = np.sqrt(_invariant(test.strain) / 3.0)
    u = (_largest_so_far(stretch) - 1.0) / (np.sqrt(_largest_invariant(test) / 3.0) - 1.0)
    links = shape["links"] * _largest_invariant(test) / 3.0

    def chain(x: FloatArray) -> FloatArray:
        return np.asarray((3.0 - x * x) / (1.0 - x * x))

    virgin = chain(stretch / np.sqrt(links))
    broken = np.exp(-a * u) * chain(stretch / np.sqrt(links * np.exp(a * u)))
    test.network.append(lambda strain: broken / virgin)


def _lemaitre(test: BenchTest, a: float, shape: Shape) -> None:
    """Lemaitre 1985, ductile damage: D = D_c (p - p_D)/(p_R - p_D), p the largest strain; a = D at the campaign's."""
    peak = test.scales.strain
    p = _largest_so_far(test.strain)
    d = a * np.clip((p - shape["onset"] * peak) / ((1.0 - shape["onset"]) * peak), 0.0, 1.0)
    test.after.append(lambda stress: (1.0 - d) * stress)


def _mazars(test: BenchTest, a: float, shape: Shape) -> None:
    """Mazars 1984, its second term: D = A (1 - exp(-B (k - k_0))) beyond k_0, k the largest strain; a = A."""
    beyond = np.maximum(_largest_so_far(test.strain) / test.scales.strain - shape["onset"], 0.0)
    d = -a * np.expm1(-shape["b"] * beyond)
    test.after.append(lambda stress: (1.0 - d) * stress)


def _weibull_damage(test: BenchTest, a: float, shape: Shape) -> None:
    """Krajcinovic & Silva 1982: bundles of fibres, D = 1 - exp(-a (p/p_max)^m)."""
    p = np.maximum(_largest_so_far(test.strain), 0.0) / test.scales.strain
    test.after.append(lambda stress: stress * np.exp(-a * p ** shape["m"]))


def _armstrong_frederick(test: BenchTest, a: float, shape: Shape) -> None:
    """Armstrong & Frederick 1966: dX = C dp - gamma X |dp|, a = C/gamma over the largest stress."""
    back = _back_stress(test, a * test.scales.stress, shape["recall"], 0.0)
    test.after.append(lambda stress: stress + back)


def _ohno_wang(test: BenchTest, a: float, shape: Shape) -> None:
    """Ohno & Wang 1993, second model: dX = C dp - gamma (|X|/r)^m X |dp|, r = C/gamma."""
    back = _back_stress(test, a * test.scales.stress, shape["recall"], shape["m"])
    test.after.append(lambda stress: stress + back)


def _chaboche(test: BenchTest, a: float, shape: Shape) -> None:
    """Chaboche 1986: two such stresses, the second five times as slow to saturate."""
    back = _back_stress(test, 0.5 * a * test.scales.stress, shape["recall"], 0.0)
    back = back + _back_stress(test, 0.5 * a * test.scales.stress, 0.2 * shape["recall"], 0.0)
    test.after.append(lambda stress: stress + back)


def _back_stress(test: BenchTest, saturation: float, recall: float, power: float) -> FloatArray:
    """Plastic strain moves where the strain has gone one elastic range beyond a reversal (Prandtl's slider)."""
    reach = test.scales.stress / test.law.modulus
    slider, back, found = 0.0, 0.0, [0.0]
    for strain in test.strain[1:]:
        moved = strain - np.clip(strain - slider, -reach, reach) - slider
        slider += moved
        for _ in range(4):
            recalled = (abs(back) / saturation) ** power * back
            back += recall * (saturation * moved - recalled * abs(moved)) / 4.0
        found.append(back)
    return np.asarray(found)


def _struik(test: BenchTest, a: float, shape: Shape) -> None:
    """Struik 1978: ln tau grows by mu ln(age); the tests follow one another, the first at an age of one interval."""
    test.flow.append(lambda stress: np.full(len(test.modulus), a * np.log(1.0 + test.programme.order)))


def _moisture(test: BenchTest, a: float, shape: Shape) -> None:
    """Crank 1956, uptake of a sheet, about 1 - exp(-pi^2 D t/h^2); water plasticises: E falls by a times it."""
    taken = -np.expm1(-shape["speed"] * test.programme.order)
    test.modulus *= 1.0 - a * taken
    test.flow.append(lambda stress: np.full(len(test.modulus), -a * taken))


def _kww(test: BenchTest, a: float, shape: Shape) -> None:
    """Kohlrausch 1854, Williams & Watts 1970: exp(-(t/tau)^beta), mixed in by a."""
    test.memory = test.memory.mixed(Memory.of_function(np.exp(-((TABLE / shape["time"]) ** shape["beta"]))), a)


def _fractional(test: BenchTest, a: float, shape: Shape) -> None:
    """Schiessel et al. 1995: fractional Maxwell element, E_alpha(-(t/tau)^alpha), by its spectrum (Gross 1947)."""
    alpha = shape["alpha"]
    ratio = np.logspace(-8.0, 3.0, 111)
    x = ratio**alpha
    share = np.sin(alpha * np.pi) * x / (x * x + 2.0 * x * np.cos(alpha * np.pi) + 1.0)
    test.memory = test.memory.mixed(Memory.of_modes(ratio * shape["time"], share / share.sum()), a)


def _box(test: BenchTest, a: float, shape: Shape) -> None:
    """Tobolsky 1960, Fung 1972: all relaxation times of a box alike in weight, log-evenly."""
    ratio = np.logspace(-shape["decades"], 0.0, 60)
    test.memory = test.memory.mixed(Memory.of_modes(ratio, np.full(60, 1.0 / 60.0)), a)


def _flory(test: BenchTest, a: float, shape: Shape) -> None:
    """Flory 1947, equilibrium crystallinity X of a network beyond lambda_c; it stiffens as a filler (Guth & Gold 1938).

    G (1 + 2.5 X + 14.1 X^2); X grows as 1 - sqrt((l_m - l)/(l_m - l_c)) up to a at the largest strain.
    """
    peak = np.exp(test.scales.strain)
    onset = 1.0 + shape["onset"] * (peak - 1.0)
    part = np.clip((np.exp(test.strain) - onset) / (peak * 1.05 - onset), 0.0, 0.99)
    crystals = (
        a
        * (1.0 - np.sqrt(1.0 - part))
        / (1.0 - np.sqrt(1.0 - np.clip((peak - onset) / (peak * 1.05 - onset), 0, 0.99)))
    )
    test.network.append(lambda strain: 1.0 + 2.5 * crystals + 14.1 * crystals**2)


def _avrami(test: BenchTest, a: float, shape: Shape) -> None:
    """Avrami 1939, Nakamura 1973: dX/dt = (X_e - X)/t_c, X_e = a (l - l_c)/(l_m - l_c) beyond l_c."""
    peak = np.exp(test.scales.strain)
    onset = 1.0 + shape["onset"] * (peak - 1.0)
    goal = a * np.clip((np.exp(test.strain) - onset) / (peak - onset), 0.0, None)
    crystals, now = np.zeros_like(goal), 0.0
    for k, dt in enumerate(np.diff(test.time)):
        now += (goal[k + 1] - now) * -np.expm1(-dt / (shape["time"] * test.scales.duration))
        crystals[k + 1] = now
    test.network.append(lambda strain: 1.0 + 2.5 * crystals + 14.1 * crystals**2)


def _klompen(test: BenchTest, a: float, shape: Shape) -> None:
    """Klompen et al. 2005: ln tau += S_a R(p), R = (1 + (r_0 e^p)^r_1)^((r_2-1)/r_1) / (1 + r_0^r_1)^((r_2-1)/r_1)."""
    r0, r1, r2 = 0.95, shape["r1"], -5.0
    p = 3.0 * mid(_largest_so_far(test.strain)) / max(test.scales.strain, 0.2)
    level = ((1.0 + (r0 * np.exp(p)) ** r1) / (1.0 + r0**r1)) ** ((r2 - 1.0) / r1)
    test.flow.append(lambda stress: a * level)


def _fictive(test: BenchTest, a: float, shape: Shape) -> None:
    """Buckley, Dooling, Harding & Ruiz 2004: fictive temperature rises with viscous strain, ln tau += a exp(-p/p_0)."""
    p = mid(_largest_so_far(test.strain)) / (shape["spread"] * test.scales.strain)
    test.flow.append(lambda stress: a * np.exp(-p))


MATERIAL = (
    Cause(
        "network_locking",
        (
            Form("Gent 1996", _gent, 0.9, {}),
            Form("three-chain, Wang & Guth 1952", _three_chain, 0.9, {}),
            Form("Edwards & Vilgis 1986", _slip_links, 0.85, {"sliding": (0.05, 0.6), "eta": (0.1, 0.5)}),
        ),
    ),
    Cause(
        "rate_dependent_flow",
        (
            Form("power law, Perzyna 1966", _power_flow, 0.6, {}, signed=True),
            Form("Cowper & Symonds 1957", _cowper_symonds, 4.0, {"q": (1.5, 6.0)}),
            Form("Johnson & Cook 1983", _johnson_cook, 0.25, {}, signed=True),
        ),
        needs="speeds",
    ),
    Cause(
        "rate_dependent_network",
        (
            Form("Wendlandt, Tervoort & Suter 2005", _eyring_hardening, 0.2, {}),
            Form("Hoy & Robbins 2006", _power_hardening, 0.25, {}),
        ),
        needs="speeds",
    ),
    Cause(
        "activated_flow",
        (
            Form("Ree & Eyring 1955", _ree_eyring, 4.0, {"second": (0.1, 0.5), "volumes": (1.5, 4.0)}),
            Form("Haward & Thackray 1968", _haward_thackray_flow, 4.0, {}),
            Form("Norton 1929", _norton_flow, 4.0, {"n": (2.0, 6.0)}),
        ),
    ),
    Cause(
        "plastic_heating",
        (
            Form("Arrhenius", _arrhenius, 0.5, {"enthalpy": (80.0, 300.0), "cooling": (0.05, 5.0)}),
            Form("Williams, Landel & Ferry 1955", _wlf, 0.5, {"cooling": (0.05, 5.0)}),
            Form("Johnson & Cook 1983, thermal", _thermal_softening, 0.5, {"m": (0.8, 1.3), "cooling": (0.05, 5.0)}),
        ),
    ),
    Cause(
        "mullins",
        (
            Form("Simo 1987", _simo, 0.6, {"alpha": (0.15, 1.0)}),
            Form("Marckmann et al. 2002", _network_alteration, 0.8, {"links": (1.6, 6.0)}),
        ),
        needs="unloading",
    ),
    Cause(
        "ductile_damage",
        (
            Form("Lemaitre 1985", _lemaitre, 0.4, {"onset": (0.05, 0.6)}),
            Form("Mazars 1984", _mazars, 0.5, {"onset": (0.02, 0.4), "b": (0.5, 4.0)}),
            Form("Krajcinovic & Silva 1982", _weibull_damage, 0.5, {"m": (0.7, 4.0)}),
        ),
    ),
    Cause(
        "kinematic_hardening",
        (
            Form("Armstrong & Frederick 1966", _armstrong_frederick, 0.4, {"recall": (3.0, 60.0)}),
            Form("Ohno & Wang 1993", _ohno_wang, 0.4, {"recall": (3.0, 40.0), "m": (1.0, 5.0)}),
            Form("Chaboche 1986", _chaboche, 0.4, {"recall": (10.0, 80.0)}),
        ),
        needs="unloading",
    ),
    Cause(
        "ageing_between_tests",
        (
            Form("Struik 1978", _struik, 0.4, {}),
            Form("Crank 1956, moisture", _moisture, 0.4, {"speed": (0.2, 1.5)}),
        ),
        needs="order",
    ),
    Cause(
        "other_spectrum",
        (
            Form("Williams & Watts 1970", _kww, 1.0, {"beta": (0.3, 0.6), "time": (0.05, 0.5)}),
            Form(
                "fractional Maxwell, Schiessel et al. 1995",
                _fractional,
                1.0,
                {"alpha": (0.4, 0.8), "time": (0.05, 0.4)},
            ),
            Form("box, Fung 1972", _box, 1.0, {"decades": (2.0, 6.0)}),
        ),
    ),
    Cause(
        "crystallisation",
        (
            Form("Flory 1947", _flory, 0.3, {"onset": (0.3, 0.7)}),
            Form("Avrami 1939, Nakamura 1973", _avrami, 0.3, {"onset": (0.3, 0.7), "time": (0.02, 0.5)}),
        ),
    ),
    Cause(
        "rejuvenation",
        (
            Form("Klompen et al. 2005", _klompen, 1.5, {"r1": (2.0, 30.0)}),
            Form("Buckley et al. 2004", _fictive, 1.5, {"spread": (0.05, 0.4)}),
        ),
    ),
)
