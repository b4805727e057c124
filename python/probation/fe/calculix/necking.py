"""The dumbbell pulled at constant grip speed: its force, and how its centre and its face stretch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.exporting.constants import MaterialConstants
from probation.fe.calculix import deck
from probation.fe.calculix.program import run
from probation.fe.neck_figures import neck_figures
from probation.fe.point import MaterialPoint

if TYPE_CHECKING:
    from pathlib import Path

    from probation._arrays import FloatArray
    from probation.fe.calculix.dumbbell import Dumbbell
    from probation.fe.calculix.printed import Printed
    from probation.law.modal import Law


@dataclass(frozen=True, eq=False)
class NeckingRun:
    """What the run recorded; arrays of shape (increments,) unless stated.

    Attributes
    ----------
    time : ndarray [s]
    nominal_strain, nominal_stress : ndarray [-], [MPa]
        Grip displacement over half gauge, force over initial area (that of the bar without imperfection).
    centre_strain : ndarray [-]
        ln(initial / current section) of the centre, from its width and its thickness.
    centre_rate : ndarray [1/s]
        Over each increment.
    face : ndarray, shape (increments, along, across, 4, 2) [mm]
        Corners of the elements' faces on the broad side, x and y.
    face_strain : ndarray, shape (increments, along, across) [-]
        True strain along the specimen in the middle of these.
    """

    time: FloatArray
    nominal_strain: FloatArray
    nominal_stress: FloatArray
    centre_strain: FloatArray
    centre_rate: FloatArray
    face: FloatArray
    face_strain: FloatArray

    @property
    def top(self) -> int:
        """Increment of the largest force."""
        return int(np.argmax(self.nominal_stress))

    @property
    def fastest(self) -> int:
        """Increment in which the centre is fastest, from the largest force on."""
        return self.top + int(np.argmax(self.centre_rate[self.top :]))

    def face_rate(self, at: int) -> FloatArray:
        """Rate of `face_strain` over that increment, not the first, shape (along, across) [1/s]."""
        return np.asarray(np.diff(self.face_strain[at - 1 : at + 1], axis=0)[0] / np.diff(self.time[at - 1 : at + 1]))

    def figures(self) -> dict[str, float]:
        """The numbers that tell a neck: the force maximum, the plateau, the largest rate over the smallest before."""
        return neck_figures(
            self.nominal_strain, self.nominal_stress, self.centre_strain, self.centre_rate, self.top, self.fastest
        )


def neck_deck(law: Law, dumbbell: Dumbbell, bulk_modulus: float, rate_filter: float = 0.0) -> str:
    """The deck of the dumbbell; symmetry on three planes, the head held and moved at constant speed."""
    length = dumbbell.nominal_strain / dumbbell.nominal_rate
    largest = dumbbell.largest_step / dumbbell.nominal_rate
    times = ",".join(map(deck.number, (largest / 50.0, length, largest * 1e-6, largest)))
    point = MaterialPoint.from_law(law, bulk_modulus, rate_filter=rate_filter)
    planes = {"CENTRE": 0, "MIDWIDTH": 1, "MIDTHICKNESS": 2}
    return deck.deck(
        deck.nodes(dumbbell.points),
        deck.elements("C3D20R", dumbbell.connectivity.tolist()),
        *(deck.node_set(name, dumbbell.nodes_on(axis)) for name, axis in planes.items()),
        deck.node_set("GRIP", dumbbell.nodes_on(0, last=True)),
        deck.node_set("FACE", dumbbell.nodes_on(2, last=True)),
        deck.node_set("SECTION", _section(dumbbell)),
        deck.fixed([*((name, axis + 1) for name, axis in planes.items()), ("GRIP", 2), ("GRIP", 3)]),
        deck.material(MaterialConstants.of(law, bulk_modulus, rate_filter), point.state_size),
        deck.step(
            f"*STATIC\n{times}",
            {("GRIP", 1): (dumbbell.nominal_strain * dumbbell.half_gauge, "")},
            [deck.printing("U", "FACE"), deck.printing("U", "SECTION"), deck.printing("RF", "GRIP", total=True)],
        ),
    )


def neck(
    ccx: Path,
    law: Law,
    folder: Path,
    dumbbell: Dumbbell,
    *,
    bulk_modulus: float = 2e4,
    rate_filter: float = 0.0,
    threads: int = 1,
) -> NeckingRun:
    """Pull the dumbbell.

    Parameters
    ----------
    folder : Path
        Where the files of the run go.
    bulk_modulus : float [MPa]
    rate_filter : float [-]

    Raises
    ------
    InputError
        As `probation.fe.calculix.run` does; also where no increment, however small, finds an equilibrium.
    """
    printed = run(ccx, neck_deck(law, dumbbell, bulk_modulus, rate_filter), folder, threads=threads)
    section = dumbbell.points[np.array(_section(dumbbell)) - 1]
    moved = _ordered(printed["displacements", "SECTION"], _section(dumbbell))
    width, thickness = (moved[:, at, at + 1] / section[at, at + 1] for at in range(2))
    force = printed["total force", "GRIP"]
    time = np.concatenate([[0.0], force.time])
    strain = np.concatenate([[0.0], -np.log1p(width) - np.log1p(thickness)])
    face = _Face(dumbbell, printed["displacements", "FACE"])
    return NeckingRun(
        time=time[1:],
        nominal_strain=dumbbell.nominal_rate * time[1:],
        nominal_stress=force.values[:, 0, 0] / dumbbell.initial_area,
        centre_strain=strain[1:],
        centre_rate=np.diff(strain) / np.diff(time),
        face=face.corners,
        face_strain=face.strain,
    )


def _section(dumbbell: Dumbbell) -> tuple[int, int]:
    """The two nodes of the centre that tell its width and its thickness."""
    return int(dumbbell.numbering[0, -1, 0]), int(dumbbell.numbering[0, 0, -1])


def _ordered(printed: Printed, nodes: tuple[int, ...]) -> FloatArray:
    """The values of these nodes, in this order."""
    return printed.values[:, [printed.nodes.index(node) for node in nodes]]


class _Face:
    """The broad side of the dumbbell, element by element."""

    def __init__(self, dumbbell: Dumbbell, printed: Printed) -> None:
        numbers = dumbbell.numbering[:, :, -1]
        place = np.full((int(numbers.max()) + 1, 2), np.nan)
        nodes = np.array(printed.nodes)
        place[nodes] = dumbbell.points[nodes - 1, :2]
        moved = np.repeat(place[None], len(printed.time), axis=0)
        moved[:, nodes] += printed.values[:, :, :2]
        grid = moved[:, numbers]  # (increments, 2 along + 1, 2 across + 1, 2)
        self.corners = np.stack(
            [grid[:, :-1:2, :-1:2], grid[:, 2::2, :-1:2], grid[:, 2::2, 2::2], grid[:, :-1:2, 2::2]], axis=3
        )
        # In the middle of an eight-node face only the middles of the edges have a slope.
        initial = place[numbers]
        now, then = (each[..., 2::2, 1::2, 0] - each[..., :-1:2, 1::2, 0] for each in (grid, initial))
        self.strain = np.log(now / then)
