"""G without the law's dynamics: the slope of stress over Haward-Thackray strain at large strain, Figure S1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.kinematics import haward_thackray_strain

if TYPE_CHECKING:
    from probation._arrays import FloatArray

FROM_STRAIN = 0.4
"""Least true strain of the regression, as in the paper."""

FEWEST = 10


@dataclass(frozen=True)
class HardeningRegression:
    """A straight line through stress over Haward-Thackray strain.

    Attributes
    ----------
    hardening_modulus : float
        Its slope [MPa].
    intercept : float [MPa]
    r_squared : float
    rms : float
        Of what the line leaves [MPa].
    from_strain : float
        Least true strain of the samples taken.
    """

    hardening_modulus: float
    intercept: float
    r_squared: float
    rms: float
    from_strain: float


def regress_hardening(
    true_strain: FloatArray, true_stress: FloatArray, from_strain: float = FROM_STRAIN
) -> HardeningRegression | None:
    """Regress true stress on Haward-Thackray strain, eq. (3), where the true strain exceeds `from_strain`.

    Parameters
    ----------
    true_strain, true_stress : ndarray, shape (n_times,) [-], [MPa]
    from_strain : float

    Returns
    -------
    HardeningRegression or None
        None where fewer than ten samples reach that strain.
    """
    large = true_strain > from_strain
    if np.count_nonzero(large) < FEWEST:
        return None
    hardening, stress = haward_thackray_strain(true_strain[large]), true_stress[large]
    columns = np.column_stack([hardening, np.ones_like(hardening)])
    (slope, intercept), *_ = np.linalg.lstsq(columns, stress, rcond=None)
    left = stress - columns @ (slope, intercept)
    spread = float(np.sum((stress - stress.mean()) ** 2))
    r_squared = 1.0 - float(left @ left) / spread if spread > 0.0 else 0.0
    return HardeningRegression(float(slope), float(intercept), r_squared, float(np.sqrt(np.mean(left**2))), from_strain)
