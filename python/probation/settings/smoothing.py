"""From measured strain to the strain and rate that drive the law: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class SmoothingSettings:
    """From measured strain to the strain and rate that drive the law."""

    near_zero: float = chosen(
        0.02,
        "largest rate",
        "Part of the largest rate below which no relative error of a rate is reported: holds and turning points.",
    )
    varies: float = chosen(1.05, "-", "Ratio of rates from which on a rate is said to vary.")
    uncertain: float = chosen(
        20.0,
        "-",
        "Standard error of a rate, over the median one, beyond which it does not count in the range of rates.",
    )
    correlated: float = chosen(1.2, "-", "Inflation of variances from which on noise is said to be correlated.")
    white_neighbours: float = chosen(
        1.7,
        "-",
        "Variance of fourth differences over three samples, over that of those over one, up to which a strain's noise "
        "is white from sample to sample; 2.4 to 5 in averages of two pictures and more.",
    )
    far_residual: float = chosen(8.0, "standard deviations", "Residuals beyond this are warned of.")
    rate_noise: float = chosen(
        2e-3,
        "typical rate",
        "Noise of the differenced strain, over the typical rate, from which on a strain is smoothed.",
    )
    misses: float = chosen(
        10.0,
        "-",
        "What a smoother leaves, over the scatter of neighbouring samples, from which on it missed the history.",
    )
    turn: float = chosen(0.02, "strain range", "Return of the strain beyond which a segment has no single direction.")
    beyond_noise: float = chosen(
        10.0, "standard deviations", "Standard deviations of its noise by which such a return is no noise."
    )
    fewest_for_necking: int = chosen(40, "samples", "Samples that the fit of (A-1) needs.")
    necking_return: float = chosen(0.05, "strain range", "Return of the strain beyond which a record does not neck.")
    necking_rates: float = chosen(1.5, "-", "Least ratio of the largest to the smallest rate of a record that necks.")
    necking_misfit: float = chosen(0.05, "strain range", "Largest root mean square that (A-1) may leave.")
    necking_outlier: float = chosen(
        3.0, "-", "Residual, over the usual one, from which on it counts less than squared."
    )
    samples_per_knot: int = chosen(8, "samples", "Samples per knot: correlated noise is not followed by so few knots.")
    exhausted: float = chosen(0.9, "-", "Degrees of freedom per knot from which on more knots are tried.")
    better: float = chosen(0.5, "residual", "They are kept if the residual falls below this part.")
    changed_spacing: float = chosen(
        2.0, "-", "Factor of the usual spacing of samples from which on a change of it is by design."
    )
    mostly_noise: float = chosen(
        0.05, "-", "Median relative standard error of a rate by differences beyond which it is said to be mostly noise."
    )
    least_part_of_speed: float = chosen(
        0.2, "median rate", "Rate, on both sides of a jump, below which the jump is measured by the record's own rate."
    )
    polynomial_order: int = chosen(3, "-", "Order of the local polynomials.")
    smallest_window: int = chosen(7, "samples", "Smallest window of the local polynomials.")
    without_jump: int = chosen(
        12, "samples", "Samples from which on a segment does not use the sample at the rate discontinuity."
    )
    shortest_curve: int = chosen(4, "samples", "Samples below which a segment gets a straight line.")
    least_jump: float = chosen(
        0.1, "steeper slope", "Change of the slope at a rate discontinuity, at least: less is a bend."
    )
    jump_significance: float = chosen(
        8.0,
        "standard errors",
        "What a change of the slope at a rate discontinuity needs where the stress shows no corner.",
    )
    jump_evidence: float = chosen(
        16.0,
        "noise variances",
        "Gain of a corner over the best cubic, at least: twice the logarithm of the 3000 samples where it may be.",
    )
    stress_corner: float = chosen(
        3.0,
        "standard errors",
        "What a change of the strain's slope needs where the stress has a corner, and up to what a jump may be moved "
        "there.",
    )
    placed_scatter: float = chosen(
        1.2, "noise", "Scatter around two lines that meet up to which a larger window places a rate discontinuity."
    )
    left_by_two: float = chosen(
        0.1, "of what one leaves", "What two rate discontinuities that are closer than a window may leave."
    )
    clean: float = chosen(1e-9, "true strain", "Strain noise below which the samples are taken as they are.")
    most_sines: int = chosen(8, "sines", "Sines that are tried at most.")
    fastest_sine: float = chosen(30.0, "cycles per record", "Highest frequency of a sine.")
    slowest_sine: float = chosen(0.5, "cycles per record", "Lowest frequency of a sine.")
    samples_per_cycle: int = chosen(8, "samples", "Samples of a cycle at least.")
    prudence: float = chosen(
        1.4,
        "-",
        "Weight of a degree of freedom in generalised cross-validation, which otherwise sometimes follows the noise.",
        source="Kim & Gu 2004",
    )
    longest_average: int = chosen(40, "samples", "Lag up to which an average by the extensometer is looked for.")
    levelled: float = chosen(1.35, "-", "Growth of the variance with the lag below which it is constant.")
    rough: float = chosen(
        4.0,
        "-",
        "Growth of the variance of rough noise where the lag doubles, at most: 2 for averages, 16 for a curve.",
    )
    lag_caution: float = chosen(
        18.0, "-", "Twice the log odds against a start that takes some samples from which on it is sharp."
    )
    least_strain_noise: float = chosen(1e-6, "-", "Noise of a strain without noise, over what its start may leave.")
    smallest_jump_window: int = chosen(
        8, "samples", "Samples on each side through which lines show a discontinuity of the rate, at least."
    )
    largest_jump_window: int = chosen(60, "samples", "The same at most, before it is widened.")
    jump_windows: int = chosen(60, "-", "Between these the window is one over this of a record.")
    wider_jump_windows: tuple[int, ...] = chosen(
        (1, 3, 5), "-", "Windows so many times larger are searched: noisier jumps stand out in the larger ones."
    )
    sines_in_vain: int = chosen(3, "sines", "Sines that are added in vain before the search ends.")
    sine_blocks: int = chosen(400, "means", "Means of neighbouring samples in which sines are looked for.")
    sine_spacing: float = chosen(0.25, "cycles per record", "Spacing of the frequencies at which a sine begins.")
    lag_times: tuple[float, ...] = chosen(
        (0.5, 1.0, 2.0, 4.0, 8.0, 16.0),
        "sampling interval",
        "Time constants of a lag, where a corner is told from one.",
    )
    start_knots: tuple[float, ...] = chosen(
        (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 24.0, 32.0),
        "sampling interval",
        "Knots of what a start leaves of the rate.",
    )
    start_part: float = chosen(0.5, "change of the rate", "Standard deviation of each function of what a start leaves.")
    usual_start: float = chosen(4.0, "sampling interval", "Until then it is that; the later a function ends the less.")
    corner_places: int = chosen(
        4, "places", "From sample to sample, at which a sharp corner is tried before a lag is taken for it."
    )
    longest_step: int = chosen(4, "samples", "Within which the strain takes a step: a sudden slip, averaged or not.")
    step_significance: float = chosen(
        8.0, "standard deviations", "By which the changes from sample to sample of a step stand out from those around."
    )
    step_over_others: float = chosen(3.0, "-", "The same over that of the changes next to the step.")
    lag_reach: float = chosen(
        3.0, "longest lag", "Samples from a start, over the longest lag's, within which a bend may be a lag."
    )
    trends: int = chosen(50, "sizes", "Sizes of an unknown trend of the strain that are averaged over.")
    wanders: int = chosen(20, "sizes", "Sizes of an unknown wander of its slope that are averaged over.")
    spacing_window: float = chosen(0.05, "samples", "Part of the samples over which their usual spacing is a median.")
    border_samples: int = chosen(12, "samples", "Samples next to a border whose slope is the rate there.")


SMOOTHING = SmoothingSettings()
