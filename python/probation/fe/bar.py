"""A round bar between grips, in felupe: geometry, mesh, one increment of it, and what can be measured on it.

One quarter of the meridian (symmetry at the centre), eight-node quadrilaterals with 2 x 2 points, the section at the
centre smaller by a chosen fraction. The grip end keeps its radius.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.errors import InputError
from probation.fe.felupe import felupe_material
from probation.fe.point import CutStep

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.fe.point import MaterialPoint

_RATE, _EQUIVALENT_STRAIN, _VOLUME_CHANGE = 0, 2, 3
"""Places in the state of a point."""


@dataclass(frozen=True, kw_only=True)
class Bar:
    """Geometry, mesh and loading.

    Parameters
    ----------
    half_length, radius : float [mm]
    imperfection : float [-]
        Fraction by which the section at the centre is smaller.
    elements : (int, int)
        Along and across.
    nominal_rate : float [1/s]
        Grip speed over half length.
    largest_step : float [-]
        Largest increment of nominal strain.
    largest_centre_step : float [-]
        Increment of the centre's true strain that is aimed at where the former would make a longer one.
    centre_strain : float [-]
        True strain of the centre section at which to stop.

    Raises
    ------
    InputError
        Naming what is no bar.
    """

    half_length: float = 15.0
    radius: float = 2.0
    imperfection: float = 0.02
    elements: tuple[int, int] = (24, 2)
    nominal_rate: float = 1e-3
    largest_step: float = 0.01
    largest_centre_step: float = 0.2
    centre_strain: float = 1.8

    def __post_init__(self) -> None:
        for name in ("half_length", "radius", "nominal_rate", "largest_step", "largest_centre_step", "centre_strain"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0.0):
                raise InputError(f"{name} is {value}; a positive number is needed")
        if not 0.0 <= self.imperfection < 1.0:
            raise InputError(f"imperfection is {self.imperfection}; a fraction from 0 to below 1 is needed")
        if min(self.elements) < 1:
            raise InputError(f"elements are {self.elements}; at least one along and one across are needed")

    @property
    def centre_radius(self) -> float:
        """Radius of the undeformed centre section [mm]."""
        return self.radius * (1.0 - 0.5 * self.imperfection)


@dataclass(frozen=True)
class Centre:
    """The section at the centre at one instant.

    Attributes
    ----------
    radius : float [mm]
    surface_stretch : float [-]
        Of a line along the bar on the surface.
    curvature : float [1/mm]
        Of the outline; positive in a neck.
    axis_axial_stress, axis_mean_stress, axis_equivalent_stress : float [MPa]
        Cauchy stress along the bar, its mean (a third of its trace) and von Mises' at the point nearest to the axis.
    axis_volume_change : float [-]
        J - 1 there.
    """

    radius: float
    surface_stretch: float
    curvature: float
    axis_axial_stress: float
    axis_mean_stress: float
    axis_equivalent_stress: float
    axis_volume_change: float


@dataclass(frozen=True, eq=False)
class Snapshot:
    """The deformed mesh at one instant.

    Attributes
    ----------
    time : float [s]
    outlines : ndarray, shape (cells, 8, 2) [mm]
        Position along the bar and radius of each element's nodes, around it.
    strain, rate : ndarray, shape (cells,) [-], [1/s]
        Equivalent strain and its rate, means over the points of an element.
    """

    time: float
    outlines: FloatArray
    strain: FloatArray
    rate: FloatArray


class BarModel:
    """The bar in felupe.

    Raises
    ------
    InputError
        If felupe is not installed.
    """

    def __init__(self, point: MaterialPoint, bar: Bar) -> None:
        try:
            import felupe  # noqa: PLC0415 -- an extra
        except ModuleNotFoundError:
            raise InputError("felupe is not installed; pip install 'probation[fe]' brings it") from None

        self.felupe = felupe
        along, across = bar.elements
        # Finer towards the centre, where the neck is.
        mesh = felupe.Rectangle(b=(1.0, 1.0), n=(along + 1, across + 1)).add_midpoints_edges()
        u = mesh.points[:, 0] ** 1.3
        v = mesh.points[:, 1].copy()
        dent = 1.0 - 0.5 * bar.imperfection * np.cos(0.5 * np.pi * u)
        mesh.points[:] = np.stack([bar.half_length * u, bar.radius * dent * v], axis=1)
        region = felupe.RegionQuadraticQuad(mesh, quadrature=felupe.GaussLegendre(order=1, dim=2))
        field = felupe.FieldAxisymmetric(region, dim=2)
        self.field = felupe.FieldContainer([field])
        self.solid = felupe.SolidBody(felupe_material(point, 1.0), self.field)
        surface = np.flatnonzero(v == 1.0)
        self.surface = surface[np.argsort(u[surface])]
        self.end = u == 1.0
        boundary = felupe.Boundary
        self.boundaries = {
            "centre": boundary(field, fx=0.0, skip=(0, 1)),
            "axis": boundary(field, fy=0.0, skip=(1, 0)),
            "grip": boundary(field, fx=bar.half_length, skip=(1, 0)),
            "move": boundary(field, fx=bar.half_length, skip=(0, 1)),
        }
        self.points: FloatArray = mesh.points
        self.cells = mesh.cells
        self.velocity = np.zeros_like(mesh.points)
        middle = np.mean(mesh.points[self.cells], axis=1)
        self.axis_cell = int(np.argmin(np.sum(middle**2, axis=1)))

    def advance(self, displacement: float, dt: float) -> float | None:
        """Force [N] at a displacement of the grip; None, and everything as before, where there is no equilibrium."""
        before, start = self.solid.checkpoint(), self.field[0].values.copy()
        self.solid.umat.kwargs["dt"] = dt
        self.field[0].values[:] += self.velocity * dt  # or the first iteration puts all of it beside the grip
        self.boundaries["move"].update(displacement)
        dof0, dof1 = self.felupe.dof.partition(self.field, self.boundaries)
        ext0 = self.felupe.dof.apply(self.field, self.boundaries, dof0)
        try:
            self.felupe.newtonraphson(
                items=[self.solid], dof0=dof0, dof1=dof1, ext0=ext0, tol=1e-6, maxiter=12, verbose=0
            )
        except (CutStep, RuntimeError, ValueError, FloatingPointError):
            self.solid.umat.kwargs["dt"] = 1e-3
            self.solid.restore(before)
            return None
        self.velocity = (self.field[0].values - start) / dt
        # felupe integrates over the circumference.
        return float(self.solid.results.force.toarray().reshape(-1, 2)[self.end, 0].sum())

    @property
    def position(self) -> FloatArray:
        """Of the nodes, along the bar and across, shape (nodes, 2) [mm]."""
        displacement: FloatArray = self.field[0].values
        return self.points + displacement

    def outline(self) -> FloatArray:
        """Position along the bar and radius of the surface, shape (2, nodes) [mm]."""
        return self.position[self.surface].T

    def centre(self) -> Centre:
        """What the centre section is like now."""
        x, r = self.outline()[:, :3]
        initial = self.points[self.surface[1:3], 0]
        # By symmetry r = a + b x^2 + c x^4 and x = s X + k X^3, through the nodes of the first element.
        b = np.linalg.solve(np.stack([x[1:] ** 2, x[1:] ** 4], axis=1), r[1:] - r[0])[0]
        s = np.linalg.solve(np.stack([initial, initial**3], axis=1), x[1:])[0]
        stress = self._axis_stress()
        deviator = stress - np.trace(stress) / 3.0 * np.eye(3)
        return Centre(
            radius=float(r[0]),
            surface_stretch=float(s),
            curvature=float(2.0 * b),
            axis_axial_stress=float(stress[0, 0]),
            axis_mean_stress=float(np.trace(stress) / 3.0),
            axis_equivalent_stress=float(np.sqrt(1.5 * np.sum(deviator**2))),
            axis_volume_change=float(self._state(_VOLUME_CHANGE)[:, self.axis_cell].mean()),
        )

    def snapshot(self, time: float) -> Snapshot:
        """The deformed mesh now."""
        around = self.cells[:, [0, 4, 1, 5, 2, 6, 3, 7]]
        strain, rate = (self._state(place).mean(axis=0) for place in (_EQUIVALENT_STRAIN, _RATE))
        return Snapshot(time, self.position[around], strain, rate)

    def _state(self, place: int) -> FloatArray:
        """One state variable, shape (points, cells)."""
        values: Any = self.solid.results.statevars
        return np.asarray(values[place])

    def _axis_stress(self) -> FloatArray:
        """Cauchy stress, of the points of the cell at axis and centre the one nearest to both."""
        gradient = self.solid.results.kinematics[0][..., self.axis_cell]
        piola = self.solid.results.stress[0][..., self.axis_cell]
        nearest = int(np.argmin(self._quadrature_distance()))
        f, p = gradient[..., nearest], piola[..., nearest]
        return np.asarray(p @ f.T / np.linalg.det(f))

    def _quadrature_distance(self) -> FloatArray:
        """From the origin, of the points of the cell at axis and centre, shape (points,) [mm]."""
        h = self.field.region.h[..., 0]
        place = np.einsum("ai,aq->qi", self.points[self.cells[self.axis_cell]], h)
        return np.asarray(np.sum(place**2, axis=1))
