"""G without the law's dynamics: the slope of stress over Haward-Thackray strain at large strain, Figure S1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.law.kinematics import haward_thackray_strain
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True)
class HardeningRegression:
    """Stress = G e_HT + intercept, a straight line.

    Attributes
    ----------
    hardening_modulus : float [MPa]
    intercept : float [MPa]
    se : float [MPa]
        Standard error of G were the residuals white; they are not, where the law curves.
    r_squared : float [-]
    curvature : float [MPa]
        Largest departure of the stress from the line.
    from_strain : float [-]
    """

    hardening_modulus: float
    intercept: float
    se: float
    r_squared: float
    curvature: float
    from_strain: float


def reaches_hardening(true_strain: FloatArray) -> bool:
    """Whether enough samples exceed the strain from which on the regression is taken."""
    return int(np.count_nonzero(true_strain > CERTIFICATE.hardening_from)) >= CERTIFICATE.fewest_for_hardening


def regress_hardening(true_strain: FloatArray, true_stress: FloatArray) -> HardeningRegression:
    """G from the slope of the stress over e_HT, eq. (3), Figure S1.

    Parameters
    ----------
    true_strain : ndarray, shape (n_times,) [-]
    true_stress : ndarray, shape (n_times,) [MPa]

    Raises
    ------
    InputError
        If fewer than three samples are left.
    """
    from_strain = CERTIFICATE.hardening_from
    taken = true_strain > from_strain
    if not reaches_hardening(true_strain):
        raise InputError(
            f"true_strain: found {np.count_nonzero(taken)} samples above {from_strain}, expected at least "
            f"{CERTIFICATE.fewest_for_hardening}"
        )
    measure, stress = haward_thackray_strain(true_strain[taken]), true_stress[taken]
    slope, intercept = np.polyfit(measure, stress, 1)
    left = stress - (slope * measure + intercept)
    degrees = max(len(left) - 2, 1)
    error = np.sqrt(np.sum(left**2) / degrees / np.sum((measure - measure.mean()) ** 2))
    spread = float(np.sum((stress - stress.mean()) ** 2))
    return HardeningRegression(
        hardening_modulus=float(slope),
        intercept=float(intercept),
        se=float(error),
        r_squared=1.0 - float(left @ left) / spread if spread > 0.0 else 0.0,
        curvature=float(np.abs(left).max()),
        from_strain=from_strain,
    )
