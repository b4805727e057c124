"""Identification pixel by pixel: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import calibrated, chosen


@dataclass(frozen=True)
class FieldSettings:
    """Identification pixel by pixel."""

    longest_gap: int = chosen(
        3, "samples", "Samples that may lack in a row: the strain is straight across. A longer gap ends the record."
    )
    lengths: int = chosen(
        16,
        "lengths",
        "Lengths that a record which ends early is cut to: pixels that share their instants are identified together.",
    )
    neighbourhood: int = chosen(8, "pixels", "Pixels along a neighbourhood whose draws of an error are taken together.")
    fewest_draws: int = chosen(16, "draws", "Draws of an error in a neighbourhood, at least.")
    scheme_pixels: int = chosen(
        64, "pixels", "Pixels of a block, evenly spaced, on which the error of the scheme is measured."
    )
    reference_substeps: int = chosen(
        4,
        "substeps",
        "Substeps of SA3 that the error of the scheme is measured against: its own error falls with their cube.",
    )
    part_of_negligible_error: float = chosen(
        95.0, "%", "Percentage of the pixels of a block in which the error of the scheme must be negligible."
    )
    certain: float = chosen(
        4.0,
        "standard deviations",
        "Deviation of ln(rms residual / noise) from which on a residual is beyond the noise.",
    )
    uneven: float = chosen(
        2.0,
        "-",
        "Variance of that logarithm times the samples: 1/2 for even noise that is known, more where the noise grows "
        "along the record and is estimated.",
    )
    noise_part: int = chosen(10, "samples", "Samples of a part of the record with a noise of its own, at least.")
    most_noise_parts: int = chosen(16, "parts", "Such parts at most.")
    excess_of_squared_median: float = calibrated(
        3.8,
        "1/number",
        "Mean of the squared median of the moduli of third differences, over the square of its limit, less 1, times "
        "their number.",
        source="a million draws of white noise: 3.66 for 10 differences, 3.85 for 20, 3.97 for 100",
    )
    penalised_derivative: int = chosen(
        4, "-", "Derivative that smoothing penalises; a lower one bends the start, where the unrelaxed modulus is."
    )
    stiffness_exponents: tuple[float, float] = chosen(
        (-3.0, 14.0), "-", "Decimal exponents of the least and the largest stiffness of the spline that are tried."
    )
    stiffness_step: float = chosen(
        0.5, "-", "Distance of the exponents that are tried; times count in median intervals between instants."
    )


FIELD = FieldSettings()
