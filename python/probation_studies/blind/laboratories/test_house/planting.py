"""Causes that are put into a series: plain, and standing out from every other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.causes import FORMS, RIVALS, Effect, Form
from probation_studies.blind.laboratories.test_house.draws import LogEven
from probation_studies.blind.laboratories.test_house.machine import base_stress, observe
from probation_studies.blind.laboratories.test_house.metric import Metric
from probation_studies.blind.laboratories.test_house.plan import Plan, draw_plan

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.test_house.metric import Signals
    from probation_studies.blind.laboratories.test_house.modal import FloatArray
    from probation_studies.blind.laboratories.test_house.trial import Test

ATTEMPTS, _PATIENCE = 60, 12
_AIMS = LogEven(30.0, 500.0)
LEAST, LEAST_OF_PAIR, MOST = 0.95 * 30.0, 0.95 * 20.0, 1500.0
"""sqrt(lambda) after the law's refit, of one cause alone and jointly with another."""
RESOLVABLE = 8.0
"""sqrt(lambda) that the nearest other cause must leave."""
_UNSEEN = 3.0
"""sqrt(lambda) of a usual amount that is no rival."""
_REFITS, _FITTED, _STRIDE = 5, 1e-3, 0.4


@dataclass(frozen=True, eq=False)
class Placed:
    """A form in a place.

    Attributes
    ----------
    form : Form
    record : str or None
        None for all.
    share : float
        How often it is drawn so, of its cause.
    signal : ndarray, shape (n_all,)
        Whitened, without what is fitted.
    """

    form: Form
    record: str | None
    share: float
    signal: FloatArray


@dataclass(frozen=True, eq=False)
class Planted:
    """A cause at work.

    Attributes
    ----------
    effect : Effect
    size : float
        sqrt(lambda) that law and partner cannot take up.
    left : float
        What the nearest rival leaves of it.
    nearest : str
        Whose that is.
    signal : ndarray, shape (n_all,)
        Whitened, without what the law takes up.
    """

    effect: Effect
    size: float
    left: float
    nearest: str
    signal: FloatArray


@dataclass(frozen=True, eq=False)
class Series:
    """A plan with its causes, the refitted law's tests, and the metric there."""

    plan: Plan
    planted: tuple[Planted, ...]
    tests: tuple[Test, ...]
    metric: Metric


def draw_series(
    seed: int, forms: Sequence[Form], *, strain_noise: float | None = None, alike: bool | None = None
) -> Series | None:
    """A series in which each of some forms is plain and stands out.

    Parameters
    ----------
    seed : int
    forms : sequence of Form
        None, one or two.
    strain_noise : float, optional
    alike : bool, optional
        Whether specimens are. Both are drawn if left out; where scatter hides a cause, they are alike.

    Returns
    -------
    Series or None
        None if no plan in `ATTEMPTS` shows them.
    """
    needs: frozenset[str] = frozenset().union(*(each.needs for each in forms))
    for attempt in range(ATTEMPTS):
        random = np.random.default_rng([seed, attempt])
        same = bool(random.uniform() < 0.5) if alike is None else alike
        same = same or "order" in needs or (attempt >= _PATIENCE and bool(forms))
        plan = draw_plan(random, needs, alike=same, strain_noise=strain_noise)
        found = _planted(random, plan, forms)
        if found is not None:
            return found
    return None


def _planted(random: Generator, plan: Plan, forms: Sequence[Form]) -> Series | None:
    metric = Metric(plan.coarse, plan.errors, plan.scatter)
    if not forms:
        return Series(plan, (), plan.coarse, metric)
    base = {test.name: base_stress(test) for test in plan.coarse}
    effects = []
    for form in forms:
        effect = _drawn(random, form, plan.coarse)
        aim = _AIMS.draw(random)
        effects.append(replace(effect, amount=_amount(plan.coarse, base, metric, effect, aim)))
    tests, metric, gap = _fitted(plan, effects, metric)
    base = {test.name: base_stress(test) for test in tests}
    signals = [gap] if len(effects) == 1 else [signal_of(tests, each, base) for each in effects]
    planted = []
    for k, (effect, signal) in enumerate(zip(effects, signals, strict=True)):
        own = metric if len(effects) == 1 else metric.jointly_with(signals[1 - k])
        shown = own.left(signal)
        size = float(np.linalg.norm(shown))
        if not (LEAST if len(effects) == 1 else LEAST_OF_PAIR) <= size <= MOST:
            return None
        left, nearest = _nearest(rivals(tests, base, own, {each.form.cause for each in effects}), shown)
        if left < RESOLVABLE:
            return None
        planted.append(Planted(effect, size, left, nearest, metric.left(signal)))
    return Series(plan, tuple(planted), tests, metric)


def _drawn(random: Generator, form: Form, tests: Sequence[Test]) -> Effect:
    """With its place and shape."""
    scope = str(random.choice(["one", "all"])) if form.scope == "either" else form.scope
    record = str(random.choice([test.name for test in tests])) if scope == "one" else None
    return Effect(form, 1.0, form.draw(random), record)


def _amount(tests: Sequence[Test], base: Signals, metric: Metric, effect: Effect, aim: float) -> float:
    """At which sqrt(lambda) is what is aimed at, within the form's range."""

    def size(amount: float) -> float:
        return float(np.linalg.norm(metric.left(signal_of(tests, replace(effect, amount=amount), base))))

    low, high = effect.form.low, effect.form.high
    if size(low) >= aim:
        return low
    if not size(high) > aim:
        return high
    for _ in range(9):
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if size(middle) < aim else (low, middle)
    return float(np.sqrt(low * high))


def _fitted(plan: Plan, effects: Sequence[Effect], metric: Metric) -> tuple[tuple[Test, ...], Metric, Signals]:
    """Tests with the law refitted to what is recorded with the effects, without noise (Gauss and Newton).

    Large effects move the parameters far. The metric there, and what the refit leaves.
    """
    recorded = {}
    for test in plan.coarse:
        strain, force = observe(test, effects)
        recorded[test.name] = strain if _is_late(effects, test) else None, force * np.exp(strain)
    tests = plan.coarse
    for iteration in range(_REFITS + 1):
        gap = {test.name: recorded[test.name][1] - base_stress(test, recorded[test.name][0]) for test in tests}
        step = np.linalg.lstsq(metric.whitened(metric.parameters), metric.whitened(gap), rcond=None)[0]
        if iteration == _REFITS or np.abs(step).max() < _FITTED:
            break
        factors = np.exp(np.clip(step, -_STRIDE, _STRIDE)).tolist()
        tests = tuple(replace(test, law=test.law.scaled(*factors)) for test in tests)
        metric = Metric(tests, plan.errors, plan.scatter)
    return tests, metric, gap


def _is_late(effects: Sequence[Effect], test: Test) -> bool:
    return any(change.late is not None for each in effects for change in each.changes(test))


def signal_of(tests: Sequence[Test], effect: Effect, base: Signals) -> dict[str, FloatArray]:
    """Recorded true stress less the law's at the recorded strain [MPa], by record that is touched."""
    found = {}
    for test in tests:
        if effect.touches(test):
            strain, force = observe(test, [effect])
            expected = base_stress(test, strain) if _is_late([effect], test) else base[test.name]
            found[test.name] = force * np.exp(strain) - expected
    return found


def rivals(tests: Sequence[Test], base: Signals, metric: Metric, but: set[str]) -> Iterator[Placed]:
    """Every cause but some, in both forms and all places, where it shows."""
    one_temperature = len({test.temperature for test in tests}) == 1
    for form in (*FORMS.values(), *RIVALS):
        if form.cause in but or (one_temperature and "temperatures" in form.needs):
            continue
        if form.name == "test_to_test" and "change_between_tests" in but:  # their temperatures are recorded
            continue
        whole = signal_of(tests, form.usual, base)
        for record, share in form.shares([test.name for test in tests]).items():
            left = metric.left(whole if record is None else {record: whole[record]})
            if np.all(np.isfinite(left)) and np.linalg.norm(left) > _UNSEEN:
                yield Placed(form, record, 0.5 * share, left)


def _nearest(others: Iterator[Placed], shown: FloatArray) -> tuple[float, str]:
    """Least sqrt(lambda) that a rival leaves, the first that is too little, and whose it is."""
    best = float(np.linalg.norm(shown)), "none"
    for rival in others:
        signal = rival.signal
        left = float(np.linalg.norm(shown - signal * (signal @ shown) / (signal @ signal)))
        if left < best[0]:
            best = left, f"{rival.form.cause}/{rival.form.name}" + (f"@{rival.record}" if rival.record else "")
        if left < RESOLVABLE:
            break
    return best
