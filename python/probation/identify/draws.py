"""Draws of the parameters from their posterior, or from its Laplace approximation."""

from __future__ import annotations

from dataclasses import dataclass
from inspect import signature
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from probation.errors import InputError
from probation.results.data import Stored
from probation.results.extras import needed

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.results.labelled import LabelledMatrix

Method = Literal["laplace", "emcee"]
METHODS: tuple[Method, ...] = ("laplace", "emcee")

MOST_REDRAWS = 100
"""Times that draws below zero are drawn again before it is given up."""


@dataclass(frozen=True, eq=False)
class Draws(Stored):
    """Draws of the identified parameters.

    Attributes
    ----------
    names : tuple of str
        With units: "unrelaxed_modulus_MPa".
    values : ndarray, shape (n_draws, n_parameters)
    """

    SCHEMA: ClassVar[str] = "probation.draws/1"

    names: tuple[str, ...]
    values: FloatArray

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, name: str) -> FloatArray:
        """The draws of one parameter, shape (n_draws,).

        Raises
        ------
        InputError
            For a name that is not there.
        """
        if name not in self.names:
            raise InputError(f"draws: found no {name!r}, expected one of {', '.join(self.names)}")
        return np.asarray(self.values[:, self.names.index(name)])

    def __repr__(self) -> str:
        return f"<{len(self)} draws of {', '.join(self.names)}>"

    def to_dict(self) -> dict[str, Any]:
        """The draws of each parameter, as Python objects."""
        return {"draws": {name: self[name] for name in self.names}}

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame, a row a draw.

        Raises
        ------
        InputError
            Where pandas is not installed.
        """
        return needed("pandas", "to_dataframe").DataFrame(self.values, columns=self.names)

    def to_arviz(self) -> Any:
        """As ArviZ takes them, in one chain: `arviz.plot_pair(draws.to_arviz())`.

        Raises
        ------
        InputError
            Where arviz is not installed.
        """
        arviz = needed("arviz", "to_arviz")
        posterior = {name: self[name][None] for name in self.names}
        if "posterior" in signature(arviz.from_dict).parameters:  # arviz before 1.0
            return arviz.from_dict(posterior=posterior)
        return arviz.from_dict({"posterior": posterior})


def normal_draws(centre: FloatArray, covariance: LabelledMatrix, count: int, random: np.random.Generator) -> FloatArray:
    """From a normal distribution around the estimates, without what is negative; shape (count, n_parameters)."""
    matrix = covariance.matrix
    if not np.all(np.isfinite(matrix)):
        lost = [name for name, value in zip(covariance.names, np.diag(matrix), strict=True) if not value < np.inf]
        raise InputError(f"sample: found no standard error of {', '.join(lost)}, expected one; hold it, or add records")
    size = np.where(centre != 0.0, np.abs(centre), 1.0)
    spread, basis = np.linalg.eigh(matrix / np.outer(size, size))
    root = size[:, None] * basis * np.sqrt(np.maximum(spread, 0.0))
    values = np.empty((0, len(centre)))
    for _ in range(MOST_REDRAWS):
        drawn = centre + random.standard_normal((count - len(values), len(centre))) @ root.T
        values = np.concatenate([values, drawn[np.all(drawn >= 0.0, axis=1)]])
        if len(values) == count:
            return values
    raise InputError("sample: found almost no draw with positive parameters; the records hardly determine them")
