"""One element in CalculiX against the law in one dimension: pulled and let go, and pulled and turned."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from probation.exporting.constants import MaterialConstants
from probation.fe.calculix import deck
from probation.fe.calculix.one_dimension import pull_bar
from probation.fe.calculix.program import run
from probation.fe.point import MaterialPoint

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from probation._arrays import FloatArray
    from probation.fe.calculix.deck import Degree
    from probation.law.modal import Law

LOADING = ((0.004, 4.0),) * 25 + ((0.006, 0.6),) * 20
"""A ramp, then a rate ten times higher: increments of true strain [-], and of time [s]."""
UNLOADING = ((-0.002, 2.0),) * 10
STRETCH, TURN = ((0.01, 2.0),) * 10, ((0.0, 2.0),) * 10
"""The second is a hold, while the element turns by a right angle."""

CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float
)
"""Of a C3D8 of 1 mm, in CalculiX' order."""

TIGHT = "*CONTROLS, PARAMETERS=FIELD\n1e-8,1e-8,,,1e-8"
"""Relative residual force, correction, and residual force after many iterations; by default 0.005, 0.01, 0.02."""


@dataclass(frozen=True)
class Comparison:
    """One number against its limit.

    Attributes
    ----------
    name : str
    found : float [-]
        Largest difference over the largest value.
    limit : float or None
        None: a property of the law or of K, not a fault.
    """

    name: str
    found: float
    limit: float | None

    @property
    def holds(self) -> bool:
        """Whether the limit is kept."""
        return self.limit is None or self.found <= self.limit


def stretch_element(ccx: Path, law: Law, folder: Path, bulk_modulus: float = 1e6) -> tuple[Comparison, ...]:
    """Pull one C3D8 with a rate jump and let it go; its reaction against the law in one dimension.

    Parameters
    ----------
    folder : Path
        Where the files of the run go.
    bulk_modulus : float
        K [MPa]. The element changes its volume and the one-dimensional law does not: the difference falls as 1/K, and
        what is left against a bar that changes its volume, too, is what ccx prints and where it stops to iterate.

    Returns
    -------
    tuple of Comparison
        Without the volume change on loading (limit 1e-4 at K = 1e6) and on unloading, with it on both (1e-6).

    Raises
    ------
    InputError
        As `probation.fe.calculix.run` does.
    """
    increments = (*LOADING, *UNLOADING)
    strain = np.cumsum([rise for rise, _ in increments])
    pulled = np.flatnonzero(CORNERS[:, 0] == 1.0) + 1
    blocks = [deck.node_set("PULLED", pulled), deck.fixed(_resting(0, 1, 2))]
    moved: dict[Degree, FloatArray] = {("PULLED", 1): np.expm1(strain)}
    reaction = _run(ccx, folder, law, bulk_modulus, blocks, increments, moved)[:, pulled - 1, 0].sum(axis=1)
    found = reaction * np.exp(strain)
    point = MaterialPoint.from_law(law, bulk_modulus)
    comparisons = []
    for name, k, limit in (
        ("1D", np.inf, 1e-4 * 1e6 / bulk_modulus),
        ("1D with the volume change of K", bulk_modulus, 1e-6),
    ):
        expected = pull_bar(point, increments, k).kirchhoff_stress
        difference = np.abs(found - expected) / np.abs(expected).max()
        on_unloading = None if np.isinf(k) else limit
        comparisons += [
            Comparison(f"reaction against {name}, loading", float(difference[: len(LOADING)].max()), limit),
            Comparison(f"reaction against {name}, unloading", float(difference[len(LOADING) :].max()), on_unloading),
        ]
    return tuple(comparisons)


def turn_element(ccx: Path, law: Law, folder: Path, bulk_modulus: float = 2e4) -> tuple[Comparison, ...]:
    """Pull one C3D8, turn it by a right angle about its third axis, and do the same without turning.

    Its nodes move as those of a bar do that is free to contract; along the third axis they find that themselves.

    Parameters
    ----------
    ccx, law, folder, bulk_modulus
        As of `stretch_element`.

    Returns
    -------
    tuple of Comparison
        Nodal forces, turned back, against those of the element that was not turned; the force along the turned bar
        against the law in one dimension with the volume change of K; the force across it, which is none.

    Raises
    ------
    InputError
        As `probation.fe.calculix.run` does.
    """
    increments = (*STRETCH, *TURN)
    strain = np.cumsum([rise for rise, _ in increments])
    bar = pull_bar(MaterialPoint.from_law(law, bulk_modulus), increments, bulk_modulus)
    stretch = np.exp([strain, 0.5 * (bar.log_volume - strain)])
    turned_by = np.concatenate([np.zeros(len(STRETCH)), np.linspace(0.0, np.pi / 2, len(TURN) + 1)[1:]])
    forces = []
    for name, angle in (("turned", turned_by), ("straight", np.zeros_like(turned_by))):
        rotation = _rotation(angle)
        moved: dict[Degree, FloatArray] = {}
        for node, corner in enumerate(CORNERS, start=1):
            place = np.einsum("iab,bi->ia", rotation[:, :2, :2], stretch * corner[:2, None])
            for axis in range(2):
                moved[node, axis + 1] = place[:, axis] - corner[axis]
        found = _run(ccx, folder / name, law, bulk_modulus, [deck.fixed(_resting(2))], increments, moved)
        forces.append(np.einsum("iba,inb->ina", rotation, found))
    end = forces[0][:, CORNERS[:, 0] == 1.0].sum(axis=1)
    side = forces[0][:, CORNERS[:, 1] == 1.0].sum(axis=1)[:, 1]
    expected = bar.kirchhoff_stress / stretch[0]
    differences = (
        ("nodal forces against the unturned element", forces[0] - forces[1], forces[1]),
        ("force along the turned bar against 1D", end[:, 0] - expected, expected),
        ("force across the turned bar", side, expected),
    )
    return tuple(
        Comparison(name, float(np.abs(difference).max() / np.abs(scale).max()), 1e-6)
        for name, difference, scale in differences
    )


def _resting(*axes: int) -> list[tuple[int, int]]:
    """Nodes on the coordinate plane across each of these axes and the direction, 1 to 3, that they do not move in."""
    return [(int(node), axis + 1) for axis in axes for node in np.flatnonzero(CORNERS[:, axis] == 0.0) + 1]


def _rotation(angle: FloatArray) -> FloatArray:
    """About the third axis, shape (increments, 3, 3)."""
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.moveaxis(np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]]), -1, 0)


def _run(
    ccx: Path,
    folder: Path,
    law: Law,
    bulk_modulus: float,
    blocks: Sequence[str],
    increments: Sequence[tuple[float, float]],
    moved: Mapping[Degree, FloatArray],
) -> FloatArray:
    """Nodal forces after every increment, shape (increments, 8, 3) [N], of displacements prescribed after each."""
    constants = MaterialConstants.of(law, bulk_modulus)
    time = np.concatenate([[0.0], np.cumsum([dt for _, dt in increments])])
    names = {key: f"MOVE{at}" for at, key in enumerate(moved, start=1)}
    steps = []
    for dt, same in groupby(dt for _, dt in increments):
        length = dt * len(list(same))
        steps.append(
            deck.step(
                f"*STATIC, DIRECT\n{deck.number(dt)},{deck.number(length)}",
                {key: (1.0, name) for key, name in names.items()},
                [deck.printing("RF", "ALL")],
                controls=TIGHT,
            )
        )
    text = deck.deck(
        deck.nodes(CORNERS),
        deck.elements("C3D8", [range(1, 9)]),
        *blocks,
        deck.material(constants, MaterialPoint.from_law(law, bulk_modulus).state_size),
        *(deck.amplitude(names[key], time, np.concatenate([[0.0], values])) for key, values in moved.items()),
        *steps,
    )
    return run(ccx, text, folder)["forces", "ALL"].values
