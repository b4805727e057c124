"""How much a record scatters from sample to sample, without a model of what it measures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.normal import SD_OF_MEDIAN
from probation.records.quantisation import quantisation_step
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.records.record import Record


def robust_deviation(values: FloatArray) -> float:
    """Standard deviation of normal values (n,), by the median distance to their median: outliers hardly count."""
    return float(SD_OF_MEDIAN * np.median(np.abs(values - np.median(values))))


def noise_level(time: FloatArray, values: FloatArray) -> float:
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
    return robust_deviation(distance)


def stress_noise(record: Record) -> float:
    """Standard deviation of a record's stress noise [MPa]: as stated with it, else by `noise_level`; never 0.

    Nor less than what the steps of the readings make: between coarse ones most readings follow a line.
    """
    noise = record.noise.stress_MPa
    if noise is None:
        nominal = record.true_stress * np.exp(-record.true_strain)
        step = max(quantisation_step(record.true_stress), quantisation_step(nominal))
        noise = max(noise_level(record.time, record.true_stress), step / np.sqrt(12.0))
    return max(noise, NOISE.least_noise * float(np.ptp(record.true_stress)), 1e-12)
