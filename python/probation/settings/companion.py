"""The calibration of companion relations: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class CompanionCalibrationSettings:
    """The calibration of companion relations."""

    fewest_rates: int = chosen(3, "rates", "Different rates from which on one can be left out.")
    modulus_scatter: float = chosen(0.05, "-", "Scatter of E_u between records from which on it is reported.")
    constant_level: float = chosen(
        0.05, "probability", "p-value from which on the relaxation times of all rates are taken to agree."
    )
    negligible_dependence: float = chosen(
        0.01, "-", "Largest distance of ln tau_max from the mean with which no relation is needed."
    )
    enough_samples: int = chosen(
        1000, "samples", "Samples of a record to which it is thinned for the comparison of relations."
    )
    same_rate: float = chosen(
        1.1, "-", "Ratio of neighbouring rates up to which they count as one: replicates of a test."
    )
    warned_spread: float = chosen(
        1.1, "-", "95th over 5th percentile of the rate of a record from which on a warning is given."
    )
    nearly_constant: float = chosen(
        1.5, "-", "The same from which on a constant tau_max of the record is no relaxation time at one rate."
    )
    apart_level: float = chosen(
        0.05, "probability", "Level of the F test by which a form predicts rates that were left out worse than another."
    )
    searched_alpha: tuple[float, float] = chosen(
        (1e-2, 1e2), "-", "Range of a record's own alpha: beyond a hundredfold error a relation predicts nothing."
    )
    searched_times: tuple[float, float] = chosen(
        (0.1, 1e3), "shortest step, longest record", "Range of tau_max: below, E_u grows without end."
    )
    rate_ends: tuple[float, float] = chosen((5.0, 95.0), "%", "Percentiles of a record's rate that are its range.")


COMPANION = CompanionCalibrationSettings()
