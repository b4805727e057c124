"""Whether a parameter keeps its value from record to record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class Estimate:
    """A parameter's value on one record.

    Attributes
    ----------
    se : float or None
        Standard error with noise and model bias; None where the record does not determine the parameter.
    se_noise : float or None
        The part that the fit's own residual explains.
    shifts : tuple of float
        What one standard error of each common cause moves it by: of E_u, held on all records alike, and of what the
        companion relation was calibrated with.
    se_specimen : float
        What its specimen may differ by from others: no error of the value, but none of a difference either.
    """

    value: float
    se: float | None
    se_noise: float | None
    shifts: tuple[float, ...] = ()
    se_specimen: float = 0.0

    @property
    def total_se(self) -> float | None:
        """Standard error with those of the common causes."""
        return None if self.se is None else float(np.linalg.norm([self.se, *self.shifts]))


@dataclass(frozen=True)
class Consistency:
    """Whether the values of one parameter agree.

    Attributes
    ----------
    by_record : dict of str to Estimate
    mean : float
        Weighted by the inverse of their covariance.
    p_value : float
        Of Cochran's Q (1954), with the common shifts: chance of values that differ at least so much, were the
        true value the same.
    tested : bool
        Whether two records or more determine the parameter.
    passes : bool
        Not rejected at `CERTIFICATE.significance`, shared between the parameters (Holm 1979).
    """

    by_record: Mapping[str, Estimate]
    mean: float
    p_value: float
    tested: bool
    passes: bool

    @property
    def spread(self) -> float:
        """Highest over lowest value, less one."""
        values = [estimate.value for estimate in self.by_record.values() if estimate.se is not None]
        return max(values) / min(values) - 1.0 if len(values) > 1 and min(values) > 0.0 else 0.0

    def contradicts(self, value: float) -> bool:
        """Whether some record says clearly, by `CERTIFICATE.clearly`, that the parameter has another value."""
        return any(
            estimate.total_se
            and abs(estimate.value - value) > CERTIFICATE.clearly * np.hypot(estimate.total_se, estimate.se_specimen)
            for estimate in self.by_record.values()
        )


def judge(estimates: Mapping[str, Mapping[str, Estimate]]) -> dict[str, Consistency]:
    """Judge every parameter, by name, on its estimates by record."""
    judged = {name: _cochran(by_record) for name, by_record in estimates.items()}
    failing: set[str] = set()
    tested = sorted((name for name in judged if judged[name][2]), key=lambda name: judged[name][1])
    for rank, name in enumerate(tested):
        if judged[name][1] >= CERTIFICATE.significance / (len(tested) - rank):
            break  # Holm: once one is let pass, so are all with a larger p-value
        failing.add(name)
    return {
        name: Consistency(estimates[name], mean, p_value, was_tested, name not in failing)
        for name, (mean, p_value, was_tested) in judged.items()
    }


def _cochran(by_record: Mapping[str, Estimate]) -> tuple[float, float, bool]:
    """Weighted mean, p-value of Cochran's Q, whether there was anything to compare."""
    known = [estimate for estimate in by_record.values() if estimate.se]
    if not known:
        return float(np.mean([estimate.value for estimate in by_record.values()])), 1.0, False
    values = np.array([estimate.value for estimate in known])
    shifts = np.array([estimate.shifts for estimate in known])
    precision = np.linalg.inv(
        np.diag([estimate.se**2 + estimate.se_specimen**2 for estimate in known if estimate.se]) + shifts @ shifts.T
    )
    mean = float(precision.sum(axis=0) @ values / precision.sum())
    if len(values) < 2:
        return mean, 1.0, False
    apart = values - mean
    return mean, float(chdtrc(len(values) - 1, apart @ precision @ apart)), True
