"""The calibration of companion relations: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class CompanionSettings:
    """The calibration of companion relations."""

    fewest_rates: int = setting(
        3,
        "Different rates from which on one can be left out.",
        unit="rates",
        origin="chosen",
        used_in="calibration/calibrate.py",
    )
    modulus_scatter: float = setting(
        0.05,
        "Scatter of E_u between records from which on it is reported.",
        unit="-",
        origin="chosen",
        used_in="calibration/calibrate.py",
    )
    constant_level: float = setting(
        0.05,
        "p-value from which on the relaxation times of all rates are taken to agree.",
        unit="probability",
        origin="chosen",
        used_in="calibration/constant_time.py",
    )
    negligible_dependence: float = setting(
        0.01,
        "Largest distance of ln tau_max from the mean with which no relation is needed.",
        unit="-",
        origin="chosen",
        used_in="calibration/constant_time.py",
    )
    enough_samples: int = setting(
        1000,
        "Samples of a record to which it is thinned for the comparison of relations.",
        unit="samples",
        origin="chosen",
        used_in="calibration/direct.py",
    )
    same_rate: float = setting(
        1.1,
        "Ratio of neighbouring rates up to which they count as one: replicates of a test.",
        unit="-",
        origin="chosen",
        used_in="calibration/rate_table.py",
    )
    warned_spread: float = setting(
        1.1,
        "95th over 5th percentile of the rate of a record from which on a warning is given.",
        unit="-",
        origin="chosen",
        used_in="calibration/record_fits.py",
    )
    nearly_constant: float = setting(
        1.5,
        "The same from which on a constant tau_max of the record is no relaxation time at one rate.",
        unit="-",
        origin="chosen",
        used_in="calibration/calibrate.py",
    )


COMPANION = CompanionSettings()
