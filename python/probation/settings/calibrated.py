"""The campaigns on which the probabilities of a diagnosis were calibrated: the ranges that the first 60 cover."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import calibrated, chosen

_SOURCE = "the first 60 campaigns of calibrate, seed 43: python -m bench.calibrated_ranges"
_ELSEWHERE = "docs/laboratories.md, tuned in turn: python -m bench.in_turn"


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
    scatter: tuple[float, float] = calibrated(
        (0.0, 0.0), "-", "Standard deviation between specimens, of what they differ in most.", source=_SOURCE
    )
    law: str = calibrated("modal law", "-", "The law whose errors were explained.", source=_SOURCE)
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
    fall_with_distance: float = calibrated(
        0.88,
        "-",
        "Outside these ranges the odds of known effects fall with their distance D in log evidence from the best "
        "explanation as (1 + D) to minus this power.",
        source=_ELSEWHERE,
    )
    unknown_power_outside: float = calibrated(
        0.016,
        "-",
        "Power to which evidence counts there where an effect outside the catalogue acts: it has no form to be wrong.",
        source=_ELSEWHERE,
    )
    odds_of_two: float = calibrated(
        0.07,
        "-",
        "Odds there of two known effects over a single one, both as far from the best explanation.",
        source=_ELSEWHERE,
    )
    odds_of_three: float = calibrated(0.0015, "-", "Odds there of three known effects or more.", source=_ELSEWHERE)
    odds_of_unknown: float = calibrated(0.15, "-", "Odds there of an effect outside the catalogue.", source=_ELSEWHERE)
    odds_of_unknown_with_known: float = calibrated(
        0.0002, "-", "Odds there of an effect outside the catalogue jointly with known ones.", source=_ELSEWHERE
    )
    most_unknown_outside: float = calibrated(
        0.2,
        "probability",
        "Most that an effect outside the catalogue keeps there where a known explanation leads it by `plain_lead`.",
        source="docs/laboratories-seeds.md, plain single effects: seeds 19001 to 19003",
    )
    plain_lead: float = calibrated(
        5.0,
        "log evidence",
        "Lead of the best known explanation over an effect outside the catalogue from which on that holds.",
        source="docs/laboratories-seeds.md, plain single effects: seeds 19001 to 19003",
    )
    said_elsewhere: tuple[float, float] = calibrated(
        (0.44, 0.67),
        "probability",
        "Of what leads, in the mean over declared gaps of other laboratories: the least, and the most of any.",
        source=_ELSEWHERE,
    )
    right_elsewhere: tuple[float, float] = calibrated(
        (0.38, 0.74), "-", "Part of these gaps in which it was right, likewise.", source=_ELSEWHERE
    )
    right_with_a_gap_left: float = calibrated(
        0.17,
        "-",
        "Part of these gaps in which it was right though the test for a gap rejects what it leaves.",
        source="docs/laboratories.md, verdict of the first table: 63 gaps",
    )
    held_elsewhere: tuple[float, float] = calibrated(
        (0.68, 0.89),
        "-",
        "Part of declared gaps of other laboratories whose answer sets held the truth: the least, and the most of any.",
        source=_ELSEWHERE,
    )


CALIBRATED = CalibratedRanges()
