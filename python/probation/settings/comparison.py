"""What changed between two campaigns: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class ComparisonSettings:
    """What changed between two campaigns."""

    reported: float = chosen(0.0001, "probability", "Probability from which on sizes are reported.")
    batch_spread: float = chosen(
        0.1, "-", "Natural logarithm by which a law's constants may differ from batch to batch."
    )
    branch_intervals: int = chosen(24, "intervals", "Intervals of a branch along which the reference is followed.")
    smoother_distance: float = chosen(
        8.0, "medians", "Medians of what a smoother takes off the strain, beyond which it is no noise."
    )
    size_error: float = chosen(
        0.01,
        "-",
        "Relative error of a size by the fault's form and by the step between samples, the least of `form_errors`.",
    )
    outlying_one_in: int = chosen(
        100, "samples", "One in so many samples, the worst, is not asked how large the noise is."
    )
    sharp_reference: float = chosen(
        8.0,
        "medians",
        "Medians of what smooth curves leave, beyond which a reference shows something that they cannot follow.",
    )
    branch_ends: int = chosen(
        3, "samples", "Samples at the ends of a branch that are taken as they are, not as a smooth curve."
    )


COMPARISON = ComparisonSettings()
