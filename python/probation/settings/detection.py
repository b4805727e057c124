"""Whether a law departs from its records, and where: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen, derived


@dataclass(frozen=True)
class DetectionSettings:
    """Whether a law departs from its records, and where."""

    gap_level: float = chosen(
        0.005,
        "-",
        "A gap is declared below this p-value. Of false alarms of 1 % half is left for noise that is not as it was "
        "modelled.",
    )
    low_noise: float = chosen(
        0.8, "-", "Noise, over what is estimated, with which the test for a gap is repeated: less than estimated."
    )
    high_noise: float = chosen(
        1.25, "-", "The same for more than estimated; a gap below `fraction_of_noise` must be significant there, too."
    )
    fraction_of_noise: float = chosen(
        0.5,
        "noise",
        "Gap, over the noise, below which it is declared only if it is significant with other models of the noise, "
        "too.",
    )
    trend_level: float = chosen(
        0.02,
        "-",
        "A trend of the specimens' deviations is told below this p-value: it changes no verdict, and looks for a "
        "missing cause where scatter hides it.",
    )
    trend_alike: float = chosen(
        3.0,
        "log likelihood",
        "A variable that the deviations follow less well by less than this is named, too: a ratio of 20, from which "
        "on evidence is strong.",
        source="Kass & Raftery 1995",
    )
    least_specimens: int = chosen(5, "specimens", "Fewer have too few orders for such a p-value.")
    most_orders: int = chosen(5040, "orders", "Orders of specimens that are compared: all of seven.")
    tolerance: float = chosen(
        0.001,
        "largest stress",
        "Gap, over the largest stress of its record, that is said not to matter: a fifth of the permissible error "
        "of force of a testing machine of class 0.5.",
        source="ISO 7500-1",
    )
    smooth_orders: tuple[int, ...] = chosen(
        (2, 5, 12),
        "half periods",
        "Half periods per record of the smooth waves of each test: a broad gap is detected with few, a wavy one "
        "with many; the last is all that `smooth_basis` has.",
    )
    record_order: int = chosen(6, "half periods", "Order of the smooth waves that are tested in one record alone.")
    directed_share: float = chosen(
        0.7, "-", "Part of the level that is spent on the directions of known effects, where there are any."
    )
    most_places_left_out: int = chosen(8, "places", "Places that are left out at most, and that are tried each time.")
    least_gain_of_a_place: float = chosen(
        20.0,
        "noise variances",
        "Sum of squares over what its samples would have by noise that leaving a place out must take away.",
    )
    least_share_kept: float = chosen(0.5, "-", "Part of all samples that stays in the fit.")
    bump_widths: tuple[float, ...] = chosen(
        (0.015, 0.03),
        "largest strain",
        "Standard deviations of the bumps that are looked for, as parts of the largest strain.",
    )
    fewest_bump_samples: int = chosen(
        3, "samples", "Samples within a bump's standard deviation that a record needs to be asked."
    )
    hidden_bump_share: float = chosen(
        0.2, "-", "Part of a bump that slow waves leave, below which nothing is asked of it."
    )
    strain_periodic_level: float = chosen(
        0.0001, "-", "p-value below which a strain-periodic component may explain something (`strain_periodic_waves`)."
    )
    harmonics: tuple[int, ...] = chosen(
        (1, 4, 16), "-", "The first so many are added up: a wave has one, teeth have many."
    )
    fewest_teeth: int = chosen(
        4,
        "jumps",
        "Jumps that a record must have for a comb: samples are cut to the height of the fourth; a slip or two are "
        "none.",
    )
    shortest_strain_period: int = chosen(
        8, "samples", "Samples per period, on the average, of the shortest strain period that is searched."
    )
    shortest_harmonic: float = derived(
        2.5,
        "samples",
        "Samples per period, on the average, of the highest harmonic: above two.",
        source="waves alias at two samples per period",
    )
    slowest_line: int = chosen(
        8,
        "half periods",
        "Half periods per record from which on a wave counts as periodic; slower ones are a smooth gap.",
    )
    step_candidates: int = chosen(128, "instants", "Instants per record at which a step is first looked for.")
    step_recoveries: tuple[float, ...] = chosen(
        (float("inf"), 0.08, 0.025),
        "record",
        "Parts of a record's samples in which the stress recovers from a step: it does not, does slowly, or soon.",
    )
    step_neighbours: tuple[int, ...] = chosen(
        (6, 14), "samples", "Samples on each side of a step by which the noise there is judged, closely and less so."
    )
    burst_samples: int = chosen(4, "samples", "Neighbouring samples that a short burst of noise moves together.")
    negligible_wander: float = chosen(
        0.1, "noise variance", "Energy of a hidden wander of the speed at one frequency below which it is left out."
    )
    line_neighbours: int = chosen(
        60, "frequencies", "Frequencies whose median power a line is measured against, if that is above the noise's."
    )
    sharp_is_no_noise: float = chosen(
        1e-5,
        "p-value",
        "Level below which a step, a line in time, or what is periodic in the strain, is taken out of a residual "
        "before its noise is estimated.",
    )
    most_taken_out: int = chosen(
        4, "-", "So many lines of a record, so many strain periods, and so many steps, are taken out at most."
    )
    noise_without_strain_period: float = chosen(
        0.5,
        "noise",
        "Noise, over that before, that may be left where a strain period is taken out: a screw leaves a tenth.",
    )
    mostly_quieter: float = chosen(
        0.5,
        "-",
        "Median difference of neighbouring samples, over what the noise has it, below which several steps may have "
        "made that noise.",
    )
    sharp_difference: float = chosen(
        6.0,
        "standard deviations",
        "Difference of neighbouring samples, over what the median one tells, from which on it is one of these steps.",
    )
    most_hidden_steps: int = chosen(12, "steps", "So many of these are taken out of a record at most.")
    samples_per_step: int = chosen(40, "samples", "Samples of a record for each of them, at least.")
    left_by_a_step: float = chosen(
        0.5, "-", "Sum of squares around such a step that a recovery may leave; what leaves more is no step."
    )
    noise_without_hidden_steps: float = chosen(
        0.5, "noise", "Noise, over that before, that may be left without all of them."
    )
    samples_per_harmonic: int = chosen(
        80,
        "samples",
        "Samples of a record for each harmonic of a strain period that is taken out: its four columns take away a "
        "twentieth of the noise's variance, each time.",
    )
    sharp_share: float = chosen(
        0.075, "-", "Part of the level that is spent on each: lines, steps, strain periods, and bumps that recur."
    )
    region_level: float = chosen(0.01, "-", "Familywise level at which a region is reported.")
    region_degree: int = chosen(
        2,
        "-",
        "A region's gap is looked for as a parabola over it; as a mean where it has fewer than `parabola_samples` "
        "samples.",
    )
    parabola_samples: int = chosen(
        12, "samples", "Samples of a region from which on its gap is looked for as a parabola."
    )
    outline_waves: int = chosen(16, "half periods", "Half periods of the smooth curve that draws a gap's outline.")
    outline_fraction: float = chosen(
        0.25,
        "-",
        "A gap's region ends where the smooth curve falls below this fraction of its largest value in the record ...",
    )
    outline_errors: float = chosen(
        2.0, "standard errors", "A gap's region ends where the smooth curve falls below so many standard errors."
    )
    acting_energy: float = chosen(0.9, "-", "Part of an effect's energy in a record that is where it acts.")
    negligible_energy: float = chosen(
        0.005, "-", "Part of its energy in all records below which a record is not one where it acts."
    )
    bridged_interruption: float = chosen(0.04, "record", "Shorter interruptions of a region are bridged.")
    shortest_region: float = chosen(0.01, "record", "Shorter regions are left out.")
    signature_level: float = chosen(0.001, "-", "p-value, over all records, below which a feature is reported.")
    scatter_level: float = chosen(
        0.01,
        "-",
        "p-value, against the scatter between records, below which a parameter is said to change with something.",
    )
    gap_draws: int = chosen(4000, "draws", "Draws of the null distribution of the test for a gap.")
    gap_draws_with_scatter: int = chosen(
        16000,
        "draws",
        "The same where the specimens' scatter is drawn, too: its tail is not that of a single p-value, and the level "
        "has to lie within the draws.",
    )
    draws_beyond: int = chosen(
        20,
        "draws",
        "Draws beyond the observed value that make a bootstrap p-value; with fewer the tail is extrapolated.",
    )
    oversampling: int = chosen(
        2,
        "-",
        "Frequencies per natural spacing at which lines and strain periods are looked for; each counts as independent.",
        source="Scargle 1982",
    )
    fewest_for_lines: int = chosen(
        8, "slowest_line", "Samples over that from which on a record is looked through for lines, periods and bumps."
    )
    fewest_for_steps: int = chosen(4, "slowest_line", "The same for steps.")
    least_strain_share: float = chosen(
        0.3, "largest strain range", "Strain range of a record from which on it is looked through for strain periods."
    )
    step_draws: int = chosen(500, "draws", "Draws of the null distribution of the largest step.")
    region_draws: int = chosen(2000, "draws", "Draws of the null distribution of the least probable region.")
    effective_one_in: int = chosen(
        100, "draws", "The largest one in so many draws tells how many independent directions the effects amount to."
    )


DETECTION = DetectionSettings()
