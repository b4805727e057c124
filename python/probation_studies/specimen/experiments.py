"""One experiment on the virtual specimen, and what is known of it that an experimenter cannot see."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation._arrays import FloatArray, as_number, one_of
from probation.errors import InputError
from probation.fe.neck import neck

if TYPE_CHECKING:
    from probation.fe.bar import Bar
    from probation.fe.neck import Necking
    from probation.fe.point import MaterialPoint

StrainMeasure = Literal["section", "surface"]
"""2 ln(initial / current radius) of the centre section; or the logarithm of the stretch along the surface there."""

STRAIN_MEASURES: tuple[StrainMeasure, ...] = ("section", "surface")


@dataclass(frozen=True, kw_only=True)
class Loading:
    """How the grips are driven; exactly one of the two.

    Parameters
    ----------
    grip_speed : float, optional [mm/s]
        By which the grips part.
    strain_rate : float, optional [1/s]
        Of the centre section, to which a video extensometer drives the grips.

    Raises
    ------
    InputError
    """

    grip_speed: float | None = None
    strain_rate: float | None = None

    def __post_init__(self) -> None:
        if (self.grip_speed is None) == (self.strain_rate is None):
            raise InputError("loading: exactly one of grip_speed and strain_rate is needed")
        for name in ("grip_speed", "strain_rate"):
            value = getattr(self, name)
            if value is not None and not as_number(value, name) > 0.0:
                raise InputError(f"{name} is {value}; a positive number is needed")

    @property
    def control(self) -> str:
        """As in a campaign."""
        return "strain-rate" if self.grip_speed is None else "displacement-rate"


@dataclass(frozen=True, eq=False)
class Experiment:
    """True histories at the centre; arrays have shape (instants,), from the relaxed and unstrained start.

    Attributes
    ----------
    name : str
    control : str
        As in a campaign.
    time : ndarray [s]
    true_strain : ndarray [-]
        By the measure that was chosen.
    true_stress : ndarray [MPa]
        Force over the current centre section.
    uniaxial_stress : ndarray [MPa]
        What the law answers in one dimension to the same strain in the same increments.
    bridgman : ndarray [-]
        (1 + 2R/a) ln(1 + a/2R), a the radius of the section and R that of the outline: what the mean axial stress is
        over the uniaxial one in a neck of a perfectly plastic body.
    triaxiality : ndarray [-]
        Mean over equivalent stress on the axis; 1/3 in uniaxial tension.
    volume_change : ndarray [-]
        J - 1 on the axis.
    """

    name: str
    control: str
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    uniaxial_stress: FloatArray
    bridgman: FloatArray
    triaxiality: FloatArray
    volume_change: FloatArray

    @property
    def strain_rate(self) -> FloatArray:
        """By central differences [1/s]."""
        rate: FloatArray = np.gradient(self.true_strain, self.time)
        return rate

    @property
    def gap(self) -> FloatArray:
        """The triaxiality gap [MPa]: mean axial stress over the section less the law's stress in one dimension."""
        return self.true_stress - self.uniaxial_stress

    def uniaxial(self) -> Experiment:
        """The same strains, answered in one dimension: the specimen as it would be without a neck's triaxiality."""
        one, third = np.ones_like(self.time), np.full_like(self.time, 1.0 / 3.0)
        return replace(
            self,
            true_stress=self.uniaxial_stress,
            bridgman=one,
            triaxiality=third,
            volume_change=np.zeros_like(self.time),
        )

    def corrected(self) -> Experiment:
        """With the stress divided by Bridgman's factor, as an experimenter can who measures the outline."""
        return replace(self, true_stress=self.true_stress / self.bridgman)


def pull(name: str, point: MaterialPoint, bar: Bar, loading: Loading, strain: StrainMeasure = "section") -> Experiment:
    """Pull the bar.

    Parameters
    ----------
    name : str
    point : MaterialPoint
    bar : Bar
        Its nominal rate is overruled by `loading`.
    loading : Loading
    strain : {"section", "surface"}

    Returns
    -------
    Experiment

    Raises
    ------
    InputError
        If the strain measure is unknown, or no increment, however small, finds an equilibrium.
    """
    one_of(strain, "strain", STRAIN_MEASURES)
    if loading.grip_speed is not None:
        bar = replace(bar, nominal_rate=loading.grip_speed / (2.0 * bar.half_length))
    return observe(name, loading.control, point, neck(point, bar, centre_rate=loading.strain_rate), strain)


def observe(name: str, control: str, point: MaterialPoint, necking: Necking, strain: StrainMeasure) -> Experiment:
    """What was seen at the centre, and what is known of it."""
    centre = necking.centre
    radius = np.array([each.radius for each in centre])
    seen = necking.centre_strain if strain == "section" else np.log([each.surface_stretch for each in centre])
    time, seen = np.append(0.0, necking.time), np.append(0.0, seen)
    relative = np.array([each.curvature for each in centre]) * radius
    triaxiality = [each.axis_mean_stress / each.axis_equivalent_stress for each in centre]
    return Experiment(
        name=name,
        control=control,
        time=time,
        true_strain=seen,
        true_stress=np.append(0.0, necking.force / (np.pi * radius**2)),
        uniaxial_stress=_uniaxial_stress(point, time, seen),
        bridgman=np.append(1.0, bridgman_factor(relative)),
        triaxiality=np.append(1.0 / 3.0, triaxiality),
        volume_change=np.append(0.0, [each.axis_volume_change for each in centre]),
    )


def constant_rate_point(
    name: str, point: MaterialPoint, strain_rate: float, end_strain: float, increment: float = 0.01
) -> Experiment:
    """A constant true strain rate in one dimension: what the video extensometer is meant to bring about.

    Parameters
    ----------
    name : str
    point : MaterialPoint
    strain_rate : float [1/s]
    end_strain, increment : float [-]
        The first increment is cut into ones that grow from a fiftieth of it.
    """
    early = increment * np.linspace(0.0, 1.0, 11) ** 2
    strain = np.append(early, np.linspace(increment, end_strain, round(end_strain / increment))[1:])
    time = strain / strain_rate
    stress = _uniaxial_stress(point, time, strain)
    same = np.ones_like(time)
    return Experiment(name, "strain-rate", time, strain, stress, stress, same, same / 3.0, 0.0 * same)


def bridgman_factor(relative_curvature: FloatArray) -> FloatArray:
    """(1 + 2R/a) ln(1 + a/2R) of a/R; 1 where the outline is straight or bulges.

    References
    ----------
    P. W. Bridgman, Studies in large plastic flow and fracture, 1952.
    """
    half = 0.5 * np.maximum(relative_curvature, 1e-9)
    factor: FloatArray = (1.0 + 1.0 / half) * np.log1p(half)
    return factor


def _uniaxial_stress(point: MaterialPoint, time: FloatArray, strain: FloatArray) -> FloatArray:
    stresses, state = [0.0], None
    for rise, dt in zip(np.diff(strain), np.diff(time), strict=True):
        stress, _, state = point.uniaxial(float(rise), float(dt), state)
        stresses.append(stress)
    return np.array(stresses)
