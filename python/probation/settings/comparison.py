"""What changed between two campaigns: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class ComparisonSettings:
    """What changed between two campaigns."""

    reported: float = setting(
        0.0001,
        "Probability from which on sizes are reported.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    batch_spread: float = setting(
        0.1,
        "Natural logarithm by which a law's constants may differ from batch to batch.",
        unit="-",
        origin="chosen",
        used_in="comparison/faults.py",
    )
    branch_intervals: int = setting(
        24,
        "Intervals of a branch along which the reference is followed.",
        unit="intervals",
        origin="chosen",
        used_in="comparison/measured_law.py",
    )
    smoother_distance: float = setting(
        8.0,
        "Medians of what a smoother takes off the strain, beyond which it is no noise.",
        unit="medians",
        origin="chosen",
        used_in="comparison/noise.py",
    )
    size_error: float = setting(
        0.01,
        "Relative error of a size by the fault's form and by the step between samples, the least of `form_errors`.",
        unit="-",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    outlying_one_in: int = setting(
        100,
        "One in so many samples, the worst, is not asked how large the noise is.",
        unit="samples",
        origin="chosen",
        used_in="comparison/noise.py",
    )
    sharp_reference: float = setting(
        8.0,
        ("Medians of what smooth curves leave, beyond which a reference shows something that they cannot follow."),
        unit="medians",
        origin="chosen",
        used_in="comparison/reference.py",
    )
    branch_ends: int = setting(
        3,
        "Samples at the ends of a branch that are taken as they are, not as a smooth curve.",
        unit="samples",
        origin="chosen",
        used_in="comparison/measured_law.py",
    )


COMPARISON = ComparisonSettings()
