"""Where a search for the law begins, and which values it is doubted at: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class IdentificationSettings:
    """Where a search for the law begins, and which values it is doubted at."""

    likely_moduli: tuple[float, float] = chosen(
        (1e-3, 1e6), "MPa", "Unrelaxed moduli that are not warned of, from the softest gel to diamond."
    )
    samples_of_first_slope: int = chosen(20, "samples", "First samples whose steepest secant bounds E_u from below.")
    least_part_of_strain: float = chosen(
        0.1, "largest strain", "Strain of these samples below which a secant is not taken."
    )
    modulus_over_first_slope: float = chosen(1.3, "-", "E_u over that secant.")
    far_modulus: float = chosen(
        3.0,
        "-",
        "Factor between a fitted E_u and the one of the first slope from which on the search begins there, too.",
    )
    early_part_of_strain_noise: float = chosen(
        0.3,
        "-",
        "Part of what makes strain noise matter from which on it is drawn again on a record too long for a matrix.",
    )
    beyond_records: float = chosen(
        1e3, "-", "How far beyond the records' own times tau_max is searched, and how far from 1 alpha."
    )
    edge: float = chosen(
        1.05, "-", "Factor from an end of the search for tau_max within which a minimum is at its edge."
    )
    beyond_edge: float = chosen(
        100.0,
        "-",
        "Factor by which tau_max is moved beyond such an edge: parameters that follow are not identified.",
    )
    profile_reach: float = chosen(
        1.25, "95 % quantile", "Signed root of the deviance up to which a likelihood profile is followed."
    )
    walkers: int = chosen(16, "walkers", "Walkers of the ensemble that samples the posterior.")
    burn_in: int = chosen(300, "steps", "Its first steps, which are dropped.")
    thinned: int = chosen(10, "steps", "Of the others one step in so many is kept.")
    nominal_coverage: float = chosen(0.95, "probability", "Coverage that intervals should have.")
    coverage_confidence: float = chosen(
        0.99, "probability", "Confidence of the interval of a coverage that was counted, which must contain it."
    )
    least_coverage: float = chosen(
        0.85, "probability", "A study says that intervals hold if its draws can exclude intervals of this coverage."
    )


IDENTIFICATION = IdentificationSettings()
