"""The campaigns on which the probabilities of a diagnosis were calibrated: the ranges that the first 60 cover."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import calibrated, chosen

_SOURCE = "the first 60 campaigns of calibrate, seed 43: python -m bench.calibrated_ranges"


@dataclass(frozen=True)
class CalibratedRanges:
    """What the campaigns have on which the probabilities were calibrated, least and most."""

    records: tuple[float, float] = calibrated((3.0, 8.0), "records", "Records that are fitted.", source=_SOURCE)
    samples: tuple[float, float] = calibrated((270.0, 660.0), "samples", "Samples of a record.", source=_SOURCE)
    noise: tuple[float, float] = calibrated(
        (2e-4, 0.08), "-", "Noise of the stress, as a part of the record's largest stress.", source=_SOURCE
    )
    strain_noise: tuple[float, float] = calibrated(
        (0.0, 3e-5), "-", "Noise of the recorded strain from sample to sample.", source=_SOURCE
    )
    gap: tuple[float, float] = calibrated((0.0, 4.8), "-", "Misfit of the base law, over the noise.", source=_SOURCE)
    gap_level_outside: float = calibrated(
        1e-5,
        "-",
        "A gap is declared below this p-value in a campaign outside these ranges, if no record is missed by "
        "`large_misfit_outside`: noise may be unlike any that was tried.",
        source="docs/tried.md: university, seed 71001; industry, seed 71002",
    )
    large_misfit_outside: float = chosen(
        3.0, "noise", "Misfit, over the noise from sample to sample, from which on `gap_level` is enough."
    )
    evidence_power_outside: float = calibrated(
        0.2,
        "-",
        "Power of the evidence of a campaign outside these ranges.",
        source="docs/tried.md: university, seed 8801; industry, seed 8802",
    )
    left_by_forms_outside: float = calibrated(
        0.05,
        "-",
        "Part of what an effect gains that the error of its form may leave there, for which no further effect counts: "
        "a form that is wrong by 22 %.",
        source="docs/laboratories-seeds.md: university, seed 51001; industry, seed 51002",
    )
    doubt_outside: float = calibrated(
        0.3,
        "probability",
        "That the forms of a campaign outside these ranges are so far from the catalogue's that evidence counts to "
        "`power_in_doubt` only.",
        source="docs/tried.md: university, seed 51001; industry, seed 51002",
    )
    power_in_doubt: float = calibrated(
        0.05,
        "-",
        "Power of the evidence where its forms are in doubt.",
        source="docs/tried.md: university, seed 51001; industry, seed 51002",
    )
    strong_doubt_outside: float = calibrated(
        0.15,
        "probability",
        "That a cause has a known name, but its form is so far from the catalogue's that evidence counts to "
        "`power_in_strong_doubt` only: a right cause may be hundreds of log units behind.",
        source="docs/tried.md: seeds 104001 to 104003",
    )
    power_in_strong_doubt: float = calibrated(
        0.005,
        "-",
        "Power of the evidence there: what is thousands of log units behind stays impossible.",
        source="docs/tried.md: seeds 104001 to 104003",
    )
    most_unknown_outside: float = calibrated(
        0.2,
        "probability",
        "Most that an effect outside the catalogue keeps outside these ranges where a known explanation leads it by "
        "`plain_lead`: evidence that counts to a low power leaves it ahead by its prior alone.",
        source="docs/laboratories-seeds.md, plain single effects: seeds 19001 to 19003",
    )
    plain_lead: float = calibrated(
        5.0,
        "log evidence",
        "Lead of the best known explanation over an effect outside the catalogue from which on that holds.",
        source="docs/laboratories-seeds.md, plain single effects: seeds 19001 to 19003",
    )
    said_elsewhere: float = calibrated(
        0.54,
        "probability",
        "Of the leading explanation, in the mean over declared gaps of other laboratories.",
        source="docs/laboratories.md: seeds 121001 to 121003 and 122001 to 122003",
    )
    right_elsewhere: tuple[float, float] = calibrated(
        (0.36, 0.49),
        "-",
        "Part of these gaps in which it was right: those of industry, and the institute's.",
        source="docs/laboratories.md: seeds 121001 to 121003 and 122001 to 122003",
    )
    credible_set_outside: float = chosen(
        0.98, "probability", "Probability that an answer set holds of a campaign outside these ranges."
    )


CALIBRATED = CalibratedRanges()
