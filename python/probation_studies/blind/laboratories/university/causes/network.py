"""Causes in the network and in what bears the load.

- Finite extensibility, in place of G(lambda^2 - 1/lambda). Arruda and Boyce 1993, J. Mech. Phys. Solids 41, 389: the
  factor (sqrt(N)/(3 lc)) Linv(lc/sqrt(N)), lc^2 = (lambda^2 + 2/lambda)/3, with Cohen 1991, Rheol. Acta 30, 270:
  Linv(x) = x (3 - x^2)/(1 - x^2). Edwards and Vilgis 1986, Polymer 27, 483 (cross-links): the factor
  (1 - a)/(1 - a I1)^2 - a/(1 - a I1). The amplitude is 1/N and a.
- Hardening that depends on the rate. Wendlandt, Tervoort and Suter 2005, Polymer 46, 11786: G proportional to
  1 + a ln(rate/rate0). Power of the rate (Senden, van Dommelen and Govaert 2010, J. Polym. Sci. B 48, 1483, say that
  the measured strain hardening scales with the flow stress): (rate/rate0)^a.
- Delayed, anelastic hardening: a part a of the network follows late. Zener 1948 (standard solid): y' = (e_HT - y)/t.
  Andrade 1910, Proc. R. Soc. A 84, 1: a part 1 - 1/(1 + (t/t0)^(1/3)) of every increment has come after t.
- Damage of the bearing section, by the largest strain. Lemaitre 1985, J. Eng. Mater. Technol. 107, 83: linear beyond a
  threshold. Mazars 1984 (exponential): 1 - exp(-(eps - eps_D)/eps_c).
- Mullins softening below the largest energy so far, energy of the Gaussian network. Ogden and Roxburgh 1999, Proc. R.
  Soc. A 455, 2861: 1 - a erf((Wm - W)/m). Dorfmann and Ogden 2004, Int. J. Solids Struct. 41, 1855:
  1 - a tanh((Wm - W)/m).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.signal import fftconvolve, lfilter
from scipy.special import erf

from probation_studies.blind.laboratories.university.causes.cause import Act, Cause, Form, Run, Setting, Shape
from probation_studies.blind.laboratories.university.modal_law import LEAST_RATE, halved, haward_thackray

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import FloatArray


def _network(factor: FloatArray) -> Act:
    """The relaxed stress times a factor on the half steps."""
    return Act(course=lambda course: replace(course, relaxed=course.relaxed * factor))


def _eight_chains(run: Run, amplitude: float, shape: Shape) -> Act:
    stretch = np.exp(run.half_strain)
    x2 = np.minimum(amplitude * (stretch**2 + 2.0 / stretch) / 3.0, 0.97)
    return _network((3.0 - x2) / (1.0 - x2) / 3.0)


def _cross_links(run: Run, amplitude: float, shape: Shape) -> Act:
    stretch = np.exp(run.half_strain)
    left = np.maximum(1.0 - amplitude * (stretch**2 + 2.0 / stretch), 0.03)
    return _network((1.0 - amplitude) / left**2 - amplitude / left)


def _nothing(random: Generator, setting: Setting) -> dict[str, float]:
    return {}


LOCKING = Cause(
    "limited chains",
    (
        Form("Arruda and Boyce 1993", _nothing, _eight_chains),
        Form("Edwards and Vilgis 1986", _nothing, _cross_links),
    ),
    scale=0.01,
    largest=0.06,
)


def _relative_rate(run: Run, shape: Shape) -> FloatArray:
    at_instants = np.gradient(run.strain, run.step)
    return np.asarray(np.maximum(np.abs(halved(at_instants)), LEAST_RATE) / shape["rate_per_s"])


def _usual_rate(random: Generator, setting: Setting) -> dict[str, float]:
    return {"rate_per_s": setting.rate}


HARDENING_RATE = Cause(
    "rate-dependent hardening",
    (
        Form(
            "Wendlandt et al. 2005",
            _usual_rate,
            lambda run, a, s: _network(np.maximum(1.0 + a * np.log(_relative_rate(run, s)), 0.1)),
        ),
        Form("power of the rate", _usual_rate, lambda run, a, s: _network(_relative_rate(run, s) ** a)),
    ),
    scale=0.05,
    largest=0.3,
    needs="rates",
)


def _late_by(run: Run, amplitude: float, late: FloatArray) -> Act:
    extra = run.material.hardening * amplitude * (late - haward_thackray(run.half_strain))
    return Act(course=lambda course: replace(course, relaxed=course.relaxed + extra))


def _zener(run: Run, amplitude: float, shape: Shape) -> Act:
    decay = np.exp(-0.5 * run.step / shape["time_s"])
    value = haward_thackray(run.half_strain)
    late = lfilter([1.0 - decay], [1.0, -decay], value - value[0]) + value[0]
    return _late_by(run, amplitude, late)


def _andrade(run: Run, amplitude: float, shape: Shape) -> Act:
    value = haward_thackray(run.half_strain)
    after = 0.5 * run.step * np.arange(1, len(value))
    come = 1.0 - 1.0 / (1.0 + np.cbrt(after / shape["time_s"]))
    late = np.concatenate([[0.0], fftconvolve(np.diff(value), come)[: len(value) - 1]]) + value[0]
    return _late_by(run, amplitude, late)


def _delay(random: Generator, setting: Setting) -> dict[str, float]:
    return {"time_s": setting.duration * 10.0 ** random.uniform(-1.5, -0.3)}


DELAYED = Cause(
    "delayed hardening",
    (Form("Zener 1948", _delay, _zener), Form("Andrade 1910", _delay, _andrade)),
    scale=0.1,
    largest=0.9,
)


def _worn(run: Run, lost: FloatArray) -> Act:
    return Act(stress=lambda stress: stress * (1.0 - np.minimum(lost, 0.9)))


def _threshold(random: Generator, setting: Setting) -> dict[str, float]:
    return {"strain": setting.strain * random.uniform(0.0, 0.5)}


DAMAGE = Cause(
    "damage",
    (
        Form("Lemaitre 1985", _threshold, lambda run, a, s: _worn(run, a * np.maximum(run.largest - s["strain"], 0.0))),
        Form(
            "Mazars 1984",
            lambda random, setting: {
                **_threshold(random, setting),
                "width": setting.strain * random.uniform(0.1, 0.5),
            },
            lambda run, a, s: _worn(run, -a * np.expm1(-np.maximum(run.largest - s["strain"], 0.0) / s["width"])),
        ),
    ),
    scale=0.05,
    largest=0.5,
)


def _below_largest(run: Run, shape: Shape) -> FloatArray:
    stretch = np.exp(run.strain)
    energy = run.material.hardening * (0.5 * stretch**2 + 1.0 / stretch - 1.5)
    return np.asarray((np.maximum.accumulate(energy) - energy) / shape["energy_MPa"])


def _energy(random: Generator, setting: Setting) -> dict[str, float]:
    return {"energy_MPa": 6.0 * max(setting.drop, 0.01) * random.uniform(0.2, 1.5)}


MULLINS = Cause(
    "Mullins softening",
    (
        Form(
            "Ogden and Roxburgh 1999",
            _energy,
            lambda run, a, s: Act(stress=lambda stress: stress * (1.0 - a * erf(_below_largest(run, s)))),
        ),
        Form(
            "Dorfmann and Ogden 2004",
            _energy,
            lambda run, a, s: Act(stress=lambda stress: stress * (1.0 - a * np.tanh(_below_largest(run, s)))),
        ),
    ),
    scale=0.1,
    largest=0.8,
    needs="unloading",
)

CAUSES = (LOCKING, HARDENING_RATE, DELAYED, DAMAGE, MULLINS)
