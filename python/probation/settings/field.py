"""Identification pixel by pixel: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class FieldSettings:
    """Identification pixel by pixel."""

    longest_gap: int = chosen(
        3, "samples", "Samples that may lack in a row: the strain is straight across. A longer gap ends the record."
    )
    neighbourhood: int = chosen(8, "pixels", "Pixels along a neighbourhood whose draws of an error are taken together.")
    fewest_draws: int = chosen(16, "draws", "Draws of an error in a neighbourhood, at least.")
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
    penalised_derivative: int = chosen(
        4, "-", "Derivative that smoothing penalises; a lower one bends the start, where the unrelaxed modulus is."
    )


FIELD = FieldSettings()
