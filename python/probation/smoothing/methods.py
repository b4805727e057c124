"""The ways from measured strain to strain and rate, by name. A new one is a file of its own and a line here."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, TypeAlias, cast

if TYPE_CHECKING:
    from probation.smoothing.smoothed import LaggingSmoother, Smoother

Method: TypeAlias = str


@dataclass(frozen=True)
class SmoothingMethod:
    """One way.

    Attributes
    ----------
    module, function : str
        Where its `Smoother` is, in this package; imported when it is first used.
    title : str
        What it is, in words.
    segmented : bool
        Whether it is done segment by segment between jumps.
    lags : bool
        Whether it lets the strain lag behind its command after a start or a jump (`smoothing.transient`).
    """

    module: str
    function: str
    title: str
    segmented: bool = True
    lags: bool = False

    @cached_property
    def smooth(self) -> Smoother:
        """The function that does it."""
        return cast("Smoother", getattr(import_module(f"{__package__}.{self.module}"), self.function))

    @property
    def smooth_lagging(self) -> LaggingSmoother | None:
        """The same function where it takes lags."""
        return cast("LaggingSmoother", self.smooth) if self.lags else None


SMOOTHERS: dict[Method, SmoothingMethod] = {
    "quintic-spline": SmoothingMethod(
        "penalised_spline",
        "smooth_quintic",
        "quintic smoothing spline (generalised cross-validation)",
        lags=True,
    ),
    "spline": SmoothingMethod(
        "penalised_spline", "smooth_cubic", "cubic smoothing spline (generalised cross-validation)", lags=True
    ),
    "savitzky-golay": SmoothingMethod(
        "savitzky_golay", "smooth_savitzky_golay", "local cubics, Savitzky-Golay (generalised cross-validation)"
    ),
    "necking": SmoothingMethod(
        "necking", "smooth_necking", "(A-1) and sines through the strain, their derivative", segmented=False
    ),
    "necking-as-printed": SmoothingMethod(
        "necking",
        "smooth_necking_as_printed",
        "(A-1) and sines through the strain, and through its three-point central difference",
        segmented=False,
    ),
}

DEFAULT: Method = "quintic-spline"
"""What "auto" smooths with; docs/excitation.md says why."""

METHODS: tuple[Method, ...] = ("auto", "raw", *SMOOTHERS)
