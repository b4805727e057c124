"""What changes the flow of the polymer: rates, stress, heat, age, its spectrum, a slow process, a back stress."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.causes.cause import Cause, Change, Form, Shape, maxwell, shifted
from probation_studies.blind.laboratories.institute.modal import RATIO, WEIGHT, haward_thackray

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation_studies.blind.laboratories.institute.modal import Course, FloatArray
    from probation_studies.blind.laboratories.institute.series import Test

_GAS, _ROOM = 8.314e-3, 296.15  # kJ/(mol K), K
_HEAT = 0.5  # K per MPa of work: the inverse of density and heat capacity, 2 MJ/(m3 K)


def _speed(test: Test) -> FloatArray:
    return np.asarray(np.abs(test.rate) / test.setting.rate)


def _cross(test: Test, a: float, shape: Shape) -> Change:
    return shifted(-a * np.log1p((_speed(test) / shape["turn"]) ** shape["power"]))


def _ree_eyring_viscosity(test: Test, a: float, shape: Shape) -> Change:
    x = np.maximum(_speed(test) / shape["turn"], 1e-9)
    return shifted(a * np.log(np.arcsinh(x) / x))


@dataclass
class _Activated:
    """Relaxation times that the stress of the moment shortens."""

    law: Callable[[float, float], float]

    def shift(self, stress: float, relaxed: float) -> float:
        return self.law(stress, relaxed)

    def advance(self, stress: float, strain_step: float, time_step: float) -> None:
        """Nothing is carried."""


def _activated(law: Callable[[float, float], float]) -> Change:
    return Change(course=lambda course: replace(course, feedbacks=(*course.feedbacks, _Activated(law))))


def _eyring(test: Test, a: float, shape: Shape) -> Change:
    def law(stress: float, relaxed: float) -> float:
        x = max(a * abs(stress) / test.setting.flow_stress, 1e-6)
        return float(np.log(x) - x - np.log1p(-np.exp(-2.0 * x)) + np.log(2.0))  # ln(x / sinh x)

    return _activated(law)


def _knauss_emri(test: Test, a: float, shape: Shape) -> Change:
    """Stress opens free volume f: ln(a) = B (1/f - 1/f0), of the overstress."""

    def law(stress: float, relaxed: float) -> float:
        x = max(stress - relaxed, 0.0) / test.setting.flow_stress
        return -a * x / (1.0 + shape["free"] * x)

    return _activated(law)


@dataclass
class _Heated:
    """A specimen that its own work warms and the air cools; its rise is kept at the nodes."""

    amount: float
    loss: float
    law: Callable[[float], float]
    begins: float
    worked: float = 0.0
    rise: float = 0.0
    clock: list[float] = field(default_factory=lambda: [0.0])
    course: list[float] = field(default_factory=lambda: [0.0])

    def shift(self, stress: float, relaxed: float) -> float:
        return self.law(self.rise)

    def advance(self, stress: float, strain_step: float, time_step: float) -> None:
        self.worked += abs(strain_step)
        part = 1.0 if self.begins <= 0.0 else -np.expm1(-self.worked / self.begins)
        kept = np.exp(-time_step / self.loss)
        heat = self.amount * _HEAT * part * stress * strain_step
        self.rise = float(kept * self.rise + heat * self.loss / time_step * (1.0 - kept))
        self.clock.append(self.clock[-1] + time_step)
        self.course.append(self.rise)


def _heated(test: Test, amount: float, loss: float, law: Callable[[float], float], begins: float = 0.0) -> Change:
    made: list[_Heated] = []

    def course(before: Course) -> Course:
        made.append(_Heated(amount, loss, law, begins))
        return replace(before, feedbacks=(*before.feedbacks, made[-1]))

    def warmth() -> FloatArray:
        nodes = test.time[::2] - test.time[0]
        return np.asarray(np.interp(nodes, made[-1].clock, made[-1].course))

    return Change(course=course, warmth=warmth)


def _arrhenius_heat(test: Test, a: float, shape: Shape) -> Change:
    """Newton's cooling; an activation energy in kJ/mol."""
    room, energy = 273.15 + test.temperature, shape["energy_kJ"]
    duration = test.setting.reach / test.setting.rate
    return _heated(
        test, a, shape["cooling"] * duration, lambda rise: energy / _GAS * (1.0 / (room + rise) - 1.0 / room)
    )


def _wlf(rise: float, c1: float, c2: float) -> float:
    return float(-np.log(10.0) * c1 * rise / (c2 + max(rise, -0.7 * c2)))


def _rittel_heat(test: Test, a: float, shape: Shape) -> Change:
    """The part of the work that becomes heat grows with strain (Rittel 1999); WLF."""
    long = 30.0 * test.setting.reach / test.setting.rate
    return _heated(test, a, long, lambda rise: _wlf(rise, shape["c1"], 80.0), begins=shape["strain"])


def _arrhenius(test: Test, a: float, shape: Shape) -> Change:
    """`a` is the shift of ln(tau_max) per 10 K."""
    energy = 0.1 * a * _GAS * _ROOM**2
    return shifted(np.full(len(test.time), energy / _GAS * (1.0 / (273.15 + test.temperature) - 1.0 / _ROOM)))


def _williams_landel_ferry(test: Test, a: float, shape: Shape) -> Change:
    c2 = shape["c2"]
    return shifted(np.full(len(test.time), _wlf(test.temperature - 23.0, 0.1 * a * c2 / np.log(10.0), c2)))


def _warming(test: Test, rise: FloatArray) -> Change:
    """The chamber's own temperature moves: 0.06 of ln(tau_max) per K, as with 45 kJ/mol."""
    return replace(shifted(-0.06 * rise), warmth=lambda: rise[::2])


def _chamber_ramp(test: Test, a: float, shape: Shape) -> Change:
    x = np.maximum(test.time, 0.0) / test.time[-1]
    return _warming(test, a * x ** shape["power"])


def _door_opened(test: Test, a: float, shape: Shape) -> Change:
    """The chamber comes back to its set temperature after a specimen was put in (first order)."""
    return _warming(test, a * np.exp(-np.maximum(test.time, 0.0) / (shape["part"] * test.time[-1])))


def _klompen(test: Test, a: float, shape: Shape) -> Change:
    """Rejuvenation (1 + (r0 exp(g))^r1)^((r2 - 1)/r1) of the aged state, with r2 = -3."""
    r0, r1 = 0.96, shape["sharpness"]
    x = test.travelled / shape["strain"]
    left = ((1.0 + (r0 * np.exp(x)) ** r1) / (1.0 + r0**r1)) ** (-4.0 / r1)
    return shifted(a * left)


def _hasan_boyce(test: Test, a: float, shape: Shape) -> Change:
    """Sites of flow multiply towards a steady number: a drop of the barrier that is exponential in strain."""
    return shifted(a * np.exp(-test.travelled / shape["strain"]))


def _spectrum(weight: FloatArray) -> Change:
    return Change(course=lambda course: replace(course, weight=weight / weight.sum()))


def _power_spectrum(test: Test, a: float, shape: Shape) -> Change:
    return _spectrum(WEIGHT * RATIO**a)


def _wiechert(test: Test, a: float, shape: Shape) -> Change:
    """A bell of relaxations on the spectrum, in the logarithm of time."""
    away = (np.log10(RATIO) + shape["decades"]) / shape["width"]
    return _spectrum(WEIGHT * (1.0 + 8.0 * a * np.exp(-0.5 * away**2)))


def _alongside(test: Test, stress: FloatArray) -> Change:
    return Change(stress=lambda own: own + stress[::2])


def _zener(test: Test, a: float, shape: Shape) -> Change:
    """One Maxwell element in parallel with the polymer."""
    slow = maxwell(test.time, test.strain, [shape["times"] * test.setting.time])[:, 0]
    return _alongside(test, a * test.setting.modulus * slow)


def _scott_blair(test: Test, a: float, shape: Shape) -> Change:
    """A springpot, as six Maxwell elements over three decades."""
    times = shape["times"] * test.setting.time * np.logspace(-1.0, 2.0, 6)
    weight = times ** (-shape["order"])
    slow = maxwell(test.time, test.strain, times.tolist()) @ (weight / weight.sum())
    return _alongside(test, a * test.setting.modulus * slow)


def _backward(test: Test, a: float, terms: list[tuple[float, float]]) -> Change:
    """Back stresses X' = C eps' - (C/X0) X |eps'| of Armstrong and Frederick: parts of X0, strains X0/C."""
    steps = np.diff(test.strain)
    found = np.zeros((len(test.strain), len(terms)))
    part, strain = np.array(terms).T
    for n, step in enumerate(steps):
        kept = np.exp(-abs(step) / strain)
        found[n + 1] = kept * found[n] + np.sign(step) * (1.0 - kept)
    stress = a * test.setting.flow_stress * found @ part
    return Change(course=lambda course: replace(course, relaxed=course.relaxed + stress))


def _armstrong_frederick(test: Test, a: float, shape: Shape) -> Change:
    return _backward(test, a, [(1.0, shape["strain"])])


def _chaboche(test: Test, a: float, shape: Shape) -> Change:
    return _backward(test, a, [(0.5, shape["strain"]), (0.5, 8.0 * shape["strain"])])


def _clamped(test: Test, a: float, shape: Shape) -> Change:
    """Stress of clamping that has not relaxed yet when the record begins."""
    weight = WEIGHT * np.exp(-shape["ago"] / RATIO)
    return Change(course=lambda course: replace(course, start=course.start + a * weight / weight.sum()))


def _pretensioned(test: Test, a: float, shape: Shape) -> Change:
    """Stress in proportion to every mode's viscosity, as a slow pull leaves it."""
    weight = WEIGHT * RATIO ** shape["power"]
    return Change(course=lambda course: replace(course, start=course.start + a * weight / weight.sum()))


def _moisture(test: Test, a: float, shape: Shape) -> Change:
    """Uptake goes with the square root of time (Crank 1956) and plasticises: flow first, then the modulus."""
    wet = a * np.sqrt(test.place)
    return Change(
        course=lambda course: replace(
            course, log_time=course.log_time - wet, modulus=course.modulus * (1.0 - shape["stiffness"] * wet)
        )
    )


def _struik_storage(test: Test, a: float, shape: Shape) -> Change:
    """Ageing between the tests: ln(tau_max) grows with the logarithm of age."""
    return shifted(np.full(len(test.time), a * np.log1p(shape["ages"] * test.place) / np.log1p(shape["ages"])))


def _stiffened(factor: FloatArray) -> Change:
    return Change(course=lambda course: replace(course, modulus=course.modulus * factor))


def _ward(test: Test, a: float, shape: Shape) -> Change:
    """An aggregate of units that turn into the axis: (1 + a cos^4) with a pseudo-affine rotation's mean."""
    turned = 1.0 - np.exp(-1.5 * np.maximum(test.strain, 0.0) / shape["strain"])
    return _stiffened(1.0 + a * turned**2)


def _taut(test: Test, a: float, shape: Shape) -> Change:
    """Tie molecules in parallel grow taut with the network's strain."""
    return _stiffened(1.0 + a * haward_thackray(test.strain) / haward_thackray(np.array(test.setting.reach)))


FLOW = (
    Cause(
        "flow of other rates", 0.15, 1.5,
        (
            Form("Cross 1965", _cross, {"turn": (0.3, 3.0), "power": (0.5, 1.2)}),
            Form("Ree and Eyring 1955", _ree_eyring_viscosity, {"turn": (0.05, 1.0)}),
        ),
        signed=True,
    ),
    Cause(
        "activation by stress", 0.8, 6.0,
        (Form("Eyring 1936", _eyring), Form("Knauss and Emri 1981", _knauss_emri, {"free": (0.1, 1.0)})),
    ),
    Cause(
        "heat of deformation", 0.7, 3.0,
        (
            Form("Arrhenius and Newton", _arrhenius_heat, {"energy_kJ": (30.0, 120.0), "cooling": (0.1, 1.0)}),
            Form("Rittel 1999", _rittel_heat, {"c1": (3.0, 9.0), "strain": (0.05, 0.3)}),
        ),
    ),
    Cause(
        "temperature of the chamber", 0.4, 1.2,
        (
            Form("Arrhenius 1889", _arrhenius),
            Form("Williams, Landel, Ferry 1955", _williams_landel_ferry, {"c2": (60.0, 150.0)}),
        ),
        needs="temperatures",
    ),
    Cause(
        "chamber that warms", 2.0, 15.0,
        (
            Form("ramp", _chamber_ramp, {"power": (0.6, 1.5)}),
            Form("door opened", _door_opened, {"part": (0.1, 0.5)}),
        ),
        rig=True, signed=True,
    ),
    Cause(
        "rejuvenation of an aged polymer", 0.5, 4.0,
        (
            Form("Klompen 2005", _klompen, {"strain": (0.03, 0.12), "sharpness": (1.0, 4.0)}),
            Form("Hasan and Boyce 1995", _hasan_boyce, {"strain": (0.03, 0.2)}),
        ),
    ),
    Cause(
        "other weights of the spectrum", 0.06, 0.4,
        (
            Form("power of time", _power_spectrum),
            Form("Wiechert 1893", _wiechert, {"decades": (0.5, 2.0), "width": (0.2, 0.7)}),
        ),
    ),
    Cause(
        "process beyond the spectrum", 0.01, 0.2,
        (
            Form("Zener 1948", _zener, {"times": (4.0, 30.0)}),
            Form("Scott Blair 1947", _scott_blair, {"times": (3.0, 10.0), "order": (0.1, 0.4)}),
        ),
    ),
    Cause(
        "kinematic hardening", 0.1, 0.8,
        (
            Form("Armstrong and Frederick 1966", _armstrong_frederick, {"strain": (0.02, 0.3)}),
            Form("Chaboche 1986", _chaboche, {"strain": (0.01, 0.1)}),
        ),
        needs="cycles",
    ),
    Cause(
        "stress of clamping", 1.0, 15.0,
        (
            Form("clamped some time ago", _clamped, {"ago": (0.003, 0.1)}),
            Form("pulled straight", _pretensioned, {"power": (0.3, 1.0)}),
        ),
        rig=True, signed=True,
    ),
    Cause(
        "storage between tests", 0.15, 1.2,
        (
            Form("Crank 1956", _moisture, {"stiffness": (0.1, 0.5)}),
            Form("Struik 1978", _struik_storage, {"ages": (2.0, 100.0)}),
        ),
        signed=True, needs="order",
    ),
    Cause(
        "modulus that grows with orientation", 0.2, 4.0,
        (Form("Ward 1962", _ward, {"strain": (0.2, 1.0)}), Form("Takayanagi 1964", _taut)),
    ),
)  # fmt: skip
