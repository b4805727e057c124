"""A campaign of six records and noises of many kinds, made without the statistics that are to be tested on them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.signal import butter, lfilter

import probation
from probation.noise.record_residual import RecordResidual

SIGMA = 0.04
KINDS = ("white", "ar1", "slow", "sum", "filter", "drift", "bursts", "heavy", "force", "digits")


@dataclass(frozen=True, eq=False)
class Test:
    name: str
    time: np.ndarray
    strain: np.ndarray
    rate: np.ndarray
    stress: np.ndarray
    tangent: np.ndarray
    jumps: tuple[int, ...]


@lru_cache
def campaign(count: int = 1000) -> tuple[Test, ...]:
    """Three ramps, a rate-jump test, an unloading, a dwell; E_u 3220 MPa, tau_max 5.2 s, G 2 MPa."""
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    corners = {
        "slow": ([0, 1500], [0, 1.5]),
        "middle": ([0, 300], [0, 1.5]),
        "fast": ([0, 90], [0, 1.8]),
        "jumps": ([0, 200, 300, 400], [0, 0.3, 1.0, 1.2]),
        "unloading": ([0, 350, 500], [0, 1.0, 0.8]),
        "dwell": ([0, 200, 350, 500], [0, 0.8, 0.8, 1.2]),
    }
    tests = []
    for name, (instants, strains) in corners.items():
        time = np.linspace(0.0, instants[-1], count)
        strain = np.interp(time, instants, strains)
        stress, tangent = law.sensitivity(time, strain)
        jumps = tuple(round(t / instants[-1] * (count - 1)) for t in instants[1:-1])
        tests.append(Test(name, time, strain, np.gradient(strain, time), stress, tangent, jumps))
    return tuple(tests)


def effects(count: int = 1000) -> dict[str, list[np.ndarray]]:
    """Stress along a dozen shared effects, and an offset and a drift of the force in each record alone."""
    tests = campaign(count)

    def log_rate(test: Test) -> np.ndarray:
        return np.log10(np.maximum(np.abs(test.rate), 1e-5) * 200.0)

    shapes = {
        "offset": lambda t: np.exp(t.strain),
        "drift": lambda t: np.exp(t.strain) * t.time / 500.0,
        "damage": lambda t: t.stress * t.strain,
        "activated": lambda t: t.tangent[:, 1] * t.stress / 50.0,
        "rate-relaxation": lambda t: t.tangent[:, 1] * log_rate(t),
        "rate-hardening": lambda t: t.tangent[:, 2] * log_rate(t),
        "locking": lambda t: t.tangent[:, 2] * np.expm1(2.0 * t.strain),
        "softening": lambda t: t.stress * np.exp(-t.strain / 0.1),
        "heating": lambda t: t.stress * np.cumsum(t.stress * t.rate * np.gradient(t.time)) / 100.0,
        "slow-process": lambda t: t.stress * (1.0 - np.exp(-t.time / 100.0)),
    }
    found = {name: [shape(test) for test in tests] for name, shape in shapes.items()}
    for index, test in enumerate(tests):
        own = [np.exp(each.strain) * (at == index) for at, each in enumerate(tests)]
        found[f"offset {test.name}"] = own
        found[f"drift {test.name}"] = [o * each.time for o, each in zip(own, tests, strict=True)]
    return found


def pink(rng: np.random.Generator, count: int) -> np.ndarray:
    """1/f noise by its spectrum, on a window of a longer record."""
    frequency = np.fft.rfftfreq(4 * count)
    frequency[0] = np.inf
    series = np.fft.irfft(np.fft.rfft(rng.standard_normal(4 * count)) / np.sqrt(frequency), 4 * count)[:count]
    return series - series.mean()


def noise(kind: str, rng: np.random.Generator, count: int) -> np.ndarray:
    """Unit standard deviation, or nearly so; (n,)."""
    white = rng.standard_normal(count + 400)
    slow = {"ar1": 0.7, "slow": 0.9, "sum": 0.85}
    if kind in slow:
        phi = slow[kind]
        series = lfilter([np.sqrt(1 - phi**2)], [1, -phi], white)[400:]
        return 0.6 * series + 0.8 * rng.standard_normal(count) if kind == "sum" else series
    if kind == "filter":  # one filter for both channels
        return lfilter(*butter(2, 0.25), white)[400:] / np.sqrt(0.25)
    if kind == "heavy":
        return rng.standard_t(3, size=count) / np.sqrt(3.0)
    size = np.ones(count)
    if kind == "bursts":
        for _ in range(3):
            first = rng.integers(0, int(0.94 * count))
            size[first : first + rng.integers(count // 50, count // 16)] = 5.0
    return size * white[400:]


def long_run(kind: str) -> float:
    """Square root of the spectrum at frequency zero, in closed form."""
    ratio = {"white": 1.0, "ar1": 1.7 / 0.3, "slow": 1.9 / 0.1, "sum": 0.36 * 1.85 / 0.15 + 0.64, "filter": 4.0}
    return float(np.sqrt(ratio[kind]))


def records(
    kind: str, rng: np.random.Generator, count: int = 1000, bias: list[np.ndarray] | None = None
) -> list[RecordResidual]:
    """The campaign measured with one kind of noise, and with a bias of the data where one is given [MPa]."""
    errors = [SIGMA * noise(kind, rng, count) for _ in campaign(count)]
    if kind == "drift":
        errors = [error + d for error, d in zip(errors, _nuisance_drift(rng, count), strict=True)]
    found = []
    for index, (test, error) in enumerate(zip(campaign(count), errors, strict=True)):
        data = test.stress + error * (np.exp(test.strain) if kind == "force" else 1.0)
        if bias is not None:
            data = data + bias[index]
        if kind == "digits":
            data = np.round(data / (2.0 * SIGMA)) * (2.0 * SIGMA)
        found.append(
            RecordResidual(
                test.name, test.time, test.strain, test.rate, test.stress - data, test.tangent, test.jumps, data
            )
        )
    return found


def _nuisance_drift(rng: np.random.Generator, count: int) -> list[np.ndarray]:
    """1/f drift whose projection on the worst effect is 0.95 standard errors, the base parameters refitted."""
    tests = campaign(count)
    drift = np.concatenate([pink(rng, count) for _ in tests])
    span = np.linalg.qr(np.vstack([test.tangent for test in tests]))[0]
    worst = 0.0
    for blocks in effects(count).values():
        column = np.concatenate(blocks)
        column = column - span @ (span.T @ column)
        worst = max(worst, abs(column @ drift) / np.linalg.norm(column))
    return np.split(0.95 * SIGMA / worst * drift, len(tests))


def with_effect(found: list[RecordResidual], name: str, amplitude: float) -> list[RecordResidual]:
    """The data moved by an effect: the residual, model minus data, moves the other way."""
    shapes = effects(len(found[0]))[name]
    return [
        replace(record, residual=record.residual - amplitude * shape, measured=None)
        for record, shape in zip(found, shapes, strict=True)
    ]
