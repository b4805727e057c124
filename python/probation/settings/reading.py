"""What a record is taken for when it is read: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class ReadingSettings:
    """What a record is taken for when it is read."""

    fewest_samples: int = chosen(10, "samples", "Samples of a record, or instants of a field, at least.")
    clock_overlap: float = chosen(
        0.5, "shorter record", "Time that two records of different clocks have in common at least."
    )
    clock_unknown: float = chosen(
        0.25, "shorter record", "Uncertainty of a shift between clocks from which on it counts as unknown."
    )
    clock_steps: int = chosen(
        20, "steps", "Steps of the grid of rates in the shorter record below which no shift is determined."
    )
    clock_rival: float = chosen(
        25.0,
        "-",
        "Rise of the squared residual, in its variances, below which another shift than the best one may be right.",
    )
    clock_onset: float = chosen(
        0.3, "largest value", "Part of the largest value up to which the onset of a signal is looked for."
    )
    clock_onset_samples: int = chosen(
        10, "samples", "Samples of an onset, at least; half of them must rest before it for it to be known."
    )
    clock_proposed: float = chosen(
        3.0, "least rest", "Rest of the rates at a shift below which the strain decides on that shift."
    )
    clock_unstrained: float = chosen(
        0.05, "largest strain", "Strain of a camera's first frame below which the specimen is at rest in it."
    )
    clock_exact: float = chosen(1e-6, "largest strain", "Least noise of a strain file.")
    clock_between: float = chosen(0.1, "distance of samples", "Least uncertainty of a shift between clocks.")
    log_missing: float = chosen(
        0.1, "duration", "Time of a record that a temperature log may leave out; the temperature is held there."
    )
    start_reach: float = chosen(4.0, "first strain", "Strain up to which the strain rate at a record's start is taken.")
    start_samples: int = chosen(
        10,
        "samples",
        "First samples behind the strain rate at a record's start; at least so many where the record was cut.",
    )
    start_samples_of_stress: int = chosen(
        4, "samples", "Samples behind the rate of the stress there, at least: it bends soon."
    )
    far_start: float = chosen(
        0.02, "largest value", "Strain or stress of the first sample from which on a record does not start at zero."
    )
    start_noise: float = chosen(
        5.0, "standard deviations", "The same, over the noise: less occurs by chance in a campaign of many records."
    )
    start_bend: float = chosen(
        0.5, "-", "Part of the time missing before the first sample by which the bend of the stress may falsify it."
    )
    start_intervals: float = chosen(
        2.0, "intervals", "Time missing before the first sample up to which a trigger may have lost it."
    )
    steady_rate: float = chosen(0.1, "-", "Relative scatter of a rate below which it is constant.")
    still_rate: float = chosen(0.05, "fastest rate", "Rate below which a record is held.")
    held_share: float = chosen(0.5, "duration", "Time at rest from which on a test is a hold.")


READING = ReadingSettings()
