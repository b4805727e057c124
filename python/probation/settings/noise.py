"""The noise of records, and how specimens scatter: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class NoiseSettings:
    """The noise of records, and how specimens scatter."""

    least_gain: float = setting(
        9.0,
        ("What a spectrum's shape must take off the deviance: three standard deviations of one parameter."),
        unit="deviance",
        origin="derived",
        source="likelihood ratio",
        used_in="noise/arma.py",
    )
    least_gain_of_low_rise: float = setting(
        25.0,
        "What a shape that rises where little was looked at must take off the deviance.",
        unit="deviance",
        origin="chosen",
        used_in="noise/arma.py",
    )
    steep_rise: float = setting(
        4.0,
        "Rise from the middle of the band to frequency zero from which on slow noise is no surprise.",
        unit="-",
        origin="chosen",
        used_in="noise/arma.py",
    )
    fisher_excess: float = setting(
        2.0,
        (
            "Variance of the spectrum at frequency zero over what Fisher's information promises; measured "
            "on AR(1), phi = 0.9."
        ),
        unit="-",
        origin="calibrated",
        source="simulated AR(1), phi = 0.9",
        used_in="noise/arma.py",
    )
    least_rise: float = setting(
        0.1,
        ("Noise that all but vanishes towards low frequencies would make a gap of anything slow: bursts can feign it."),
        unit="-",
        origin="chosen",
        used_in="noise/arma.py",
    )
    largest_log_variance: float = setting(
        1.0,
        (
            "Largest variance of the logarithm of the low frequencies' level: beyond it Fisher's "
            "information has run out (phi at its border), and a level that could be anything would excuse "
            "any gap."
        ),
        unit="-",
        origin="chosen",
        used_in="noise/arma.py",
    )
    spectrum_bins: int = setting(
        60,
        "Frequencies are pooled in so many bins, evenly in their logarithm, for the fit.",
        unit="bins",
        origin="chosen",
        used_in="noise/arma.py",
    )
    dim_bin: float = setting(
        0.05,
        "Spectrum over its largest value below which a bin all but loses its say.",
        unit="-",
        origin="chosen",
        used_in="noise/arma.py",
    )
    least_drift: float = setting(
        1.0,
        (
            "Relative variance at the first half period that is assumed in any case: less cannot be "
            "distinguished from none."
        ),
        unit="noise variances",
        origin="chosen",
        used_in="noise/drift.py",
    )
    least_drift_of_effects: float = setting(
        0.25,
        "Least variance, at the first half period, of a drift along an effect, over the noise's.",
        unit="-",
        origin="chosen",
        used_in="noise/drift.py",
    )
    drift_share_of_effects: float = setting(
        0.2,
        "Part of a drift that may go along with an effect.",
        unit="-",
        origin="chosen",
        used_in="noise/drift.py",
    )
    most_drift_of_effects: float = setting(
        2.0,
        "Largest variance, at the first half period, of a drift along an effect, over the noise's.",
        unit="-",
        origin="chosen",
        used_in="noise/drift.py",
    )
    lowest_drift_order: int = setting(
        8,
        "Orders from here on are looked at: further down a bias is all there is.",
        unit="half periods",
        origin="chosen",
        used_in="noise/drift.py",
    )
    highest_drift_order: int = setting(
        4,
        "Orders up to the samples over this are looked at.",
        unit="samples",
        origin="chosen",
        used_in="noise/drift.py",
    )
    outlying_power: float = setting(
        8.0,
        "Power of one wave, over the mean, above which it is a line and no noise.",
        unit="mean power",
        origin="chosen",
        used_in="noise/drift.py",
    )
    modelled_drift_orders: int = setting(
        48,
        "Orders that are given their drift; the roughest of them have little.",
        unit="half periods",
        origin="chosen",
        used_in="noise/drift.py",
    )
    drift_margin: float = setting(
        0.7,
        "Standard deviations that are added to what is estimated.",
        unit="standard deviations",
        origin="chosen",
        used_in="noise/drift.py",
    )
    records_apart: float = setting(
        0.2,
        "Part of the records that may have a spectrum of their own.",
        unit="-",
        origin="chosen",
        used_in="noise/drift.py",
    )
    fewest_for_a_spectrum: int = setting(
        48,
        "Shorter records are given white noise by robust differences: a spectrum needs more.",
        unit="samples",
        origin="chosen",
        used_in="noise/evidence.py",
    )
    transient_ratio: float = setting(
        4.0,
        (
            "A stretch whose low frequencies hold this many times as much, beside its high ones, as the "
            "median stretch's holds a transient of the model, and is left out."
        ),
        unit="-",
        origin="chosen",
        used_in="noise/evidence.py",
    )
    quiet_samples: int = setting(
        80,
        "Quiet samples that suffice for an estimate of their own.",
        unit="samples",
        origin="chosen",
        used_in="noise/evidence.py",
    )
    coarse_step: float = setting(
        1.2,
        ("Readings whose step is this many standard deviations of the noise say nothing of how it grows."),
        unit="noise",
        origin="chosen",
        used_in="noise/evidence.py",
    )
    clustered_size: float = setting(
        4.0,
        ("Autocorrelation of the noise's size, in standard errors, from which on it is followed all along."),
        unit="standard errors",
        origin="chosen",
        used_in="noise/local_size.py",
    )
    size_window: int = setting(
        31,
        "Samples over which it is followed.",
        unit="samples",
        origin="chosen",
        used_in="noise/local_size.py",
    )
    shortest_burst: int = setting(
        15,
        (
            "Samples of the shortest burst that is looked for: so many median sizes say what a step or an "
            "outlier cannot."
        ),
        unit="samples",
        origin="chosen",
        used_in="noise/local_size.py",
    )
    burst_ratio: float = setting(
        1.9,
        "A burst has so many times the noise of the record.",
        unit="-",
        origin="chosen",
        used_in="noise/local_size.py",
    )
    burst_errors: float = setting(
        3.5,
        "A burst is so many deviations above the scatter of its windows.",
        unit="standard deviations",
        origin="chosen",
        used_in="noise/local_size.py",
    )
    agreement_level: float = setting(
        0.001,
        (
            "Probability below which the power at lower frequencies is no longer believed to be what the "
            "rough ones predict."
        ),
        unit="-",
        origin="chosen",
        used_in="noise/spectra.py",
    )
    lowest_coefficients: int = setting(
        12,
        "Coefficients next to the bias's own, where it would show first.",
        unit="coefficients",
        origin="chosen",
        used_in="noise/spectra.py",
    )
    prediction_error: float = setting(
        0.4,
        (
            "Largest standard error of the logarithm of what the rough leftovers predict that is let "
            "excuse a difference."
        ),
        unit="-",
        origin="chosen",
        used_in="noise/spectra.py",
    )
    nuisance_drift_size: float = setting(
        0.6,
        "Standard deviations of the noise along an effect's signal that a drift may have along it.",
        unit="noise",
        origin="chosen",
        used_in="noise/nuisance_drift.py",
    )
    known_drift_variance: float = setting(
        0.1,
        ("Variance of a drift along a signal, given those along other signals, below which it is known already."),
        unit="-",
        origin="chosen",
        used_in="noise/nuisance_drift.py",
    )
    unusual_specimen: float = setting(
        0.01,
        (
            "Probability beyond which a specimen's deviations are not larger: what is missing there is "
            "not the specimen's."
        ),
        unit="-",
        origin="chosen",
        used_in="noise/own_deviations.py",
    )
    farthest_move: float = setting(
        5.0,
        (
            "Standard deviations, by the specimens' scatter, by which parameters may move once specimens may differ "
            "and the misfit grows."
        ),
        unit="standard deviations",
        origin="chosen",
        used_in="inference/base_fit.py",
    )
    most_left_to_specimens: float = setting(
        1.25,
        (
            "Misfit after a refit in which specimens may differ over that before, specimens counted as alike, beyond "
            "which their deviations hold what the law misses; the refit is given up."
        ),
        unit="-",
        origin="chosen",
        used_in="inference/base_fit.py",
    )
    on_grid: float = setting(
        0.02,
        "Largest rms distance from the grid, as a fraction of its step.",
        unit="step",
        origin="chosen",
        used_in="noise/quantisation.py",
    )
    fewest_values: int = setting(
        8,
        "Fewer different values say nothing of a grid.",
        unit="values",
        origin="chosen",
        used_in="noise/quantisation.py",
    )
    transient_segments: int = setting(
        4,
        "Transients are given to so many segments, the longest ones.",
        unit="segments",
        origin="chosen",
        used_in="noise/smooth_basis.py",
    )
    outlier_distance: float = setting(
        8.0,
        "An outlier is this many robust standard deviations away from what its neighbours say.",
        unit="robust standard deviations",
        origin="chosen",
        used_in="noise/outliers.py",
    )
    longest_outlier: int = setting(
        2,
        "Samples that an outlier may last.",
        unit="samples",
        origin="chosen",
        used_in="noise/outliers.py",
    )
    most_outliers: float = setting(
        0.005,
        "More than this fraction of a record are no outliers but the record's noise.",
        unit="record",
        origin="chosen",
        used_in="noise/outliers.py",
    )
    same_history: float = setting(
        0.03,
        (
            "Root mean square of what two strain histories differ by, over their range, below which they "
            "are one: chosen."
        ),
        unit="range",
        origin="chosen",
        used_in="inference/scatter.py",
    )
    least_time_in_common: float = setting(
        0.5,
        "Part of the longer record's time that replicates have in common at least: chosen.",
        unit="-",
        origin="chosen",
        used_in="inference/scatter.py",
    )
    scatter_seen: float = setting(
        0.2,
        ("Lower end of a scatter's interval over its value from which on the scatter is told in words: chosen."),
        unit="-",
        origin="chosen",
        used_in="inference/scatter.py",
    )
    largest_scatter: float = setting(
        3.0,
        (
            "Scatter of specimens over the assumed one, beyond which it is none: that replicates of one batch differ "
            "by 6 % in E_u or 3 % in the section has another reason."
        ),
        unit="-",
        origin="chosen",
        used_in="inference/scatter.py",
    )
    scatter_prior_freedom: int = setting(
        4,
        ("Of the half-Student prior of a standard deviation (Gelman 2006): the fewest that have a variance."),
        unit="degrees",
        origin="chosen",
        source="Gelman 2006",
        used_in="inference/scatter.py",
    )
    usual_drift: float = setting(
        5.0,
        "Relative variance of a drift at the first half period beyond which a larger one is less and less probable.",
        unit="white noise variance",
        origin="chosen",
        used_in="noise/drift.py",
    )
    specimen_scatter: tuple[float, ...] = setting(
        (0.02, 0.03, 0.03, 0.01, 1e-3),
        (
            "Standard deviations from specimen to specimen of E_u, tau_max, G and the area (relative) and of the "
            "offset of the strain, where no replicates show them."
        ),
        unit="-",
        origin="chosen",
        source="docs/diagnosis-method.md, section 10",
        used_in="inference/scatter.py",
    )
    drift_range: tuple[float, float] = setting(
        (0.5, 100.0),
        "Relative variances of a drift at the first half period that are tried beside 0, least and largest.",
        unit="white noise variance",
        origin="chosen",
        used_in="noise/drift.py",
    )
    bias_range: tuple[float, float] = setting(
        (10.0, 1e7),
        "The same of a bias of one record, whose power falls as 1/order³.",
        unit="white noise variance",
        origin="chosen",
        used_in="noise/drift.py",
    )
    fewest_for_drift: int = setting(
        64,
        "Samples below which a record says nothing of drift.",
        unit="samples",
        origin="chosen",
        used_in="noise/drift.py",
    )
    shortest_segment: int = setting(
        40,
        "Samples of the shortest segment with a noise of its own.",
        unit="samples",
        origin="chosen",
        used_in="noise/segments.py",
    )
    tested_lags: int = setting(
        20,
        "Lags of the test for whiteness, and a tenth of the samples at most.",
        unit="samples",
        origin="chosen",
        source="Ljung & Box 1978",
        used_in="noise/whiteness.py",
    )
    transient_times: tuple[tuple[float, int], ...] = setting(
        ((0.1, 5), (0.02, 9)),
        "Time constants of the transients of a smooth gap, and the order in which each is tested.",
        unit="segment, half periods",
        origin="chosen",
        used_in="noise/smooth_basis.py",
    )
    largest_moving_average: float = setting(
        0.97,
        "Largest moving-average coefficient of the noise.",
        unit="-",
        origin="chosen",
        used_in="noise/arma.py",
    )
    finest_region: int = setting(
        16,
        "Regions in time are no shorter than one over this of a record.",
        unit="-",
        origin="chosen",
        used_in="noise/regions.py",
    )
    fewest_of_a_region: int = setting(
        3,
        "Samples of the smallest region.",
        unit="samples",
        origin="chosen",
        used_in="noise/regions.py",
    )
    fewest_for_correlation: int = setting(
        30,
        "Samples below which the stress noise of a record is taken as white.",
        unit="samples",
        origin="chosen",
        used_in="inference/residual_noise.py",
    )
    least_noise: float = setting(
        1e-6,
        "Least noise of a record: synthetic records without noise do not get all of the weight.",
        unit="stress range",
        origin="chosen",
        used_in="records/noise.py",
    )
    negligible_propagated: float = setting(
        0.1,
        "Propagated strain noise along one direction, over the scatter of the stress, that is left out.",
        unit="-",
        origin="chosen",
        used_in="inference/propagated.py",
    )
    strain_beyond_chance: float = setting(
        3.0,
        "Standard deviations by which the stress must show that the recorded strain is real before it is not smoothed.",
        unit="standard deviations",
        origin="chosen",
        used_in="identify/base.py",
    )
    local_parts: int = setting(
        8,
        "Parts of a record in which the local noise variance is estimated for that choice.",
        unit="parts",
        origin="chosen",
        used_in="identify/base.py",
    )
    least_local_variance: float = setting(
        0.01,
        "Least local noise variance in that choice, over its mean.",
        unit="-",
        origin="chosen",
        used_in="identify/base.py",
    )


NOISE = NoiseSettings()
