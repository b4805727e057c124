"""What a record is taken for when it is read: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class ReadingSettings:
    """What a record is taken for when it is read."""

    clock_overlap: float = chosen(
        0.5, "shorter record", "Time that two records of different clocks have in common at least."
    )
    clock_unknown: float = chosen(
        0.25, "shorter record", "Uncertainty of a shift between clocks from which on it counts as unknown."
    )
    clock_rival: float = chosen(
        25.0,
        "-",
        "Rise of the squared residual, in its variances, below which another shift than the best one may be right.",
    )
    clock_onset: float = chosen(
        0.3, "largest value", "Part of the largest value up to which the onset of a signal is looked for."
    )
    far_start: float = chosen(
        0.02, "largest value", "Strain or stress of the first sample from which on a record does not start at zero."
    )
    start_noise: float = chosen(
        5.0, "standard deviations", "The same, over the noise: less occurs by chance in a campaign of many records."
    )
    steady_rate: float = chosen(0.1, "-", "Relative scatter of a rate below which it is constant.")
    still_rate: float = chosen(0.05, "fastest rate", "Rate below which a record is held.")
    held_share: float = chosen(0.5, "duration", "Time at rest from which on a test is a hold.")


READING = ReadingSettings()
