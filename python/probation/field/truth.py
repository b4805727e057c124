"""How near maps are to what is true, where that is known."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.field.chunks import read
from probation.normal import TWO_SIDED_95

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from probation._arrays import FloatArray


@dataclass(frozen=True)
class Closeness:
    """Of one map to the truth, over the pixels that were identified.

    Attributes
    ----------
    bias : float
        Mean relative error [-].
    scatter : float
        Standard deviation of the relative error [-].
    spread : float
        Standard deviation of error over standard error [-]; 1 where the standard errors tell the truth.
    coverage : float
        Part of the pixels whose 95 % interval holds the truth [-].
    """

    name: str
    bias: float
    scatter: float
    spread: float
    coverage: float


def closeness(
    maps: Mapping[str, FloatArray], names: tuple[str, ...], good: NDArray[np.bool_], truth: str | os.PathLike[str]
) -> tuple[Closeness, ...]:
    """One for the product and for each parameter, in the order of the names; over the pixels that are good."""
    product, *parameters = names
    true = {name: read(str(Path(truth).absolute()), name) for name in parameters}
    for name, values in true.items():
        if values.dtype.kind not in "iuf":
            raise InputError(f"{truth}: {name}: found values of type {values.dtype}, expected numbers")
        if values.shape != good.shape:
            raise InputError(f"{truth}: {name}: found the shape {values.shape}, expected {good.shape}, as of the maps")
    true[product] = true[parameters[0]] * true[parameters[1]]
    found = []
    for name in names:
        if not good.any():
            break
        error = maps[name][good] - true[name][good]
        relative, standard = error / true[name][good], error / maps[f"{name}_standard_error"][good]
        found.append(
            Closeness(
                name,
                float(np.mean(relative)),
                float(np.std(relative)),
                float(np.std(standard)),
                float(np.mean(np.abs(standard) < TWO_SIDED_95)),
            )
        )
    return tuple(found)
