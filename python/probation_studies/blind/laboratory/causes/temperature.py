"""What the temperature of a test changes, where tests stand at several."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.trial import ROOM_DEGREES, Cause

if TYPE_CHECKING:
    from probation_studies.blind.laboratory.trial import Shape, Trial

_KELVIN = 273.15
_USUAL = 0.08
"""-d ln tau_max / dT at the room's temperature [1/°C]."""


def _arrhenius(trial: Trial, amplitude: float) -> None:
    """The times fall by this part per degree at the room's temperature."""
    room = ROOM_DEGREES + _KELVIN
    trial.log_factor += amplitude * room**2 * (1.0 / (trial.degrees - ROOM_DEGREES + room) - 1.0 / room)


def _activated(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Arrhenius for the times; the glass loses a little of its modulus, in proportion."""
    _arrhenius(trial, amplitude)
    trial.modulus_factor *= 1.0 - shape["modulus_part"] * amplitude * (trial.degrees - ROOM_DEGREES)


def _free_volume(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Williams, Landel and Ferry for the times; of a usual amount the network is entropic, in proportion to kelvins."""
    warmer = trial.degrees - ROOM_DEGREES
    trial.log_factor -= amplitude * warmer / (1.0 + warmer / shape["c2_degC"])
    trial.network_factor *= 1.0 + amplitude / _USUAL * warmer / (ROOM_DEGREES + _KELVIN)


def _entangled(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Arrhenius for the times; heat dissolves entanglements, exponentially (Raha and Bowden 1972)."""
    _arrhenius(trial, amplitude)
    trial.network_factor *= np.exp(-shape["network_part"] * amplitude * (trial.degrees - ROOM_DEGREES))


_dependence = partial(Cause, "temperature_dependence", _USUAL, temperatures=True, draws=2)

CAUSES = (
    _dependence(lambda r, s: {"modulus_part": r.uniform(0.01, 0.06)}, change=_activated),
    _dependence(lambda r, s: {"c2_degC": r.uniform(80.0, 200.0)}, change=_free_volume),
    _dependence(lambda r, s: {"network_part": r.uniform(0.02, 0.1)}, change=_entangled),
)
