"""Causes that no usual catalogue holds."""

from __future__ import annotations

import numpy as np

from probation_studies.blind.laboratories.industry.bench import BenchTest, mid
from probation_studies.blind.laboratories.industry.causes.form import Cause, Form, Shape
from probation_studies.blind.laboratories.industry.memory import FloatArray


def _cell_creep(test: BenchTest, a: float, shape: Shape) -> None:
    """Bartel & Yaniv 1997 (65 load cells at NIST): the reading creeps by exponential terms of the load, and recovers.

    F + a sum_i w_i int (1 - exp(-(t - s)/t_i)) dF, two terms, the second eight times as slow.
    """
    quick = shape["time"] * test.scales.duration

    def read(force: FloatArray) -> FloatArray:
        crept = np.zeros_like(force)
        for share, time in ((0.6, quick), (0.4, 8.0 * quick)):
            now = force[0]
            late = np.empty_like(force)
            late[0] = now
            for k, dt in enumerate(np.diff(test.time)):
                now += (0.5 * (force[k] + force[k + 1]) - now) * -np.expm1(-dt / time)
                late[k + 1] = now
            crept += share * late
        return np.asarray(force + a * (crept - force[0]))

    test.force.append(read)


def _cell_log_creep(test: BenchTest, a: float, shape: Shape) -> None:
    """Andrade 1910: transient creep of the spring element with the cube root of time, of the mean load so far."""
    start = shape["time"] * test.scales.duration

    def read(force: FloatArray) -> FloatArray:
        laid = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(test.time))])
        mean = laid / np.maximum(test.time, 1e-9)
        return np.asarray(force + a * mean * np.cbrt(test.time / (test.scales.duration + start)))

    test.force.append(read)


def _neck_in_gauge(test: BenchTest, a: float, shape: Shape) -> None:
    """Considere 1885, Hutchinson & Neale 1983: a neck takes a part of the gauge length; the rest stays at its onset.

    The crosshead shows (1 - a) e + a e_n beyond the onset e_n.
    """
    onset = shape["onset"] * np.expm1(test.scales.strain)
    test.reading.append(lambda travel, force: travel - a * np.maximum(np.maximum.accumulate(travel) - onset, 0.0))


def _neck_spreading(test: BenchTest, a: float, shape: Shape) -> None:
    """Carothers & Hill 1932: the neck spreads until it holds the whole gauge length; the shortfall rises and goes."""
    whole = np.expm1(test.scales.strain)
    onset = shape["onset"] * whole

    def read(travel: FloatArray, force: FloatArray) -> FloatArray:
        beyond = np.maximum(np.maximum.accumulate(travel) - onset, 0.0) / (whole - onset)
        return np.asarray(travel - a * whole * beyond * np.exp(1.0 - beyond / shape["spread"]) / 3.0)

    test.reading.append(read)


def _ageing_in_holds(test: BenchTest, a: float, shape: Shape) -> None:
    """Struik 1978 under load: at rest the material ages, tau grows by (1 + t/t_0)^a; flow undoes it."""
    age = _rest(test)
    start = shape["time"] * test.scales.duration
    test.flow.append(lambda stress: a * np.log1p(age / start))


def _strain_ageing(test: BenchTest, a: float, shape: Shape) -> None:
    """Cottrell & Bilby 1949: in a hold the stress to go on rises by a (1 - exp(-(t/t_0)^(2/3))), undone by flow."""
    aged = -np.expm1(-((_rest(test) / (shape["time"] * test.scales.duration)) ** (2.0 / 3.0)))
    at_nodes = np.concatenate([[0.0], aged])
    test.after.append(lambda stress: stress * (1.0 + a * at_nodes))


def _rest(test: BenchTest) -> FloatArray:
    """Time spent in holds, in the intervals, forgotten over a strain of 2 %."""
    rest, now = np.zeros(len(test.modulus)), 0.0
    still = np.abs(np.diff(test.strain) / np.diff(test.time)) < 0.02 * test.scales.rate
    for k, (dt, moved) in enumerate(zip(np.diff(test.time), np.abs(np.diff(test.strain)), strict=True)):
        now = now + dt if still[k] else now * np.exp(-moved / 0.02)
        rest[k] = now
    return rest


def _kraus(test: BenchTest, a: float, shape: Shape) -> None:
    """Payne 1962, Kraus 1984: the filler's network breaks with the strain's amplitude since the last reversal.

    E (1 - a + a / (1 + (D/D_c)^(2 m))), D that amplitude.
    """
    amplitude = _amplitude(test.strain) / (shape["critical"] * test.scales.strain)
    test.modulus *= 1.0 - a + a / (1.0 + amplitude ** (2.0 * shape["m"]))


def _lion(test: BenchTest, a: float, shape: Shape) -> None:
    """Lion & Kardelky 2004: relaxation times fall with the intensity of the deformation, 1 + a q."""
    q, now = np.zeros(len(test.modulus)), 0.0
    for k, moved in enumerate(np.abs(np.diff(test.strain))):
        now += moved / (shape["critical"] * test.scales.strain) - now * np.diff(test.time)[k] / (
            0.3 * test.scales.duration
        )
        q[k] = max(now, 0.0)
    test.flow.append(lambda stress: -np.log1p(a * q))


def _amplitude(strain: FloatArray) -> FloatArray:
    """Distance from the last reversal, in the intervals."""
    found, turned, before = np.zeros(len(strain) - 1), strain[0], 1.0
    for k, step in enumerate(np.diff(strain)):
        if step * before < 0.0:
            turned, before = strain[k], np.sign(step)
        found[k] = abs(mid(strain[k : k + 2])[0] - turned)
    return found


BEYOND = (
    Cause(
        "cell_creep",
        (
            Form("Bartel & Yaniv 1997", _cell_creep, 0.2, {"time": (0.03, 0.2)}, signed=True),
            Form("Andrade 1910", _cell_log_creep, 0.2, {"time": (0.05, 0.5)}, signed=True),
        ),
        rig=True,
        needs="hold",
    ),
    Cause(
        "neck_in_gauge",
        (
            Form("Considere 1885", _neck_in_gauge, 0.4, {"onset": (0.1, 0.5)}, crosshead=True),
            Form(
                "spreading, Carothers & Hill 1932",
                _neck_spreading,
                0.3,
                {"onset": (0.05, 0.3), "spread": (0.1, 0.4)},
                crosshead=True,
            ),
        ),
        rig=True,
    ),
    Cause(
        "ageing_in_holds",
        (
            Form("Struik 1978, under load", _ageing_in_holds, 1.0, {"time": (0.003, 0.1)}),
            Form("Cottrell & Bilby 1949", _strain_ageing, 0.3, {"time": (0.01, 0.2)}),
        ),
        needs="hold",
    ),
    Cause(
        "payne",
        (
            Form("Kraus 1984", _kraus, 0.6, {"critical": (0.01, 0.1), "m": (0.5, 0.8)}),
            Form("Lion & Kardelky 2004", _lion, 2.0, {"critical": (0.05, 0.5)}),
        ),
        needs="unloading",
    ),
)
