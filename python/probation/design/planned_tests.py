"""Experiments that a laboratory with a tensile machine could do next.

A new one is a function here, of a `Laboratory`, and its line in `PLANNERS`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.design.planned_record import planned_view
from probation.errors import ConvergenceError, InputError
from probation.histories.segments import Leg, piecewise_linear
from probation.inference.modal_law import DnlrLaw
from probation.law.creep import creep
from probation.law.history import jump_indices
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.model import CampaignModel
    from probation.law.modal import Law

_HOURS = 180
"""Minutes from which on a cost is said in hours."""
_TURNS, _SETTLED = 20, 1e-3


@dataclass(frozen=True, eq=False)
class ProposedTest:
    """A strain history that could be imposed, and what is otherwise about the test.

    Attributes
    ----------
    name : str
        "rate_jump_up".
    what : str
        What to do, with its numbers, as the beginning of a sentence.
    time : ndarray, shape (n_samples,) [s]
    true_strain : ndarray, shape (n_samples,) [-]
    jumps : tuple of int
        Samples at which the rate is discontinuous.
    preparation : float
        Effort besides the test itself, as time [s].
    repeats : str, optional
        Id of the record of which it is the repeat.
    gauge_length : float
        Of the specimen, as a multiple of that in the other records.
    """

    name: str
    what: str
    time: FloatArray
    true_strain: FloatArray
    jumps: tuple[int, ...] = ()
    preparation: float = DESIGN.specimen_effort
    repeats: str | None = None
    gauge_length: float = 1.0

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.time[-1] - self.time[0])

    @property
    def effort(self) -> float:
        """Time that it costs, preparation included [s]."""
        return self.duration + self.preparation

    @property
    def cost(self) -> str:
        """What it takes: "one specimen, 20 minutes"; the time on the machine."""
        specimen = "one specimen" if self.preparation > 0.0 else "no specimen"
        if self.gauge_length != 1.0:
            specimen += f" of {self.gauge_length:g} times the gauge length"
        minutes = max(round(self.duration / 60.0), 1)
        if minutes < _HOURS:
            return f"{specimen}, {minutes} minute{'s' if minutes > 1 else ''}"
        return f"{specimen}, {self.duration / 3600.0:.2g} hours"

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        corners = [0, *self.jumps, len(self.time) - 1]
        return {
            "test": self.name,
            "what": self.what,
            "time_s": self.time[corners],
            "true_strain": self.true_strain[corners],
            "samples": len(self.time),
            "repeats": self.repeats,
        }


@dataclass(frozen=True, eq=False)
class Laboratory:
    """What has been done, and so can be done again a little differently.

    Attributes
    ----------
    model : CampaignModel
        The law without causes, on the records there are.
    parameters : ndarray
        Of the law.
    slowest, fastest : float
        Median rates while straining of the slowest and the fastest record [1/s].
    usual : float
        Their geometric mean.
    strain : float
        Largest true strain reached.
    samples : int
        Per test.
    """

    model: CampaignModel
    parameters: FloatArray
    slowest: float
    fastest: float
    usual: float
    strain: float
    samples: int

    @classmethod
    def of(cls, model: CampaignModel, parameters: FloatArray) -> Laboratory:
        """Of a model on the records there are.

        Raises
        ------
        InputError
            If no record strains.
        """
        rates = [rate for rate in map(_straining_rate, model.views) if rate > 0.0]
        strain = max(float(np.max(view.recorded_strain)) for view in model.views)
        if not rates or not strain > 0.0:
            raise InputError("next test: found no record that is stretched, expected one at least")
        samples = int(np.clip(np.median([len(view.data) for view in model.views]), *DESIGN.planned_samples))
        slowest, fastest = min(rates), max(rates)
        return cls(model, parameters, slowest, fastest, float(np.sqrt(slowest * fastest)), strain, samples)

    @property
    def contrast(self) -> tuple[float, float]:
        """A low and a high rate, a decade apart or as far as the records are [1/s]."""
        widened = max(self.fastest / self.slowest, DESIGN.rate_contrast) ** 0.5
        return self.usual / widened, self.usual * widened

    def legs(
        self,
        name: str,
        what: str,
        *legs: tuple[float, float],
        preparation: float = DESIGN.specimen_effort,
        gauge_length: float = 1.0,
    ) -> ProposedTest:
        """A test of straight legs (strain at the end, duration [s]) that starts without strain."""
        history = piecewise_linear(name, [Leg(*leg) for leg in legs], self.samples)
        time, strain = history.time, history.true_strain
        assert strain is not None
        assert history.jumps is not None
        summary = f"{what} ({_time(float(time[-1]))}, {len(time)} samples)"
        jumps = tuple(jump_indices(list(history.jumps), time, strain))
        return ProposedTest(name, summary, time, strain, jumps, preparation, gauge_length=gauge_length)

    def stress(self, test: ProposedTest) -> FloatArray:
        """What the base law predicts of a test, shape (n_samples,) [MPa]."""
        view = planned_view(test.name, test.time, test.true_strain, test.jumps, self.model.views)
        return self.model.law.stress(view, self.parameters)


Planner: TypeAlias = Callable[[Laboratory], Sequence[ProposedTest]]


def zero_load_hold(lab: Laboratory) -> list[ProposedTest]:
    """The load cell reads an unloaded specimen, for as long as the longest test and three times as long."""
    longest = max(view.duration for view in lab.model.views)
    what = "Before the next test record the force while the specimen hangs free of load"
    return [lab.legs("zero_load_hold", what, (0.0, hold), preparation=0.0) for hold in (longest, 3.0 * longest)]


def repeats(lab: Laboratory) -> list[ProposedTest]:
    """A record over again."""
    tests = []
    for view in lab.model.views:
        time, strain = view.sampled(view.elapsed), view.sampled(view.recorded_strain)
        jumps = tuple(jump // view.stride for jump in view.jumps)
        what = f"Repeat {view.id} on the same rig with a new specimen ({_time(view.duration)}, {len(time)} samples)"
        tests.append(ProposedTest("repeat", what, time, strain, jumps, repeats=view.id))
    return tests


def other_rates(lab: Laboratory) -> list[ProposedTest]:
    """Ramps half a decade and a decade beyond the rates used: the law is not known there, which counts as effort."""
    rates = [lab.slowest / factor for factor in (np.sqrt(DESIGN.rate_contrast), DESIGN.rate_contrast)]
    rates += [lab.fastest * factor for factor in (np.sqrt(DESIGN.rate_contrast), DESIGN.rate_contrast)]
    return [
        lab.legs(
            "faster_ramp" if rate > lab.usual else "slower_ramp",
            f"Stretch at {rate:.2g} /s to a true strain of {lab.strain:.2g}",
            (lab.strain, lab.strain / rate),
            preparation=2.0 * DESIGN.specimen_effort,
        )
        for rate in rates
    ]


def rate_jumps(lab: Laboratory) -> list[ProposedTest]:
    """From slow to fast and from fast to slow, half way."""
    low, high = lab.contrast
    tests = []
    for name, first, second in (("rate_jump_up", low, high), ("rate_jump_down", high, low)):
        half = 0.5 * lab.strain
        what = f"Stretch at {first:.2g} /s to a true strain of {half:.2g}, then at {second:.2g} /s to {lab.strain:.2g}"
        tests.append(lab.legs(name, what, (half, half / first), (lab.strain, half / second)))
    return tests


def dwells(lab: Laboratory) -> list[ProposedTest]:
    """Held half way, for as long as it took to get there and ten times as long."""
    half = 0.5 * lab.strain
    loading = half / lab.usual
    return [
        lab.legs(
            "dwell",
            f"Stretch at {lab.usual:.2g} /s to a true strain of {half:.2g}, hold it there for {_time(hold)}, "
            f"go on at the same rate to {lab.strain:.2g}",
            (half, loading),
            (half, hold),
            (lab.strain, loading),
        )
        for hold in (loading, DESIGN.rate_contrast * loading)
    ]


def unloading(lab: Laboratory) -> list[ProposedTest]:
    """Back to no load (to less, the specimen buckles) and up again, from half way and from just behind yield."""
    tests = []
    for top in (0.5 * lab.strain, min(DESIGN.yield_strain, DESIGN.early_unloading * lab.strain)):
        down = lab.legs("down", "", (top, top / lab.usual), (0.0, top / lab.usual))
        pressed = (np.arange(len(down.time)) > down.jumps[0]) & (lab.stress(down) <= 0.0)
        turn = float(down.true_strain[int(np.argmax(pressed))]) if pressed.any() else 0.0
        what = (
            f"Stretch at {lab.usual:.2g} /s to a true strain of {top:.2g}, unload at the same rate to no load (near "
            f"{turn:.2g}), stretch again to {lab.strain:.2g}"
        )
        rest = ((turn, (top - turn) / lab.usual), (lab.strain, (lab.strain - turn) / lab.usual))
        tests.append(lab.legs("unload_reload", what, (top, top / lab.usual), *rest))
    return tests


def dead_weight(lab: Laboratory) -> list[ProposedTest]:
    """Creep under a constant force, along the strain that the base law predicts; the engine's law only."""
    if not isinstance(lab.model.law, DnlrLaw):
        return []
    law = lab.model.law.law_at(lab.parameters)
    first = min(DESIGN.yield_strain, lab.strain)
    ramp = lab.legs("ramp", "", (first, first / lab.usual))
    nominal = DESIGN.dead_weight * float(np.max(lab.stress(ramp) * np.exp(-ramp.true_strain)))
    longest = max(view.duration for view in lab.model.views)
    time, strain = _hanging(law, nominal, longest, lab.samples)
    if np.max(strain) > lab.strain:  # taken down in time
        longest = float(time[int(np.argmax(strain > lab.strain)) - 1])
        time, strain = _hanging(law, nominal, longest, lab.samples)
    what = f"Hang a dead weight of {nominal:.2g} MPa (force over initial section) on the specimen and record its strain"
    end = f"to a true strain of {strain[-1]:.2g}"
    summary = f"{what} {end} ({_time(longest)}, {len(time)} samples, dense at first)"
    return [
        ProposedTest(
            "dead_weight", summary, time, strain, (DESIGN.loading_samples,), preparation=2.0 * DESIGN.specimen_effort
        )
    ]


def _hanging(law: Law, nominal: float, longest: float, samples: int) -> tuple[FloatArray, FloatArray]:
    """Time [s] and true strain under a constant force over the initial section [MPa], each of shape (n_samples,)."""
    put_on = min(DESIGN.loading_time, longest / DESIGN.loading_one_in)
    later = put_on + np.geomspace(
        put_on / DESIGN.loading_samples, longest - put_on, samples - DESIGN.loading_samples - 1
    )
    time = np.append(np.linspace(0.0, put_on, DESIGN.loading_samples + 1), later)
    force = nominal * np.minimum(time / put_on, 1.0)
    strain = np.zeros(len(time))
    for _ in range(_TURNS):  # true stress = force over the section that there is
        before, strain = strain, creep(law, time, force * np.exp(strain), jumps=[put_on])
        if np.max(np.abs(strain - before)) < _SETTLED:
            break
    return time, strain


def other_gauge_length(lab: Laboratory) -> list[ProposedTest]:
    """Twice the gauge length: what frame and grips add to the strain counts half."""
    what = (
        f"Stretch a specimen of twice the gauge length at {lab.usual:.2g} /s (twice the crosshead speed) to a true "
        f"strain of {lab.strain:.2g}"
    )
    ramp = (lab.strain, lab.strain / lab.usual)
    test = lab.legs("double_gauge_length", what, ramp, preparation=2.0 * DESIGN.specimen_effort, gauge_length=2.0)
    return [test]


PLANNERS: tuple[Planner, ...] = (
    zero_load_hold,
    repeats,
    other_rates,
    rate_jumps,
    dwells,
    unloading,
    dead_weight,
    other_gauge_length,
)


def planned_tests(lab: Laboratory) -> list[ProposedTest]:
    """All tests of `PLANNERS` that take no longer than two days and that the base law can predict."""
    tests = []
    for planner in PLANNERS:
        try:
            tests += [test for test in planner(lab) if test.duration <= DESIGN.longest_test]
        except ConvergenceError:
            continue
    return tests


def _straining_rate(view: RecordView) -> float:
    """Median rate while straining [1/s], 0 without any."""
    strain, time = view.sampled(view.recorded_strain), view.sampled(view.time)
    rate = np.abs(np.diff(strain) / np.diff(time))
    moving = rate > DESIGN.moving_rate * float(np.max(rate, initial=0.0))
    return float(np.median(rate[moving])) if moving.any() else 0.0


def _time(seconds: float) -> str:
    """A duration as people say it."""
    if seconds < 120.0:
        return f"{seconds:.3g} s"
    return f"{seconds / 60.0:.2g} min" if seconds < 7200.0 else f"{seconds / 3600.0:.2g} h"
