"""What tests can detect and discriminate, and which test to do next: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class DesignSettings:
    """What tests can detect and discriminate, and which test to do next."""

    detected: float = setting(
        5.0,
        ("sqrt(lambda) from which on an effect counts as seen: where nine of ten such gaps are to be detected."),
        unit="standard deviations",
        origin="derived",
        source="power of the gap test",
        used_in="design/effect_design.py",
    )
    discriminated: float = setting(
        0.95,
        "Probability of naming the right one of two from which on they count as discriminated.",
        unit="probability",
        origin="chosen",
        used_in="design/isolability.py",
    )
    small_part: float = setting(
        0.02,
        "Part of the usual size that shows what an effect looks like where it is small.",
        unit="usual size",
        origin="chosen",
        used_in="design/effect_signals.py",
    )
    further_shapes: tuple[float, ...] = setting(
        (-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5),
        (
            "Prior scales off the centre at which shapes are tried beside their starts; every other one "
            "of two shapes or more."
        ),
        unit="prior scales",
        origin="chosen",
        used_in="design/effect_signals.py",
    )
    absorbed: float = setting(
        0.9,
        (
            "Part of a signal that the base parameters take up from which on they are blamed for an "
            "effect that is not seen."
        ),
        unit="-",
        origin="chosen",
        used_in="design/isolability_result.py",
    )
    no_signal: float = setting(
        0.01,
        "Length in standard deviations below which an effect is taken to do nothing at all.",
        unit="standard deviations",
        origin="chosen",
        used_in="design/isolability_result.py",
    )
    least_help: float = setting(
        0.01,
        "Gain in the probability of a right answer below which a test is not worth doing.",
        unit="probability",
        origin="chosen",
        used_in="design/next_test.py",
    )
    help_per_half_hour: float = setting(
        0.01,
        "Gain in that probability that half an hour more of effort must bring.",
        unit="probability",
        origin="chosen",
        used_in="design/next_test.py",
    )
    rough_noise: float = setting(
        3.0,
        "Times the noise at which a test should decide, too.",
        unit="noise",
        origin="chosen",
        used_in="design/next_test.py",
    )
    separated: float = setting(
        0.9,
        "Probability of discriminating two explanations from which on a test separates them.",
        unit="probability",
        origin="chosen",
        used_in="design/next_test.py",
    )
    longest_test: float = setting(
        2.0 * 86400.0,
        "Tests that take longer [s] are not proposed.",
        unit="s",
        origin="chosen",
        used_in="design/planned_tests.py",
    )
    specimen_effort: float = setting(
        3600.0,
        "Effort of making, measuring and mounting a specimen, as time [s].",
        unit="s",
        origin="chosen",
        used_in="design/planned_tests.py",
    )
    fault_repeats: float = setting(
        0.5,
        ("Probability that a fault seen in single records is there again in a new test on the same rig."),
        unit="probability",
        origin="chosen",
        used_in="design/predicted.py",
    )
    planned_explanations: int = setting(
        4,
        "Explanations that a test is planned for, the most probable ones.",
        unit="explanations",
        origin="chosen",
        used_in="diagnosis/next.py",
    )
    forms: int = setting(
        2,
        "Forms and places of an explanation that are predicted, the best ones.",
        unit="forms",
        origin="chosen",
        used_in="diagnosis/next.py",
    )
    forms_within: float = setting(
        4.0,
        "Log evidence of a form behind the best one up to which it is predicted.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/next.py",
    )
    draws: int = setting(
        400,
        "Draws of the answers of a planned test.",
        unit="draws",
        origin="chosen",
        used_in="design/next_test.py",
    )
    strain_draws: int = setting(
        5,
        "Draws of the strain noise with which a smoother is tried; the one in the middle counts.",
        unit="draws",
        origin="chosen",
        used_in="design/planned_strain.py",
    )
    dead_weight: float = setting(
        0.6,
        "Load of a planned creep test.",
        unit="yield force",
        origin="chosen",
        used_in="design/planned_tests.py",
    )
    yield_strain: float = setting(
        0.1,
        "Strain at which the yield force is read.",
        unit="true strain",
        origin="chosen",
        used_in="design/planned_tests.py",
    )
    loading_time: float = setting(
        10.0,
        "Time in which the dead weight is applied, or a fiftieth of the test.",
        unit="s",
        origin="chosen",
        used_in="design/planned_tests.py",
    )
    bias_worth_naming: float = setting(
        0.25,
        "Part of the largest bias from which on another one is named too.",
        unit="largest bias",
        origin="chosen",
        used_in="design/isolability_result.py",
    )
    listed_tests: int = setting(
        5,
        "Tests that are listed.",
        unit="tests",
        origin="chosen",
        used_in="diagnosis/next.py",
    )


DESIGN = DesignSettings()
