"""What the catalogue of effects takes for possible: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen, derived


@dataclass(frozen=True)
class EffectsSettings:
    """What the catalogue of effects takes for possible."""

    large_gain: float = chosen(
        0.3,
        "-",
        "Standard deviation of a gross relative error of the force, the section or the elongation: a wrong range, a "
        "wrong width, a wrong gauge length.",
    )
    large_force: float = chosen(0.2, "largest force", "Standard deviation of a gross error of the force.")
    largest_drift: float = chosen(
        0.5,
        "largest force",
        "Largest gross drift of the force within a test: a channel that wanders by more measures no force.",
    )
    large_zero: float = chosen(
        0.1, "largest true strain", "Standard deviation of a strain that was zeroed at quite another length."
    )
    large_travel: float = chosen(
        0.3,
        "largest elongation",
        "Standard deviation of what the frame or slack take of the elongation where this is gross.",
    )
    largest_travel: float = chosen(
        0.9, "largest elongation", "Largest part of the elongation that frame or slack take."
    )
    travel_starts: tuple[float, ...] = chosen(
        (0.05, 0.2, 0.5), "largest elongation", "Such parts from which searches begin."
    )
    take_up_starts: tuple[float, ...] = chosen(
        (0.02, 0.2), "largest force", "Parts of the force that takes up slack, or pulls a bent strip straight."
    )
    sudden: float = chosen(
        8.0,
        "standard deviations",
        "Change from sample to sample beyond those before and after, over what the median one tells, of a slip.",
    )
    sudden_steps: float = chosen(1.5, "steps", "Such a change over the step of the readings: one of these is no slip.")
    least_sudden: float = chosen(
        0.002, "largest force or strain", "Least such change: in records without noise, rounding would be one."
    )
    most_sudden: float = chosen(
        0.2, "path of the strain", "Sudden changes of the strain that are more of it, together, are no slips of knives."
    )
    large_hysteresis: float = chosen(
        0.1, "largest force", "Standard deviation of a gross hysteresis: a guide or a joint of the load train rubs."
    )
    large_prestress: float = chosen(
        0.05,
        "largest force",
        "Standard deviation of a prestress in proportion to the force, of stiff specimens as of soft.",
    )
    large_back_stress: float = chosen(
        0.3, "largest force", "Standard deviation of a back stress that is a good part of the stress, as a metal's is."
    )
    large_damage: float = chosen(
        0.2,
        "area per strain",
        "Standard deviation of what the largest force breaks, if damage goes with the square of the stress.",
    )
    largest_damage: float = chosen(3.0, "area per strain", "Most that it breaks.")
    large_lag: float = chosen(3.0, "s", "Standard deviation of a gross lag between force and strain.")
    lag_starts: tuple[float, ...] = chosen((0.5, 4.0), "s", "Such lags from which searches begin.")
    easy_flow: float = chosen(
        3.0,
        "-",
        "Standard deviation of the gain of flow at 20 MPa, or at the largest force where that is less, where stress "
        "makes flow easy.",
    )
    easiest_flow: float = chosen(
        100.0, "-", "Largest such gain: an activation stress of 0.8 MPa where the force is above 20 MPa."
    )
    short_chains: float = chosen(
        0.1, "-", "Standard deviation of 1/(5 N) of a network that locks soon, chains of N = 2 links."
    )
    locking_starts: tuple[float, ...] = chosen((0.03, 0.1), "-", "Such values from which searches begin.")
    first_rise: tuple[float, float] = chosen(
        (0.02, 0.1),
        "largest force",
        "Parts of the largest force between which its first rise is a straight line, extended back to where it began.",
        source="ASTM D638, annex A1",
    )
    rate_decades: float = chosen(
        2.0, "decades", "Decades around the reference rate beyond which the rate, as a coordinate, is constant."
    )
    first_time: float = chosen(
        1e-3, "duration", "Time below which the logarithm of time, as a coordinate, is constant."
    )
    rate_window: int = chosen(60, "-", "The rate, as a coordinate, is a mean over one over this of a record.")
    backlash: float = chosen(1e-3, "strain range", "Range within which the strain may come back by its noise alone.")
    least_return: float = chosen(
        0.02, "largest strain", "Return of the strain that is more than its noise: an unloading."
    )
    return_over_noise: float = chosen(
        6.0, "strain noise", "Return of the strain that is an unloading, too, where the force falls by `least_fall`."
    )
    least_fall: float = chosen(0.1, "largest force", "Fall of the force that makes a short return an unloading.")
    different_temperature: float = derived(
        1.0,
        "°C",
        "Difference of temperatures that is more than their scatter: a laboratory keeps its room to 2 °C.",
        source="ISO 291",
    )
    least_rise: float = chosen(
        0.1, "°C", "Measured rise of a specimen's temperature that changes a stress by more than half a per cent."
    )
    rise_over_scatter: float = chosen(
        22.0,
        "scatter of a reading over the root of their number",
        "Such a rise, too: five standard errors of the difference of two means, each over a tenth of a record.",
    )
    different_volume: float = chosen(
        0.01, "-", "Volume strain that is more than the errors of the two measured strains it is made of."
    )
    most_of_a_record: float = chosen(0.95, "record", "Quantile that stands for the largest value of noisy samples.")
    usual_heating: float = derived(
        0.5,
        "°C/MPa",
        "Warming by work without loss: 1 / (density times heat capacity) of polyethylene.",
        source="heat capacity of polyethylene",
    )
    largest_heating: float = derived(
        1.0,
        "°C/MPa",
        "Largest warming by work: 1 / (density times heat capacity) of an elastomer, 1 MJ/(m³ °C).",
        source="heat capacity of elastomers",
    )
    fewest_in_order: int = chosen(
        3, "records", "Records from which on a change from test to test is more than a difference of two specimens."
    )
    locked: float = chosen(
        0.95, "limit", "Part of the locking limit from which on the stiffening is continued by its tangent."
    )
    necking_rate_ratio: float = chosen(
        2.0, "-", "Largest over median strain rate, under grips at one speed, from which on a section necks."
    )
    necking_strain: float = chosen(
        0.1, "true strain", "Largest strain from which on a section whose own strain is kept may be one that necks."
    )
    fewest_slack: int = chosen(5, "samples", "Samples without force in a row that are more than a crossing of zero.")
    crystallising_strain: float = chosen(
        0.15,
        "true strain",
        "Largest strain of a campaign from which on crystals may form, or be transformed: beyond yield.",
    )
    least_rate_range: float = chosen(
        0.1, "decades", "Range of the strain rate below which it is one value: it is never quite steady."
    )


EFFECTS = EffectsSettings()
