"""The stress that an identified law gives along any history, with its confidence and prediction bands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from scipy.special import stdtrit

from probation._short_repr import ShortRepr
from probation.results.data import Stored
from probation.results.frames import data_frame, over_time
from probation.results.rendering import Plotted

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class StressBand(ShortRepr, Plotted, Stored):
    """A predicted stress with what is known of it; the bands hold at each instant by itself.

    `plot` draws the stress with both bands over strain. In JSON its curves always stand.

    Attributes
    ----------
    name : str
        What was predicted by what, for the figure.
    time, true_strain, true_stress : ndarray, shape (n_times,) [s], [-], [MPa]
    standard_error : ndarray, shape (n_times,) [MPa]
        Of the law's stress, by the uncertainty of its parameters; inf where the records do not determine one that
        matters here.
    scatter_MPa : float
        Standard deviation of measured samples around the law: noise, and what the law leaves out, as on the records
        that it was identified on.
    level : float
        Probability of the bands, such as 0.95.
    degrees : float
        Of freedom of Student's t; fewer where the noise is autocorrelated.
    """

    SCHEMA: ClassVar[str] = "probation.stress-band/1"

    name: str
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    standard_error: FloatArray
    scatter_MPa: float  # noqa: N815 - as it leaves the program
    level: float
    degrees: float

    @cached_property
    def quantile(self) -> float:
        """Half the width of a band in standard deviations."""
        return float(stdtrit(self.degrees, 0.5 + 0.5 * self.level))

    @property
    def confidence(self) -> FloatArray:
        """Lower and upper end of the band of the law's own stress, shape (2, n_times) [MPa]."""
        return self._band(self.standard_error)

    @property
    def prediction(self) -> FloatArray:
        """Lower and upper end of the band of a measured sample, shape (2, n_times) [MPa]."""
        return self._band(np.hypot(self.standard_error, self.scatter_MPa))

    def _band(self, deviation: FloatArray) -> FloatArray:
        reach = self.quantile * deviation
        return np.stack([self.true_stress - reach, self.true_stress + reach])

    def to_dict(self) -> dict[str, Any]:
        """The band as Python objects."""
        return {
            "name": self.name,
            "level": self.level,
            "degrees": self.degrees,
            "scatter_MPa": self.scatter_MPa,
            **self._columns(),
        }

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame, a row an instant.

        Raises
        ------
        InputError
            Where pandas is not installed.
        """
        return data_frame(self._columns())

    def to_xarray(self) -> Any:
        """As an xarray Dataset over "time_s".

        Raises
        ------
        InputError
            Where xarray is not installed.
        """
        return over_time(self._columns())

    def _columns(self) -> dict[str, FloatArray]:
        return {
            "time_s": self.time,
            "true_strain": self.true_strain,
            "true_stress_MPa": self.true_stress,
            "standard_error_MPa": self.standard_error,
            "confidence_low_MPa": self.confidence[0],
            "confidence_high_MPa": self.confidence[1],
            "prediction_low_MPa": self.prediction[0],
            "prediction_high_MPa": self.prediction[1],
        }


def standard_error(slopes: FloatArray, covariance: FloatArray) -> FloatArray:
    """Of a stress by the uncertainty of the identified parameters, shape (n_times,) [MPa].

    Parameters
    ----------
    slopes : ndarray, shape (n_times, free) [MPa per unit]
        Along these parameters.
    covariance : ndarray, shape (free, free)
        Of them; not finite where the records do not determine one.
    """
    unknown = ~np.isfinite(np.diag(covariance))
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    variance = np.einsum("ij,jk,ik->i", slopes, known, slopes)
    matters = np.any(slopes[:, unknown] != 0.0, axis=1)
    return np.asarray(np.where(matters, np.inf, np.sqrt(np.maximum(variance, 0.0))))
