"""How much a record scatters from sample to sample, without a model of what it measures."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_NORMAL_CONSISTENCY = 1.482602218505602  # standard deviation over median absolute deviation


def scatter(time: FloatArray, values: FloatArray) -> float:
    r"""Estimate the noise from each sample's distance to the line through its neighbours.

    With :math:`w = (t_{i+1}-t_i)/(t_{i+1}-t_{i-1})`, the distance
    :math:`d_i = y_i - w\,y_{i-1} - (1-w)\,y_{i+1}` of white noise of standard deviation :math:`s` has
    :math:`s\sqrt{1 + w^2 + (1-w)^2}`; the median over the record shuts out jumps and kinks. Noise
    that is correlated from sample to sample is underestimated.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
        Increasing; n of at least 3.
    values : ndarray, shape (n,)

    Returns
    -------
    float [as the values]
        Standard deviation.
    """
    weight = (time[2:] - time[1:-1]) / (time[2:] - time[:-2])
    distance = values[1:-1] - weight * values[:-2] - (1.0 - weight) * values[2:]
    distance /= np.sqrt(1.0 + weight**2 + (1.0 - weight) ** 2)
    return float(_NORMAL_CONSISTENCY * np.median(np.abs(distance - np.median(distance))))
