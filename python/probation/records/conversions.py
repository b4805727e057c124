r"""What machines measure to true strain and true stress.

The cross-section is that of the measured transverse strain, :math:`A = A_0 e^{2\varepsilon_t}`, alike in width and
thickness; where none was measured it is taken to shrink at constant volume, :math:`A = A_0/\lambda`. So it is where the
measured one would mean a volume that shrinks in tension: no solid does that, but a film that is drawn may grow narrower
than thinner.
"""

import numpy as np
from numpy.typing import NDArray

from probation.settings.effects import EFFECTS

FloatArray = NDArray[np.float64]


def stretch_from(role: str, values: FloatArray, gauge_length: float | None = None) -> FloatArray:
    r"""Compute the stretch from whichever measure of elongation a file holds.

    .. math:: \lambda = e^{\varepsilon} = 1 + e = 1 + u/L_0

    Parameters
    ----------
    role : {"true_strain", "engineering_strain", "stretch", "displacement"}
    values : ndarray, shape (n,) [-, or mm for a displacement]
    gauge_length : float, optional [mm]
        :math:`L_0`, for a displacement only.

    Returns
    -------
    ndarray, shape (n,) [-]
        Not checked to be positive: the caller knows the row to complain about.
    """
    match role:
        case "true_strain":
            with np.errstate(over="ignore"):  # strain in percent may overflow; it is refused next
                return np.exp(values)
        case "engineering_strain":
            return 1.0 + values
        case "stretch":
            return values
        case "displacement" if gauge_length is not None:
            return 1.0 + values / gauge_length
    raise RuntimeError(f"no stretch from {role} with gauge length {gauge_length}")


def true_strain_from(role: str, values: FloatArray, gauge_length: float | None = None) -> FloatArray:
    r"""Compute true strain, :math:`\varepsilon = \ln\lambda`, keeping the digits near zero strain.

    Parameters and shapes as in `stretch_from`; the stretch must be positive.

    >>> true_strain_from("displacement", np.array([0.0, 80.0]), gauge_length=80.0).round(6)
    array([0.      , 0.693147])
    """
    match role:
        case "true_strain":
            return values
        case "engineering_strain":
            return np.log1p(values)
        case "stretch":
            return np.log(values)
        case "displacement" if gauge_length is not None:
            return np.log1p(values / gauge_length)
    raise RuntimeError(f"no true strain from {role} with gauge length {gauge_length}")


def true_stress_from(
    role: str,
    values: FloatArray,
    stretch: FloatArray,
    area: float | None = None,
    transverse_strain: FloatArray | None = None,
) -> FloatArray:
    r"""Compute true stress by the measured section, or by constant volume.

    .. math:: \sigma = \frac{F}{A_0}\,e^{-2\varepsilon_t} \qquad \text{or} \qquad \sigma = \frac{F}{A_0}\,\lambda

    Parameters
    ----------
    role : {"true_stress", "engineering_stress", "force"}
    values : ndarray, shape (n,) [MPa, or N for a force]
    stretch : ndarray, shape (n,) [-]
    area : float, optional [mm²]
        Initial cross-section :math:`A_0`, for a force only.
    transverse_strain : ndarray, shape (n,) [-], optional
        Logarithmic :math:`\varepsilon_t`; without it the volume is constant.

    Returns
    -------
    ndarray, shape (n,) [MPa]
    """
    shrunk = stretch if transverse_strain is None else np.exp(-2.0 * transverse_strain)
    match role:
        case "true_stress":
            return values
        case "engineering_stress":
            return values * shrunk
        case "force" if area is not None:
            return values / area * shrunk
    raise RuntimeError(f"no true stress from {role} with area {area}")


def volume_strain_from(true_strain: FloatArray, transverse_strain: FloatArray) -> FloatArray:
    r"""Logarithm of the volume over the first, :math:`\varepsilon + 2\varepsilon_t`, width and thickness alike."""
    return true_strain + 2.0 * transverse_strain


def shrinks_in_tension(true_strain: FloatArray, transverse_strain: FloatArray) -> bool:
    """Whether the volume would shrink under tension, or grow under compression, by more than errors of the strains."""
    against = -volume_strain_from(true_strain, transverse_strain) * np.sign(true_strain)
    return bool(np.quantile(against, EFFECTS.most_of_a_record) > EFFECTS.different_volume)
