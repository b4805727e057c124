"""A round bar that necks at constant grip speed, in felupe: ``python -m probation.fe.necking --plot neck.png``.

One quarter of the meridian (symmetry at the centre), eight-node quadrilaterals with 2 x 2 points, the section at the
centre smaller by a chosen fraction. The grip end keeps its radius.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.companion import Weissenberg
from probation.errors import InputError
from probation.fe.felupe import felupe_material
from probation.fe.point import CutStep, MaterialPoint
from probation.law import Law

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


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
    centre_strain : float [-]
        True strain of the centre section at which to stop.
    """

    half_length: float = 15.0
    radius: float = 2.0
    imperfection: float = 0.02
    elements: tuple[int, int] = (24, 2)
    nominal_rate: float = 1e-3
    largest_step: float = 0.01
    centre_strain: float = 1.8


@dataclass(frozen=True, eq=False)
class Necking:
    """What the run recorded; arrays have shape (increments,).

    Attributes
    ----------
    time : ndarray [s]
    nominal_strain, nominal_stress : ndarray [-], [MPa]
        Grip displacement over half length, force over initial area (that of the bar without imperfection).
    centre_strain : ndarray [-]
        2 ln(initial / current radius) of the centre section.
    centre_rate : ndarray [1/s]
    outline : ndarray, shape (2, nodes)
        Position along the bar and radius at the end [mm].
    """

    time: FloatArray
    nominal_strain: FloatArray
    nominal_stress: FloatArray
    centre_strain: FloatArray
    centre_rate: FloatArray
    outline: FloatArray

    def figures(self) -> dict[str, float]:
        """The numbers that tell a neck: the force maximum, the plateau, the largest rate over the smallest before."""
        top, fastest = int(np.argmax(self.nominal_stress)), int(np.argmax(self.centre_rate))
        slowest = float(self.centre_rate[: fastest + 1].min())
        return {
            "largest_nominal_stress_MPa": float(self.nominal_stress[top]),
            "nominal_strain_at_largest_stress": float(self.nominal_strain[top]),
            "lowest_nominal_stress_after_MPa": float(self.nominal_stress[top:].min()),
            "slowest_centre_rate_per_s": slowest,
            "fastest_centre_rate_per_s": float(self.centre_rate[fastest]),
            "centre_rate_ratio": float(self.centre_rate[fastest]) / slowest,
            "centre_strain_at_fastest_rate": float(self.centre_strain[fastest]),
            "centre_strain_at_end": float(self.centre_strain[-1]),
            "increments": len(self.time),
        }


class _Model:
    """The bar in felupe, and one increment of it."""

    def __init__(self, point: MaterialPoint, bar: Bar) -> None:
        import felupe  # noqa: PLC0415 -- an extra

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
        self.points = mesh.points
        self.velocity = np.zeros_like(mesh.points)

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

    def outline(self) -> FloatArray:
        values: Any = self.field[0].values
        return np.asarray((self.points + values)[self.surface].T)


def neck(point: MaterialPoint, bar: Bar | None = None) -> Necking:
    """Pull the bar until its centre has reached the strain that was asked for.

    Parameters
    ----------
    point : MaterialPoint
    bar : Bar, optional

    Returns
    -------
    Necking

    Raises
    ------
    InputError
        If no increment, however small, finds an equilibrium.
    """
    bar = Bar() if bar is None else bar
    model = _Model(point, bar)
    initial_radius = model.outline()[1, 0]
    rows: list[tuple[float, float, float, float]] = [(0.0, 0.0, 0.0, 0.0)]
    strain, step = 0.0, bar.largest_step / 50.0
    while rows[-1][3] < bar.centre_strain:
        force = model.advance((strain + step) * bar.half_length, step / bar.nominal_rate)
        if force is None:
            step /= 2.0
            if step < bar.largest_step * 1e-6:
                raise InputError(f"no equilibrium beyond a nominal strain of {strain:.4f}, however small the increment")
            continue
        strain += step
        centre = 2.0 * float(np.log(initial_radius / model.outline()[1, 0]))
        rows.append((strain / bar.nominal_rate, strain, force / (np.pi * bar.radius**2), centre))
        step = min(1.3 * step, bar.largest_step)
    time, nominal, stress, centre_strain = np.array(rows).T
    rate = np.gradient(centre_strain, time)
    return Necking(time[1:], nominal[1:], stress[1:], centre_strain[1:], rate[1:], model.outline())


def plot(necking: Necking, file: Path) -> None:
    """Force, centre rate and the outline of the bar, as a picture."""
    from matplotlib.figure import Figure  # noqa: PLC0415 -- slow to import

    figure = Figure(figsize=(9.0, 5.0), layout="constrained")
    axes = figure.subplot_mosaic([["force", "rate"], ["shape", "shape"]], height_ratios=[3.0, 1.0])
    axes["force"].plot(necking.nominal_strain, necking.nominal_stress)
    axes["force"].set(xlabel="grip displacement / half length", ylabel="force / initial area (MPa)", ylim=(0.0, None))
    axes["rate"].plot(necking.centre_strain, 1e3 * necking.centre_rate)
    axes["rate"].set(xlabel="true strain of the centre", ylabel="its rate (10⁻³ 1/s)", ylim=(0.0, None))
    x, r = np.hstack([necking.outline[:, :0:-1] * [[-1.0], [1.0]], necking.outline])
    axes["shape"].fill_between(x, -r, r, color="0.75")
    axes["shape"].set(xlabel="along the bar (mm)", ylabel="mm", aspect="equal")
    figure.savefig(file, dpi=150)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the bar with the options of the command line and print its figures."""
    parser = argparse.ArgumentParser(prog="python -m probation.fe.necking", description=__doc__.splitlines()[0])
    for name, default in (
        ("unrelaxed-modulus", 2000.0),
        ("hardening-modulus", 1.5),
        ("bulk-modulus", 2e4),
        ("rate-filter", 0.0),
        ("radius", 2.0),
        ("imperfection", 0.02),
        ("nominal-rate", 1e-3),
        ("largest-step", 0.01),
        ("centre-strain", 1.8),
    ):
        parser.add_argument(f"--{name}", type=float, default=default, help=f"default {default:g}")
    parser.add_argument("--elements", type=int, nargs=2, default=(24, 2), metavar=("ALONG", "ACROSS"))
    parser.add_argument("--plot", type=Path, metavar="FILE")
    parser.add_argument("--json", type=Path, metavar="FILE")
    given = parser.parse_args(arguments)
    law = Law(
        unrelaxed_modulus=given.unrelaxed_modulus,
        hardening_modulus=given.hardening_modulus,
        companion=Weissenberg(0.00464, 0.0367),
    )
    point = MaterialPoint.from_law(law, given.bulk_modulus, rate_filter=given.rate_filter)
    bar = Bar(
        radius=given.radius,
        imperfection=given.imperfection,
        elements=tuple(given.elements),
        nominal_rate=given.nominal_rate,
        largest_step=given.largest_step,
        centre_strain=given.centre_strain,
    )
    necking = neck(point, bar)
    for name, value in necking.figures().items():
        print(f"{name:36s} {value:.6g}")
    if given.plot:
        plot(necking, given.plot)
    if given.json:
        arrays = {name: getattr(necking, name).tolist() for name in ("time", "centre_strain", "centre_rate")}
        given.json.write_text(json.dumps({"figures": necking.figures(), **arrays}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
