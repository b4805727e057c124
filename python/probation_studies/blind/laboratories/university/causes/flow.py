"""Causes in the relaxation times: rate, stress, heat, an aged start; in the spectrum; processes parallel to it.

Every form is written as a shift of ln(tau_max), all modes alike, unless it says otherwise.

- Flow that depends on the rate. Ree and Eyring 1955, J. Appl. Phys. 26, 793: stress proportional to asinh(x),
  x = rate/rate0, so that tau changes by asinh(x)/x. Fotheringham and Cherry 1978, J. Mater. Sci. 13, 951, and Richeton
  et al. 2006, Int. J. Solids Struct. 43, 2318: n processes at once, asinh(x^(1/n))/x. The amplitude is the power.
- Flow activated by stress. Eyring 1936, J. Chem. Phys. 4, 283: y/sinh(y), y = stress/s0, here by the overstress. Argon
  1973, Philos. Mag. 28, 839: rate proportional to exp(-(A s/kT)(1 - (stress/s)^(5/6))).
- Self-heating. rho c dT/dt = beta stress rate - rho c (T - T0)/t_c (Taylor and Quinney 1934 for beta), with Arrhenius
  (Q/R)(1/T - 1/T0) or, without losses, with Williams, Landel and Ferry 1955, J. Am. Chem. Soc. 77, 3701:
  -ln(10) C1 (T - T0)/(C2 + T - T0).
- Yield softening of an aged start. Klompen, Engels, Govaert and Meijer 2005, Macromolecules 38, 6997: S_a R(eps),
  R = ((1 + (r0 e^eps)^r1)/(1 + r0^r1))^((r2 - 1)/r1). Boyce, Parks and Argon 1988, Mech. Mater. 7, 15: the strength
  relaxes as exp(-h eps). Strain is the largest so far.
- Another spectrum, mixed with the law's by the amplitude. Cole and Cole 1941, J. Chem. Phys. 9, 341:
  sin(b pi)/(cosh((1 - b) ln(tau/tau0)) - cos(b pi)). Kohlrausch, Williams and Watts 1970, Trans. Faraday Soc. 66, 80,
  with the power 1/2: sqrt(tau/tau0) exp(-tau/(4 tau0)).
- A slow process. Maxwell 1867: one branch of a longer time. Scott Blair 1947: a power of time, (1 + t/t0)^-n.
- Physical ageing during the test. Struik 1978, Physical Aging in Amorphous Polymers and Other Materials: ln(tau) grows
  by mu ln(1 + t/t_e).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.signal import fftconvolve, lfilter

from probation_studies.blind.laboratories.university.causes.cause import Act, Cause, Form, Run, Setting, Shape
from probation_studies.blind.laboratories.university.modal_law import LEAST_RATE, RATIO, Course

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import Feedback, FloatArray

_GAS_CONSTANT = 8.314  # J/(mol K)
_ROOM = 296.0  # K
_HEAT_CAPACITY = 1.9  # MPa/K, of polyethylene at 0.95 g/cm^3


def _shifted(course: Course, shift: FloatArray) -> Course:
    return replace(course, log_time=course.log_time + shift)


def _mean(values: FloatArray) -> FloatArray:
    """Of both ends of every step."""
    return np.asarray(0.5 * (values[1:] + values[:-1]))


def _by_rate(run: Run, amplitude: float, shape: Shape, power: float) -> Act:
    def log_ratio(rate: FloatArray) -> FloatArray:
        x = np.maximum(np.abs(rate), LEAST_RATE) / shape["rate0_per_s"]
        return np.asarray(np.log(np.arcsinh(x**power) / x))

    usual = log_ratio(np.array([shape["reference_per_s"]]))
    return Act(course=lambda course: _shifted(course, amplitude * (log_ratio(run.rate) - usual)))


def _rates(random: Generator, setting: Setting) -> dict[str, float]:
    rate0 = setting.rate * 10.0 ** random.uniform(-1.0, 0.0)
    return {"rate0_per_s": rate0, "reference_per_s": setting.rate}


def _cooperative_rates(random: Generator, setting: Setting) -> dict[str, float]:
    return {**_rates(random, setting), "n": random.uniform(2.0, 6.0)}


FLOW_RATE = Cause(
    "rate-dependent flow",
    (
        Form("Ree and Eyring 1955", _rates, lambda run, a, s: _by_rate(run, a, s, 1.0)),
        Form("Fotheringham and Cherry 1978", _cooperative_rates, lambda run, a, s: _by_rate(run, a, s, 1.0 / s["n"])),
    ),
    scale=0.1,
    largest=0.8,
    signed=True,
    needs="rates",
)


@dataclass
class _Sinh:
    inverse_stress: float

    def shift(self, stress: float, overstress: float, strain_step: float, time_step: float) -> float:
        y = min(abs(overstress) * self.inverse_stress, 30.0)
        return float(np.log(y / np.sinh(y))) if y > 1e-4 else 0.0


@dataclass
class _FiveSixths:
    energy: float
    strength: float

    def shift(self, stress: float, overstress: float, strain_step: float, time_step: float) -> float:
        return -self.energy * float((abs(overstress) / self.strength) ** (5.0 / 6.0))


def _fed(feedback: Callable[[], Feedback]) -> Act:
    """A fresh one for every integration: some remember what has been."""
    return Act(course=lambda course: replace(course, feedbacks=(*course.feedbacks, feedback())))


FLOW_STRESS = Cause(
    "stress-activated flow",
    (
        Form(
            "Eyring 1936",
            lambda random, setting: {"flow_MPa": setting.flow_stress},
            lambda run, a, s: _fed(lambda: _Sinh(np.sqrt(6.0 * a) / s["flow_MPa"])),
        ),
        Form(
            "Argon 1973",
            lambda random, setting: {"flow_MPa": setting.flow_stress * random.uniform(0.8, 2.0)},
            lambda run, a, s: _fed(lambda: _FiveSixths(a, s["flow_MPa"])),
        ),
    ),
    scale=0.15,
    largest=3.0,
)


class _Heating:
    """The specimen's temperature above the room's [K], and what it does."""

    def __init__(self, part: float, loss_time: float, shift_of: tuple[str, float, float]) -> None:
        self.part, self.loss_time, self.shift_of = part, loss_time, shift_of
        self.warmer = 0.0

    def shift(self, stress: float, overstress: float, strain_step: float, time_step: float) -> float:
        work = self.part * max(overstress * strain_step, 0.0) / _HEAT_CAPACITY
        self.warmer += work - self.warmer * time_step / self.loss_time
        kind, one, two = self.shift_of
        if kind == "arrhenius":
            return one / _GAS_CONSTANT * (1.0 / (_ROOM + self.warmer) - 1.0 / _ROOM)
        return -float(np.log(10.0)) * one * self.warmer / (two + self.warmer)


HEATING = Cause(
    "self-heating",
    (
        Form(
            "Arrhenius with losses",
            lambda random, setting: {
                "loss_time_s": setting.duration * 10.0 ** random.uniform(-0.7, 0.5),
                "energy_J_per_mol": random.uniform(60e3, 140e3),
            },
            lambda run, a, s: _fed(lambda: _Heating(a, s["loss_time_s"], ("arrhenius", s["energy_J_per_mol"], 0.0))),
        ),
        Form(
            "Williams, Landel and Ferry 1955, adiabatic",
            lambda random, setting: {"c1": random.uniform(8.0, 17.4), "c2_K": random.uniform(80.0, 150.0)},
            lambda run, a, s: _fed(lambda: _Heating(a, 1e9, ("wlf", s["c1"], s["c2_K"]))),
        ),
    ),
    scale=0.1,
    largest=1.0,
)


def _aged(run: Run, amplitude: float, shape: Shape) -> Act:
    r0, r1, r2 = shape["r0"], shape["r1"], shape["r2"]
    strain = np.minimum(run.largest / shape["strain"], 40.0)
    left = ((1.0 + (r0 * np.exp(strain)) ** r1) / (1.0 + r0**r1)) ** ((r2 - 1.0) / r1)
    return Act(course=lambda course: _shifted(course, amplitude * _mean(left)))


def _strengthened(run: Run, amplitude: float, shape: Shape) -> Act:
    left = np.exp(-run.largest / shape["strain"])
    return Act(course=lambda course: _shifted(course, amplitude * _mean(left)))


AGED_START = Cause(
    "yield softening",
    (
        Form(
            "Klompen et al. 2005",
            lambda random, setting: {
                "r0": random.uniform(0.6, 0.98),
                "r1": random.uniform(3.0, 20.0),
                "r2": random.uniform(-5.0, -1.0),
                "strain": setting.strain * random.uniform(0.15, 0.4),
            },
            _aged,
        ),
        Form(
            "Boyce, Parks and Argon 1988",
            lambda random, setting: {"strain": setting.strain * random.uniform(0.05, 0.25)},
            _strengthened,
        ),
    ),
    scale=0.15,
    largest=1.5,
)


def _mixed(amplitude: float, other: FloatArray) -> Act:
    share = amplitude * other / other.sum()
    return Act(course=lambda course: replace(course, weight=(1.0 - amplitude) * course.weight + share))


def _cole_cole(run: Run, amplitude: float, shape: Shape) -> Act:
    b = shape["b"]
    x = np.log(RATIO / shape["ratio"])
    return _mixed(amplitude, np.sin(b * np.pi) / (np.cosh((1.0 - b) * x) - np.cos(b * np.pi)))


def _kww(run: Run, amplitude: float, shape: Shape) -> Act:
    x = RATIO / shape["ratio"]
    return _mixed(amplitude, np.sqrt(x) * np.exp(-0.25 * x))


SPECTRUM = Cause(
    "another spectrum",
    (
        Form(
            "Cole and Cole 1941",
            lambda random, setting: {"b": random.uniform(0.3, 0.7), "ratio": 10.0 ** random.uniform(-1.5, -0.2)},
            _cole_cole,
        ),
        Form("Williams and Watts 1970", lambda random, setting: {"ratio": 10.0 ** random.uniform(-2.0, -0.6)}, _kww),
    ),
    scale=0.1,
    largest=0.9,
)


def _slow_maxwell(run: Run, amplitude: float, shape: Shape) -> Act:
    decay = np.exp(-run.step / shape["time_s"])
    gain = amplitude * shape["modulus_MPa"] * (1.0 - decay) * shape["time_s"] / run.step
    added = np.concatenate([[0.0], lfilter([gain], [1.0, -decay], np.diff(run.strain))])
    return Act(stress=lambda stress: stress + added)


def _slow_power(run: Run, amplitude: float, shape: Shape) -> Act:
    kernel = amplitude * shape["modulus_MPa"] * (1.0 + run.time[1:] / shape["time_s"]) ** -shape["power"]
    added = np.concatenate([[0.0], fftconvolve(np.diff(run.strain), kernel)[: len(run.strain) - 1]])
    return Act(stress=lambda stress: stress + added)


def _slow(random: Generator, setting: Setting) -> dict[str, float]:
    return {"modulus_MPa": setting.flow_stress / setting.strain}


SLOW = Cause(
    "slow process",
    (
        Form(
            "Maxwell 1867",
            lambda random, setting: {
                **_slow(random, setting),
                "time_s": float(np.clip(setting.time * 10.0 ** random.uniform(0.7, 1.7), 0.0, setting.duration)),
            },
            _slow_maxwell,
        ),
        Form(
            "Scott Blair 1947",
            lambda random, setting: {
                **_slow(random, setting),
                "time_s": setting.time,
                "power": random.uniform(0.3, 0.7),
            },
            _slow_power,
        ),
    ),
    scale=0.1,
    largest=2.0,
)


def _older(run: Run, amplitude: float, shape: Shape) -> Act:
    middle = 0.5 * (run.time[1:] + run.time[:-1])
    shift = amplitude * np.log1p(middle / shape["time_s"])
    return Act(course=lambda course: replace(course, log_time=course.log_time + shift))


def _older_saturating(run: Run, amplitude: float, shape: Shape) -> Act:
    middle = 0.5 * (run.time[1:] + run.time[:-1])
    shift = amplitude * np.log1p(middle / shape["time_s"] / (1.0 + middle / run.time[-1]))
    return Act(course=lambda course: replace(course, log_time=course.log_time + shift))


def _age(random: Generator, setting: Setting) -> dict[str, float]:
    return {"time_s": setting.duration * random.uniform(0.05, 0.3)}


AGEING = Cause(
    "ageing during the test",
    (Form("Struik 1978", _age, _older), Form("Struik 1978, saturating", _age, _older_saturating)),
    scale=0.1,
    largest=1.0,
)


CAUSES = (FLOW_RATE, FLOW_STRESS, HEATING, AGED_START, SPECTRUM, SLOW, AGEING)
