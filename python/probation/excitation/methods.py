"""The ways from measured strain to strain and rate, by name. A new one is a file of its own and a line here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from probation.excitation.penalised_spline import smooth_cubic, smooth_quintic

if TYPE_CHECKING:
    from probation.excitation.smoothed import Smoother

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
}

DEFAULT: Method = "quintic-spline"
"""What "auto" smooths with; docs/excitation.md says why."""

METHODS: tuple[Method, ...] = ("auto", "raw", *SMOOTHERS)
