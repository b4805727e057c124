r"""Fewer modes: the relaxation kernel of a spectrum, refitted to a wanted accuracy.

With :math:`K(\xi) = \sum_j p_j e^{-\xi/r_j}` and the reduced time :math:`\xi = \int dt/\tau_{max}`, eq. (6) is

.. math:: \sigma = G \varepsilon_{HT} + \int K(\xi - \xi') \, d(E_u \varepsilon - G \varepsilon_{HT})

so that a spectrum acts through K alone, at any rate and under any companion relation. A refit with another kernel moves
neither E_u (K(0) = 1), nor the flow stress (the integral of K), nor what tau_max means.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray

_POINTS = 400  # reduced times of the fit
_CHECK_POINTS = 2500  # of the error
_EXACTLY = 1e3  # weight of the two sums that are kept
_FIRST_GAP = 2.0  # between the first two relaxation times, in ln


class FewerModes(NamedTuple):
    """Relaxation times over tau_max and weights, each of shape (modes,), and their errors.

    `error` and `ramp_error` are those of `spectrum.Reduction`.
    """

    relaxation_ratio: FloatArray
    modal_weight: FloatArray
    error: float
    ramp_error: float


def fewer_modes(
    relaxation_ratio: FloatArray, modal_weight: FloatArray, accuracy: float, most: int
) -> FewerModes | None:
    """The best refit of a kernel with at most so many modes, fewer than it has; with the fewest that are accurate.

    Weights by non-negative least squares, relaxation times by Gauss-Newton around it, one mode more at a time.

    Parameters
    ----------
    relaxation_ratio, modal_weight : ndarray, shape (modes,) [-]
    accuracy : float
        Error at which no further mode is added [-].

    Returns
    -------
    FewerModes or None
        None where the kernel has one mode only, or none could be refitted.
    """
    active = modal_weight > 0.0
    ratio, weight = relaxation_ratio[active], modal_weight[active]
    kernel = _Kernel(ratio, weight)
    times = np.array([np.sum(weight * ratio**2) / np.sum(weight * ratio)])
    best: FewerModes | None = None
    for _ in range(min(most, len(ratio) - 1)):
        try:
            times, weights = kernel.refitted(times)
        except RuntimeError:  # nnls gives up on times that all but coincide: no more modes can be discriminated
            break
        weights = weights * (weight.sum() / weights.sum())
        fewer = FewerModes(times, weights, *kernel.errors(times, weights))
        if best is None or fewer.error < best.error:
            best = fewer
        if fewer.error <= accuracy:
            break
        times = kernel.with_one_more(times)
    return best


class _Kernel:
    """The kernel to be met, through its integral: the viscous stress of a ramp, at 1 per unit of reduced time."""

    def __init__(self, ratio: FloatArray, weight: FloatArray) -> None:
        self.weight = weight
        self.limits = np.log(ratio.min()), np.log(ratio.max())
        self.at = np.geomspace(0.01 * ratio.min(), 30.0 * ratio.max(), _POINTS)
        self.ramp = _ramp(self.at, ratio) @ weight
        self.flow = float(weight @ ratio)
        self.check_at = np.geomspace(1e-3 * ratio.min(), 40.0 * ratio.max(), _CHECK_POINTS)
        self.check_ramp = _ramp(self.check_at, ratio) @ weight

    def weights(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Weights >= 0 for these relaxation times, and the relative error at every point and of the two sums."""
        rows = np.vstack(
            [
                _ramp(self.at, times) / self.ramp[:, None],
                np.full((1, len(times)), _EXACTLY / self.weight.sum()),
                _EXACTLY * times[None, :] / self.flow,
            ]
        )
        wanted = np.concatenate([np.ones(len(self.at)), [_EXACTLY, _EXACTLY]])
        from scipy.optimize import nnls  # noqa: PLC0415 - slow to load, and few ask for fewer modes

        weights, _ = nnls(rows, wanted)
        return weights, rows @ weights - wanted

    def _misfit(self, logs: FloatArray) -> FloatArray:
        return self.weights(np.exp(logs))[1]

    def refitted(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The nearest better relaxation times, increasing, and their weights, all positive."""
        low, high = self.limits[0] - 1e-9, self.limits[1] + 1e-9
        from scipy.optimize import least_squares  # noqa: PLC0415

        minimum = least_squares(
            self._misfit,
            np.clip(np.log(times), low + 1e-10, high - 1e-10),
            bounds=(low, high),
            x_scale=0.1,
            max_nfev=100,
        )
        times = np.unique(np.exp(minimum.x))
        weights = self.weights(times)[0]
        return times[weights > 0.0], weights[weights > 0.0]

    def with_one_more(self, times: FloatArray) -> FloatArray:
        """One more relaxation time to begin with: below the others, or, where there is no room, among them."""
        logs = np.log(times)
        gap = logs[1] - logs[0] if len(logs) > 1 else _FIRST_GAP
        below = max(logs[0] - gap, self.limits[0])
        if logs[0] - below > 0.5 * gap:
            more = np.concatenate([[below], logs])
        else:
            index = np.arange(len(logs))
            more = np.interp(np.linspace(0.0, index[-1], len(logs) + 1), index, logs)
        begin: FloatArray = np.exp(more)
        return begin

    def errors(self, times: FloatArray, weights: FloatArray) -> tuple[float, float]:
        """Relative error on any history (the total variation of the ramp's), and on ramps."""
        difference = _ramp(self.check_at, times) @ weights - self.check_ramp
        variation = np.cumsum(np.abs(np.diff(difference, prepend=0.0)))
        return float(np.max(variation / self.check_ramp)), float(np.max(np.abs(difference) / self.check_ramp))


def _ramp(at: FloatArray, ratio: FloatArray) -> FloatArray:
    r"""R (1 - e^{-\xi/r}) of every mode, shape (n, modes)."""
    answer: FloatArray = -np.expm1(-at[:, None] / ratio) * ratio
    return answer
