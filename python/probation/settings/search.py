"""Which explanations are tried: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class SearchSettings:
    """Which explanations are tried."""

    first_steps: int = chosen(4, "steps", "Gauss-Newton steps of a refit before it is compared with the others.")
    in_the_race: float = chosen(
        6.0,
        "-",
        "A cause stays in the race while what it leaves of the gap is below so many times the best one's, plus the "
        "slack.",
    )
    slack: float = chosen(30.0, "log evidence", "The slack of the race.")
    worth_polishing: float = chosen(
        10.0,
        "-",
        "A cause in the race is refitted further while its log evidence falls short of a perfect one's by less than "
        "so many times the best one's, plus the slack; of a strong gap that no single effect explains.",
    )
    race_gain: float = chosen(
        40.0, "log evidence", "A cause is raced if its linearised gain is within so much of the best one's."
    )
    race_fraction: float = chosen(0.02, "-", "For a strong gap, if it is this part of the best one's.")
    passed_over: float = chosen(
        0.5,
        "-",
        "A cause that was not raced is, after all, if its linearised gain is this part of what the best one gained, or "
        "within `race_gain` of it.",
    )
    strong_gap: float = chosen(
        100.0, "log evidence", "Linearised gain, or misfit beyond its expectation, from which on a gap is strong."
    )
    certain_gap: float = chosen(
        2.0, "standard deviations", "Misfit above its expectation that counts as noise: what is beyond it is the gap."
    )
    steps_apart: int = chosen(
        2,
        "steps",
        "Gauss-Newton steps of specimens that differ, from the optimum of specimens that are alike, after which it "
        "shows whether their deviations hold a strong gap.",
    )
    farthest_specimen: float = chosen(
        12.0,
        "of what is usual",
        "Deviations of a specimen, over those that are usual, from which on a refit of a strong gap stays where "
        "specimens that are alike end.",
    )
    nearly_usual: float = chosen(
        1.5,
        "of what is usual",
        "Deviations of a specimen, over those that are usual, up to which a refit of a strong gap goes on after "
        "`steps_apart` steps, whatever the deviations hold, and up to which the slopes at its start let it begin with "
        "specimens that differ.",
    )
    line_or_step_level: float = chosen(
        0.01,
        "-",
        "p-value of a line, a step or a strain period, over all records, below which causes of it are sought there.",
    )
    soft_step_level: float = chosen(
        0.1, "-", "p-value up to which step effects are tried where they gain more than the best smooth effect."
    )
    soft_step_lead: float = chosen(
        30.0, "log evidence", "Linearised gain above that of the best smooth effect that a soft step needs."
    )
    soft_step_ratio: float = chosen(
        0.5,
        "-",
        "Ratio of the linearised gain of a step effect, of a strong gap, to the best smooth effect's at which it is "
        "tried whatever the tests on steps say: they see a step, not one that relaxes.",
    )
    starts: int = chosen(3, "starts", "Starts per form and place that a cause in the running is given.")
    places: int = chosen(2, "records", "Records in which a rig's fault is tried alone, those with the best score.")
    extended_explanations: int = chosen(2, "explanations", "Best explanations that are added to.")
    additions: int = chosen(6, "effects", "Additions that each of them is given.")
    with_unknown: int = chosen(
        5, "hypotheses", "Leading hypotheses with which an unknown effect is looked for jointly."
    )
    fewer_with_unknown: int = chosen(
        2, "hypotheses", "The best of one and of two effects that are among them in any case."
    )
    hopeless: float = chosen(
        15.0, "log evidence", "Log evidence behind the best one from which on a hypothesis is not looked at again."
    )
    reconsidered: int = chosen(
        16,
        "hypotheses",
        "Hypotheses, of every number of effects, that are judged again once the noise is estimated jointly with the "
        "best one.",
    )
    worth_refitting: float = chosen(10.0, "log evidence", "Linearised gain from which on an addition is refitted.")
    most_effects: int = chosen(3, "effects", "Effects of one explanation at most.")
    unknown_lead: float = chosen(
        3.0,
        "log evidence",
        "Log evidence by which an explanation with an unknown effect must lead for the search to go on.",
    )
    largest_start: float = chosen(2.0, "prior scales", "Prior scales within which searches begin.")
    settled: float = chosen(
        0.02, "log evidence", "A refit ends where a step would lower the objective by less than this."
    )
    sharp_steps: int = chosen(
        6, "steps", "Gauss-Newton steps of an effect with a frequency or an instant where there is no gap."
    )
    sharp_places: int = chosen(
        3, "places", "Forms and places of such an effect that are refitted, those with the best score."
    )
    budget_of_search: float = chosen(0.6, "budget", "Part of the budget after which no further hypothesis is begun.")
    budget_of_design: float = chosen(
        0.75, "budget", "Part of the budget after which isolability and the next test are not begun."
    )
    most_samples: int = chosen(
        3000, "samples", "Longer records are thinned: gaps are slow, and a search costs in proportion."
    )
    sharp_start: float = chosen(
        0.3,
        "prior scales",
        "Amplitude from which an effect with a frequency or an instant is refitted where there is no gap.",
    )


SEARCH = SearchSettings()
