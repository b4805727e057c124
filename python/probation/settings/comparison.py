"""What changed between two campaigns: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class ComparisonSettings:
    """What changed between two campaigns."""

    nothing: float = setting(
        0.5,
        "Prior probability that nothing changed.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    one_cause: float = setting(
        0.35,
        "Prior probability of one cause.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    two_causes: float = setting(
        0.04,
        "Prior probability of two causes.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    unknown_change: float = setting(
        0.07,
        "Prior probability of something unknown.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    unknown_with_one: float = setting(
        0.04,
        "Prior probability of something unknown jointly with one cause.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    reported: float = setting(
        0.0001,
        "Probability from which on sizes are reported.",
        unit="probability",
        origin="chosen",
        used_in="comparison/compare.py",
    )
    roughest_change: int = setting(
        16,
        "Half periods per record of an unknown change at most.",
        unit="half periods",
        origin="chosen",
        used_in="comparison/evidence.py",
    )
    change_softness: float = setting(
        2.0,
        "Power by which the spectrum of an unknown change falls with its order.",
        unit="-",
        origin="chosen",
        used_in="comparison/evidence.py",
    )
    batch_spread: float = setting(
        0.1,
        "Natural logarithm by which a law's constants may differ from batch to batch.",
        unit="-",
        origin="chosen",
        used_in="comparison/faults.py",
    )
    force_fault: float = setting(
        0.05,
        "Usual size of a fault of the force.",
        unit="largest force",
        origin="chosen",
        used_in="comparison/faults.py",
    )
    travel_fault: float = setting(
        0.03,
        "Usual size of a fault of the compliance.",
        unit="travel",
        origin="chosen",
        used_in="comparison/faults.py",
    )
    wider_priors: float = setting(
        10.0,
        "Prior scales of the others over the catalogue's, which says what a sound rig has.",
        unit="-",
        origin="chosen",
        used_in="comparison/faults.py",
    )
    widest: float = setting(
        10.0,
        "Bounds of the others.",
        unit="prior scales",
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
    starts: int = setting(
        2,
        "Starts of a cause that are refitted.",
        unit="starts",
        origin="chosen",
        used_in="comparison/search.py",
    )
    worth_refitting: float = setting(
        1.0,
        "Linearised gain below which a cause is judged where it starts: the refit would not move.",
        unit="log evidence",
        origin="chosen",
        used_in="comparison/search.py",
    )


COMPARISON = ComparisonSettings()
