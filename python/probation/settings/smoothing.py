"""From measured strain to the strain and rate that drive the law: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class SmoothingSettings:
    """From measured strain to the strain and rate that drive the law."""

    near_zero: float = setting(
        0.02,
        "Part of the largest rate below which no relative error of a rate is reported: holds and turning points.",
        unit="largest rate",
        origin="chosen",
        used_in="smoothing/answer.py",
    )
    varies: float = setting(
        1.05,
        "Ratio of rates from which on a rate is said to vary.",
        unit="-",
        origin="chosen",
        used_in="smoothing/answer.py",
    )
    uncertain: float = setting(
        20.0,
        "Standard error of a rate, over the median one, beyond which it does not count in the range of rates.",
        unit="-",
        origin="chosen",
        used_in="smoothing/answer.py",
    )
    correlated: float = setting(
        1.2,
        "Inflation of variances from which on noise is said to be correlated.",
        unit="-",
        origin="chosen",
        used_in="smoothing/answer.py",
    )
    far_residual: float = setting(
        8.0,
        "Residuals beyond this are warned of.",
        unit="standard deviations",
        origin="chosen",
        used_in="smoothing/answer.py",
    )
    rate_noise: float = setting(
        2e-3,
        "Noise of the differenced strain, over the typical rate, from which on a strain is smoothed.",
        unit="typical rate",
        origin="chosen",
        used_in="smoothing/excitation.py",
    )
    misses: float = setting(
        10.0,
        "What a smoother leaves, over the scatter of neighbouring samples, from which on it missed the history.",
        unit="-",
        origin="chosen",
        used_in="smoothing/excitation.py",
    )
    turn: float = setting(
        0.02,
        "Return of the strain beyond which a segment has no single direction.",
        unit="strain range",
        origin="chosen",
        used_in="smoothing/excitation.py",
    )
    beyond_noise: float = setting(
        10.0,
        "Standard deviations of its noise by which such a return is no noise.",
        unit="standard deviations",
        origin="chosen",
        used_in="smoothing/excitation.py",
    )
    fewest_for_necking: int = setting(
        40,
        "Samples that the fit of (A-1) needs.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/necking.py",
    )
    necking_return: float = setting(
        0.05,
        "Return of the strain beyond which a record does not neck.",
        unit="strain range",
        origin="chosen",
        used_in="smoothing/necking.py",
    )
    necking_rates: float = setting(
        1.5,
        "Least ratio of the largest to the smallest rate of a record that necks.",
        unit="-",
        origin="chosen",
        used_in="smoothing/necking.py",
    )
    necking_misfit: float = setting(
        0.05,
        "Largest root mean square that (A-1) may leave.",
        unit="strain range",
        origin="chosen",
        used_in="smoothing/necking.py",
    )
    necking_outlier: float = setting(
        3.0,
        "Residual, over the usual one, from which on it counts less than squared.",
        unit="-",
        origin="chosen",
        used_in="smoothing/necking.py",
    )
    samples_per_knot: int = setting(
        8,
        "Samples per knot: correlated noise is not followed by so few knots.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/penalised_spline.py",
    )
    exhausted: float = setting(
        0.9,
        "Degrees of freedom per knot from which on more knots are tried.",
        unit="-",
        origin="chosen",
        used_in="smoothing/penalised_spline.py",
    )
    better: float = setting(
        0.5,
        "They are kept if the residual falls below this part.",
        unit="residual",
        origin="chosen",
        used_in="smoothing/penalised_spline.py",
    )
    changed_spacing: float = setting(
        2.0,
        "Factor of the usual spacing of samples from which on a change of it is by design.",
        unit="-",
        origin="chosen",
        used_in="smoothing/penalised_spline.py",
    )
    polynomial_order: int = setting(
        3,
        "Order of the local polynomials.",
        unit="-",
        origin="chosen",
        used_in="smoothing/savitzky_golay.py",
    )
    smallest_window: int = setting(
        7,
        "Smallest window of the local polynomials.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/savitzky_golay.py",
    )
    without_jump: int = setting(
        12,
        "Samples from which on a segment does not use the sample at the rate discontinuity.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/segmented.py",
    )
    shortest_curve: int = setting(
        4,
        "Samples below which a segment gets a straight line.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/segmented.py",
    )
    least_jump: float = setting(
        0.1,
        "Change of the slope at a rate discontinuity, at least: less is a bend.",
        unit="steeper slope",
        origin="chosen",
        used_in="smoothing/segments.py",
    )
    jump_significance: float = setting(
        8.0,
        "The same in standard errors.",
        unit="standard errors",
        origin="chosen",
        used_in="smoothing/segments.py",
    )
    jump_evidence: float = setting(
        16.0,
        "Gain of a corner over the best cubic, at least: twice the logarithm of the 3000 samples where it may be.",
        unit="noise variances",
        origin="chosen",
        used_in="smoothing/segments.py",
    )
    stress_corner: float = setting(
        3.0,
        "Standard errors that a change of the strain's slope needs where the stress has a corner, and up to which a "
        "jump may be moved there.",
        unit="standard errors",
        origin="chosen",
        used_in="smoothing/segments.py",
    )
    placed_scatter: float = setting(
        1.2,
        "Scatter around two lines that meet up to which a larger window places a rate discontinuity.",
        unit="noise",
        origin="chosen",
        used_in="smoothing/segments.py",
    )
    clean: float = setting(
        1e-9,
        "Strain noise below which the samples are taken as they are.",
        unit="true strain",
        origin="chosen",
        used_in="smoothing/segments.py",
    )
    most_sines: int = setting(
        8,
        "Sines that are tried at most.",
        unit="sines",
        origin="chosen",
        used_in="smoothing/sines.py",
    )
    fastest_sine: float = setting(
        30.0,
        "Highest frequency of a sine.",
        unit="cycles per record",
        origin="chosen",
        used_in="smoothing/sines.py",
    )
    slowest_sine: float = setting(
        0.5,
        "Lowest frequency of a sine.",
        unit="cycles per record",
        origin="chosen",
        used_in="smoothing/sines.py",
    )
    samples_per_cycle: int = setting(
        8,
        "Samples of a cycle at least.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/sines.py",
    )
    prudence: float = setting(
        1.4,
        "Weight of a degree of freedom in generalised cross-validation, which otherwise sometimes follows the noise.",
        unit="-",
        origin="chosen",
        source="Kim & Gu 2004",
        used_in="smoothing/savitzky_golay.py",
    )
    longest_average: int = setting(
        40,
        "Lag up to which an average by the extensometer is looked for.",
        unit="samples",
        origin="chosen",
        used_in="smoothing/averaging.py",
    )
    levelled: float = setting(
        1.35,
        "Growth of the variance with the lag below which it is constant.",
        unit="-",
        origin="chosen",
        used_in="smoothing/averaging.py",
    )
    rough: float = setting(
        4.0,
        "Growth of the variance of rough noise where the lag doubles, at most: 2 for averages, 16 for a curve.",
        unit="-",
        origin="chosen",
        used_in="smoothing/averaging.py",
    )
    lag_caution: float = setting(
        12.0,
        "Twice the log odds against lags at a start from which on they are left out.",
        unit="-",
        origin="chosen",
        used_in="smoothing/transient.py",
    )
    least_strain_noise: float = setting(
        1e-6,
        "Noise of a strain without noise, over the lags at its start.",
        unit="-",
        origin="chosen",
        used_in="smoothing/transient.py",
    )


SMOOTHING = SmoothingSettings()
