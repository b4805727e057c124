"""The noise of records, and how specimens scatter: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import calibrated, chosen, derived


@dataclass(frozen=True)
class NoiseSettings:
    """The noise of records, and how specimens scatter."""

    least_gain: float = derived(
        9.0,
        "deviance",
        "What a spectrum's shape must take off the deviance: three standard deviations of one parameter.",
        source="likelihood ratio",
    )
    least_gain_of_low_rise: float = chosen(
        25.0, "deviance", "What a shape that rises where little was looked at must take off the deviance."
    )
    steep_rise: float = chosen(
        4.0, "-", "Rise from the middle of the band to frequency zero from which on slow noise is no surprise."
    )
    fisher_excess: float = calibrated(
        2.0,
        "-",
        "Variance of the spectrum at frequency zero over what Fisher's information promises; measured on AR(1), phi "
        "= 0.9.",
        source="simulated AR(1), phi = 0.9",
    )
    least_rise: float = chosen(
        0.1,
        "-",
        "Noise that all but vanishes towards low frequencies would make a gap of anything slow: bursts can feign it.",
    )
    largest_log_variance: float = chosen(
        1.0,
        "-",
        "Largest variance of the logarithm of the low frequencies' level: beyond it Fisher's information has run "
        "out (phi at its border), and a level that could be anything would excuse any gap.",
    )
    spectrum_bins: int = chosen(
        60, "bins", "Frequencies are pooled in so many bins, evenly in their logarithm, for the fit."
    )
    dim_bin: float = chosen(0.05, "-", "Spectrum over its largest value below which a bin all but loses its say.")
    least_drift: float = chosen(
        1.0,
        "noise variances",
        "Relative variance at the first half period that is assumed in any case: less cannot be distinguished from "
        "none.",
    )
    least_drift_of_effects: float = chosen(
        0.25, "-", "Least variance, at the first half period, of a drift along an effect, over the noise's."
    )
    drift_share_of_effects: float = chosen(0.2, "-", "Part of a drift that may go along with an effect.")
    most_drift_of_effects: float = chosen(
        2.0, "-", "Largest variance, at the first half period, of a drift along an effect, over the noise's."
    )
    lowest_drift_order: int = chosen(
        8, "half periods", "Orders from here on are looked at: further down a bias is all there is."
    )
    highest_drift_order: int = chosen(4, "samples", "Orders up to the samples over this are looked at.")
    level_range: tuple[float, float] = chosen(
        (0.1, 2.0),
        "-",
        "Ends of the search for a level of white noise: over the smaller and the larger of the known noise and the "
        "residual.",
    )
    outlying_power: float = chosen(
        8.0, "mean power", "Power of one wave, over the mean, above which it is a line and no noise."
    )
    modelled_drift_orders: int = chosen(
        48, "half periods", "Orders that are given their drift; the roughest of them have little."
    )
    drift_margin: float = chosen(0.7, "standard deviations", "Standard deviations that are added to what is estimated.")
    records_apart: float = chosen(0.2, "-", "Part of the records that may have a spectrum of their own.")
    fewest_for_a_spectrum: int = chosen(
        48, "samples", "Shorter records are given white noise by robust differences: a spectrum needs more."
    )
    transient_ratio: float = chosen(
        4.0,
        "-",
        "A segment whose low frequencies hold this many times as much, relative to its high ones, as the median "
        "segment's holds a transient of the model, and is left out.",
    )
    transient_size: float = chosen(
        8.0,
        "-",
        "A segment that holds this many times as much as the median one holds a transient with an edge, unless its "
        "large second differences are `transient_ratio` times as large, squared: a burst of noise.",
    )
    edgeless: float = chosen(
        0.9, "-", "Quantile of a segment's second differences that tells their size: an edge reaches fewer of them."
    )
    edged_segments: int = chosen(
        2, "segments", "Segments of a record that are left out for an edge at most: where there are more, it is noise."
    )
    quiet_samples: int = chosen(80, "samples", "Quiet samples that suffice for an estimate of their own.")
    coarse_step: float = chosen(
        1.2, "noise", "Readings whose step is this many standard deviations of the noise say nothing of how it grows."
    )
    clustered_size: float = chosen(
        4.0,
        "standard errors",
        "Autocorrelation of the noise's size, in standard errors, from which on it is followed all along.",
    )
    size_window: int = chosen(31, "samples", "Samples over which it is followed.")
    shortest_burst: int = chosen(
        15,
        "samples",
        "Samples of the shortest burst that is looked for: so many median sizes say what a step or an outlier cannot.",
    )
    burst_ratio: float = chosen(1.9, "-", "A burst has so many times the noise of the record.")
    burst_errors: float = chosen(
        3.5, "standard deviations", "A burst is so many deviations above the scatter of its windows."
    )
    agreement_level: float = chosen(
        0.001,
        "-",
        "Probability below which the power at lower frequencies is no longer believed to be what the rough ones "
        "predict.",
    )
    lowest_coefficients: int = chosen(
        12, "coefficients", "Coefficients next to the bias's own, where it would show first."
    )
    prediction_error: float = chosen(
        0.4,
        "-",
        "Largest standard error of the logarithm of what the rough leftovers predict that is let excuse a difference.",
    )
    nuisance_drift_size: float = chosen(
        0.6, "noise", "Standard deviations of the noise along an effect's signal that a drift may have along it."
    )
    known_drift_variance: float = chosen(
        0.1,
        "-",
        "Variance of a drift along a signal, given those along other signals, below which it is known already.",
    )
    unusual_specimen: float = chosen(
        0.01,
        "-",
        "Probability beyond which a specimen's deviations are not larger: what is missing there is not the specimen's.",
    )
    left_beside_specimens: float = chosen(
        1.1,
        "-",
        "Misfit squared over the noise's, specimens that differ allowed for, beyond which these leave a gap: the noise "
        "is known to some per cent.",
    )
    most_left_to_specimens: float = chosen(
        1.25,
        "-",
        "Misfit after a refit in which specimens may differ over that before, specimens counted as alike, beyond "
        "which their deviations hold what the law misses; the refit is given up where it leaves a gap all the same.",
    )
    on_grid: float = chosen(0.02, "step", "Largest rms distance from the grid, as a fraction of its step.")
    fewest_values: int = chosen(8, "values", "Fewer different values say nothing of a grid.")
    transient_segments: int = chosen(4, "segments", "Transients are given to so many segments, the longest ones.")
    outlier_distance: float = chosen(
        8.0,
        "robust standard deviations",
        "An outlier is this many robust standard deviations away from what its neighbours say.",
    )
    longest_outlier: int = chosen(2, "samples", "Samples that an outlier may last.")
    most_outliers: float = chosen(
        0.005, "record", "More than this fraction of a record are no outliers but the record's noise."
    )
    same_history: float = chosen(
        0.03,
        "range",
        "Root mean square of what two strain histories differ by, over their range, below which they are one: chosen.",
    )
    least_time_in_common: float = chosen(
        0.5, "-", "Part of the longer record's time that replicates have in common at least: chosen."
    )
    same_temperature: float = chosen(
        3.0,
        "°C",
        "Difference of the temperatures, where both are known, up to which tests are replicates: a room kept to 2 °C, "
        "and less than what makes specimens of most polymers seem to differ by more than they do.",
    )
    scatter_seen: float = chosen(
        0.2,
        "-",
        "Lower end of a scatter's interval over its value from which on the scatter is reported in words: chosen.",
    )
    largest_scatter: float = chosen(
        3.0,
        "-",
        "Scatter of specimens over the assumed one, beyond which it is none: that replicates of one batch differ by "
        "6 % in E_u or 3 % in the section has another reason.",
    )
    scatter_prior_freedom: int = chosen(
        4,
        "degrees",
        "Of the half-Student prior of a standard deviation (Gelman 2006): the fewest that have a variance.",
        source="Gelman 2006",
    )
    usual_drift: float = chosen(
        5.0,
        "white noise variance",
        "Relative variance of a drift at the first half period beyond which a larger one is less and less probable.",
    )
    specimen_scatter: tuple[float, ...] = chosen(
        (0.02, 0.03, 0.03, 0.01, 1e-3),
        "-",
        "Standard deviations from specimen to specimen of E_u, tau_max, G and the area (relative) and of the offset "
        "of the strain, where no replicates show them.",
        source="docs/diagnosis-method.md, section 10",
    )
    drift_range: tuple[float, float] = chosen(
        (0.5, 100.0),
        "white noise variance",
        "Relative variances of a drift at the first half period that are tried in addition to 0, least and largest.",
    )
    bias_range: tuple[float, float] = chosen(
        (10.0, 1e7), "white noise variance", "The same of a bias of one record, whose power falls as 1/order³."
    )
    fewest_for_drift: int = chosen(64, "samples", "Samples below which a record says nothing of drift.")
    shortest_segment: int = chosen(40, "samples", "Samples of the shortest segment with a noise of its own.")
    tested_lags: int = chosen(
        20, "samples", "Lags of the test for whiteness, and a tenth of the samples at most.", source="Ljung & Box 1978"
    )
    transient_times: tuple[tuple[float, int], ...] = chosen(
        ((0.1, 5), (0.02, 9)),
        "segment, half periods",
        "Time constants of the transients of a smooth gap, and the order in which each is tested.",
    )
    largest_moving_average: float = chosen(0.97, "-", "Largest moving-average coefficient of the noise.")
    finest_region: int = chosen(16, "-", "Regions in time are no shorter than one over this of a record.")
    fewest_of_a_region: int = chosen(3, "samples", "Samples of the smallest region.")
    fewest_for_correlation: int = chosen(
        30, "samples", "Samples below which the stress noise of a record is taken as white."
    )
    least_noise: float = chosen(
        1e-6, "stress range", "Least noise of a record: synthetic records without noise do not get all of the weight."
    )
    negligible_propagated: float = chosen(
        0.1, "-", "Propagated strain noise along one direction, over the scatter of the stress, that is left out."
    )
    speed_wander: float = chosen(
        3e-3, "speed", "Standard deviation of a machine's speed at one frequency: a servo-hydraulic supply's."
    )
    wander_cycles: int = chosen(
        24, "cycles per record", "Frequencies up to which a speed may wander: faster ones are damped."
    )
    strain_beyond_chance: float = chosen(
        3.0,
        "standard deviations",
        "Standard deviations by which the stress must show that the recorded strain is real before it is not smoothed.",
    )
    local_parts: int = chosen(
        8, "parts", "Parts of a record in which the local noise variance is estimated for that choice."
    )
    least_local_variance: float = chosen(0.01, "-", "Least local noise variance in that choice, over its mean.")
    smooth_waves: int = chosen(12, "half periods", "Cosine waves along a record that a gap, not noise, may hold.")
    fewest_for_a_transient: int = chosen(
        20, "samples", "Intervals from which on a segment has transients of a smooth gap."
    )
    segments: int = chosen(12, "segments", "Segments of a record on which polynomials take all but the noise.")
    segment_degree: int = chosen(5, "-", "Degree of these polynomials.")
    lowest_frequency: float = chosen(2e-3, "rad per sample", "Lower end of the bins of a spectrum.")
    long_run_frequency: float = chosen(
        1e-3, "rad per sample", "Frequency at which a spectrum's shape counts as uncertain: the noise of slow averages."
    )
    solid_bin: float = chosen(10.0, "coefficients", "Coefficients of a bin from which on it may be dim.")
    dim_weight: float = chosen(0.02, "-", "Part of its weight that a dim bin keeps.")
    no_rise_margin: float = chosen(
        3.0,
        "lowest frequency",
        "Distance of phi from 1, over the lowest frequency that was looked at, of noise that does not rise there.",
    )
    low_rise_margin: float = chosen(0.7, "lowest frequency", "The same of noise that may rise there.")
    least_largest_phi: float = chosen(0.1, "-", "Largest phi that is tried however short a record.")
    smallest_phi: float = chosen(-0.7, "-", "Smallest phi that is tried.")
    low_coefficients: int = chosen(
        8, "coefficients", "Lowest coefficients of a segment, whose power over the others' shows a transient."
    )
    least_left: float = chosen(
        0.3, "-", "Part of a cosine coefficient that a projection must leave for it to count in a spectrum."
    )
    own_shape_errors: float = chosen(
        3.0, "standard deviations", "Gain of a spectrum's shape for each record, beyond chance, that shared ones lack."
    )
    prediction_margin: float = chosen(
        1.5, "standard errors", "Standard errors of a predicted spectrum by which its power may be exceeded."
    )
    level_variance_of_few: float = chosen(
        5.0, "over the samples", "Variance of the logarithm of a level by robust differences, times the samples."
    )
    least_level_of_few: float = chosen(
        0.1, "scatter of differences", "Least noise of a short record: the median of few differences is uncertain."
    )
    growth_window: int = chosen(
        5,
        "samples",
        "Second differences over which a size of the noise is averaged before it is held against the strain.",
    )
    least_size: float = chosen(0.05, "mean size", "Least of these sizes.")
    growth_memory: float = chosen(7.0, "samples", "Of these sizes so many count as one: neighbours share samples.")
    force_slope: float = chosen(0.5, "-", "Slope of the logarithm of the size over the strain of force noise; it is 1.")
    force_slope_errors: float = chosen(3.0, "standard errors", "Standard errors of that slope, too.")
    clipped_size: float = chosen(5.0, "mean size", "Largest size that the moving mean of sizes sees.")
    least_followed_size: float = chosen(0.1, "median size", "Least value of that moving mean.")
    cluster_spacing: int = chosen(6, "samples", "Distance of the sizes whose correlation shows clusters.")
    fewest_for_clusters: int = chosen(12, "sizes", "Such sizes up to which nothing is said of clusters.")
    size_variance: float = derived(
        0.57, "-", "Variance of one size over its squared mean.", source="normal noise: pi/2 - 1"
    )
    chance_of_sizes: float = chosen(1.5, "-", "Factor of the variance that a moving mean of sizes has by chance.")
    outlier_sides: float = chosen(0.25, "distance", "Most that the two sides of an outlier may differ.")
    strain_regions: int = chosen(6, "regions", "Regions of the strain range.")
    most_rate_regions: int = chosen(5, "regions", "Regions of the strain rate at most, one a decade.")
    least_rate_range: float = chosen(0.3, "decades", "Range of the rates from which on they are parted in regions.")
    rate_ends: tuple[float, float] = chosen((0.01, 0.99), "-", "Quantiles of the rate that are the ends of that range.")
    dwell_rate: float = chosen(0.02, "median rate", "Strain rate below which a record dwells.")
    fewest_for_inflation: int = chosen(20, "samples", "Samples below which a residual is taken as white.")
    correlation_lengths: float = chosen(
        4.0, "correlation lengths", "Lags, over the correlation length, over which a residual is correlated."
    )
    quieting_window: int = chosen(
        50,
        "-",
        "Where effects hand the recorded stress back, half the window that smooths it is one over this of a record.",
    )
    quieting_draws: int = chosen(
        19,
        "draws",
        "Draws of a record's noise; the largest of their slow parts is what noise may have: one null in 20 has more.",
    )
    scatter_draws: int = chosen(6000, "steps", "Metropolis steps of the posterior of the specimens' scatter.")
    scatter_burn_in: int = chosen(1000, "steps", "The first of them, which adapt the steps and are left out.")
    most_with_strain_noise: int = chosen(
        3000,
        "samples",
        "Samples up to which a record's strain noise has a matrix; that of 3000 takes about 3 s to make and factor.",
    )
    not_as_stated: float = chosen(
        1.5, "-", "Estimated over stated noise of the stress from which on a diagnosis says that they differ."
    )
    tenfold: float = chosen(10.0, "-", "Ratio of the records' noise from which on it is noted.")


NOISE = NoiseSettings()
