r"""Fewer modes: the relaxation kernel of a spectrum, refitted to a wanted accuracy.

With :math:`K(\xi) = \sum_j p_j e^{-\xi/r_j}` and the reduced time :math:`\xi = \int dt/\tau_{max}`, eq. (6) is

.. math:: \sigma = G \varepsilon_{HT} + \int K(\xi - \xi') \, d(E_u \varepsilon - G \varepsilon_{HT})

so that a spectrum acts through K alone, at any rate and under any companion relation. A refit with another kernel moves
neither E_u (K(0) = 1), nor the flow stress (the integral of K), nor what tau_max means.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from probation._arrays import FloatArray, as_number, as_whole_number
from probation.errors import InputError
from probation.law.modal import ACCURACIES, Spectrum

_POINTS = 400  # reduced times of the fit
_CHECK_POINTS = 2500  # of the error
_EXACTLY = 1e3  # weight of the two sums that are kept
_FIRST_GAP = 2.0  # between the first two relaxation times, in ln


@dataclass(frozen=True, eq=False)
class Reduction:
    """A spectrum of fewer modes in the place of another.

    Attributes
    ----------
    spectrum : Spectrum
        Its times are fractions of the same tau_max.
    original : Spectrum
    error : float
        Bound of the relative error of the stress [-]: along any history it errs by no more than this fraction of the
        viscous stress that a ramp has at the history's largest Weissenberg number after the same reduced time. (As long
        as the hardening is no steeper than 2 E_u.)
    ramp_error : float
        Largest relative error of the viscous stress on a ramp, at any rate and strain [-].
    """

    spectrum: Spectrum
    original: Spectrum
    error: float
    ramp_error: float

    @property
    def modes(self) -> int:
        """How many are left."""
        return len(self.spectrum.modal_weight)

    def summary(self) -> str:
        """One line."""
        before = len(self.original.modal_weight)
        return (
            f"{self.modes} modes for {before}: the stress errs by at most {self.error:.1e} of the flow stress on any "
            f"history, {self.ramp_error:.1e} on ramps"
        )


def reduce_spectrum(
    spectrum: Spectrum | None = None, *, accuracy: float | None = None, modes: int | None = None
) -> Reduction:
    """Refit the kernel of a spectrum with fewer modes.

    Weights by non-negative least squares, relaxation times by Gauss-Newton around it, one mode more at a time.

    Parameters
    ----------
    spectrum : Spectrum, optional
        The paper's 50 modes over 6 decades if left out.
    accuracy : float, optional
        Take the fewest modes whose `Reduction.error` is no larger [-].
    modes : int, optional
        Take the best spectrum of no more modes. Give one of the two.

    Returns
    -------
    Reduction
        The original where fewer modes do not reach the accuracy, or are not wanted.

    Raises
    ------
    InputError
        Unless one of `accuracy` (1e-5 to 0.5) and `modes` (at least 1) is given.

    Examples
    --------
    >>> reduce_spectrum(accuracy=1e-3).modes
    9
    """
    if (accuracy is None) == (modes is None):
        found = "neither" if accuracy is None else "both"
        raise InputError(f"accuracy and modes: found {found}, expected one of them")
    original = Spectrum.log_spaced() if spectrum is None else spectrum
    if modes is not None:
        count = as_whole_number(modes, "modes")
        if count < 1:
            raise InputError(f"modes is {count}; at least 1 is needed")
        return _reduced(original, 0.0, count)
    wanted = as_number(accuracy, "accuracy")
    finest, coarsest = ACCURACIES
    if not finest <= wanted <= coarsest:
        raise InputError(f"accuracy is {wanted:g}; a relative error from {finest:g} to {coarsest:g} is needed")
    return _reduced(original, wanted, len(original.modal_weight))


def spectrum_of(modes: int, decades: float, accuracy: float | None) -> Spectrum:
    """The spectrum that a campaign or the command line names: eqs. (4), (5), refitted where an accuracy is given."""
    spectrum = Spectrum.log_spaced(modes, decades)
    return spectrum if accuracy is None else spectrum.reduced(accuracy=accuracy)


@lru_cache(maxsize=16)  # of immutable values; a refit takes half a second
def _reduced(original: Spectrum, accuracy: float, most: int) -> Reduction:
    active = original.modal_weight > 0.0
    ratio, weight = original.relaxation_ratio[active], original.modal_weight[active]
    unchanged = Reduction(original, original, 0.0, 0.0)
    if most >= len(original.modal_weight) and accuracy == 0.0:
        return unchanged
    kernel = _Kernel(ratio, weight)
    times = np.array([np.sum(weight * ratio**2) / np.sum(weight * ratio)])
    best: Reduction | None = None
    for _ in range(min(most, len(ratio) - 1)):
        try:
            times, weights = kernel.refitted(times)
        except RuntimeError:  # nnls gives up on times that all but coincide: no more modes can be discriminated
            break
        fewer = Spectrum(times, weights * (weight.sum() / weights.sum()))
        found = Reduction(fewer, original, *kernel.errors(fewer))
        if best is None or found.error < best.error:
            best = found
        if found.error <= max(accuracy, 0.5 * ACCURACIES[0]):
            break
        times = kernel.with_one_more(times)
    if best is None or (best.error > accuracy > 0.0):
        return unchanged
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

        found = least_squares(
            self._misfit,
            np.clip(np.log(times), low + 1e-10, high - 1e-10),
            bounds=(low, high),
            x_scale=0.1,
            max_nfev=100,
        )
        times = np.unique(np.exp(found.x))
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

    def errors(self, fewer: Spectrum) -> tuple[float, float]:
        """Relative error on any history (the total variation of the ramp's), and on ramps."""
        difference = _ramp(self.check_at, fewer.relaxation_ratio) @ fewer.modal_weight - self.check_ramp
        variation = np.cumsum(np.abs(np.diff(difference, prepend=0.0)))
        return float(np.max(variation / self.check_ramp)), float(np.max(np.abs(difference) / self.check_ramp))


def _ramp(at: FloatArray, ratio: FloatArray) -> FloatArray:
    r"""R (1 - e^{-\xi/r}) of every mode, shape (n, modes)."""
    answer: FloatArray = -np.expm1(-at[:, None] / ratio) * ratio
    return answer
