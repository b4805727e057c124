"""A round bar that necks between grips, in felupe: ``python -m probation.fe.necking --plot neck.png``."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.fe.bar import Bar, BarModel, Centre, Snapshot
from probation.fe.neck_figures import neck_figures
from probation.fe.point import MaterialPoint
from probation.law.companion import Weissenberg
from probation.law.modal import Law

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray

_SMALLEST = 1e-6
"""Smallest increment that is tried, over the largest."""


@dataclass(frozen=True, eq=False)
class Necking:
    """What the run recorded; arrays have shape (increments,).

    Attributes
    ----------
    bar : Bar
    time : ndarray [s]
    nominal_strain : ndarray [-]
        Grip displacement over half length.
    force : ndarray [N]
    centre_strain : ndarray [-]
        2 ln(initial / current radius) of the centre section.
    centre : tuple of Centre
        The centre section after each increment.
    snapshots : tuple of Snapshot
        The deformed mesh where the centre strain first reached what was asked for, and at the end.
    outline : ndarray, shape (2, nodes)
        Position along the bar and radius at the end [mm].
    """

    bar: Bar
    time: FloatArray
    nominal_strain: FloatArray
    force: FloatArray
    centre_strain: FloatArray
    centre: tuple[Centre, ...]
    snapshots: tuple[Snapshot, ...]
    outline: FloatArray

    @property
    def nominal_stress(self) -> FloatArray:
        """Force over the initial area of the bar without imperfection [MPa]."""
        return self.force / (np.pi * self.bar.radius**2)

    @property
    def centre_rate(self) -> FloatArray:
        """Rate of the centre strain [1/s], by central differences."""
        time, strain = np.append(0.0, self.time), np.append(0.0, self.centre_strain)
        rate: FloatArray = np.gradient(strain, time)[1:]
        return rate

    def figures(self) -> dict[str, float]:
        """The numbers that tell a neck: the force maximum, the plateau, the largest rate over the smallest before."""
        stress, rate = self.nominal_stress, self.centre_rate
        top, fastest = int(np.argmax(stress)), int(np.argmax(rate))
        return neck_figures(self.nominal_strain, stress, self.centre_strain, rate, top, fastest)


def neck(
    point: MaterialPoint,
    bar: Bar | None = None,
    *,
    centre_rate: float | None = None,
    stages: Sequence[float] = (),
) -> Necking:
    """Pull the bar until its centre has reached the strain that was asked for.

    Parameters
    ----------
    point : MaterialPoint
    bar : Bar, optional
    centre_rate : float, optional
        Strain rate of the centre [1/s] that the grips are driven for, as a video extensometer does: after each
        increment their speed is set anew from the strain that the centre has and should have. Left out: the grips
        move at constant speed.
    stages : sequence of float
        Centre strains at which to keep a snapshot.

    Returns
    -------
    Necking

    Raises
    ------
    InputError
        If no increment, however small, finds an equilibrium.
    """
    bar = Bar() if bar is None else bar
    model = BarModel(point, bar)
    rows: list[tuple[float, float, float, float]] = [(0.0, 0.0, 0.0, 0.0)]
    centre, snapshots, ahead = [], [], sorted(stages)
    step = bar.largest_step / 50.0
    speed = bar.nominal_rate if centre_rate is None else centre_rate  # over half length
    while rows[-1][3] < bar.centre_strain:
        time, strain, _, before = rows[-1]
        force = model.advance((strain + step) * bar.half_length, step / speed)
        if force is None:
            step /= 2.0
            if step < bar.largest_step * _SMALLEST:
                raise InputError(f"no equilibrium beyond a nominal strain of {strain:.4f}, however small the increment")
            continue
        centre.append(model.centre())
        now = 2.0 * float(np.log(bar.centre_radius / centre[-1].radius))
        rows.append((time + step / speed, strain + step, force, now))
        if ahead and now >= ahead[0]:
            snapshots.append(model.snapshot(rows[-1][0]))
            ahead = [stage for stage in ahead if stage > now]
        fits = bar.largest_centre_step * step / max(now - before, 1e-12)
        if centre_rate is not None:
            speed = _servo(speed, centre_rate, rows)
        step = min(1.3 * step, bar.largest_step, max(fits, 0.5 * step))
    time, nominal, force, centre_strain = np.array(rows[1:]).T
    snapshots.append(model.snapshot(float(time[-1])))
    return Necking(bar, time, nominal, force, centre_strain, tuple(centre), tuple(snapshots), model.outline())


def _servo(speed: float, centre_rate: float, rows: Sequence[tuple[float, float, float, float]]) -> float:
    """The speed that makes up for the missing strain within about four increments; a factor of 2 at most."""
    (before, _, _, strain_before), (time, _, _, strain) = rows[-2:]
    dt = time - before
    wanted = centre_rate + (centre_rate * time - strain) / (4.0 * dt)
    found = max((strain - strain_before) / dt, 1e-3 * centre_rate)
    return speed * float(np.clip(wanted / found, 0.5, 2.0))


def add_bar_options(parser: argparse.ArgumentParser, **changed: float | None) -> None:
    """Options of material, geometry, mesh and steps; `changed` gives other defaults, None for an option left out."""
    group = parser.add_argument_group("material, geometry, mesh and steps")
    for name, default, text in (
        ("unrelaxed-modulus", 2000.0, "E_u [MPa]"),
        ("hardening-modulus", 1.5, "G [MPa]"),
        ("bulk-modulus", 2e4, "K [MPa]"),
        ("rate-filter", 0.0, "strain over which the rate is filtered [-]"),
        ("half-length", 15.0, "of the bar [mm]"),
        ("radius", 2.0, "of the bar [mm]"),
        ("imperfection", 0.02, "by which the section at the centre is smaller [-]"),
        ("nominal-rate", 1e-3, "grip speed over half length [1/s]"),
        ("largest-step", 0.01, "largest increment of nominal strain [-]"),
        ("largest-centre-step", 0.2, "increment of the centre's true strain aimed at [-]"),
        ("centre-strain", 1.8, "true strain of the centre at which to stop [-]"),
    ):
        value = changed.get(name.replace("-", "_"), default)
        if value is None:
            continue
        group.add_argument(f"--{name}", type=float, default=value, metavar="X", help=f"{text}; default {value:g}")
    group.add_argument(
        "--elements", type=int, nargs=2, default=(24, 2), metavar=("ALONG", "ACROSS"), help="default 24 2"
    )


def bar_of(given: argparse.Namespace) -> Bar:
    """The bar of the options."""
    return Bar(
        half_length=given.half_length,
        radius=given.radius,
        imperfection=given.imperfection,
        elements=tuple(given.elements),
        nominal_rate=getattr(given, "nominal_rate", Bar.nominal_rate),
        largest_step=given.largest_step,
        largest_centre_step=given.largest_centre_step,
        centre_strain=given.centre_strain,
    )


def law_of(given: argparse.Namespace) -> Law:
    """The law of the options, with eq. (11)."""
    return Law(
        unrelaxed_modulus=given.unrelaxed_modulus,
        hardening_modulus=given.hardening_modulus,
        companion=Weissenberg(0.00464, 0.0367),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the bar with the options of the command line and print its figures."""
    parser = argparse.ArgumentParser(prog="python -m probation.fe.necking", description=__doc__)
    add_bar_options(parser)
    parser.add_argument("--plot", type=Path, metavar="FILE", help="force, centre rate with Figure 1, and the neck")
    parser.add_argument("--json", type=Path, metavar="FILE", help="figures, and time, strain and rate of the centre")
    given = parser.parse_args(arguments)
    try:
        point = MaterialPoint.from_law(law_of(given), given.bulk_modulus, rate_filter=given.rate_filter)
        necking = neck(point, bar_of(given), stages=_STAGES)
    except InputError as error:
        print(f"necking: {error}", file=sys.stderr)
        return 2
    for name, value in necking.figures().items():
        print(f"{name:36s} {value:.6g}")
    if given.plot:
        from probation.fe.neck_pictures import draw_neck  # noqa: PLC0415 -- slow to import

        draw_neck(necking, given.plot)
    if given.json:
        arrays = {name: getattr(necking, name).tolist() for name in ("time", "centre_strain", "centre_rate")}
        given.json.write_text(json.dumps({"figures": necking.figures(), **arrays}))
    return 0


_STAGES = (0.3, 1.0)
"""Centre strains that the picture shows, beside the end."""


if __name__ == "__main__":
    sys.exit(main())
