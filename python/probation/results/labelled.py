"""A matrix whose rows and columns have names."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.errors import InputError
from probation.results.extras import needed

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def _nothing() -> FloatArray:
    return np.zeros((0, 0))


@dataclass(frozen=True, eq=False)
class LabelledMatrix:
    """A square matrix by names, such as a covariance; numpy takes it as an array.

    Attributes
    ----------
    names : tuple of str
        Of rows and columns, with units: "unrelaxed_modulus_MPa".
    matrix : ndarray, shape (n, n)
    """

    names: tuple[str, ...] = ()
    matrix: FloatArray = field(default_factory=_nothing)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return np.array(self.matrix, dtype=dtype) if copy or dtype else self.matrix

    def __getitem__(self, pair: tuple[str, str]) -> float:
        """The entry of a row and a column, by their names.

        Raises
        ------
        InputError
            For a name that is not there.
        """
        for name in pair:
            if name not in self.names:
                raise InputError(f"covariance: found no {name!r}, expected one of {', '.join(self.names)}")
        return float(self.matrix[self.names.index(pair[0]), self.names.index(pair[1])])

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        rows = (
            "  ".join([f"{name:<24}", *(f"{value:>12.5g}" for value in row)])
            for name, row in zip(self.names, self.matrix, strict=True)
        )
        return "\n".join(rows)

    def to_dict(self) -> dict[str, Any]:
        """`names` and `matrix`, as in JSON."""
        return {"names": list(self.names), "matrix": self.matrix}

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame with named rows and columns.

        Raises
        ------
        InputError
            Where pandas is not installed.
        """
        return needed("pandas", "to_dataframe").DataFrame(self.matrix, index=self.names, columns=self.names)

    def to_xarray(self) -> Any:
        """As an xarray DataArray with the dimensions "parameter" and "other_parameter".

        Raises
        ------
        InputError
            Where xarray is not installed.
        """
        names = list(self.names)
        return needed("xarray", "to_xarray").DataArray(
            self.matrix, coords=[("parameter", names), ("other_parameter", names)], name="covariance"
        )
