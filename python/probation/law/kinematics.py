"""Kinematics of uniaxial, isochoric tension."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation import _core
from probation._arrays import FloatArray, as_samples

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def haward_thackray_strain(true_strain: ArrayLike) -> FloatArray:
    r"""Strain measure that straightens the hardening branch.

    .. math:: \varepsilon_{HT} = \lambda^2 - 1/\lambda, \qquad \lambda = e^{\varepsilon}

    Parameters
    ----------
    true_strain : array_like, shape (n_times,) [-]
        Uniaxial true strain, tension positive.

    Returns
    -------
    ndarray, shape (n_times,) [-]

    Raises
    ------
    InputError
        If the input is not one-dimensional, or has a sample that is not finite or whose stretch is beyond all numbers.

    References
    ----------
    André et al., below eq. (3).

    Examples
    --------
    >>> import math
    >>> haward_thackray_strain([0.0, math.log(2.0)])
    array([0. , 3.5])
    """
    return _core.haward_thackray_strain(as_samples(true_strain, "true_strain"))
