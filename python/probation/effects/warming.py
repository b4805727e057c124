"""How a law answers to a change of temperature where nothing more is known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray

SOFTENING_PER_DEGREE = 0.1
"""-d ln tau_max / dT [1/°C]: an activation energy of 70 kJ/mol at room temperature, the alpha relaxation of
polyethylene within its scatter. Only its product with a rise of temperature enters the stress."""

HARDENING_LOSS_PER_DEGREE = 0.005
"""-d ln G / dT [1/°C], polyethylene."""


def warmed(rise: FloatArray) -> Modification:
    """The law at a temperature above the usual one by `rise` (n,) [°C]."""
    return Modification(
        relaxation_time_factor=np.exp(-SOFTENING_PER_DEGREE * rise),
        hardening_factor=np.exp(-HARDENING_LOSS_PER_DEGREE * rise),
    )
