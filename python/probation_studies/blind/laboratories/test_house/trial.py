"""A test that is planned, and a specimen that is pulled."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation_studies.blind.laboratories.test_house.histories import History
    from probation_studies.blind.laboratories.test_house.modal import FloatArray, Law


@dataclass(frozen=True, eq=False)
class Test:
    """One test of a series.

    Attributes
    ----------
    name : str
    history : History
        Of the crosshead.
    law : Law
        Of this specimen.
    section : float
        The true one over the stated one.
    specimen : str
    order : float
        From 0 to 1 within the series.
    temperature : float [°C]
        Declared.
    reference : float [1/s]
        Strain rate in the middle of the series.
    typical : float
        tau_max times this rate: the Weissenberg number.
    longest : float [s]
        Duration of the longest test of the series.
    shortest_interval : float [s]
        Between the samples of the fastest test.
    """

    name: str
    history: History
    law: Law
    section: float
    specimen: str
    order: float
    temperature: float
    reference: float
    typical: float
    longest: float
    shortest_interval: float


@dataclass(frozen=True, eq=False)
class Run:
    """A specimen that is pulled.

    Attributes
    ----------
    test : Test
    law : Law
        Which a cause may have changed.
    strain : ndarray, shape (n_fine,)
        Of the specimen, which may be less than the crosshead's.
    """

    test: Test
    law: Law
    strain: FloatArray

    @property
    def time(self) -> FloatArray:
        """Fine instants [s]."""
        return self.test.history.fine

    @cached_property
    def rate(self) -> FloatArray:
        """Strain rate of every step [1/s]."""
        return np.asarray(np.diff(self.strain) / np.diff(self.time))

    @property
    def part(self) -> FloatArray:
        """Of the test's duration that is over."""
        return np.asarray(self.time / self.time[-1])
