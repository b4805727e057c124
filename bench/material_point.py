"""What does one update of the three-dimensional material point cost with fewer modes, with and without the tangent?

Through the C interface, first Piola-Kirchhoff stress and dP/dF, many points a call so that Python hardly counts. The
error is that of P against 50 modes along one path, over the largest P.
"""

from collections.abc import Callable

import numpy as np

from bench import cases
from bench.fewer_modes import WHOLE, laws_by_modes
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.spectrum import Array
from bench.timing import take_turns
from probation import Law
from probation.fe import MaterialPoint

POINTS = 200
"""A call; with 50 modes their states fill a megabyte, before and after the increment."""

BULK_MODULUS = 1e5  # MPa

WITH = {False: "stress", True: "stress and tangent"}


def run(found: Findings, progress: Progress, quick: bool) -> None:
    """tau_max by rate: every update forms its coefficients anew, as in a finite-element run."""
    case = "material point in three dimensions"
    progress(f"fewer modes: {case}")
    laws = laws_by_modes(engine.law_of(cases.grips()))
    reference = _path(laws[str(WHOLE)][1])
    errors = {key: float(np.abs(_path(law) - reference).max()) for key, (_, law) in laws.items()}
    for tangent, label in WITH.items():
        timings = take_turns({key: _call(law, tangent) for key, (_, law) in laws.items()}, 5 if quick else 15)
        for key, (words, _) in laws.items():
            one = timings[key]
            note = f"{1e6 * one.median / POINTS:.3g} us an update"
            relative = f"{errors[key] / np.abs(reference).max():.1e} of the largest"
            method = f"point_{'tangent' if tangent else 'stress'}_{key}"
            entry = row("fewer modes", case, method, f"{label}, {words}", one, {}, errors[key], f"{note}, {relative}")
            entry.ratios["whole"] = one.over(timings[str(WHOLE)])
            found.rows.append(entry)


def _call(law: Law, tangent: bool) -> Callable[[], object]:
    """One increment of points that have flowed, each a little further than the last."""
    point = MaterialPoint.from_law(law, BULK_MODULUS)
    stretch = np.linspace(0.0, 0.3, POINTS)
    before = point.first_piola(_gradient(stretch, 0.1 * stretch), 100.0, with_tangent=False)[2]
    after = _gradient(stretch + 1e-3, 0.1 * stretch + 1e-3)
    return lambda: point.first_piola(after, 1.0, before, with_tangent=tangent)


def _path(law: Law) -> Array:
    """P along tension with shear, ten times faster from half-way, then unloading; shape (increments, 3, 3) [MPa]."""
    point = MaterialPoint.from_law(law, BULK_MODULUS)
    strain = np.concatenate([np.linspace(0.0, 0.6, 121)[1:], np.linspace(0.6, 0.55, 21)[1:]])
    lengths = np.concatenate([np.full(60, 5.0), np.full(80, 0.5)])
    state, stresses = None, []
    for gradient, dt in zip(_gradient(strain, 0.3 * strain), lengths, strict=True):
        stress, _, state = point.first_piola(gradient[None], float(dt), state, with_tangent=False)
        stresses.append(stress[0])
    return np.array(stresses)


def _gradient(strain: Array, shear: Array) -> Array:
    """F of incompressible tension after a simple shear, shape (points, 3, 3)."""
    gradient = np.zeros((len(strain), 3, 3))
    gradient[:, 0, 0] = np.exp(strain)
    gradient[:, 1, 1] = gradient[:, 2, 2] = np.exp(-0.5 * strain)
    gradient[:, 0, 1] = np.exp(strain) * shear
    return gradient
