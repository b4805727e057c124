"""What a column can be for: the keys of ``columns`` in a campaign, and the headings that imply them."""

import re
from dataclasses import dataclass

from probation.records.units import measures


@dataclass(frozen=True)
class Role:
    """What a column is for.

    Attributes
    ----------
    unit : str
        The internal unit, as `units` spells it.
    kind : str
        What the unit must measure, with an example, for error messages.
    headings : frozenset of str
        Headings, in the form of `normalised`, that mean this role and nothing else.
    further : frozenset of str
        Those that mean it where no column is headed by one of `headings`: "Stroke" beside "Extension".
    """

    unit: str
    kind: str
    headings: frozenset[str]
    further: frozenset[str]


def _role(unit: str, kind: str, *headings: str, further: tuple[str, ...] = ()) -> Role:
    return Role(unit=unit, kind=kind, headings=frozenset(headings), further=frozenset(further))


_STRAIN_UNIT = "a strain unit such as '-' or '%'"
_STRESS_UNIT = "a stress unit such as 'MPa'"

ROLES: dict[str, Role] = {
    "time": _role(
        *("s", "a time unit such as 's'", "time", "t", "elapsed_time", "test_time"),
        further=(
            *("running_time", "total_time", "timestamp", "x_value", "zeit", "prüfzeit", "pruefzeit", "messzeit"),
            *("temps", "durée", "temps_écoulé", "tempo", "tiempo"),
        ),
    ),
    "true_strain": _role(
        *("dimensionless", _STRAIN_UNIT, "true_strain", "hencky_strain", "log_strain", "logarithmic_strain"),
        further=("wahre_dehnung", "logarithmische_dehnung", "déformation_vraie", "deformation_vraie"),
    ),
    "engineering_strain": _role(
        *("dimensionless", _STRAIN_UNIT, "engineering_strain", "eng_strain", "nominal_strain"),
        further=(
            *("tensile_strain", "axial_strain", "technische_dehnung", "nominelle_dehnung", "zugdehnung"),
            *("extensometer", "axial_extensometer", "extensometer_strain", "feindehnung", "extensomètre"),
            *("déformation_nominale", "déformation_conventionnelle", "deformation_nominale"),
        ),
    ),
    "stretch": _role("dimensionless", _STRAIN_UNIT, "stretch", "stretch_ratio"),
    "displacement": _role(
        *("mm", "a length unit such as 'mm'", "displacement", "extension", "crosshead_displacement", "disp"),
        further=(
            *(
                "stroke",
                "crosshead",
                "crosshead_travel",
                "axial_displacement",
                "tensile_extension",
                "machine_extension",
            ),
            *("standardweg", "traversenweg", "kolbenweg", "weg", "verschiebung"),
            *("déplacement", "deplacement", "déplacement_traverse", "course"),
            *("standard_travel", "spostamento", "corsa", "desplazamiento", "carrera"),
        ),
    ),
    "true_stress": _role(
        *("MPa", _STRESS_UNIT, "true_stress", "cauchy_stress"),
        further=("wahre_spannung", "contrainte_vraie"),
    ),
    "engineering_stress": _role(
        *("MPa", _STRESS_UNIT, "engineering_stress", "eng_stress", "nominal_stress"),
        further=(
            *("tensile_stress", "axial_stress", "technische_spannung", "zugspannung"),
            *("contrainte_nominale", "contrainte_conventionnelle"),
        ),
    ),
    "force": _role(
        *("N", "a force unit such as 'N'", "force", "load"),
        further=(
            *("axial_force", "axial_load", "kraft", "last", "standardkraft", "prüfkraft", "pruefkraft"),
            *("standard_force", "effort", "charge", "forza", "carico", "fuerza", "carga"),
        ),
    ),
    "strain_rate": _role("1/s", "a rate unit such as '1/s'", "strain_rate", "true_strain_rate"),
    "transverse_strain": _role("dimensionless", _STRAIN_UNIT, "transverse_strain", "true_transverse_strain"),
    "temperature": _role(
        *("degC", "a temperature unit such as 'degC'", "temperature", "temp"),
        further=("temperatur", "température", "temperatura"),
    ),
}
VAGUE = {
    "strain": (
        *("strain", "strain_1", "elongation", "dehnung", "verlängerung", "verlaengerung"),
        *("déformation", "deformation", "allongement", "deformazione", "allungamento", "deformación", "alargamiento"),
    ),
    "stress": ("stress", "spannung", "contrainte", "tensione", "sforzo", "tensión", "esfuerzo"),
}
"""Headings, as `normalised`, that do not say whether a strain or a stress is true or engineering."""
QUANTITY_NAMES = frozenset(
    [*(name for role in ROLES.values() for name in role.headings | role.further), *VAGUE["strain"], *VAGUE["stress"]]
)
"""Every heading, as `normalised`, that means a quantity of a test."""
STRAIN_ROLES = ("true_strain", "engineering_strain", "stretch", "displacement")
STRESS_ROLES = ("true_stress", "engineering_stress", "force")
OPTIONAL_ROLES = ("strain_rate", "transverse_strain", "temperature")
RIVALS = (("time",), STRAIN_ROLES, STRESS_ROLES, *((role,) for role in OPTIONAL_ROLES))
"""Roles of which a table needs one."""

_SUFFIX_UNITS = {
    **{unit.lower(): unit for unit in ("s", "ms", "min", "h", "MPa", "kPa", "Pa", "GPa", "N", "kN")},
    **{unit.lower(): unit for unit in ("mm", "cm", "m", "um", "us", "K", "C", "degC", "percent")},
    "pct": "percent",
    "per_s": "1/s",
    "per_min": "1/min",
}


def normalised(heading: str) -> str:
    """Fold a heading for comparison: lower case, words joined by one underscore."""
    return re.sub(r"[\W_]+", "_", heading.casefold()).strip("_")


def role_of(heading: str) -> str | None:
    """Tell the role that a heading without unit stands for, if it says so unmistakably."""
    folded = normalised(heading)
    return next((name for name, role in ROLES.items() if folded in role.headings | role.further), None)


def role_in(heading: str, unit: str | None) -> str | None:
    """Tell the role that a heading stands for in that unit: an extensometer's column in mm is a displacement."""
    role = role_of(heading)
    if role == "engineering_strain" and unit and measures(unit, "mm"):
        return "displacement"
    return role


def is_further(role: str, heading: str) -> bool:
    """Tell whether a heading means the role only where no column is headed by a better one."""
    return normalised(heading) in ROLES[role].further


def split_suffix(folded: str) -> tuple[str, str] | None:
    """Split a unit from the end of a heading such as ``true_stress_mpa``, where the rest is a role's."""
    for suffix, unit in _SUFFIX_UNITS.items():
        stem = folded.removesuffix(f"_{suffix}")
        if stem != folded and role_of(stem) is not None:
            return stem, unit
    return None
