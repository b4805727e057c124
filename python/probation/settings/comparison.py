"""What changed between two campaigns: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class ComparisonSettings:
    """What changed between two campaigns."""

    reported: float = chosen(0.0001, "probability", "Probability from which on sizes are reported.")
    taken_for_specimens: float = chosen(
        3.0, "-", "Ratio of what a record is off to what is left where specimens may differ, from which on it is told."
    )
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
    graded_intervals: int = chosen(
        3, "intervals", "Intervals at the start of a branch that get finer towards it: onsets are steep."
    )
    grading: float = chosen(0.7, "-", "Factor by which they get finer.")
    samples_per_interval: int = chosen(4, "samples", "Samples per interval of a branch, at least.")
    samples_at_start: float = chosen(1.5, "samples", "The same of the finest one.")
    farthest_answer: float = chosen(
        3.0, "standard deviations", "Standard deviations up to which the law's answer to another history may err."
    )
    beyond_reference: int = chosen(
        3, "orders", "Beyond a reference's end the rest is a constant, a line and a parabola."
    )


COMPARISON = ComparisonSettings()
