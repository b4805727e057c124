"""A curve as a few lines of text: two by four dots in every character."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_BLANK = 0x2800
"""The braille character without a dot (Unicode)."""
# Bit of each dot in a braille character, by row from the top and column.
_DOTS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])


def text_plot(x: FloatArray, y: FloatArray, x_label: str, y_label: str, *, width: int = 60, height: int = 10) -> str:
    """Draw y over x in braille characters.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Finite.
    x_label, y_label : str
        With their units.
    width, height : int
        Of the plot, in characters.

    Returns
    -------
    str
        The axes' labels and ranges, and the curve.
    """
    columns, rows = _dense(_scaled(x, 2 * width), _scaled(-y, 4 * height))
    canvas = np.full((height, width), _BLANK)
    np.bitwise_or.at(canvas, (rows // 4, columns // 2), _DOTS[rows % 4, columns % 2])
    edge = max(len(f"{limit:.4g}") for limit in (y.min(), y.max()))
    limits = {0: f"{y.max():.4g}", height - 1: f"{y.min():.4g}"} if y.max() > y.min() else {}
    limits = limits or {height // 2: f"{y.max():.4g}"}
    lines = [f"{'':>{edge}} {y_label}"]
    for at, row in enumerate(canvas):
        label = limits.get(at, "")
        lines.append(f"{label:>{edge}} ┤{''.join(map(chr, row))}")
    left, right = f"{x.min():.4g}", f"{x.max():.4g} {x_label}"
    lines.append(f"{'':>{edge}} └{'─' * width}")
    lines.append(f"{'':>{edge}}  {left}{right:>{max(width - len(left), len(right) + 1)}}")
    return "\n".join(lines)


def _scaled(values: FloatArray, count: int) -> FloatArray:
    """Values on a scale from 0 to count - 1; all in the middle where they do not differ."""
    low, high = float(values.min()), float(values.max())
    if high == low:
        return np.full(len(values), (count - 1) / 2)
    return (values - low) / (high - low) * (count - 1)


def _dense(x: FloatArray, y: FloatArray) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Dots close enough to look like a line through the points."""
    steps = np.maximum(np.abs(np.diff(x)), np.abs(np.diff(y)))
    along = np.concatenate([[0.0], np.cumsum(steps)])
    fine = np.linspace(0.0, along[-1], int(along[-1]) + 2)
    return (
        np.rint(np.interp(fine, along, x)).astype(np.int64),
        np.rint(np.interp(fine, along, y)).astype(np.int64),
    )
