"""The stress drops and recovers with a period in the strain: serrated flow."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import running_integral
from probation.detection.strain_periodic import likely_periods
from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.effects.effect import StressHook
    from probation.effects.record_view import RecordView

_DROP = 0.04
"""Least part of a period that a drop takes; a sample where that is more."""
_RECOVERIES = (0.3, 3.0)
"""Recoveries over the period [-] from which searches begin: soon after the drop, and nearly a straight line."""
_ONSET, _GROWTH = 0.05, 0.2
"""Onset, and strain over which drops grow [true strain], from which searches begin: yield, and some tenths."""
_HARMONICS = 12
"""Harmonics of a tooth that place its first drop; of the highest, a drop of `_DROP` is half a wave."""
_NEWTON_STEPS = 3
"""Steps by which the best phase on the grid is refined: each doubles its digits."""
_GRID = np.arange(256) / 256.0
"""Phases [periods] that are tried first: twenty to a wave of the highest harmonic."""
_WAVES = np.exp(2j * np.pi * np.outer(_GRID, np.arange(1, _HARMONICS + 1)))
"""Of all harmonics, at these phases."""

_PERIOD = EffectParameter(
    name="period_strain",
    unit="",
    lower=1e-4,
    upper=1.0,
    centre=0.05,
    scale=float("inf"),
    log=True,
    reason="a thousandth in metals, some hundredths in a drawn polyester: any",
)
_PARAMETERS = (
    EffectParameter(
        "drop_MPa", "MPa", 0.0, 50.0, 1.0, "some tenths of a MPa to some MPa; a drop, so that it has one sign"
    ),
    _PERIOD,
    EffectParameter(
        name="recovery_of_period",
        unit="",
        lower=0.05,
        upper=10.0,
        centre=1.0,
        scale=1.5,
        log=True,
        starts=_RECOVERIES,
        reason="reloaded along a straight line (large) or back soon after the drop (small)",
    ),
    EffectParameter(
        name="onset_strain",
        unit="",
        lower=0.0,
        upper=2.0,
        centre=0.0,
        scale=0.3,
        starts=(_ONSET,),
        reason="none before yield; the critical strain of an alloy is some per cent, that of a neck some tenths",
    ),
    EffectParameter(
        name="growth_strain",
        unit="",
        lower=0.005,
        upper=2.0,
        centre=_GROWTH,
        scale=1.2,
        log=True,
        starts=(_GROWTH,),
        reason="drops grow over some per cent to some tenths of strain, then stay",
    ),
    EffectParameter(
        name="power_of_stretch",
        unit="",
        lower=-1.0,
        upper=3.0,
        centre=1.0,
        scale=0.7,
        starts=(1.0,),
        reason="drops alike in force have 1, in true stress 0; in proportion to a hardening stress more",
    ),
)


def _tooth(part: FloatArray, drop: float, recovery: float) -> FloatArray:
    """0 before a drop, -1 after it, and back by 1 - e^(-x / recovery), x the part of the way to the next; shape (n,).

    Parameters
    ----------
    part : ndarray, shape (n,)
        Of the period since the drop began.
    drop : float
        Part of the period that it takes.
    """
    falling = np.minimum(part / drop, 1.0)
    since = np.clip((part - drop) / (1.0 - drop), 0.0, 1.0)
    left = np.expm1((1.0 - since) / recovery) / np.expm1(1.0 / recovery)
    return -np.where(part < drop, falling**2 * (3.0 - 2.0 * falling), left)


def _teeth(view: RecordView, period: float, recovery: float, size: FloatArray) -> FloatArray:
    """Teeth over the largest strain so far, shape (n,): below it the material does not flow.

    Where the first drop is differs from specimen to specimen: it is read off the record, where it correlates best with
    teeth of such a size.
    """
    largest = view.largest_strain
    sample = view.stride * float(largest[-1] - largest[0]) / max(len(view) - 1, 1)
    drop = float(np.clip(sample / period, _DROP, 0.5))
    orders = np.arange(1, int(np.clip(0.5 * period / max(sample, 1e-300), 1, _HARMONICS)) + 1)
    tooth = np.fft.rfft(_tooth(_GRID, drop, recovery))[orders]
    first = _best_phase(orders, np.conj(tooth) * _coefficients(view, period, size, orders))
    return size * _tooth(np.mod(largest / period - first, 1.0), drop, recovery)


def _coefficients(
    view: RecordView, period: float, size: FloatArray, orders: NDArray[np.intp]
) -> NDArray[np.complex128]:
    """Fourier's, over the strain, of the recorded force less its mean over a period, weighted by size; (n_orders,)."""
    strain = view.sampled(view.largest_strain)
    flowing = np.diff(strain, prepend=-np.inf) > 0.0
    strain, force = strain[flowing], (view.data / view.sampled(view.stretch))[flowing]
    if len(strain) < 2:
        return np.zeros(len(orders), dtype=np.complex128)
    area = running_integral(force, strain)
    behind, ahead = strain - 0.5 * period, strain + 0.5 * period
    mean = (np.interp(ahead, strain, area) - np.interp(behind, strain, area)) / period
    inside = (behind >= strain[0]) & (ahead <= strain[-1])
    step = np.gradient(strain)  # an integral over the strain: samples of a wait count for nothing
    weighted = np.where(inside, view.sampled(size)[flowing] * (force - mean) * step, 0.0)
    wave = np.exp(-2j * np.pi / period * strain)
    return np.asarray(np.cumprod(np.broadcast_to(wave, (len(orders), len(wave))), axis=0) @ weighted)


def _best_phase(orders: NDArray[np.intp], answers: NDArray[np.complex128]) -> float:
    """Where sum Re c_k e^(2 pi i k x) is largest: on a grid, then by Newton's method."""
    turn = 2j * np.pi * orders
    phase = float(_GRID[int(np.argmax((_WAVES[:, : len(orders)] @ answers).real))])
    for _ in range(_NEWTON_STEPS):
        here = answers * np.exp(turn * phase)
        slope, bend = float(np.sum(turn * here).real), float(np.sum(turn**2 * here).real)
        if bend < 0.0:
            phase -= float(np.clip(slope / bend, -_GRID[1], _GRID[1]))
    return phase


def _dropping(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """True stress falls by a(1 - e^(-x / w)) e^(n e), x the strain beyond the onset, e the strain."""
    return np.asarray(stress + _drops(view, tuple(map(float, values))))


def _rising(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """True stress rises by as much between one drop and the next, and falls back: serrations of type A."""
    given = tuple(map(float, values))
    return np.asarray(stress + _drops(view, given) + _size(view, given))


def _size(view: RecordView, values: tuple[float, ...]) -> FloatArray:
    """Of a drop at each instant, shape (n,) [MPa]."""
    drop, _, _, onset, growth, power = values
    grown = -np.expm1(-np.maximum(view.largest_strain - onset, 0.0) / growth)
    return np.asarray(drop * grown * np.exp(power * view.largest_strain))


@lru_cache(maxsize=256)
def _drops(view: RecordView, values: tuple[float, ...]) -> FloatArray:
    """The teeth of one record, shape (n,) [MPa]: kept, since all slopes along other parameters ask for the same."""
    _, period, recovery, *_ = values
    return _teeth(view, period, recovery, _size(view, values))


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """The likeliest periods of the residuals; without residuals the prior's centre."""
    periods = [_PERIOD.centre]
    if residuals is not None:
        periods = likely_periods([view.sampled(view.largest_strain) for view in views], residuals)
    inside = [_PERIOD.inside(likely) for likely in periods]
    return [(likely, recovery, _ONSET, _GROWTH, 1.0) for likely in inside for recovery in _RECOVERIES]


def _form(name: str, stress: StressHook, *, several: bool = True) -> Form:
    """One that is sought where something is periodic in the strain."""
    return Form(
        name,
        _PARAMETERS,
        recorded_stress=stress,
        placements=("all", "one"),
        starts=_starts,
        sharp="strain_period",
        several=several,
        variant=True,
    )


EFFECT = Effect(
    name="serrated_flow",
    title="serrated flow",
    physics=(
        "Beyond an onset the stress drops again and again, at one distance in strain, and recovers as straining goes "
        "on: bands of an alloy that ages as it is strained, a neck that runs and stops.\n"
        "Amplitude: fall of the stress far beyond the onset, over a power of the stretch."
    ),
    source=(
        "Penning 1972, Acta Metall. 20, 1169; Rodriguez 1984, Bull. Mater. Sci. 6, 653 (drops below the general level, "
        "or rises above it: types C and A); Kubin & Estrin 1985, Acta Metall. 33, 397; Andrianova, Kechekyan & Kargin "
        "1971, J. Polym. Sci. A-2 9, 1919; Barenblatt 1974, Rheol. Acta 13, 924; Reed & Walter 2003, Mater. Sci. Eng. "
        "A 359, 1 (drops grow with strain)"
    ),
    shows_in="a saw tooth over the strain, whatever the rate; not below the largest strain so far",
    kind="material",
    coordinate="largest_strain",
    forms=(
        _form("recurring_drops", _dropping),
        # Where only some records have them, drops stand in: numbers of their own in each record are a long search.
        _form("recurring_rises", _rising, several=False),
    ),
    odds=0.3,
)
