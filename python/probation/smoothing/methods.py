"""The ways from measured strain to strain and rate, by name. A new one is a file of its own and a line here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from probation.smoothing.necking import smooth_necking, smooth_necking_as_printed
from probation.smoothing.penalised_spline import smooth_cubic, smooth_quintic
from probation.smoothing.savitzky_golay import smooth_savitzky_golay

if TYPE_CHECKING:
    from probation.smoothing.smoothed import Smoother

Method: TypeAlias = str


@dataclass(frozen=True)
class Way:
    """One way.

    Attributes
    ----------
    smooth : Smoother
    title : str
        What it is, in words.
    segmented : bool
        Whether it is done segment by segment between jumps.
    """

    smooth: Smoother
    title: str
    segmented: bool = True


SMOOTHERS: dict[Method, Way] = {
    "quintic-spline": Way(smooth_quintic, "quintic smoothing spline (generalised cross-validation)"),
    "spline": Way(smooth_cubic, "cubic smoothing spline (generalised cross-validation)"),
    "savitzky-golay": Way(smooth_savitzky_golay, "local cubics, Savitzky-Golay (generalised cross-validation)"),
    "necking": Way(smooth_necking, "(A-1) and sines through the strain, their derivative", segmented=False),
    "necking-as-printed": Way(
        smooth_necking_as_printed,
        "(A-1) and sines through the strain, and through its three-point central difference",
        segmented=False,
    ),
}

DEFAULT: Method = "quintic-spline"
"""What "auto" smooths with; docs/excitation.md says why."""

METHODS: tuple[Method, ...] = ("auto", "raw", *SMOOTHERS)
