"""The gap test with what is sharp in frequency, in time, in the strain or in its period."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.detection.lines_and_steps import find_lines, find_steps
from probation.detection.recurring import find_recurring
from probation.detection.strain_periodic import find_strain_periodic
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from probation.detection.gap_test import GapTest
    from probation.noise.whitening import Whitened


def with_sharp(gap: GapTest, whitened: Whitened) -> GapTest:
    """The test's p-value with lines of one frequency, steps at one instant, and periods and bumps of the strain.

    A test along smooth curves and known effects sees a wave of any frequency, or a slip at any instant, only as far as
    they resemble the few that were put into it. At another level of the noise all of them are tested again.

    Parameters
    ----------
    gap : GapTest
        Along smooth curves and effects.
    whitened : Whitened
    """
    sharp = _p_values(whitened)
    share = 1.0 - len(sharp) * DETECTION.sharp_share

    def family(p_value: float, noise: float) -> float:
        others = sharp if noise == 1.0 else _p_values(replace(whitened, residual=whitened.residual / noise))
        return min(p_value / share, min(others.values()) / DETECTION.sharp_share, 1.0)

    return replace(
        gap,
        p_value=family(gap.p_value, 1.0),
        p_value_low_noise=family(gap.p_value_low_noise, DETECTION.low_noise),
        p_value_high_noise=family(gap.p_value_high_noise, DETECTION.high_noise),
        p_values={**gap.p_values, **sharp},
    )


def _p_values(whitened: Whitened) -> dict[str, float]:
    """The least p-value of each kind, over all records."""
    return {
        "lines": min((line.p_value for line in find_lines(whitened)), default=1.0),
        "steps": min((step.p_value for step in find_steps(whitened)), default=1.0),
        "strain_periodic": min((component.p_value for component in find_strain_periodic(whitened)), default=1.0),
        "recurring": min((bump.p_value for bump in find_recurring(whitened)), default=1.0),
    }
