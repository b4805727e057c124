"""Whether a law departs from its records, and where: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class DetectionSettings:
    """Whether a law departs from its records, and where."""

    gap_level: float = setting(
        0.005,
        (
            "A gap is declared below this p-value. Of false alarms of 1 % half is left for noise that is not as it was "
            "modelled."
        ),
        unit="-",
        origin="chosen",
        used_in="detection/gap_test.py",
    )
    low_noise: float = setting(
        0.8,
        "Noise, over what is estimated, with which the test for a gap is repeated: less than estimated.",
        unit="-",
        origin="chosen",
        used_in="detection/gap_test.py",
    )
    high_noise: float = setting(
        1.25,
        "The same for more than estimated; a gap must be significant there, too.",
        unit="-",
        origin="chosen",
        used_in="detection/gap_test.py",
    )
    tolerance: float = setting(
        0.001,
        (
            "Gap, over the largest stress of its record, that is said not to matter: a fifth of the permissible error "
            "of force of a testing machine of class 0.5."
        ),
        unit="largest stress",
        origin="chosen",
        source="ISO 7500-1",
        used_in="inference/gap.py",
    )
    smooth_orders: tuple[int, ...] = setting(
        (2, 5, 12),
        (
            "Half periods per record of the smooth waves of each test: a broad gap is detected with few, a wavy one "
            "with many; the last is all that `smooth_basis` has."
        ),
        unit="half periods",
        origin="chosen",
        used_in="detection/gap_test.py",
    )
    record_order: int = setting(
        6,
        "Order of the smooth waves that are tested in one record alone.",
        unit="half periods",
        origin="chosen",
        used_in="detection/gap_test.py",
    )
    directed_share: float = setting(
        0.7,
        "Part of the level that is spent on the directions of known effects, where there are any.",
        unit="-",
        origin="chosen",
        used_in="detection/gap_test.py",
    )
    most_places_left_out: int = setting(
        8,
        "Places that are left out at most, and that are tried each time.",
        unit="places",
        origin="chosen",
        used_in="detection/place_left_out.py",
    )
    least_gain_of_a_place: float = setting(
        20.0,
        ("Sum of squares over what its samples would have by noise that leaving a place out must take away."),
        unit="noise variances",
        origin="chosen",
        used_in="detection/place_left_out.py",
    )
    least_share_kept: float = setting(
        0.5,
        "Part of all samples that stays in the fit.",
        unit="-",
        origin="chosen",
        used_in="detection/place_left_out.py",
    )
    bump_widths: tuple[float, ...] = setting(
        (0.015, 0.03),
        "Standard deviations of the bumps that are looked for, as parts of the largest strain.",
        unit="largest strain",
        origin="chosen",
        used_in="detection/recurring.py",
    )
    fewest_bump_samples: int = setting(
        3,
        "Samples within a bump's standard deviation that a record needs to be asked.",
        unit="samples",
        origin="chosen",
        used_in="detection/recurring.py",
    )
    hidden_bump_share: float = setting(
        0.2,
        "Part of a bump that slow waves leave, below which nothing is asked of it.",
        unit="-",
        origin="chosen",
        used_in="detection/recurring.py",
    )
    strain_periodic_level: float = setting(
        0.0001,
        ("p-value below which a strain-periodic component may explain something (`strain_periodic_waves`)."),
        unit="-",
        origin="chosen",
        used_in="detection/strain_periodic.py",
    )
    harmonics: tuple[int, ...] = setting(
        (1, 4, 16),
        "The first so many are added up: a wave has one, teeth have many.",
        unit="-",
        origin="chosen",
        used_in="detection/strain_periodic.py",
    )
    fewest_teeth: int = setting(
        4,
        (
            "Jumps that a record must have for a comb: samples are cut to the height of the fourth; a "
            "slip or two are none."
        ),
        unit="jumps",
        origin="chosen",
        used_in="detection/strain_periodic.py",
    )
    shortest_strain_period: int = setting(
        8,
        "Samples per period, on the average, of the shortest strain period that is searched.",
        unit="samples",
        origin="chosen",
        used_in="detection/strain_periodic.py",
    )
    shortest_harmonic: float = setting(
        2.5,
        "Samples per period, on the average, of the highest harmonic: above two.",
        unit="samples",
        origin="derived",
        source="waves alias at two samples per period",
        used_in="detection/strain_periodic.py",
    )
    slowest_line: int = setting(
        8,
        ("Half periods per record from which on a wave counts as periodic; slower ones are a smooth gap."),
        unit="half periods",
        origin="chosen",
        used_in="detection/lines_and_steps.py",
    )
    step_candidates: int = setting(
        128,
        "Instants per record at which a step is first looked for.",
        unit="instants",
        origin="chosen",
        used_in="detection/lines_and_steps.py",
    )
    step_neighbours: tuple[int, ...] = setting(
        (6, 14),
        "Samples on each side of a step by which the noise there is judged, closely and less so.",
        unit="samples",
        origin="chosen",
        used_in="detection/lines_and_steps.py",
    )
    burst_samples: int = setting(
        4,
        "Neighbouring samples that a short burst of noise moves together.",
        unit="samples",
        origin="chosen",
        used_in="detection/lines_and_steps.py",
    )
    line_neighbours: int = setting(
        60,
        "Frequencies whose median power a line is measured against, if that is above the noise's.",
        unit="frequencies",
        origin="chosen",
        used_in="detection/lines_and_steps.py",
    )
    sharp_share: float = setting(
        0.075,
        "Part of the level that is spent on each: lines, steps, strain periods, and bumps that recur.",
        unit="-",
        origin="chosen",
        used_in="detection/sharp_gap.py",
    )
    region_level: float = setting(
        0.01,
        "Familywise level at which a region is reported.",
        unit="-",
        origin="chosen",
        used_in="detection/where.py",
    )
    region_degree: int = setting(
        2,
        (
            "A region's gap is looked for as a parabola over it; as a mean where it has fewer than "
            "`parabola_samples` samples."
        ),
        unit="-",
        origin="chosen",
        used_in="detection/where.py",
    )
    parabola_samples: int = setting(
        12,
        "Samples of a region from which on its gap is looked for as a parabola.",
        unit="samples",
        origin="chosen",
        used_in="detection/where.py",
    )
    outline_waves: int = setting(
        16,
        "Half periods of the smooth curve that draws a gap's outline.",
        unit="half periods",
        origin="chosen",
        used_in="detection/where.py",
    )
    outline_fraction: float = setting(
        0.25,
        ("A gap's region ends where the smooth curve falls below this fraction of its largest value in the record ..."),
        unit="-",
        origin="chosen",
        used_in="detection/where.py",
    )
    outline_errors: float = setting(
        2.0,
        "A gap's region ends where the smooth curve falls below so many standard errors.",
        unit="standard errors",
        origin="chosen",
        used_in="detection/where.py",
    )
    acting_energy: float = setting(
        0.9,
        "Part of an effect's energy in a record that is where it acts.",
        unit="-",
        origin="chosen",
        used_in="detection/where.py",
    )
    negligible_energy: float = setting(
        0.005,
        "Part of its energy in all records below which a record is not one where it acts.",
        unit="-",
        origin="chosen",
        used_in="detection/where.py",
    )
    bridged_interruption: float = setting(
        0.04,
        "Shorter interruptions of a region are bridged.",
        unit="record",
        origin="chosen",
        used_in="detection/where.py",
    )
    shortest_region: float = setting(
        0.01,
        "Shorter regions are left out.",
        unit="record",
        origin="chosen",
        used_in="detection/where.py",
    )
    signature_level: float = setting(
        0.001,
        "p-value, over all records, below which a feature is reported.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/signatures.py",
    )
    scatter_level: float = setting(
        0.01,
        ("p-value, against the scatter between records, below which a parameter is said to change with something."),
        unit="-",
        origin="chosen",
        used_in="diagnosis/signatures.py",
    )
    draws_beyond: int = setting(
        20,
        "Draws beyond the observed value that make a bootstrap p-value; with fewer the tail is extrapolated.",
        unit="draws",
        origin="chosen",
        used_in="detection/tail.py",
    )


DETECTION = DetectionSettings()
