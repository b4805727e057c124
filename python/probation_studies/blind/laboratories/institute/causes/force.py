"""What the force cell and its amplifier do."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.causes.cause import Cause, Change, Form, Shape

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation_studies.blind.laboratories.institute.modal import FloatArray
    from probation_studies.blind.laboratories.institute.series import Test


def _of_force(change: Callable[[FloatArray], FloatArray]) -> Change:
    return Change(channels=lambda strain, force: (strain, change(force)))


def _progress(test: Test) -> FloatArray:
    """0 at the first sample, 1 at the last; at the nodes."""
    return np.asarray(np.maximum(test.time[::2], 0.0) / test.time[-1])


def _zero(test: Test, a: float, shape: Shape) -> Change:
    return _of_force(lambda force: force + a)


def _warm_zero(test: Test, a: float, shape: Shape) -> Change:
    """A zero that was taken before the cell was quite warm: a twentieth still goes."""
    settled = 1.0 - 0.05 * np.exp(-_progress(test) / shape["part"])
    return _of_force(lambda force: force + a * settled)


def _linear_drift(test: Test, a: float, shape: Shape) -> Change:
    return _of_force(lambda force: force + a * _progress(test))


def _cell_creep(test: Test, a: float, shape: Shape) -> Change:
    """Creep of the cell's glue and warming of its bridge: first order, `a` at the end (OIML R 60 tests for it)."""
    x, part = _progress(test), shape["part"]
    return _of_force(lambda force: force + a * np.expm1(-x / part) / np.expm1(-1.0 / part))


def _gain(test: Test, a: float, shape: Shape) -> Change:
    return _of_force(lambda force: (1.0 + a) * force)


def _bent_gain(test: Test, a: float, shape: Shape) -> Change:
    """A wrong gain with a twentieth of itself in curvature."""
    return _of_force(lambda force: force * (1.0 + a * (1.0 + 0.05 * force / np.abs(force).max())))


def _strain_late(test: Test, a: float, shape: Shape) -> Change:
    """The force runs ahead by `a` seconds: every strain sample is an old one, or every force sample."""
    time = test.time[::2]
    if a >= 0.0:
        return Change(channels=lambda strain, force: (np.interp(time - a, time, strain), force))
    return _of_force(lambda force: np.interp(time + a, time, force))


def _filtered(test: Test, a: float, shape: Shape) -> Change:
    """A low-pass of first order in the strain channel (a > 0) or in the force channel."""
    time = test.time[::2]

    def late(values: FloatArray) -> FloatArray:
        found = values.copy()
        z = np.diff(time) / abs(a)
        kept, mean = np.exp(-z), -np.expm1(-z) / z
        for n in range(len(z)):
            rest = found[n] - values[n]
            found[n + 1] = values[n + 1] + kept[n] * rest - mean[n] * (values[n + 1] - values[n])
        return found

    return Change(channels=lambda strain, force: (late(strain), force) if a > 0.0 else (strain, late(force)))


def _clipped(test: Test, a: float, shape: Shape) -> Change:
    """The amplifier's range ends `a` below the largest force, as a part of it."""
    return _of_force(lambda force: np.minimum(force, (1.0 - a) * force.max()))


def _saturated(test: Test, a: float, shape: Shape) -> Change:
    """A range that ends softly: (1 + (F/c)^n)^(-1/n), which takes `a` of the largest force."""
    n = shape["sharpness"]

    def change(force: FloatArray) -> FloatArray:
        x = ((1.0 - a) ** -n - 1.0) * np.maximum(force / force.max(), 0.0) ** n
        return np.asarray(force * (1.0 + x) ** (-1.0 / n))

    return _of_force(change)


def _play(values: FloatArray, width: float) -> FloatArray:
    """Prandtl's play: what lies behind the values by up to `width` on both sides."""
    found = np.empty_like(values)
    behind = 0.0
    for n, value in enumerate(values):
        behind = min(max(behind, value - width), value + width)
        found[n] = behind
    return found


def _prandtl_cell(test: Test, a: float, shape: Shape) -> Change:
    """A cell that is read too high as the force falls (reversibility of ISO 376); `a` of the largest force."""

    def change(force: FloatArray) -> FloatArray:
        most = force.max()
        return np.asarray(force + a * (_play(force, shape["width"] * most) - force) / shape["width"])

    return _of_force(change)


def _duhem_cell(test: Test, a: float, shape: Shape) -> Change:
    """Dahl's rate-independent friction in the cell: h' = F' - h |F'|/w."""

    def change(force: FloatArray) -> FloatArray:
        width = shape["width"] * force.max()
        lag = np.zeros_like(force)
        for n, step in enumerate(np.diff(force)):
            kept = np.exp(-abs(step) / width)
            lag[n + 1] = kept * lag[n] + np.sign(step) * (1.0 - kept)
        return np.asarray(force - a * force.max() * lag)

    return _of_force(change)


def _waves(test: Test, a: float, shape: Shape, overtones: tuple[float, ...]) -> Change:
    turns = 2.0 * np.pi * shape["waves"] * _progress(test)
    wave = sum(part * np.sin((k + 1) * turns + 1.3 * k) for k, part in enumerate(overtones))
    return _of_force(lambda force: force + a * wave)


def _sine(test: Test, a: float, shape: Shape) -> Change:
    return _waves(test, a, shape, (1.0,))


def _pump(test: Test, a: float, shape: Shape) -> Change:
    """Compressor of the chamber: a wave with an overtone."""
    return _waves(test, a, shape, (1.0, 0.35))


_WIDTH = {"width": (0.02, 0.3)}
FORCE = (
    Cause(
        "zero of the cell", 0.3, 20.0,
        (Form("constant", _zero), Form("cell not quite warm", _warm_zero, {"part": (0.1, 0.6)})),
        rig=True, signed=True,
    ),
    Cause(
        "drift of the cell", 0.3, 20.0,
        (Form("linear", _linear_drift), Form("first order", _cell_creep, {"part": (0.2, 1.0)})),
        rig=True, signed=True,
    ),
    Cause("gain of the cell", 0.03, 0.4, (Form("constant", _gain), Form("bent", _bent_gain)), rig=True, signed=True),
    Cause(
        "channels apart in time", 0.5, 20.0, (Form("old samples", _strain_late), Form("low-pass", _filtered)),
        rig=True, signed=True,
    ),
    Cause(
        "end of the amplifier's range", 0.05, 0.5,
        (Form("hard", _clipped), Form("soft", _saturated, {"sharpness": (6.0, 20.0)})), rig=True,
    ),
    Cause(
        "friction in the cell", 0.01, 0.2,
        (Form("Prandtl 1928", _prandtl_cell, _WIDTH), Form("Dahl 1968", _duhem_cell, _WIDTH)),
        rig=True, needs="cycles",
    ),
    Cause(
        "hum", 0.1, 10.0,
        (Form("sine", _sine, {"waves": (3.0, 60.0)}), Form("compressor", _pump, {"waves": (3.0, 30.0)})), rig=True,
    ),
)  # fmt: skip
