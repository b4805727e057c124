"""A campaign before anything acts on it: base law, histories, machine, noise."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.bank import Bench
from probation_studies.blind.laboratory.histories import draw_schedules
from probation_studies.blind.laboratory.material import BaseLaw
from probation_studies.blind.laboratory.noise import Noise, draw_noise
from probation_studies.blind.laboratory.rig import draw_controller, drive
from probation_studies.blind.laboratory.specimens import draw_own, draw_sizes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratory.histories import Schedule

_PLATEAU = 0.382
"""Steady stress over E_u We: sum of p_j tau_j / tau_max."""
_LARGEST_STRESS = 110.0  # MPa, of the network at the end
_COMPANION_PART = 1.0 / 3.0
_HELD_OUT_PART = 1.0 / 3.0
_SPECIMENS_DIFFER = 0.5
_REPLICATED = 0.5
_WIDER_STRAIN_NOISE = (-5.3, -3.0)  # decimal logarithm
_SEVERAL_TEMPERATURES = 0.25
_CHAMBER = (5.0, 15.0, 23.0, 30.0, 40.0, 50.0)  # °C


@dataclass(frozen=True)
class Design:
    """A bench, the noise of its channels, and how far its specimens differ.

    Attributes
    ----------
    bench : Bench
    noise : Noise
    scatter : tuple of float
        As `specimens.USUAL`; empty where they are alike.
    """

    bench: Bench
    noise: Noise
    scatter: tuple[float, ...] = ()


def draw_design(
    random: Generator,
    *,
    needs_unloading: bool,
    needs_reach: bool,
    wider: bool = False,
    temperatures: bool | None = None,
) -> Design:
    """Draw a campaign as a laboratory might run it.

    Parameters
    ----------
    random : Generator
    needs_unloading : bool
        One of its histories is unloaded.
    needs_reach : bool
        It goes to large strains.
    wider : bool
        With the errors of `laboratory.wider`.
    temperatures : bool, optional
        Of `laboratory.wider`, whether tests stand at several temperatures; drawn if left out.
    """
    modulus = float(np.exp(random.uniform(np.log(500.0), np.log(4000.0))))
    end = random.uniform(1.2, 2.0) if needs_reach else random.uniform(0.6, 2.0)
    most = min(8.0, _LARGEST_STRESS / float(np.exp(2.0 * end)))
    hardening = float(np.exp(random.uniform(np.log(0.5), np.log(max(most, 0.6)))))
    with_companion = bool(random.uniform() < _COMPANION_PART)
    flow_stress = random.uniform(20.0, 60.0)
    weissenberg = flow_stress / (_PLATEAU * modulus)
    fastest = 10.0 ** random.uniform(-3.0, -1.3)
    if with_companion:
        slowest = fastest / 10.0 ** random.uniform(2.0, 3.5)
        middle = float(np.sqrt(slowest * fastest))
        slope = weissenberg * random.uniform(0.05, 0.15)
        alpha = random.uniform(0.9, 1.15)
        companion = (float(slope), float(weissenberg - slope * np.log10(middle)))
        law = BaseLaw(modulus, alpha, hardening, companion)
    else:
        slowest = fastest / 10.0 ** random.uniform(1.3, 2.0)
        law = BaseLaw(modulus, 1.5 * weissenberg / fastest, hardening)

    def elastic_strain(rate: float) -> float:
        return _PLATEAU * rate * float(np.exp(law.log_time(np.array([rate]))[0]))

    count = int(random.integers(3, 9))
    schedules = draw_schedules(random, count, slowest, fastest, end, elastic_strain, needs_unloading, with_companion)
    scatter: tuple[float, ...] = ()
    if wider and random.uniform() < _SPECIMENS_DIFFER:
        scatter = draw_sizes(random)
        if random.uniform() < _REPLICATED:
            schedules = _replicated(random, schedules)
            count = len(schedules)
    controller = draw_controller(random)
    samples = int(random.integers(280, 560))
    tests = tuple(drive(random, each, int(samples * random.uniform(0.85, 1.2)), controller) for each in schedules)
    held_out = [False] * count
    if count >= 4 and random.uniform() < _HELD_OUT_PART * 1.2:
        held_out[int(random.integers(count))] = True
    bench = Bench(
        law, tests, tuple(f"test-{k + 1}" for k in range(count)), tuple(held_out), float(np.sqrt(slowest * fastest))
    )
    noise = draw_noise(random, flow_stress, with_companion)
    if wider:
        strain = float(10.0 ** random.uniform(*_WIDER_STRAIN_NOISE))
        noise = replace(noise, strain=strain, first_strain=True)
    if scatter:
        bench = replace(bench, specimens=tuple(draw_own(random, scatter) for _ in range(count)))
    if wider and (random.uniform() < _SEVERAL_TEMPERATURES if temperatures is None else temperatures):
        bench = replace(bench, degrees=_chamber(random, schedules, bench.identified))
    return Design(bench, noise, scatter)


def _chamber(random: Generator, schedules: Sequence[Schedule], identified: Sequence[int]) -> tuple[float, ...]:
    """Temperatures of the tests [°C], two or three of them; identified records stand at several.

    Tests of one history stand at one, unless all tests are of it.
    """
    histories = [id(schedule) for schedule in schedules]
    if len({histories[k] for k in identified}) == 1:
        histories = list(range(len(schedules)))
    while True:
        levels = random.choice(_CHAMBER, int(random.integers(2, 4)), replace=False)
        of_each = {history: float(random.choice(levels)) for history in histories}
        degrees = tuple(of_each[history] for history in histories)
        if len({degrees[k] for k in identified}) > 1:
            return degrees


def _replicated(random: Generator, schedules: Sequence[Schedule]) -> list[Schedule]:
    """Fewer histories, each in two or three tests; those that unload stay."""
    repeats = int(random.integers(2, 4))
    kept = sorted(schedules, key=lambda each: not each.unloads)[: max(2, len(schedules) // repeats)]
    return [each for each in kept for _ in range(repeats)]
