"""What changes the network and what carries the load: locking, late or broken chains, crystals, necks, serrations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erf

from probation_studies.blind.laboratories.institute.causes.cause import (
    Cause,
    Change,
    Form,
    Shape,
    hardened,
    maxwell,
    scaled,
)
from probation_studies.blind.laboratories.institute.modal import haward_thackray

if TYPE_CHECKING:
    from probation_studies.blind.laboratories.institute.modal import FloatArray
    from probation_studies.blind.laboratories.institute.series import Test


def _invariant(strain: FloatArray) -> FloatArray:
    """First invariant of an incompressible bar, less three."""
    return np.asarray(np.exp(2.0 * strain) + 2.0 * np.exp(-strain) - 3.0)


def _wendlandt(test: Test, a: float, shape: Shape) -> Change:
    """Hardening that grows with the logarithm of the rate."""
    speed = np.maximum(np.abs(test.rate) / test.setting.rate, 1e-3)
    return hardened(np.maximum(1.0 + a * np.log(speed), 0.05))


def _hoy_robbins(test: Test, a: float, shape: Shape) -> Change:
    """Hardening in proportion to a flow stress that saturates at high rates."""
    x = np.abs(test.rate) / test.setting.rate / shape["turn"]
    return hardened(np.exp(a * np.log((x + 0.01) / (1.0 + x))))


def _gent(test: Test, a: float, shape: Shape) -> Change:
    """`a` is the part of the limiting invariant that is reached at the largest strain."""
    part = a * _invariant(test.strain) / _invariant(np.array(test.setting.reach))
    return hardened(1.0 / (1.0 - np.minimum(part, 0.98)))


def _eight_chains(test: Test, a: float, shape: Shape) -> Change:
    """Arruda and Boyce's chains with Cohen's inverse Langevin function: factor (3 - x^2)/(3 (1 - x^2)).

    `a` is the square of a chain's stretch over its contour, at the largest strain.
    """
    square = a * (_invariant(test.strain) + 3.0) / (_invariant(np.array(test.setting.reach)) + 3.0)
    square = np.minimum(square, 0.98)
    return hardened((3.0 - square) / (3.0 * (1.0 - square)))


def _behind(test: Test, delay: float) -> Change:
    """The network follows the strain by a first-order delay [s]."""
    full = haward_thackray(test.strain)
    late = full - full[0] - maxwell(test.time, full, [delay])[:, 0] + full[0]
    # R = G late; where the strain is nil both are, and the factor does not matter
    return hardened(np.divide(late, full, out=np.ones_like(full), where=np.abs(full) > 1e-12))


def _tobolsky(test: Test, a: float, shape: Shape) -> Change:
    """Chains that take time to come under load; the delay in strains at the usual rate."""
    return _behind(test, a / test.setting.rate)


def _seguela(test: Test, a: float, shape: Shape) -> Change:
    """Tie molecules that are taut only after some strain."""
    return hardened(-np.expm1(-(np.maximum(test.largest / a, 1e-9) ** shape["sharpness"])))


def _flory(test: Test, a: float, shape: Shape) -> Change:
    """Crystals in equilibrium with the stretch beyond an onset; they tie chains and stiffen."""
    beyond = np.maximum(np.exp(test.strain) - np.exp(shape["onset"] * test.setting.reach), 0.0)
    return hardened(1.0 + a * beyond / (shape["half"] + beyond))


def _doufas(test: Test, a: float, shape: Shape) -> Change:
    """Crystals that grow by a kinetics of their own and do not melt."""
    beyond = np.maximum(test.largest - shape["onset"] * test.setting.reach, 0.0) / test.setting.reach
    driving = -np.expm1(-4.0 * beyond)
    grown = driving - maxwell(test.time, driving, [shape["strain"] / test.setting.rate])[:, 0]
    return hardened(1.0 + a * np.maximum.accumulate(grown))


def _lemaitre(test: Test, a: float, shape: Shape) -> Change:
    """1 - D grows from an onset by a power of the largest strain."""
    onset = shape["onset"] * test.setting.reach
    x = np.maximum(test.largest - onset, 0.0) / (test.setting.reach - onset)
    return scaled(1.0 - np.minimum(a * x ** shape["power"], 0.95))


def _bundle(test: Test, a: float, shape: Shape) -> Change:
    """Fibres whose strengths have Weibull's distribution (Daniels 1945)."""
    broken = -np.expm1(-((test.largest / (shape["strain"] * test.setting.reach)) ** shape["sharpness"]))
    return scaled(1.0 - a * broken)


def _ogden_roxburgh(test: Test, a: float, shape: Shape) -> Change:
    """Eta = 1 - a erf((W_max - W)/(m W_ref)), with the energy of a neo-Hookean bar."""
    energy = _invariant(test.strain)
    missing = np.maximum.accumulate(energy) - energy
    return scaled(1.0 - a * erf(missing / (shape["width"] * _invariant(np.array(0.3 * test.setting.reach)))))


def _beatty(test: Test, a: float, shape: Shape) -> Change:
    """Beatty and Krishnaswamy: exp(-b sqrt(largest stretch - stretch))."""
    missing = np.maximum(np.exp(test.largest) - np.exp(test.strain), 0.0)
    return scaled(np.exp(-a * np.sqrt(missing / (0.1 * test.setting.reach))))


def _bridgman(test: Test, a: float, shape: Shape) -> Change:
    """Le Roy's radius: (section over radius of the neck) grows in proportion to the strain beyond its onset."""
    onset = shape["onset"] * test.setting.reach
    sharp = a * np.maximum(test.largest - onset, 0.0) / (test.setting.reach - onset)
    x = np.maximum(sharp, 1e-9)
    return scaled((1.0 + 2.0 / x) * np.log1p(0.5 * x))


def _davidenkov(test: Test, a: float, shape: Shape) -> Change:
    """Davidenkov and Spiridonova's 1 + (section over radius)/4, of a neck that comes and runs out (G'Sell 1979)."""
    onset = shape["onset"] * test.setting.reach
    u = np.maximum(test.largest - onset, 0.0) / (0.35 * test.setting.reach)
    return scaled(1.0 + 0.25 * a * u * np.exp(1.0 - u))


def _teeth(strain: FloatArray, onset: float, spacing: float, uneven: float) -> FloatArray:
    """From 0 to 1 over every tooth; spacings differ by the golden section's fractions, up to `uneven`."""
    golden = 0.6180339887
    count = int(max(float(strain.max()) - onset, 0.0) / (spacing * (1.0 - uneven))) + 2
    lengths = spacing * (1.0 + uneven * (2.0 * (golden * np.arange(1, count + 1) % 1.0) - 1.0))
    corners = onset + np.concatenate([[0.0], np.cumsum(lengths)])
    at = np.clip(np.searchsorted(corners, strain, side="right") - 1, 0, count - 1)
    return np.where(strain < onset, 0.0, (strain - corners[at]) / lengths[at])


def _barenblatt(test: Test, a: float, shape: Shape) -> Change:
    """Self-oscillation of drawing: the load climbs and falls at every step of the neck."""
    onset = shape["onset"] * test.setting.reach
    teeth = _teeth(test.largest, onset, shape["spacing"] * test.setting.reach, 0.0)
    return scaled(1.0 - a * np.sin(np.pi * teeth) ** 2)


def _pakula(test: Test, a: float, shape: Shape) -> Change:
    """Sudden falls of the load and slow climbs, unevenly apart."""
    onset = shape["onset"] * test.setting.reach
    teeth = _teeth(test.largest, onset, shape["spacing"] * test.setting.reach, 0.4)
    return scaled(np.where(test.largest < onset, 1.0, 1.0 - a * (1.0 - teeth) ** 2))


def _gsell_volume(test: Test, a: float, shape: Shape) -> Change:
    """Volume grows in proportion to the strain beyond yield; the section that is assumed is too small by so much."""
    onset = shape["onset"] * test.setting.reach
    return scaled(1.0 + a * np.maximum(test.largest - onset, 0.0) / (test.setting.reach - onset))


def _cavities(test: Test, a: float, shape: Shape) -> Change:
    """Cavities that open within a range of strains, and stay (Pawlak and Galeski 2005)."""
    x = test.largest / (shape["strain"] * test.setting.reach)
    return scaled(1.0 + a * x**2 / (1.0 + x**2))


def _tension_field(test: Test, a: float, shape: Shape) -> Change:
    """A wrinkled strip carries a part 1 - a of what would press it (Wagner 1929)."""
    return Change(stress=lambda stress: np.where(stress < 0.0, (1.0 - a) * stress, stress))


def _euler(test: Test, a: float, shape: Shape) -> Change:
    """A strip buckles at a part of the flow stress, soon enough none: what is beyond is lost, by a part a."""
    load = shape["load"] * test.setting.flow_stress
    return Change(stress=lambda stress: stress - a * np.minimum(stress + load, 0.0))


NETWORK = (
    Cause(
        "hardening of other rates", 0.05, 0.5,
        (Form("Wendlandt 2005", _wendlandt), Form("Hoy and Robbins 2006", _hoy_robbins, {"turn": (0.3, 3.0)})),
        signed=True,
    ),
    Cause(
        "chains of limited length", 0.3, 0.9, (Form("Gent 1996", _gent), Form("Arruda and Boyce 1993", _eight_chains))
    ),
    Cause(
        "network that comes late", 0.05, 0.6,
        (Form("first order in time", _tobolsky), Form("Seguela 2005", _seguela, {"sharpness": (1.0, 2.5)})),
    ),
    Cause(
        "crystals by stretching", 0.3, 4.0,
        (
            Form("Flory 1947", _flory, {"onset": (0.2, 0.6), "half": (0.2, 1.0)}),
            Form("Doufas 2000", _doufas, {"onset": (0.15, 0.6), "strain": (0.02, 0.3)}),
        ),
    ),
    Cause(
        "loss of section that carries", 0.08, 0.6,
        (
            Form("Lemaitre 1985", _lemaitre, {"onset": (0.02, 0.4), "power": (1.0, 2.5)}),
            Form("Daniels 1945", _bundle, {"strain": (0.3, 0.9), "sharpness": (1.5, 4.0)}),
        ),
    ),
    Cause(
        "softening below the largest strain", 0.1, 0.7,
        (
            Form("Ogden and Roxburgh 1999", _ogden_roxburgh, {"width": (0.2, 2.0)}),
            Form("Beatty and Krishnaswamy 2000", _beatty),
        ),
        needs="cycles",
    ),
    Cause(
        "neck across the section", 0.5, 4.0,
        (
            Form("Bridgman 1944", _bridgman, {"onset": (0.05, 0.5)}),
            Form("Davidenkov and Spiridonova 1946", _davidenkov, {"onset": (0.05, 0.4)}),
        ),
    ),
    Cause(
        "jerky flow", 0.03, 0.4,
        (
            Form("Barenblatt 1974", _barenblatt, {"onset": (0.1, 0.5), "spacing": (0.03, 0.15)}),
            Form("Pakula and Fischer 1981", _pakula, {"onset": (0.1, 0.5), "spacing": (0.04, 0.2)}),
        ),
    ),
    Cause(
        "volume that grows", 0.05, 0.6,
        (
            Form("G'Sell 2002", _gsell_volume, {"onset": (0.02, 0.3)}),
            Form("Pawlak and Galeski 2005", _cavities, {"strain": (0.15, 0.7)}),
        ),
    ),
    Cause(
        "strip that buckles", 0.8, 1.0,
        (Form("Wagner 1929", _tension_field), Form("Euler 1744", _euler, {"load": (0.02, 0.2)})),
        needs="deep",
    ),
)  # fmt: skip
