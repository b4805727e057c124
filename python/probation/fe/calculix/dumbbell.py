"""A flat dumbbell: one eighth of it, in twenty-node bricks, finer towards the centre."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray

# Corners, then the middles of the edges, of a C3D20R in steps of half an element, in CalculiX' order.
_TWENTY = np.array(
    [
        *((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)),
        *((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2)),
        *((0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)),
    ]
)


@dataclass(frozen=True, kw_only=True)
class Dumbbell:
    """Geometry, mesh and loading; lengths in mm, x along, y across the width, z through the thickness.

    Parameters
    ----------
    half_gauge, half_width, half_thickness : float [mm]
        Of the straight part.
    shoulder : float [mm]
        Length over which the width rises, as half a wave of a cosine, to that of the head.
    half_head : float [mm]
        Half the width of the head, which the grip holds.
    imperfection : float [-]
        Fraction by which the width at the centre is smaller; it fades to none at the end of the straight part.
    elements : (int, int, int, int)
        Along the straight part, along the shoulder, across, through.
    nominal_rate : float [1/s]
        Grip speed over half gauge.
    largest_step : float [-]
        Largest increment of nominal strain.
    nominal_strain : float [-]
        Grip displacement over half gauge at the end.

    Raises
    ------
    InputError
        If one of them is not positive, or the imperfection not between 0 and 0.5.
    """

    half_gauge: float = 15.0
    half_width: float = 2.0
    half_thickness: float = 1.5
    shoulder: float = 8.0
    half_head: float = 4.0
    imperfection: float = 0.02
    elements: tuple[int, int, int, int] = (24, 4, 2, 2)
    nominal_rate: float = 1e-3
    largest_step: float = 0.01
    nominal_strain: float = 1.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if name not in {"elements", "imperfection"} and not value > 0.0:
                raise InputError(f"{name} is {value}; a positive number is needed")
        if not 0.0 <= self.imperfection < 0.5:
            raise InputError(f"imperfection is {self.imperfection}; a fraction of the width, below 0.5, is needed")
        if len(self.elements) != 4 or min(self.elements) < 1:
            raise InputError(f"elements is {self.elements}; four numbers, at least 1, are needed")

    @property
    def initial_area(self) -> float:
        """Of a quarter of the section, without imperfection [mm^2]."""
        return self.half_width * self.half_thickness

    def width_at(self, x: FloatArray) -> FloatArray:
        """Half the width there [mm]."""
        gauge = self.half_width * (1.0 - self.imperfection * np.cos(0.5 * np.pi * np.minimum(x / self.half_gauge, 1.0)))
        up = np.clip((x - self.half_gauge) / self.shoulder, 0.0, 1.0)
        head: FloatArray = (self.half_head - self.half_width) * 0.5 * (1.0 - np.cos(np.pi * up))
        return np.asarray(gauge + head)

    @cached_property
    def numbering(self) -> NDArray[np.int64]:
        """Node at (i, j, k) of a grid of half elements, counted from 1; 0 where a brick has none."""
        along, shoulder, across, through = self.elements
        shape = (2 * (along + shoulder) + 1, 2 * across + 1, 2 * through + 1)
        exists = sum(index % 2 for index in np.indices(shape)) <= 1
        numbers = np.zeros(shape, dtype=int)
        numbers[exists] = np.arange(1, exists.sum() + 1)
        return numbers

    @cached_property
    def points(self) -> FloatArray:
        """Where the nodes are, shape (nodes, 3) [mm]."""
        along, shoulder, across, through = self.elements
        x = np.concatenate(
            [
                self.half_gauge * np.linspace(0.0, 1.0, along + 1) ** 1.3,
                self.half_gauge + self.shoulder * np.linspace(0.0, 1.0, shoulder + 1)[1:],
            ]
        )
        x = np.interp(np.arange(2 * len(x) - 1) / 2.0, np.arange(len(x)), x)
        i, j, k = np.nonzero(self.numbering)
        return np.stack(
            [x[i], self.width_at(x[i]) * j / (2.0 * across), self.half_thickness * k / (2.0 * through)], axis=1
        )

    @cached_property
    def connectivity(self) -> NDArray[np.int64]:
        """Nodes of the bricks, shape (elements, 20)."""
        along, shoulder, across, through = self.elements
        first = 2 * np.stack(np.meshgrid(*map(np.arange, (along + shoulder, across, through)), indexing="ij"), axis=-1)
        i, j, k = np.moveaxis(first.reshape(-1, 1, 3) + _TWENTY, -1, 0)
        return np.asarray(self.numbering[i, j, k])

    def nodes_on(self, axis: int, *, last: bool = False) -> tuple[int, ...]:
        """Nodes on the plane of symmetry normal to an axis, or on the face opposite."""
        plane = np.take(self.numbering, -1 if last else 0, axis=axis)
        return tuple(int(node) for node in np.sort(plane[plane > 0]))
