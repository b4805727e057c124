"""The network locks: its chains have a finite length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_AMPLITUDE = EffectParameter(
    name="inverse_extensibility",
    unit="",
    lower=0.0,
    upper=0.2,
    scale=0.01,
    reason="1/J_m; locking at a stretch of about 10 (J_m = 100)",
)


def _gent(view: RecordView, values: Values) -> Modification:
    """Gent: G over 1 - a (I_1 - 3), a = 1 / J_m."""
    used = values[0] * view.first_invariant
    free = 1.0 - np.minimum(used, EFFECTS.locked)
    return Modification(hardening_factor=1.0 / free + np.maximum(used - EFFECTS.locked, 0.0) / free**2)


def _langevin(view: RecordView, values: Values) -> Modification | None:
    """Eight chains of N = 1 / (5 a) links: G times L^-1(y) / 3y over its value at rest, y^2 = I_1 / 3N."""
    if values[0] <= 0.0:
        return None
    links = 1.0 / (5.0 * values[0])
    part = np.sqrt((view.first_invariant + 3.0) / (3.0 * links))
    at_rest = float(_stiffening(np.array([1.0 / np.sqrt(links)]))[0])
    return Modification(hardening_factor=_stiffening(part) / at_rest)


def _three_chains(view: RecordView, values: Values) -> Modification | None:
    """Chains along the three axes: G times (h(l) - h(l^-1/2)) / (l^2 - 1/l), h(x) = x L^-1(x / N^1/2), over its value
    at rest; l the stretch, N = 1 / (5 a).
    """
    if values[0] <= 0.0:
        return None
    root = np.sqrt(1.0 / (5.0 * values[0]))
    # x L^-1(x / N^1/2) = 3 x^2 / N^1/2 times the stiffening; at rest half its slope is what the ratio tends to.
    at_rest = np.ones(1) / root
    bend = float((_stiffening(at_rest + 1e-5) - _stiffening(at_rest - 1e-5))[0]) / 2e-5 / root
    limit = float(_stiffening(at_rest)[0]) + 0.5 * bend
    stretch = np.where(np.abs(view.stretch - 1.0) < 1e-6, 1.0 + 1e-6, view.stretch)
    pulled = stretch**2 * _stiffening(stretch / root) - _stiffening(stretch**-0.5 / root) / stretch
    return Modification(hardening_factor=pulled / (stretch**2 - 1.0 / stretch) / limit)


def _stiffening(part: FloatArray) -> FloatArray:
    """L^-1(y) / 3y, straight beyond `locked`."""
    y = np.minimum(part, EFFECTS.locked)
    factor = inverse_langevin(y) / (3.0 * y)
    beyond = part > EFFECTS.locked
    if np.any(beyond):
        step = 1e-4
        low, high = inverse_langevin(np.array([EFFECTS.locked - step, EFFECTS.locked])) / (
            3.0 * np.array([EFFECTS.locked - step, EFFECTS.locked])
        )
        factor = factor + (high - low) / step * np.maximum(part - EFFECTS.locked, 0.0)
    return factor


def inverse_langevin(y: FloatArray) -> FloatArray:
    """Solve coth x - 1/x = y for 0 < y < 1, by Newton's method from Cohen's approximation; a series below 0.05."""
    y2 = y * y
    series = y * (3.0 + y2 * (9.0 / 5.0 + y2 * (297.0 / 175.0 + y2 * (1539.0 / 875.0 + y2 * 126117.0 / 67375.0))))
    small = y < 0.05
    bounded = np.where(small, 0.5, y)
    x = bounded * (3.0 - bounded**2) / (1.0 - bounded**2)
    for _ in range(5):
        langevin = 1.0 / np.tanh(x) - 1.0 / x
        slope = 1.0 / x**2 - 1.0 / np.sinh(np.minimum(x, 300.0)) ** 2
        x = x - (langevin - bounded) / slope
    return np.where(small, series, x)


EFFECT = Effect(
    name="finite_extensibility",
    title="finite extensibility of the network",
    physics=(
        "Chains have a finite length: the relaxed stress rises above Haward-Thackray and locks.\n"
        "Amplitude: 1/J_m (Gent), or 1/(5 N) for chains of N links (Langevin), the same to first order."
    ),
    source=(
        "Gent 1996, Rubber Chem. Technol. 69, 59; Arruda & Boyce 1993, J. Mech. Phys. Solids 41, 389; Wang & Guth "
        "1952, J. Chem. Phys. 20, 1144"
    ),
    shows_in="records reaching large strains",
    kind="material",
    forms=(
        Form("gent", (_AMPLITUDE,), modification=_gent),
        Form("langevin", (_AMPLITUDE,), modification=_langevin),
        Form("three_chains", (_AMPLITUDE,), modification=_three_chains, variant=True),
    ),
)
