"""Which causes act, how strongly, and what can be confused with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.causes import AT_TEMPERATURES, KNOWN, NAMES, OUTSIDE
from probation_studies.blind.laboratory.oracle import TARGETS
from probation_studies.blind.laboratory.trial import Acting

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.bank import Bank, Signal
    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Cause, Shape

LEAST = 2.0
"""Less detectable causes are not planted."""

_LADDER = np.array([1e-3, 4e-3, 0.015, 0.04, 0.1, 0.2, 0.4, 0.7, 1.0])
_NEAREST = 8


@dataclass(frozen=True)
class Wish:
    """A cause that is to act.

    Attributes
    ----------
    cause : Cause
    everywhere : bool
        In all records, or in one.
    target : float
        Detectability aimed at.
    """

    cause: Cause
    everywhere: bool
    target: float


@dataclass(frozen=True)
class Planted:
    """A cause that acts: in which record (None for all), how strongly, and its projected signal, shape (n_all,)."""

    acting: Acting
    record: int | None
    column: FloatArray

    @property
    def detectability(self) -> float:
        """Norm of the signal."""
        return float(np.linalg.norm(self.column))


def draw_wish(random: Generator, name: str, *, outside: bool = False, least: float = 0.0) -> Wish:
    """One of the forms of a name, its placement and a target of at least `least`."""
    forms = [cause for cause in (OUTSIDE if outside else (*KNOWN, *AT_TEMPERATURES)) if cause.name == name]
    cause = forms[int(random.integers(len(forms)))]
    placement = cause.placements[int(random.integers(len(cause.placements)))]
    targets = [target for target in TARGETS if target >= least]
    target = targets[int(random.integers(len(targets)))] * random.uniform(0.9, 1.15)
    return Wish(cause, placement == "all", float(target))


def draw_names(random: Generator, count: int, *, temperatures: bool) -> list[str]:
    """Different names of the catalogue, of tests at several temperatures among them."""
    names = (*NAMES, *dict.fromkeys(cause.name for cause in AT_TEMPERATURES)) if temperatures else NAMES
    return [names[k] for k in random.permutation(len(names))[:count]]


def plant(
    random: Generator, bank: Bank, wish: Wish, shape: Shape | None = None, record: int | None = None
) -> Planted | None:
    """Find the amplitude at which a cause has the detectability wished for, or the largest plausible one.

    None where even that cannot be detected, or where there is nothing for it to act on.
    """
    identified = bank.bench.identified
    if record is None and not wish.everywhere:
        record = int(identified[int(random.integers(len(identified)))])
    records = identified if record is None else [record]
    setting = bank.setting(records)
    if not wish.cause.shows(setting):
        return None
    if shape is None:
        shape = wish.cause.draw(random, setting)
    sign = float(random.choice([-1.0, 1.0])) if wish.cause.signed else 1.0
    amplitudes = sign * wish.cause.largest(setting) * _LADDER
    sizes = np.array([np.linalg.norm(each) for each in _columns(bank, wish.cause, shape, amplitudes, records)])
    if not np.all(np.isfinite(sizes)) or sizes.max() < LEAST:
        return None
    top = int(np.argmax(sizes >= wish.target)) if np.any(sizes >= wish.target) else int(np.argmax(sizes))
    amplitude = amplitudes[top]
    if top > 0 and sizes[top] >= wish.target:
        log_sizes, log_amplitudes = np.log(sizes[top - 1 : top + 1]), np.log(np.abs(amplitudes[top - 1 : top + 1]))
        amplitude = sign * float(np.exp(np.interp(np.log(wish.target), log_sizes, log_amplitudes)))
    elif sizes[top] > 1.5 * wish.target:
        amplitude *= wish.target / sizes[top]
    column = _columns(bank, wish.cause, shape, [amplitude], records)[0]
    found = Planted(Acting(wish.cause, float(amplitude), shape), record, column)
    return found if found.detectability >= LEAST else None


def _columns(
    bank: Bank, cause: Cause, shape: Shape, amplitudes: Sequence[float] | FloatArray, records: Sequence[int]
) -> list[FloatArray]:
    added = {k: bank.added(k, [(Acting(cause, float(each), shape),) for each in amplitudes]) for k in records}
    return [bank.column({k: added[k][row] for k in records}) for row in range(len(amplitudes))]


def likeness(signals: Sequence[Signal], planted: Planted) -> dict[str, float]:
    """Largest cosine with the signals of every other cause, most alike first."""
    found: dict[str, float] = {}
    for signal in signals:
        if signal.cause.name != planted.acting.cause.name:
            cosine = abs(float(signal.column @ planted.column)) / (signal.norm * planted.detectability)
            found[signal.cause.name] = max(found.get(signal.cause.name, 0.0), cosine)
    return dict(sorted(found.items(), key=lambda item: -item[1]))


def left_by_others(signals: Sequence[Signal], column: FloatArray, but: Sequence[str]) -> tuple[float, float, str]:
    """Norm of a signal that is left by the nearest placed cause of the catalogue, and by the nearest pair of them.

    A placed cause takes what its shapes can make together, of amplitudes up to some three usual ones (normal): the
    rest is sqrt(d^T (I + S S^T)^-1 d). The names `but` are left out.

    Returns
    -------
    tuple of float, float, str
        Left by one, left by two, and the name of that one.
    """
    placed: dict[tuple[str, tuple[int, ...]], list[FloatArray]] = {}
    for signal in signals:
        if not signal.cause.outside and signal.cause.name not in but:
            placed.setdefault(signal.where, []).append(3.0 * signal.column)
    spans = {where: np.stack(columns, axis=1) for where, columns in placed.items()}
    alone = sorted((_left([span], column), where) for where, span in spans.items())
    nearest = [where for _, where in alone[:_NEAREST]]
    pairs = [_left([spans[one], spans[two]], column) for one, two in combinations(nearest, 2)]
    return alone[0][0], min(pairs), alone[0][1][0]


def _left(spans: list[FloatArray], column: FloatArray) -> float:
    together = np.concatenate(spans, axis=1)
    both = together.T @ column
    taken = both @ np.linalg.solve(np.eye(len(both)) + together.T @ together, both)
    return float(np.sqrt(max(float(column @ column - taken), 0.0)))
