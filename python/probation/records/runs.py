"""Where in a record something holds, from sample to sample without a break."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def runs(inside: NDArray[np.bool_], bridge: int = 0, least: int = 1) -> list[slice]:
    """Runs of True; gaps of up to `bridge` samples are closed, then runs below `least` samples dropped."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int)))
    bridged: list[list[int]] = []
    for first, stop in edges.reshape(-1, 2).tolist():
        if bridged and first - bridged[-1][1] <= bridge:
            bridged[-1][1] = stop
        else:
            bridged.append([first, stop])
    return [slice(first, stop) for first, stop in bridged if stop - first >= least]
