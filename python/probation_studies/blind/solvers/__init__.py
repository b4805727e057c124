"""Solvers by name: the package's own diagnosis, and baselines that a diagnosis has to be seen beside."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from probation.errors import InputError

Solver: TypeAlias = Callable[[Path], dict[str, object]]
"""From the folder of a campaign to an answer."""

BASELINES = {
    "nearest-signature": "probation_studies.blind.solvers.nearest_signature:nearest_signature",
    "bic-argmin": "probation_studies.blind.solvers.bic_argmin:bic_argmin",
    "score-screen": "probation_studies.blind.solvers.score_screen:score_screen",
}
"""Solvers whose answers are kept in baselines/NAME of a split and scored beside."""

NAMED = {
    "diagnose": "probation_studies.blind.solve:diagnosed",
    "no-gap": "probation_studies.blind.example:no_gap",
} | BASELINES


def solver_named(name: str) -> Solver:
    """The solver of that name, or ``module:function``.

    Raises
    ------
    InputError
        If there is none.
    """
    module, colon, function = NAMED.get(name, name).partition(":")
    try:
        found = getattr(importlib.import_module(module), function) if colon else None
    except (ImportError, AttributeError, ValueError) as failure:
        raise InputError(f"solver: found {name!r}, which cannot be loaded: {failure}") from None
    if not callable(found):
        expected = f"{', '.join(NAMED)} or MODULE:FUNCTION, from a campaign's folder to an answer"
        raise InputError(f"solver: found {name!r}, expected {expected}")
    return found  # type: ignore[no-any-return]
