"""What the catalogue of effects takes for possible: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class EffectsSettings:
    """What the catalogue of effects takes for possible."""

    large_gain: float = setting(
        0.3,
        "Standard deviation of a gross relative error of the force or the section: a wrong range, a wrong width.",
        unit="-",
        origin="chosen",
        used_in="effects/large_faults.py",
    )
    large_force: float = setting(
        0.2,
        "Standard deviation of a gross error of the force.",
        unit="largest force",
        origin="chosen",
        used_in="effects/large_faults.py",
    )
    large_travel: float = setting(
        0.3,
        "Standard deviation of what the frame or slack take of the elongation where this is gross.",
        unit="largest elongation",
        origin="chosen",
        used_in="effects/large_faults.py",
    )
    largest_travel: float = setting(
        0.9,
        "Largest part of the elongation that frame or slack take.",
        unit="largest elongation",
        origin="chosen",
        used_in="effects/large_faults.py",
    )
    travel_starts: tuple[float, ...] = setting(
        (0.05, 0.2, 0.5),
        "Such parts from which searches begin.",
        unit="largest elongation",
        origin="chosen",
        used_in="effects/large_faults.py",
    )
    first_rise: tuple[float, float] = setting(
        (0.02, 0.1),
        "Parts of the largest force between which its first rise is a straight line, extended back to where it began.",
        unit="largest force",
        origin="chosen",
        source="ASTM D638, annex A1",
        used_in="effects/large_faults.py",
    )
    rate_decades: float = setting(
        2.0,
        "Decades around the reference rate beyond which the rate, as a coordinate, is constant.",
        unit="decades",
        origin="chosen",
        used_in="effects/coordinate.py",
    )
    first_time: float = setting(
        1e-3,
        "Time below which the logarithm of time, as a coordinate, is constant.",
        unit="duration",
        origin="chosen",
        used_in="effects/coordinate.py",
    )
    rate_window: int = setting(
        60,
        "The rate, as a coordinate, is a mean over one over this of a record.",
        unit="-",
        origin="chosen",
        used_in="effects/coordinate.py",
    )
    backlash: float = setting(
        1e-3,
        "Range within which the strain may come back by its noise alone.",
        unit="strain range",
        origin="chosen",
        used_in="effects/record_view.py",
    )
    least_return: float = setting(
        0.02,
        "Return of the strain that is more than its noise: an unloading.",
        unit="largest strain",
        origin="chosen",
        used_in="effects/visible.py",
    )
    different_temperature: float = setting(
        1.0,
        "Difference of temperatures that is more than their scatter: a laboratory keeps its room to 2 °C.",
        unit="°C",
        origin="derived",
        source="ISO 291",
        used_in="effects/visible_temperature.py",
    )
    usual_heating: float = setting(
        0.5,
        "Warming by work without loss: 1 / (density times heat capacity) of polyethylene.",
        unit="°C/MPa",
        origin="derived",
        source="heat capacity of polyethylene",
        used_in="effects/visible_temperature.py",
    )
    largest_heating: float = setting(
        1.0,
        "Largest warming by work: 1 / (density times heat capacity) of an elastomer, 1 MJ/(m³ °C).",
        unit="°C/MPa",
        origin="derived",
        source="heat capacity of elastomers",
        used_in="effects/visible_temperature.py",
    )
    fewest_in_order: int = setting(
        3,
        "Records from which on a change from test to test is more than a difference of two specimens.",
        unit="records",
        origin="chosen",
        used_in="effects/catalogue/change_between_tests.py",
    )
    locked: float = setting(
        0.95,
        "Part of the locking limit from which on the stiffening is continued by its tangent.",
        unit="limit",
        origin="chosen",
        used_in="effects/catalogue/finite_extensibility.py",
    )
    necking_rate_ratio: float = setting(
        2.0,
        "Largest over median strain rate, under grips at one speed, from which on a section necks.",
        unit="-",
        origin="chosen",
        used_in="effects/catalogue/neck_triaxiality.py",
    )
    fewest_slack: int = setting(
        5,
        "Samples without force in a row that are more than a crossing of zero.",
        unit="samples",
        origin="chosen",
        used_in="effects/catalogue/slack_strip.py",
    )
    crystallising_strain: float = setting(
        0.15,
        "Largest strain of a campaign from which on crystals may form, or be transformed: beyond yield.",
        unit="true strain",
        origin="chosen",
        used_in="effects/catalogue/strain_induced_crystallisation.py",
    )


EFFECTS = EffectsSettings()
