"""What a record is taken for when it is read: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class ReadingSettings:
    """What a record is taken for when it is read."""

    clock_overlap: float = setting(
        0.5,
        "Time that two records of different clocks have in common at least.",
        unit="shorter record",
        origin="chosen",
        used_in="records/clock.py",
    )
    clock_unknown: float = setting(
        0.25,
        "Uncertainty of a shift between clocks from which on it counts as unknown.",
        unit="shorter record",
        origin="chosen",
        used_in="records/clock.py",
    )
    clock_rival: float = setting(
        25.0,
        "Rise of the squared residual, in its variances, below which another shift than the best one may be right.",
        unit="-",
        origin="chosen",
        used_in="records/clock.py",
    )
    clock_onset: float = setting(
        0.3,
        "Part of the largest value up to which the onset of a signal is looked for.",
        unit="largest value",
        origin="chosen",
        used_in="records/clock.py",
    )
    far_start: float = setting(
        0.02,
        "Strain or stress of the first sample from which on a record does not start at zero.",
        unit="largest value",
        origin="chosen",
        used_in="records/start.py",
    )
    start_noise: float = setting(
        5.0,
        "The same, over the noise: less occurs by chance in a campaign of many records.",
        unit="standard deviations",
        origin="chosen",
        used_in="records/start.py",
    )
    start_bend: float = setting(
        0.5,
        "Part of the time missing before the first sample by which the bend of the stress may falsify it.",
        unit="-",
        origin="chosen",
        used_in="records/start.py",
    )
    steady_rate: float = setting(
        0.1,
        "Relative scatter of a rate below which it is constant.",
        unit="-",
        origin="chosen",
        used_in="records/initial/control.py",
    )
    still_rate: float = setting(
        0.05,
        "Rate below which a record is held.",
        unit="fastest rate",
        origin="chosen",
        used_in="records/initial/control.py",
    )
    held_share: float = setting(
        0.5,
        "Time at rest from which on a test is a hold.",
        unit="duration",
        origin="chosen",
        used_in="records/initial/control.py",
    )


READING = ReadingSettings()
