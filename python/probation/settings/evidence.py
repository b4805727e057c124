"""Prior probabilities, evidence, and what is reported of explanations: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class EvidenceSettings:
    """Prior probabilities, evidence, and what is reported of explanations."""

    no_effect: float = setting(
        0.45,
        "Prior probability that no effect is needed.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    one_effect: float = setting(
        0.33,
        "Prior probability of one effect of the catalogue.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    two_effects: float = setting(
        0.12,
        "Prior probability of two effects of the catalogue.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    three_effects: float = setting(
        0.01,
        "Prior probability of three effects of the catalogue.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    unknown_effect: float = setting(
        0.08,
        "Prior probability of an effect outside the catalogue.",
        unit="probability",
        origin="calibrated",
        source="docs/blind-results.md: calibrate, seed 43",
        used_in="diagnosis/probabilities.py",
    )
    unknown_with_known: float = setting(
        0.01,
        "Prior probability of an effect outside the catalogue jointly with one of it.",
        unit="probability",
        origin="calibrated",
        source="docs/blind-results.md: calibrate, seed 43",
        used_in="diagnosis/probabilities.py",
    )
    evidence_power: float = setting(
        0.4,
        (
            "Power of the evidence, which believes in its forms and its noise more than these deserve: "
            "the one by which the probabilities of causes come true, found on sealed campaigns of the "
            "split that is for it."
        ),
        unit="-",
        origin="calibrated",
        source="docs/blind-results.md: calibrate, seed 43",
        used_in="diagnosis/calibration.py",
    )
    undeclared_gap_power: float = setting(
        0.2,
        (
            "Of gaps that are not declared, P(p-value of the gap test < p) = p to this power, found on the same "
            "campaigns; without a gap it is p."
        ),
        unit="-",
        origin="calibrated",
        source="docs/blind-results.md: calibrate, seed 43",
        used_in="diagnosis/probabilities.py",
    )
    again_in_another_record: float = setting(
        0.03,
        (
            "Prior probability of an effect in another record, too, in another form or size, over that of "
            "its being in one."
        ),
        unit="-",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    left_to_an_unknown: float = setting(
        0.9,
        ("Part of an explanation's probability that goes to it jointly with an unknown where a gap is left after it."),
        unit="-",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    about_as_probable: float = setting(
        12.0,
        ("Log evidence within which forms of one effect are discriminated by how well they fit as they are."),
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    unseen_second_effect: float = setting(
        0.2,
        (
            "Evidence, to its power, for a second effect that is too weak to show, over that without it: "
            "its freedom costs little and gains nothing. So what was probable beforehand of two effects "
            "stays so, shared out to those that were not tried."
        ),
        unit="-",
        origin="calibrated",
        source="docs/blind-results.md: calibrate, seed 43",
        used_in="diagnosis/probabilities.py",
    )
    noted_with_others: float = setting(
        0.05,
        ("Probability from which on a single effect is reported with others that may act jointly, unseen."),
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    credible_set: float = setting(
        0.95,
        "Probability that an answer set holds.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    discrepancy_softness: tuple[float, ...] = setting(
        (2.0, 1.0),
        ("The spectrum of a discrepancy falls with the order of its waves to these powers, half of its energy each."),
        unit="-",
        origin="chosen",
        used_in="inference/discrepancy.py",
    )
    roughest_discrepancy: int = setting(
        24,
        "Half periods per record up to which a discrepancy is looked for.",
        unit="half periods",
        origin="chosen",
        used_in="inference/discrepancy.py",
    )
    common_discrepancy: int = setting(
        12,
        "Half periods over the strain up to which one that is the same in all records is looked for.",
        unit="half periods",
        origin="chosen",
        used_in="inference/discrepancy.py",
    )
    form_errors: tuple[float, ...] = setting(
        (0.0, 0.04, 0.08, 0.16, 0.32),
        (
            "Relative errors of an effect's form along its own coordinate that are allowed for: standard deviations "
            "of the coefficients of its freedom."
        ),
        unit="-",
        origin="chosen",
        used_in="inference/evidence.py",
    )
    form_error_weights: tuple[float, ...] = setting(
        (0.4, 0.2, 0.2, 0.12, 0.08),
        "How probable these errors of a form are beforehand.",
        unit="probability",
        origin="chosen",
        used_in="inference/evidence.py",
    )
    form_waves: int = setting(
        4,
        "Polynomials along an effect's own coordinate by which its form may be wrong.",
        unit="polynomials",
        origin="chosen",
        used_in="inference/form_error.py",
    )
    form_rest: float = setting(
        0.25,
        "Error of a form that is no function of its own coordinate, record by record, over that along it.",
        unit="-",
        origin="chosen",
        used_in="inference/evidence.py",
    )
    rig_form_error: float = setting(
        0.25,
        "Error of the form of a rig's fault over that of a material's effect, which has no formula.",
        unit="-",
        origin="chosen",
        used_in="inference/form_error.py",
    )
    unknown_range: tuple[float, float] = setting(
        (10.0**0.5, 10.0**8.5),
        "Energy of an unknown effect in one record, least and largest; log-uniform.",
        unit="noise variance",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_of_the_strain: float = setting(
        0.2,
        "Prior share of an unknown effect that is one function of the strain.",
        unit="probability",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_periodic: float = setting(
        0.1,
        "Prior share of one that is periodic in the strain.",
        unit="probability",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_of_the_specimen: float = setting(
        0.2,
        "Prior share of other parameters in each record.",
        unit="probability",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_in_all: float = setting(
        0.2,
        "Prior share of one size in all records.",
        unit="probability",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_in_one: float = setting(
        0.2,
        "Prior share of one record only.",
        unit="probability",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_in_each: float = setting(
        0.1,
        "Prior share of a size of its own in each record.",
        unit="probability",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    unknown_records_tried: int = setting(
        2,
        "Records that are tried alone, those with the most left.",
        unit="records",
        origin="chosen",
        used_in="inference/unknown.py",
    )
    fewest_to_leave_out: int = setting(
        3,
        "Records below which none can be left out.",
        unit="records",
        origin="chosen",
        used_in="diagnosis/checks.py",
    )
    disagreement_level: float = setting(
        0.001,
        (
            "Below this p-value, and with the amplitude scattering by `disagreement_scatter`, records are "
            "said to want different ones."
        ),
        unit="-",
        origin="chosen",
        used_in="diagnosis/checks.py",
    )
    disagreement_scatter: float = setting(
        0.25,
        "Relative scatter of the amplitude from which on records are said to want different ones.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/checks.py",
    )
    uninformed: float = setting(
        0.9,
        "A standard error above so much of the prior's means that the data add nothing.",
        unit="prior deviations",
        origin="chosen",
        used_in="diagnosis/explain.py",
    )
    held_out_misfit: float = setting(
        4.0,
        (
            "Standard deviations by which a record's misfit exceeds what an explanation, were it right, "
            "would make of it."
        ),
        unit="standard deviations",
        origin="chosen",
        used_in="diagnosis/held_out.py",
    )
    held_out_penalty: float = setting(
        0.01,
        ("Part of its probability that an explanation keeps which makes the prediction of a held-out record worse."),
        unit="probability",
        origin="chosen",
        used_in="diagnosis/held_out.py",
    )
    tolerated_form_error: float = setting(
        0.2,
        ("Relative error of an effect's form along its own coordinate that the test of what is left lets pass."),
        unit="-",
        origin="chosen",
        used_in="diagnosis/remaining.py",
    )
    reported_remainder: float = setting(
        0.25,
        ("Part of what evidence lets pass beyond which a gap is reported as left: it is real, whatever its cause."),
        unit="-",
        origin="chosen",
        used_in="diagnosis/remaining.py",
    )
    most_left: float = setting(
        1.5,
        (
            "Misfit after an explanation, over the noise and over what any smooth correction leaves, "
            "beyond which it explains too little, however its form may be wrong. Right explanations of "
            "sealed campaigns leave 0.9 to 1.2 times the noise."
        ),
        unit="-",
        origin="calibrated",
        source="docs/blind-results.md: calibrate, seed 43",
        used_in="diagnosis/remaining.py",
    )
    share_worth_naming: float = setting(
        0.01,
        "Part of the gap below which an effect is not named beside those that close the rest.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/attribution.py",
    )
    probability_worth_naming: float = setting(
        0.01,
        "Probability from which on an effect is listed that is not in the best explanation.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/attribution.py",
    )
    negligible_form_error: float = setting(
        1e-3,
        "Mean relative error of a form below which it is taken for exact.",
        unit="-",
        origin="chosen",
        used_in="inference/evidence.py",
    )
    least_p_value: float = setting(
        1e-12,
        "Smaller p-values are reported as this.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/probabilities.py",
    )
    held_out_draws: int = setting(
        400,
        "Draws of the parameters with which a held-out record is predicted.",
        unit="draws",
        origin="chosen",
        used_in="diagnosis/held_out.py",
    )
    closure_draws: int = setting(
        1000,
        "Bootstrap draws of the interval of the explained fraction.",
        unit="draws",
        origin="chosen",
        used_in="diagnosis/closure.py",
    )
    fewest_resampled: int = setting(
        6,
        "Records from which on that bootstrap resamples whole records.",
        unit="records",
        origin="chosen",
        used_in="diagnosis/closure.py",
    )
    closure_blocks: int = setting(
        8,
        "Contiguous parts that are resampled instead where there is one record.",
        unit="parts",
        origin="chosen",
        used_in="diagnosis/closure.py",
    )
    closure_coverage: float = setting(
        0.9,
        "Coverage of the interval of the explained fraction.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/closure.py",
    )


EVIDENCE = EvidenceSettings()
