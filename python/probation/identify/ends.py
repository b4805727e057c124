"""Parameters that a search left at an end of their range: their value is the range's, and no error belongs to it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from probation.identify.search import search_range
from probation.identify.variable_projection import project
from probation.inference.parameter import SYMBOLS, UNITS
from probation.settings.certificate import CERTIFICATE
from probation.settings.identification import IDENTIFICATION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem


@dataclass(frozen=True)
class Ends:
    """What cannot be said of the parameters because a search stopped at an end.

    Attributes
    ----------
    withdrawn : frozenset of str
        Parameters without status, standard error and interval: those at an end, and those whose value follows a
        tau_max (or alpha) that the records do not bound.
    product : bool
        Whether the same holds for E_u tau_max (or E_u alpha).
    warnings : tuple of str
    """

    withdrawn: frozenset[str] = field(default_factory=frozenset)
    product: bool = False
    warnings: tuple[str, ...] = ()


def ends_of(problem: Problem, parameters: FloatArray, limits: Mapping[str, tuple[float, float]]) -> Ends:
    """Where the search of a fit ended, and what that leaves unknown.

    Parameters
    ----------
    parameters : ndarray, shape (free,)
        The best ones.
    limits : mapping of str to (float, float)
        Bounds that were asked for; (0, inf) otherwise.
    """
    law, free = problem.law_at(parameters), problem.engine_law().free
    names, values = law.parameter_names, law.parameters
    withdrawn: set[str] = set()
    warnings = []
    for index in free:
        name, value = names[index], float(values[index])
        low, high = limits[name]
        if value <= low * (1.0 + 1e-6) or value >= high * (1.0 - 1e-6):
            withdrawn.add(name)
            warnings.append(f"{SYMBOLS[name]} ended at its bound, {_with_unit(value, name, 6)}")
    ended = not withdrawn.isdisjoint(names[:2])
    if 1 not in free or names[1] in withdrawn:
        return Ends(frozenset(withdrawn), ended, tuple(warnings))
    low, high = search_range(problem, limits)
    value = float(values[1])
    end = "lower" if value <= low * IDENTIFICATION.edge else "upper" if value >= high / IDENTIFICATION.edge else ""
    if not end:
        return Ends(frozenset(withdrawn), ended, tuple(warnings))
    moved_to = value / IDENTIFICATION.beyond_edge if end == "lower" else value * IDENTIFICATION.beyond_edge
    beyond = problem.law_at(project(problem.frozen_at(parameters), moved_to)[0]).parameters
    moved = np.abs(beyond - values) > CERTIFICATE.identifiable * np.abs(values)
    product = abs(beyond[0] * beyond[1] - values[0] * value) > CERTIFICATE.identifiable * abs(values[0] * value)
    warnings.append(
        f"{SYMBOLS[names[1]]}: the search ended at the {end} edge of its range, {value:.3g} of {low:.3g} to "
        f"{_with_unit(high, names[1], 3)}; these records do not bound it"
    )
    withdrawn.update(names[index] for index in free if moved[index])
    return Ends(frozenset(withdrawn), ended or bool(product), tuple(warnings))


def _with_unit(value: float, name: str, digits: int) -> str:
    return f"{value:.{digits}g} {UNITS[name]}".rstrip()
