"""Savitzky-Golay: a cubic through a moving window of samples, the window chosen by cross-validation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.settings.smoothing import SMOOTHING
from probation.smoothing.operators import Operators
from probation.smoothing.smoothed import ROUNDS, Smoothed, inflation, polynomial

if TYPE_CHECKING:
    from probation._arrays import FloatArray

WINDOWS = 24
"""Windows that are tried, up to the whole segment."""

EVEN = 1e-3
"""Steps that differ by less than this part are the same."""

AT_ONCE = 4_000_000
"""Numbers in one batch of local fits."""


def smooth_savitzky_golay(time: FloatArray, true_strain: FloatArray) -> Smoothed:
    """Smooth by local cubics; on even samples those of `scipy.signal.savgol_filter` with its polynomial ends."""
    count = len(time)
    if count < SMOOTHING.smallest_window + 2:
        return polynomial(time, true_strain, 1 if count < 6 else 2)
    largest = count - 1 + count % 2
    sizes = np.geomspace(SMOOTHING.smallest_window, largest, WINDOWS)
    tried = [LocalCubics(time, true_strain, window) for window in sorted({2 * int(size / 2) + 1 for size in sizes})]
    grown = 1.0
    for _ in range(ROUNDS):
        best = tried[int(np.argmin([fitted.score(SMOOTHING.prudence * grown) for fitted in tried]))]
        before, grown = grown, max(grown, inflation(true_strain - best.strain))
        if grown < 1.02 * before:
            break
    strain_error, rate_error = best.norms()
    return Smoothed(
        best.strain,
        best.rate,
        np.sqrt(grown) * strain_error,
        np.sqrt(grown) * rate_error,
        best.freedom,
        best.squares,
        grown,
        best.operators,
    )


class LocalCubics:
    """Least-squares cubics through `window` samples around each sample; at the ends, through the outermost ones."""

    def __init__(self, time: FloatArray, values: FloatArray, window: int) -> None:
        half, inside = window // 2, len(time) - window + 1
        self.window = window
        # What each sample of a window does to strain [-] and rate [1/s], each (windows, positions in it, window): at
        # the beginning, inside, at the end.
        self.weights = (
            _cubic(time[None, :window], slice(half)),
            _inner(time, window),
            _cubic(time[None, -window:], slice(half + 1, window)),
        )
        windows = np.lib.stride_tricks.sliding_window_view(values, window)
        parts = (windows[:1], windows, windows[-1:])
        self.strain, self.rate = (
            np.concatenate(
                [(rows[which] @ part[:, :, None]).ravel() for rows, part in zip(self.weights, parts, strict=True)]
            )
            for which in (0, 1)
        )
        self.squares = float(np.sum((values - self.strain) ** 2))
        begin, inner, end = (rows[0] for rows in self.weights)
        own = inner[:, 0, half].sum() * (inside / len(inner))
        self.freedom = float(np.trace(begin[0]) + own + np.trace(end[0], offset=half + 1))

    def score(self, cost: float) -> float:
        """Generalised cross-validation, every degree of freedom counted `cost` times."""
        left = 1.0 - min(cost * self.freedom / len(self.strain), 1.0)
        return self.squares / left**2 if left > 0.0 else np.inf

    def norms(self) -> tuple[FloatArray, FloatArray]:
        """Standard errors of strain and rate for white noise of 1, each of shape (n_times,)."""
        inside = len(self.strain) - self.window + 1
        strain, rate = (
            np.concatenate(
                [
                    np.broadcast_to(errors, (inside,)) if at == 1 else errors
                    for at, errors in enumerate(np.linalg.norm(rows[which], axis=2).ravel() for rows in self.weights)
                ]
            )
            for which in (0, 1)
        )
        return strain, rate

    def operators(self) -> Operators:
        """The dense operators: banded but for the ends."""
        count, window = len(self.strain), self.window
        made = []
        for which in (0, 1):
            operator = np.zeros((count, count))
            begin, inner, end = (rows[which] for rows in self.weights)
            operator[: window // 2, :window] = begin[0]
            operator[-(window // 2) :, -window:] = end[0]
            rows = np.arange(count - window + 1)[:, None]
            operator[rows + window // 2, rows + np.arange(window)] = inner[:, 0]
            made.append(operator)
        return Operators(*made)


def _inner(time: FloatArray, window: int) -> tuple[FloatArray, FloatArray]:
    """Weights at the middle of each window, (windows, 1, window); one for all where the samples are even."""
    from scipy.signal import savgol_coeffs  # noqa: PLC0415 - slow to load, and this is one way of several

    step = np.diff(time)
    if np.ptp(step) <= EVEN * np.median(step):
        spacing = float(step.mean())
        strain, rate = (
            savgol_coeffs(window, SMOOTHING.polynomial_order, deriv, spacing, use="dot")[None, None] for deriv in (0, 1)
        )
        return strain, rate
    windows = np.lib.stride_tricks.sliding_window_view(time, window)
    batch = max(AT_ONCE // (4 * window), 1)
    middle = slice(window // 2, window // 2 + 1)
    parts = [_cubic(windows[at : at + batch], middle) for at in range(0, len(windows), batch)]
    return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])


def _cubic(windows: FloatArray, at: slice) -> tuple[FloatArray, FloatArray]:
    """Weights of strain and rate at some positions of each window, each (windows, positions, window)."""
    middle = 0.5 * (windows[:, :1] + windows[:, -1:])
    half = 0.5 * (windows[:, -1:] - windows[:, :1])
    x = (windows - middle) / half
    powers = np.arange(SMOOTHING.polynomial_order + 1)
    basis, triangle = np.linalg.qr(x[..., None] ** powers)
    inverse = np.linalg.solve(triangle, basis.transpose(0, 2, 1))
    points = x[:, at, None]
    slopes = powers * points ** np.maximum(powers - 1, 0) / half[..., None]
    return points**powers @ inverse, slopes @ inverse
