"""How close each method comes to a known rate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from probation.errors import InputError
from probation.normal import TWO_SIDED_95
from probation.records.record import Record
from probation.results.data import Stored
from probation.results.rendering import Plotted, Summarised
from probation.smoothing.excitation import excite
from probation.smoothing.methods import DEFAULT, SMOOTHERS
from probation.wording import percentage
from probation_studies.smoothing.known_histories import KNOWN_HISTORIES

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

NOISES = (2e-5, 1e-4, 3e-4, 1e-3)
"""Standard deviations of the strain noise [-]."""

DRAWS = 5
COMPARED = ("raw", *SMOOTHERS)
AIM = 0.005
"""Relative error of the rate that 95 % of the samples stay below, on "jump" at noise 2e-5."""

Key: TypeAlias = tuple[str, float, str]


@dataclass(frozen=True)
class Closeness:
    """How close one method comes on one history at one noise; means over the draws.

    Attributes
    ----------
    p95, median : float
        Relative error of the rate, |rate - truth| / |truth|, of the samples.
    coverage : float
        Fraction of samples whose true rate lies within 1.96 standard errors.
    """

    p95: float
    median: float
    coverage: float


@dataclass(frozen=True, eq=False)
class Comparison(Summarised, Plotted, Stored):
    """All methods on histories whose rate is known.

    `plot` draws the errors over the noise, one panel per history.

    Attributes
    ----------
    results : dict of (history, noise, method) to Closeness, or str
        A text says why a method does not apply.
    noises : tuple of float [-]
    methods : tuple of str
    draws : int
    seed : int
    """

    SCHEMA = "probation.excitation-comparison/1"
    RENDERERS: ClassVar = {
        "summary": "probation_studies.smoothing.summary.comparison_summary",
        "plot": "probation_studies.smoothing.figure.comparison_figure",
    }

    results: dict[Key, Closeness | str]
    noises: tuple[float, ...]
    methods: tuple[str, ...]
    draws: int
    seed: int

    @property
    def verdict(self) -> str:
        """How the default does on the case that has an aim, and on all."""
        own = [
            (key, result) for key, result in self.results.items() if key[2] == DEFAULT and isinstance(result, Closeness)
        ]
        if not own:
            return f"The default, {DEFAULT}, was not among the methods."
        first = min(self.noises)
        parts = []
        for key, each in own:
            if key[:2] == ("jump", first):
                met = "met" if each.p95 <= AIM else "missed"
                parts.append(
                    f"{percentage(each.p95)} % at a jump by ten with noise {first:g} (aim {100 * AIM:g} %: {met})"
                )
        worst_key, worst = max(own, key=lambda pair: pair[1].p95)
        parts.append(f"at most {percentage(worst.p95)} % ({worst_key[0]}, noise {worst_key[1]:g})")
        return f"Default {DEFAULT}: 95 % of the rates are within " + "; ".join(parts) + "."

    def errors_over_noise(self, history: str, method: str) -> tuple[list[float], list[float]]:
        """Noises [-] and p95 [%] where the method applies."""
        found = [(noise, self.results[history, noise, method]) for noise in self.noises]
        known = [(noise, 100.0 * closeness.p95) for noise, closeness in found if isinstance(closeness, Closeness)]
        return [noise for noise, _ in known], [error for _, error in known]

    def to_dict(self) -> dict[str, Any]:
        """The comparison as Python objects."""
        rows = []
        for (history, noise, method), result in self.results.items():
            row: dict[str, Any] = {"history": history, "strain_noise": noise, "method": method}
            if isinstance(result, str):
                row["not_applicable"] = result
            else:
                row |= {"p95": result.p95, "median": result.median, "coverage95": result.coverage}
            rows.append(row)
        return {"default": DEFAULT, "verdict": self.verdict, "draws": self.draws, "seed": self.seed, "results": rows}


def compare(
    histories: Sequence[str] | None = None,
    noises: Sequence[float] | None = None,
    methods: Sequence[str] | None = None,
    *,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Callable[[int, int, str], None] | None = None,
) -> Comparison:
    """Compare methods on histories whose rate is known; jumps are found, the noise level is estimated.

    Parameters
    ----------
    histories : sequence of str, optional
        Of `KNOWN_HISTORIES`; all if left out.
    noises : sequence of float [-], optional
        `NOISES` if left out.
    methods : sequence of str, optional
        `COMPARED` if left out.
    draws : int
        Draws of the white noise for each.
    seed : int
    progress : callable, optional
        Called with (done, total, what).
    """
    results: dict[Key, Closeness | str] = {}
    noises, methods = tuple(noises or NOISES), tuple(methods or COMPARED)
    cases = [
        (history, noise, method) for history in histories or KNOWN_HISTORIES for noise in noises for method in methods
    ]
    for done, key in enumerate(cases):
        if progress:
            progress(done, len(cases), f"{key[2]} on {key[0]}")
        results[key] = _closeness(key, draws, seed)
    return Comparison(results, noises, methods, draws, seed)


def _closeness(key: Key, draws: int, seed: int) -> Closeness | str:
    history, noise, method = key
    seen = []
    for draw in range(draws):
        # The same noise for every method.
        random = np.random.default_rng([seed, draw, list(KNOWN_HISTORIES).index(history)])
        known = KNOWN_HISTORIES[history][1](random)
        strain = known.true_strain + noise * random.normal(size=len(known.time))
        record = Record(history, known.time, strain, np.zeros_like(strain), control="displacement-rate")
        try:
            found = excite(record, method)
        except InputError as reason:
            return str(reason)
        off = np.abs(found.rate - known.strain_rate)
        relative = off / np.abs(known.strain_rate)
        seen.append((np.quantile(relative, 0.95), np.median(relative), np.mean(off < TWO_SIDED_95 * found.rate_se)))
    p95, median, coverage = np.mean(seen, axis=0).tolist()
    return Closeness(p95, median, coverage)
