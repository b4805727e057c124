"""What tests can detect and discriminate, and which test to do next: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen, derived


@dataclass(frozen=True)
class DesignSettings:
    """What tests can detect and discriminate, and which test to do next."""

    detected: float = derived(
        5.0,
        "standard deviations",
        "sqrt(lambda) from which on an effect counts as seen: where nine of ten such gaps are to be detected.",
        source="power of the gap test",
    )
    discriminated: float = chosen(
        0.95, "probability", "Probability of naming the right one of two from which on they count as discriminated."
    )
    small_part: float = chosen(
        0.02, "usual size", "Part of the usual size that shows what an effect looks like where it is small."
    )
    further_values: tuple[float, ...] = chosen(
        (-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5),
        "prior scales",
        "Prior scales off the centre at which nonlinear parameters are tried in addition to their starts; of two such "
        "parameters or more, every other one.",
    )
    absorbed: float = chosen(
        0.9,
        "-",
        "Part of a signal that the base parameters take up from which on they are blamed for an effect that is not "
        "seen.",
    )
    no_signal: float = chosen(
        0.01,
        "standard deviations",
        "Length in standard deviations below which an effect is taken to do nothing at all.",
    )
    least_help: float = chosen(
        0.01, "probability", "Gain in the probability of a right answer below which a test is not worth doing."
    )
    help_per_half_hour: float = chosen(
        0.01, "probability", "Gain in that probability that half an hour more of effort must bring."
    )
    rough_noise: float = chosen(3.0, "noise", "Times the noise at which a test should decide, too.")
    separated: float = chosen(
        0.9, "probability", "Probability of discriminating two explanations from which on a test separates them."
    )
    longest_test: float = chosen(2.0 * 86400.0, "s", "Tests that take longer [s] are not proposed.")
    specimen_effort: float = chosen(3600.0, "s", "Effort of making, measuring and mounting a specimen, as time [s].")
    fault_repeats: float = chosen(
        0.5,
        "probability",
        "Probability that a fault seen in single records is there again in a new test on the same rig.",
    )
    planned_explanations: int = chosen(
        4, "explanations", "Explanations that a test is planned for, the most probable ones."
    )
    forms: int = chosen(2, "forms", "Forms and places of an explanation that are predicted, the best ones.")
    forms_within: float = chosen(
        4.0, "log evidence", "Log evidence of a form behind the best one up to which it is predicted."
    )
    seen_in_noise: float = chosen(
        0.01,
        "noise",
        "Predictions of a test are compared along directions in which all of them together differ by more than this: "
        "what is left out changes a log density by some 1e-4.",
    )
    draws: int = chosen(400, "draws", "Draws of the answers of a planned test.")
    strain_draws: int = chosen(
        5, "draws", "Draws of the strain noise with which a smoother is tried; the one in the middle counts."
    )
    dead_weight: float = chosen(0.6, "yield force", "Load of a planned creep test.")
    yield_strain: float = chosen(0.1, "true strain", "Strain at which the yield force is read.")
    loading_time: float = chosen(10.0, "s", "Time in which the dead weight is applied, or a fiftieth of the test.")
    bias_worth_naming: float = chosen(
        0.25, "largest bias", "Part of the largest bias from which on another one is named too."
    )
    listed_tests: int = chosen(5, "tests", "Tests that are listed for one question.")
    moving_rate: float = chosen(0.01, "largest rate", "Rate from which on a specimen of a planned test is straining.")
    least_form_weight: float = chosen(0.01, "probability", "Share of an explanation from which on a form is predicted.")
    rate_contrast: float = chosen(10.0, "-", "Ratio of the rates of planned tests, and of their times, at least.")
    planned_samples: tuple[int, int] = chosen((200, 1000), "samples", "Least and most samples of a planned test.")
    loading_samples: int = chosen(20, "samples", "Samples of the loading by a dead weight.")
    loading_one_in: float = chosen(50.0, "-", "The loading takes one over this of the test at most.")
    early_unloading: float = chosen(0.25, "largest strain", "Strain from which a test is unloaded just behind yield.")


DESIGN = DesignSettings()
