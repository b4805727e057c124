"""Prior probabilities, evidence, and what is reported of explanations: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import calibrated, chosen


@dataclass(frozen=True)
class EvidenceSettings:
    """Prior probabilities, evidence, and what is reported of explanations."""

    no_effect: float = chosen(0.45, "probability", "Prior probability that no effect is needed.")
    one_effect: float = chosen(0.33, "probability", "Prior probability of one effect of the catalogue.")
    two_effects: float = chosen(0.12, "probability", "Prior probability of two effects of the catalogue.")
    three_effects: float = chosen(0.01, "probability", "Prior probability of three effects of the catalogue.")
    unknown_effect: float = calibrated(
        0.08,
        "probability",
        "Prior probability of an effect outside the catalogue.",
        source="docs/blind-results.md: calibrate, seed 43",
    )
    unknown_with_known: float = calibrated(
        0.01,
        "probability",
        "Prior probability of an effect outside the catalogue jointly with one of it.",
        source="docs/blind-results.md: calibrate, seed 43",
    )
    evidence_power: float = calibrated(
        0.4,
        "-",
        "Power of the evidence, which believes in its forms and its noise more than these deserve: the one by which "
        "the probabilities of causes come true, found on sealed campaigns of the split that is for it.",
        source="docs/blind-results.md: calibrate, seed 43",
    )
    undeclared_gap_power: float = calibrated(
        0.2,
        "-",
        "Of gaps that are not declared, P(p-value of the gap test < p) = p to this power, found on the same "
        "campaigns; without a gap it is p.",
        source="docs/blind-results.md: calibrate, seed 43",
    )
    again_in_another_record: float = chosen(
        0.03,
        "-",
        "Prior probability of an effect in one more record, in a form and a size of its own, over that of its not "
        "acting there.",
    )
    about_as_probable: float = chosen(
        12.0,
        "log evidence",
        "Log evidence within which forms of one effect are discriminated by how well they fit as they are.",
    )
    unseen_second_effect: float = calibrated(
        0.2,
        "-",
        "Evidence, to its power, for a second effect that is too weak to show, over that without it: its freedom "
        "costs little and gains nothing. So what was probable beforehand of two effects stays so, shared out to "
        "those that were not tried.",
        source="docs/blind-results.md: calibrate, seed 43",
    )
    noted_with_others: float = chosen(
        0.05,
        "probability",
        "Probability from which on a single effect is reported with others that may act jointly, unseen.",
    )
    credible_set: float = chosen(0.95, "probability", "Probability that an answer set holds.")
    discrepancy_softness: tuple[float, ...] = chosen(
        (2.0, 1.0),
        "-",
        "The spectrum of a discrepancy falls with the order of its waves to these powers, half of its energy each.",
    )
    roughest_discrepancy: int = chosen(
        24, "half periods", "Half periods per record up to which a discrepancy is looked for."
    )
    common_discrepancy: int = chosen(
        12,
        "half periods",
        "Half periods over the strain up to which one that is the same in all records is looked for.",
    )
    form_errors: tuple[float, ...] = chosen(
        (0.0, 0.04, 0.08, 0.16, 0.32),
        "-",
        "Relative errors of an effect's form along its own coordinate that are allowed for: standard deviations of "
        "the coefficients of its freedom.",
    )
    form_error_weights: tuple[float, ...] = chosen(
        (0.4, 0.2, 0.2, 0.12, 0.08), "probability", "How probable these errors of a form are beforehand."
    )
    form_waves: int = chosen(
        4, "polynomials", "Polynomials along an effect's own coordinate by which its form may be wrong."
    )
    form_rest: float = chosen(
        0.25, "-", "Error of a form that is no function of its own coordinate, record by record, over that along it."
    )
    rig_form_error: float = chosen(
        0.25, "-", "Error of the form of a rig's fault over that of a material's effect, which has no formula."
    )
    unknown_range: tuple[float, float] = chosen(
        (10.0**0.5, 10.0**8.5),
        "noise variance",
        "Energy of an unknown effect in one record, least and largest; log-uniform.",
    )
    unknown_of_the_strain: float = chosen(
        0.2, "probability", "Prior share of an unknown effect that is one function of the strain."
    )
    unknown_periodic: float = chosen(0.1, "probability", "Prior share of one that is periodic in the strain.")
    unknown_of_the_specimen: float = chosen(0.2, "probability", "Prior share of other parameters in each record.")
    unknown_in_all: float = chosen(0.2, "probability", "Prior share of one size in all records.")
    unknown_in_one: float = chosen(0.2, "probability", "Prior share of one record only.")
    unknown_in_each: float = chosen(0.1, "probability", "Prior share of a size of its own in each record.")
    unknown_records_tried: int = chosen(2, "records", "Records that are tried alone, those with the most left.")
    fewest_to_leave_out: int = chosen(3, "records", "Records below which none can be left out.")
    left_out_gap: float = chosen(
        2.0,
        "standard deviations",
        "Standard deviations by which the misfit of records that the others predict by the base law must exceed its "
        "expectation for a part of it to be reported as explained.",
    )
    voting_error: float = chosen(
        3.0,
        "amplitude",
        "Standard error of an amplitude in one record, over the amplitude in all, from which on that record has no "
        "vote on whether they agree.",
    )
    disagreement_level: float = chosen(
        0.001,
        "-",
        "Below this p-value, and with the amplitude scattering by `disagreement_scatter`, records are said to want "
        "different ones.",
    )
    disagreement_scatter: float = chosen(
        0.25, "-", "Relative scatter of the amplitude from which on records are said to want different ones."
    )
    uninformed: float = chosen(
        0.9, "prior deviations", "A standard error above so much of the prior's means that the data add nothing."
    )
    held_out_misfit: float = chosen(
        4.0,
        "standard deviations",
        "Standard deviations by which a record's misfit exceeds what an explanation, were it right, would make of it.",
    )
    held_out_penalty: float = chosen(
        0.01,
        "probability",
        "Part of its probability that an explanation keeps which makes the prediction of a held-out record worse.",
    )
    tolerated_form_error: float = chosen(
        0.2, "-", "Relative error of an effect's form along its own coordinate that the test of what is left lets pass."
    )
    reported_remainder: float = chosen(
        0.25,
        "-",
        "Part of what evidence lets pass beyond which a gap is reported as left: it is real, whatever its cause.",
    )
    most_left: float = calibrated(
        1.5,
        "-",
        "Misfit after an explanation, over the noise and over what any smooth correction leaves, beyond which it "
        "explains too little, however its form may be wrong; over the noise alone where what is left is mostly a "
        "function of a recorded variable, or a good part of the gap (`explained_part`). "
        "Right explanations of sealed campaigns leave 0.9 to 1.2 times the noise.",
        source="docs/blind-results.md: calibrate, seed 43",
    )
    explained_part: float = chosen(
        0.8,
        "-",
        "Part of the squared gap beyond the noise that an explanation closes at least, unless it leaves less than "
        "`most_left` times the noise. None of 78 campaigns of three laboratories (seeds 140001) does between the two.",
    )
    share_worth_naming: float = chosen(
        0.01, "-", "Part of the gap below which an effect is not named jointly with those that close the rest."
    )
    half_of_the_gap: float = chosen(
        0.5, "-", "Known effects that close less than this part, with less than an even chance, only come nearest."
    )
    mostly_slow: float = chosen(
        4.0,
        "-",
        "Noise over what readings scatter by from one to the next beyond which a headline that sees no gap says so: "
        "what is slow may be none.",
    )
    other_measure: float = chosen(
        0.9,
        "-",
        "Part of the squared misfit that closes where a column is taken for engineering stress or strain, from which "
        "on that is asked.",
    )
    other_rate: float = chosen(1.2, "-", "Ratio of two rates of tests from which on they are meant to differ.")
    least_part: float = chosen(
        0.05,
        "-",
        "Known effects that leave a gap and close less than this part of it only come nearest, however likely.",
    )
    even_chance: float = chosen(0.5, "probability", "That chance.")
    far_behind: float = chosen(
        100.0,
        "log evidence",
        "So far behind an explanation that leaves a gap, another is not one that the tests cannot distinguish from it.",
    )
    nearly_all: float = chosen(
        0.9,
        "-",
        "Part of what an explanation closes from which on one of its effects alone closes nearly all of it: several "
        "such effects can stand in for each other, and have no shares of their own.",
    )
    probability_worth_naming: float = chosen(
        0.01, "probability", "Probability from which on an effect is listed that is not in the best explanation."
    )
    negligible_form_error: float = chosen(1e-3, "-", "Mean relative error of a form below which it is taken for exact.")
    least_p_value: float = chosen(1e-12, "probability", "Smaller p-values are reported as this.")
    held_out_draws: int = chosen(
        400,
        "draws",
        "Draws of a held-out record's noise, by which the misfit of an explanation is known to change by chance.",
    )
    closure_gap: float = chosen(
        2.0,
        "standard errors",
        "Mean square of a gap over its standard error up to which no explained fraction is stated.",
    )
    closure_draws: int = chosen(1000, "draws", "Bootstrap draws of the interval of the explained fraction.")
    fewest_resampled: int = chosen(6, "records", "Records from which on that bootstrap resamples whole records.")
    closure_blocks: int = chosen(8, "parts", "Contiguous parts that are resampled instead where there is one record.")
    closure_coverage: float = chosen(0.9, "probability", "Coverage of the interval of the explained fraction.")
    same_amplitude: float = chosen(
        0.01, "probability", "p-value below which an amplitude is said to differ from record to record."
    )
    remaining_draws: int = chosen(2000, "draws", "Draws of the null of the test of what an explanation leaves.")
    unknown_sizes: int = chosen(
        17, "sizes", "Sizes of an unknown effect that are weighed, evenly spaced in the logarithm."
    )
    unknown_settled: float = chosen(
        0.1, "log evidence", "Gain of a round over the records below which their own sizes are found."
    )


EVIDENCE = EvidenceSettings()
