"""Do the 95 % intervals contain the truth 95 times in 100? Counted on records whose truth is known.

The records are made here, from the closed form (7) of a ramp of the true strain in partial fractions, with noise on
strain and stress: no line of it is shared with the law, the schemes or the noise models that are judged.
"""

from __future__ import annotations

import json
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from scipy.special import betaincinv

from probation._arrays import FloatArray, as_whole_number
from probation._files import kind_of, read_whole, write_whole, written_to
from probation.errors import InputError
from probation.identify.fit import fit
from probation.pool import run_all
from probation.records.campaign import Campaign
from probation.records.record import Record
from probation.results.data import Stored
from probation.results.rendering import Plotted, Summarised
from probation.settings.identification import IDENTIFICATION

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from os import PathLike

    from probation.identify.weighting import Weighting
    from probation.smoothing.methods import Method as ExcitationMethod

TRUTH = {"unrelaxed_modulus": 3224.0, "tau_max": 5.207, "hardening_modulus": 2.556}
"""Table 1's reference [MPa], [s], [MPa]."""

STRAIN_RATE, END_STRAIN, SAMPLES = 0.005, 2.0, 300

RECOMMENDED: Weighting = "auto"
JUDGED: tuple[Weighting, ...] = ("plain", "strain-noise-frozen", "auto")


@dataclass(frozen=True)
class Case:
    """One kind of noise.

    Attributes
    ----------
    strain_noise : float [-]
    stress_noise : float [MPa]
    correlation : float
        Of AR(1) stress noise.
    excitation : {"auto", "raw"}
        Whether the fit may smooth the strain.
    """

    name: str
    strain_noise: float
    stress_noise: float = 0.04
    correlation: float = 0.0
    excitation: ExcitationMethod = "auto"


CASES: tuple[Case, ...] = (
    Case("strain noise 1e-3, unsmoothed", 1e-3, excitation="raw"),
    Case("strain noise 3e-4, unsmoothed", 3e-4, excitation="raw"),
    Case("strain noise 1e-3, smoothed", 1e-3),
    Case("stress noise 0.04 MPa", 0.0),
    Case("stress noise AR(1) 0.5", 0.0, correlation=0.5),
)


@dataclass(frozen=True)
class Counted:
    """How often the intervals of one method contained the truth.

    Attributes
    ----------
    hits : dict of str to int
        By parameter.
    bias : dict of str to float
        Mean estimate over truth, minus one [-].
    """

    case: str
    method: str
    draws: int
    hits: dict[str, int]
    bias: dict[str, float]

    def coverage(self, name: str) -> float:
        """Of one parameter [-]."""
        return self.hits[name] / self.draws

    def interval(self, name: str) -> tuple[float, float]:
        """Exact binomial interval of the coverage at `IDENTIFICATION.coverage_confidence` (Clopper & Pearson 1934)."""
        return exact_interval(self.hits[name], self.draws)

    def holds(self, name: str) -> bool:
        """Whether that interval contains `IDENTIFICATION.nominal_coverage`."""
        low, high = self.interval(name)
        return low <= IDENTIFICATION.nominal_coverage <= high

    @property
    def decides(self) -> bool:
        """Whether there are draws enough to say that an interval holds."""
        return enough_draws(self.draws)

    @property
    def all_hold(self) -> bool:
        """Whether the intervals of all parameters hold."""
        return all(self.holds(name) for name in self.hits)

    def to_dict(self) -> dict[str, Any]:
        """A row of the answer."""
        return {
            "case": self.case,
            "weighting": self.method,
            "draws": self.draws,
            "parameters": {
                name: {
                    "coverage": self.coverage(name),
                    "interval99": self.interval(name),
                    "holds": None if self.holds(name) and not self.decides else self.holds(name),
                    "bias": self.bias[name],
                }
                for name in self.hits
            },
        }


@dataclass(frozen=True)
class Coverage(Summarised, Plotted, Stored):
    """The study.

    `plot` draws the coverage of every case, method and parameter with its interval.

    Attributes
    ----------
    counted : tuple of Counted
    """

    SCHEMA = "probation.coverage/1"
    RENDERERS: ClassVar = {
        "summary": "probation_studies.coverage.summary.coverage_summary",
        "plot": "probation_studies.coverage.figure.coverage_figure",
    }

    counted: tuple[Counted, ...]
    seed: int

    def of(self, case: str, method: str) -> Counted:
        """What was counted for one case and method."""
        return next(
            counted_case for counted_case in self.counted if (counted_case.case, counted_case.method) == (case, method)
        )

    @property
    def verdict(self) -> str:
        """One sentence."""
        recommended = [counted_case for counted_case in self.counted if counted_case.method == RECOMMENDED]
        failing = [counted.case for counted in recommended if not counted.all_hold]
        draws = min(counted_case.draws for counted_case in self.counted)
        if failing:
            kinds = ", ".join(failing)
            return f"The 95 % intervals of weighting {RECOMMENDED!r} do not hold over {draws} draws: {kinds}."
        if not enough_draws(draws):
            lowest = min(counted.interval(name)[0] for counted in recommended for name in counted.hits)
            needed = next(count for count in range(draws, 1000) if enough_draws(count))
            return (
                f"{draws} draws are too few to tell whether the 95 % intervals of weighting {RECOMMENDED!r} hold: they "
                f"allow a coverage of {100 * lowest:.0f} %. {needed} draws can tell 95 % from "
                f"{100 * IDENTIFICATION.least_coverage:.0f} %."
            )
        return (
            f"The 95 % intervals of weighting {RECOMMENDED!r} hold: over {draws} draws of each of {len(recommended)} "
            "kinds of noise the exact 99 % interval of their coverage contains 95 % for every parameter."
        )

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects."""
        return {"verdict": self.verdict, "seed": self.seed, "rows": [counted.to_dict() for counted in self.counted]}


def exact_interval(hits: int, draws: int) -> tuple[float, float]:
    """Clopper and Pearson's interval of a proportion, at `IDENTIFICATION.coverage_confidence`."""
    tail = 0.5 * (1.0 - IDENTIFICATION.coverage_confidence)
    low = float(betaincinv(hits, draws - hits + 1, tail)) if hits else 0.0
    high = float(betaincinv(hits + 1, draws - hits, 1.0 - tail)) if hits < draws else 1.0
    return low, high


def enough_draws(draws: int) -> bool:
    """Whether the interval of a coverage counted at the nominal one would exclude `IDENTIFICATION.least_coverage`."""
    return exact_interval(round(IDENTIFICATION.nominal_coverage * draws), draws)[0] >= IDENTIFICATION.least_coverage


def study(
    draws: int = 1000,
    *,
    seed: int = 0,
    cases: Sequence[Case] = CASES,
    methods: Sequence[Weighting] = JUDGED,
    processes: int = 1,
    state: str | PathLike[str] | None = None,
    progress: Callable[[int, int, str], None] | None = None,
) -> Coverage:
    """Fit `draws` records of every case by every method and count the intervals that contain the truth.

    Parameters
    ----------
    cases : sequence of Case
    methods : sequence of str
        Weightings of `probation.fit`.
    state : path-like, optional
        A file that keeps what was counted, a line per draw; what it has is not done again.
    progress : callable, optional
        Called with ``(done, total, what)``.

    Raises
    ------
    InputError
        If a number is not positive or the state cannot be read.
    """
    for name, value in (("draws", draws), ("processes", processes)):
        if as_whole_number(value, name) < 1:
            raise InputError(f"{name} is {value}; expected at least 1")
    found = _kept(state, seed)
    jobs = [(case, draw) for case in cases for draw in range(draws) if _key(case, draw, methods) not in found]
    total = len(cases) * draws
    if progress:
        progress(total - len(jobs), total, "")
    done = total - len(jobs)

    def keep(job: tuple[int, int], result: Result) -> None:
        nonlocal done
        done += 1
        case, draw = cases[job[0]], job[1]
        found[_key(case, draw, methods)] = result
        if state is not None:
            with written_to(state), Path(state).open("a", encoding="utf-8") as file:
                file.write(json.dumps([seed, *_key(case, draw, methods), result]) + "\n")
        if progress:
            progress(done, total, case.name)

    arguments = {(cases.index(case), draw): (case, draw, methods, seed) for case, draw in jobs}
    run_all(_judge, arguments, processes=processes, executor=None, progress=None, on_done=keep)
    return Coverage(
        tuple(
            _count(case, method, [found[_key(case, draw, methods)][method] for draw in range(draws)])
            for case in cases
            for method in methods
        ),
        seed,
    )


Result = dict[str, dict[str, tuple[float, bool]]]
"""By method and parameter: the estimate, and whether its interval contains the truth."""


def drawn_record(case: Case, seed: int, draw: int) -> Record:
    """One record of a case: time, noisy strain, noisy stress."""
    random = np.random.default_rng([seed, draw, CASES.index(case) if case in CASES else 97])
    time = np.linspace(0.0, END_STRAIN / STRAIN_RATE, SAMPLES)
    white = random.standard_normal(SAMPLES)
    noise = np.empty(SAMPLES)
    noise[0] = white[0]
    for i in range(1, SAMPLES):
        noise[i] = case.correlation * noise[i - 1] + np.sqrt(1.0 - case.correlation**2) * white[i]
    strain = STRAIN_RATE * time + case.strain_noise * random.standard_normal(SAMPLES)
    return Record("ramp", time, strain, ramp_response(time) + case.stress_noise * noise, control="strain-rate")


def ramp_response(time: FloatArray) -> FloatArray:
    """Eq. (7) at `TRUTH`, shape (n_times,) [MPa]; mode by mode, in partial fractions of 1 / tau_j."""
    unrelaxed, longest, hardening = TRUTH.values()
    stress = np.zeros_like(time)
    times = [longest * 10.0 ** (-(50 - j) * 6.0 / 49.0) for j in range(1, 51)]  # eq. (4)
    weights = [tau**0.5 / sum(other**0.5 for other in times) for tau in times]  # eq. (5)
    for tau, weight in zip(times, weights, strict=True):
        decayed = np.exp(-time / tau)
        up = (np.exp(2.0 * STRAIN_RATE * time) - decayed) / (1.0 + 2.0 * STRAIN_RATE * tau)
        down = (np.exp(-STRAIN_RATE * time) - decayed) / (1.0 - STRAIN_RATE * tau)
        stress += weight * (unrelaxed * STRAIN_RATE * tau * (1.0 - decayed) + hardening * (up - down))
    return stress


def _judge(case: Case, draw: int, methods: Sequence[Weighting], seed: int) -> Result:
    campaign = Campaign(case.name, (drawn_record(case, seed, draw),))
    result: Result = {}
    for method in methods:
        answer = fit(
            campaign, "sa3", method="variable-projection", excitation=case.excitation, weighting=method, gap=False
        )
        result[method] = {}
        for name, parameter in answer.parameters.items():
            low, high = parameter.interval95 or (-np.inf, np.inf)
            result[method][name] = (parameter.value, bool(low <= TRUTH[name] <= high))
    return result


def _count(case: Case, method: str, results: Sequence[dict[str, tuple[float, bool]]]) -> Counted:
    values: dict[str, list[float]] = defaultdict(list)
    hits: dict[str, int] = dict.fromkeys(TRUTH, 0)
    for result in results:
        for name, (value, hit) in result.items():
            values[name].append(value)
            hits[name] += hit
    bias = {name: float(np.mean(values[name])) / TRUTH[name] - 1.0 for name in TRUTH}
    return Counted(case.name, method, len(results), hits, bias)


def _key(case: Case, draw: int, methods: Sequence[str]) -> tuple[str, int, str]:
    return case.name, draw, " ".join(methods)


def _kept(state: str | PathLike[str] | None, seed: int) -> dict[tuple[str, int, str], Any]:
    if state is None or kind_of(state) is None:
        return {}
    kept: dict[tuple[str, int, str], Any] = {}
    text = read_whole(state).decode(errors="replace")
    whole = text[: text.rfind("\n") + 1]
    if whole != text:  # the last line was cut off while it was written; the next must not go on with it
        write_whole(state, whole)
    for number, line in enumerate(whole.splitlines(), 1):
        try:
            found_seed, case, draw, methods, result = json.loads(line)
        except (ValueError, TypeError, RecursionError):
            raise InputError(f"{state}, line {number}: found {line[:40]!r}, expected a line of this study") from None
        if found_seed == seed:
            kept[case, draw, methods] = result
    return kept
