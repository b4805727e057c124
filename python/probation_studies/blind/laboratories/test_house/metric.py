"""How long a signal is, in units of its errors, when the law's parameters are fitted."""

from __future__ import annotations

from copy import copy
from dataclasses import astuple, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from scipy.linalg import cholesky, solve_triangular, toeplitz

from probation_studies.blind.laboratories.test_house.machine import base_stress
from probation_studies.blind.laboratories.test_house.modal import response_to_strain_error

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation_studies.blind.laboratories.test_house.errors import Errors, Scatter
    from probation_studies.blind.laboratories.test_house.modal import FloatArray
    from probation_studies.blind.laboratories.test_house.trial import Test

Signals: TypeAlias = "Mapping[str, FloatArray]"
"""Of the true stress [MPa], by record, as vectors or columns; zero in records that are left out."""

_DIFFERENCE = 0.005
_LEAST = 1e-12


class Metric:
    """Whitens signals by the errors' covariance of every record; takes out what is fitted.

    Parameters
    ----------
    tests : sequence of Test
    errors : Errors
    scatter : Scatter, optional
        None where specimens are alike.
    """

    def __init__(self, tests: Sequence[Test], errors: Errors, scatter: Scatter | None) -> None:
        self.tangents = {test.name: sensitivities(test) for test in tests}
        """d stress/d ln E, d ln alpha, d ln G, d ln section [MPa]."""
        self.responses = {test.name: _response(test) for test in tests}
        """d stress/d strain sample [MPa]."""
        self._roots: dict[str, FloatArray] = {}
        for test in tests:
            stretch = np.exp(test.history.strain[test.history.at])
            size = errors.stress * (stretch if errors.force_channel else np.ones(len(stretch)))
            covariance = np.diag(size**2)
            if errors.correlation:
                covariance = toeplitz(errors.correlation ** np.arange(len(size))) * np.outer(size, size)
            strained = self.responses[test.name] * errors.strain / (stretch if errors.force_channel else 1.0)
            covariance += strained @ strained.T
            if scatter is not None:
                deviating = self.tangents[test.name] * np.array(astuple(scatter))
                covariance += deviating @ deviating.T
            self._roots[test.name] = cholesky(covariance, lower=True)
        self._basis: FloatArray = np.zeros((sum(map(len, self._roots.values())), 0))
        self._fit(self.parameters)

    @property
    def count(self) -> int:
        """Samples of all records."""
        return len(self._basis)

    @property
    def parameters(self) -> dict[str, FloatArray]:
        """Signals of the law's three parameters, as columns."""
        return {name: columns[:, :3] for name, columns in self.tangents.items()}

    def jointly_with(self, signals: Signals) -> Metric:
        """With more signals that are fitted anyway."""
        other = copy(self)
        other._fit(signals)
        return other

    def _fit(self, signals: Signals) -> None:
        white = self.whitened(signals)
        white = white.reshape(len(white), -1)
        white = white / np.maximum(np.linalg.norm(white, axis=0), _LEAST)
        self._basis = np.linalg.qr(np.column_stack([self._basis, white]))[0]

    def whitened(self, signals: Signals) -> FloatArray:
        """All records one below the other, without unit."""
        shape = next(iter(signals.values())).shape[1:]
        return np.concatenate(
            [
                solve_triangular(root, signals[name], lower=True, check_finite=False)
                if name in signals
                else np.zeros((len(root), *shape))
                for name, root in self._roots.items()
            ]
        )

    def left(self, signals: Signals) -> FloatArray:
        """What the fit leaves of them, whitened; its norm is sqrt(lambda)."""
        white = self.whitened(signals)
        return np.asarray(white - self._basis @ (self._basis.T @ white))


def sensitivities(test: Test) -> FloatArray:
    """Of the true stress [MPa] to ln E, ln alpha, ln G, and the stress itself (of ln section); shape (n, 4)."""
    stress, network = base_stress(test), base_stress(replace(test, law=test.law.scaled(1e-9 / test.law.modulus)))
    up, down = (
        base_stress(replace(test, law=test.law.scaled(alpha=1.0 + each))) for each in (_DIFFERENCE, -_DIFFERENCE)
    )
    return np.column_stack([stress - network, (up - down) / (2.0 * _DIFFERENCE), network, stress])


def _response(test: Test) -> FloatArray:
    history, law = test.history, test.law
    rate = np.diff(history.strain) / np.diff(history.fine)
    middle = 0.5 * (history.fine[1:] + history.fine[:-1])
    between = np.interp(0.5 * (history.time[1:] + history.time[:-1]), middle, rate)
    strain = history.strain[history.at]
    return response_to_strain_error(history.time, strain, law.tau(between), law.modulus, law.hardening)
