"""Error and time as the step is halved, on a smooth history: the observed order of accuracy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.law.history import StrainHistory
from probation.law.ramp import ramp_stress
from probation.law.schemes import CVODE
from probation.schemes.candidates import CANDIDATES, StrainPath, solve
from probation.schemes.smooth import RampHistory

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from probation._arrays import FloatArray
    from probation.law.modal import Law
    from probation.schemes.smooth import SmoothHistory

_COARSEST, _HALVINGS = 125, 6
"""Steps of the coarsest grid over the whole history, and grids, each twice as fine as the one before."""
_AWAY_FROM_START = 1.0 / 3.0  # of the duration: an order is observed where the start is forgotten
_FLOOR = 2e-9  # MPa; below, round-off and the reference show


@dataclass(frozen=True, eq=False)
class StepStudy:
    """What halving the step does.

    Attributes
    ----------
    history : str
        The smooth history, for people.
    step : ndarray, shape (n_steps,) [s]
        Coarsest first, each half of the one before.
    largest_error_MPa : mapping of candidate to ndarray, shape (n_steps,) [MPa]
        Over the last two thirds of the history, away from the start; NaN where a scheme failed.
    time_us : mapping of candidate to ndarray, shape (n_steps,) [µs]
    order : mapping of candidate to float
        Observed at the finest pair of steps above round-off; NaN where there is none to observe.
    """

    history: str
    step: FloatArray
    largest_error_MPa: Mapping[str, FloatArray]  # noqa: N815 - the unit is part of the name, as in JSON
    time_us: Mapping[str, FloatArray]
    order: Mapping[str, float]


def study_steps(
    law: Law, history: SmoothHistory, name: str, advance: Callable[[str], None] = lambda what: None
) -> StepStudy:
    """Solve by every candidate on ever finer steps.

    Parameters
    ----------
    advance : callable
        Called with what is done next.
    """
    counts = [_COARSEST * 2**halving for halving in range(_HALVINGS)]
    reference = _reference(law, history, counts[-1])
    errors: dict[str, list[float]] = {}
    times: dict[str, list[float]] = {}
    for count in counts:
        advance(f"{name} in {count} steps")
        path = _path(history, count)
        late = slice(int(count * _AWAY_FROM_START), None)
        for candidate in CANDIDATES:
            done = solve(candidate, law, path)
            if done is None:
                continue
            error = np.nan
            if done.true_stress is not None:
                error = float(np.abs(done.true_stress - reference[:: counts[-1] // count])[late].max())
            errors.setdefault(candidate.name, []).append(error)
            times.setdefault(candidate.name, []).append(done.time_us)
    return StepStudy(
        history=name,
        step=history.duration / np.array(counts, dtype=np.float64),
        largest_error_MPa={each: np.array(values) for each, values in errors.items()},
        time_us={each: np.array(values) for each, values in times.items()},
        order={scheme: np.nan if scheme == "cvode" else observed_order(np.array(errors[scheme])) for scheme in errors},
    )


def observed_order(errors: FloatArray) -> float:
    """Order from errors at halved steps: the finest pair above round-off; NaN if there is none.

    >>> round(observed_order(np.array([4e-2, 1e-2, 2.5e-3])), 6)
    2.0
    """
    with np.errstate(invalid="ignore"):
        seen = np.flatnonzero((errors[1:] > _FLOOR) & (errors[:-1] > errors[1:]))
    return float(np.log2(errors[seen[-1]] / errors[seen[-1] + 1])) if seen.size else float("nan")


def _path(history: SmoothHistory, count: int) -> StrainPath:
    time = np.linspace(0.0, history.duration, count + 1)
    rate = history.rate if isinstance(history, RampHistory) else None
    return StrainPath(time, history.true_strain(time), history.strain_rate(time), rate, smooth=True)


def _reference(law: Law, history: SmoothHistory, count: int) -> FloatArray:
    """Eq. (7) where it holds, else CVODE at a tighter tolerance on twice as fine a grid with its rates."""
    path = _path(history, 2 * count)
    if path.ramp_rate is not None and law.companion is None:
        return ramp_stress(law, path.ramp_rate, path.time)[::2]
    fine = law.stress(
        StrainHistory(path.time, path.true_strain, strain_rate=path.strain_rate, jumps=None),
        scheme=CVODE(relative_tolerance=1e-12, absolute_tolerance=1e-12),
    )
    return fine[::2]
