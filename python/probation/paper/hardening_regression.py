"""G by regression of the stress on the Haward-Thackray strain, as in Figure S1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.kinematics import haward_thackray_strain

if TYPE_CHECKING:
    from probation._arrays import FloatArray

LEAST_STRAIN = 0.4
"""True strain from which on the regression is taken, Figure S1."""


@dataclass(frozen=True)
class Regression:
    """Stress = G e_HT + intercept.

    Attributes
    ----------
    hardening_modulus : float [MPa]
    intercept : float [MPa]
    se : float [MPa]
        Standard error of G were the residuals white; they are not, where the law curves.
    curvature : float [MPa]
        Largest departure of the stress from the line.
    """

    hardening_modulus: float
    intercept: float
    se: float
    curvature: float


def hardening_regression(true_strain: FloatArray, true_stress: FloatArray, above: float = LEAST_STRAIN) -> Regression:
    """G from the slope of the stress over e_HT, eq. (3), Figure S1.

    Parameters
    ----------
    true_strain : ndarray, shape (n_times,) [-]
    true_stress : ndarray, shape (n_times,) [MPa]
    above : float [-]
        Samples of larger strain are taken.

    Returns
    -------
    Regression

    Raises
    ------
    InputError
        If fewer than three samples are left.
    """
    taken = true_strain > above
    if np.count_nonzero(taken) < 3:
        raise InputError(f"true_strain: found {np.count_nonzero(taken)} samples above {above}, expected at least 3")
    measure, stress = haward_thackray_strain(true_strain[taken]), true_stress[taken]
    slope, intercept = np.polyfit(measure, stress, 1)
    left = stress - (slope * measure + intercept)
    spread = np.sqrt(np.sum(left**2) / (len(left) - 2) / np.sum((measure - measure.mean()) ** 2))
    return Regression(float(slope), float(intercept), float(spread), float(np.abs(left).max()))
