"""The bar that one element is: the law in one dimension, with the volume change of a finite bulk modulus."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.fe.point import MaterialPoint


@dataclass(frozen=True, eq=False)
class Pulled:
    """A bar after each increment; arrays of shape (increments,).

    Attributes
    ----------
    kirchhoff_stress : ndarray [MPa]
        Along the bar: the true stress where the volume stays, and force times stretch over initial section always.
    log_volume : ndarray [-]
        ln J.
    """

    kirchhoff_stress: FloatArray
    log_volume: FloatArray


def pull_bar(point: MaterialPoint, increments: Sequence[tuple[float, float]], bulk_modulus: float = np.inf) -> Pulled:
    """Pull a bar of section free to contract.

    With T + K ln J I as the Kirchhoff stress and nothing across, T_11 - T_22 = s and T_22 = -s/3 give K ln J = s/3, so
    that s acts along the bar and its strain is e + s/(9 K), e the isochoric strain that the law in one dimension sees.

    Parameters
    ----------
    increments : sequence of (float, float)
        Of true strain along the bar [-] and of time [s].
    bulk_modulus : float
        K [MPa]; infinite where it is left out.
    """
    soft = 0.0 if np.isinf(bulk_modulus) else 1.0 / (9.0 * bulk_modulus)
    along, isochoric, state = 0.0, 0.0, np.zeros(point.uniaxial_state_size)
    stresses = []
    for rise, dt in increments:
        along += rise
        trial = rise
        for _ in range(20):
            stress, tangent, after = point.uniaxial(trial, dt, state)
            excess = isochoric + trial + soft * stress - along
            if abs(excess) < 1e-15 + 1e-13 * abs(along):
                break
            trial -= excess / (1.0 + soft * tangent)
        isochoric, state = isochoric + trial, after
        stresses.append(stress)
    kirchhoff = np.array(stresses)
    return Pulled(kirchhoff, 3.0 * soft * kirchhoff)
