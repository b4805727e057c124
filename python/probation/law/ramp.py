"""Eq. (7): the closed form for a ramp."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation import _core
from probation._arrays import FloatArray, as_number, as_samples

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation.law.modal import Law


def ramp_stress(law: Law, strain_rate: float, time: ArrayLike) -> FloatArray:
    """True stress of the ramp true_strain = strain_rate * time, in closed form.

    Parameters
    ----------
    law : Law
    strain_rate : float [1/s]
        Of either sign, or zero.
    time : array_like, shape (n_times,) [s]
        From the start of the ramp, not negative.

    Returns
    -------
    ndarray, shape (n_times,) [MPa]

    Raises
    ------
    InputError
        If a time is negative, the rate is not finite, or a stress is beyond all numbers; then with rate and time.

    References
    ----------
    André et al., eq. (7), in a form that holds at every limit (as printed it is 0/0 at tau_j = 1/rate).
    """
    return _core.ramp_stress(law.engine, as_number(strain_rate, "strain_rate"), as_samples(time, "time"))
