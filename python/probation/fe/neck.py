"""A round bar that necks between grips: it is pulled, and what it did is recorded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.fe.bar import Bar, BarModel, Centre, Snapshot
from probation.fe.neck_figures import neck_figures

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.fe.point import MaterialPoint

_SMALLEST = 1e-6
"""Smallest increment that is tried, over the largest."""


@dataclass(frozen=True, eq=False)
class Necking:
    """What the run recorded; arrays have shape (increments,).

    Attributes
    ----------
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
    bar : Bar, optional
    centre_rate : float, optional
        Strain rate of the centre [1/s] that the grips are driven for, as a video extensometer does: after each
        increment their speed is set anew from the strain that the centre has and should have. Left out: the grips
        move at constant speed.
    stages : sequence of float
        Centre strains at which to keep a snapshot.

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
