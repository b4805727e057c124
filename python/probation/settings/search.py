"""Which explanations are tried: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class SearchSettings:
    """Which explanations are tried."""

    first_steps: int = setting(
        4,
        "Gauss-Newton steps of a refit before it is compared with the others.",
        unit="steps",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    in_the_race: float = setting(
        6.0,
        (
            "A cause stays in the race while what it leaves of the gap is below so many times the best "
            "one's, plus the slack."
        ),
        unit="-",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    slack: float = setting(
        30.0,
        "The slack of the race.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    worth_polishing: float = setting(
        10.0,
        (
            "A cause in the race is refitted further while its log evidence falls short of a perfect one's by less "
            "than so many times the best one's, plus the slack; of a strong gap that no single effect explains."
        ),
        unit="-",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    race_gain: float = setting(
        14.0,
        "A cause is raced if its linearised gain is within so much of the best one's.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    race_fraction: float = setting(
        0.02,
        "For a strong gap, if it is this part of the best one's.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    strong_gap: float = setting(
        100.0,
        "Linearised gain, or misfit beyond its expectation, from which on a gap is strong.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    steps_apart: int = setting(
        2,
        (
            "Gauss-Newton steps of specimens that differ, from the optimum of specimens that are alike, after which it "
            "shows whether their deviations hold a strong gap."
        ),
        unit="steps",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    line_or_step_level: float = setting(
        0.01,
        ("p-value of a line or a step, over all records, below which causes that make them are sought there."),
        unit="-",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    soft_step_level: float = setting(
        0.1,
        "p-value up to which step effects are tried where they gain more than the best smooth effect.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    soft_step_lead: float = setting(
        30.0,
        "Linearised gain above that of the best smooth effect that a soft step needs.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    soft_step_ratio: float = setting(
        2.0,
        (
            "Ratio of that gain to the best smooth effect's at which a step effect is tried whatever the "
            "tests on steps say."
        ),
        unit="-",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    starts: int = setting(
        3,
        "Starts per form and place that a cause in the running is given.",
        unit="starts",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    places: int = setting(
        2,
        "Records in which a rig's fault is tried alone, those with the best score.",
        unit="records",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    extended_explanations: int = setting(
        3,
        "Best explanations that are added to.",
        unit="explanations",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    additions: int = setting(
        6,
        "Additions that each of them is given.",
        unit="effects",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    with_unknown: int = setting(
        5,
        "Leading hypotheses with which an unknown effect is looked for jointly.",
        unit="hypotheses",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    fewer_with_unknown: int = setting(
        2,
        "The best of one and of two effects that are among them in any case.",
        unit="hypotheses",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    hopeless: float = setting(
        15.0,
        "Log evidence behind the best one from which on a hypothesis is not looked at again.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    reconsidered: int = setting(
        16,
        "Hypotheses that are judged again once the noise is estimated jointly with the best one.",
        unit="hypotheses",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    worth_refitting: float = setting(
        10.0,
        "Linearised gain from which on an addition is refitted.",
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    most_effects: int = setting(
        3,
        "Effects of one explanation at most.",
        unit="effects",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    unknown_lead: float = setting(
        3.0,
        ("Log evidence by which an explanation with an unknown effect must lead for the search to go on."),
        unit="log evidence",
        origin="chosen",
        used_in="diagnosis/search.py",
    )
    largest_start: float = setting(
        2.0,
        "Prior scales within which searches begin.",
        unit="prior scales",
        origin="chosen",
        used_in="inference/candidate.py",
    )
    settled: float = setting(
        0.02,
        "A refit ends where a step would lower the objective by less than this.",
        unit="log evidence",
        origin="chosen",
        used_in="inference/refit.py",
    )
    sharp_steps: int = setting(
        6,
        "Gauss-Newton steps of an effect with a frequency or an instant where there is no gap.",
        unit="steps",
        origin="chosen",
        used_in="diagnosis/linear.py",
    )
    sharp_places: int = setting(
        3,
        "Forms and places of such an effect that are refitted, those with the best score.",
        unit="places",
        origin="chosen",
        used_in="diagnosis/linear.py",
    )
    budget_of_search: float = setting(
        0.6,
        "Part of the budget after which no further hypothesis is begun.",
        unit="budget",
        origin="chosen",
        used_in="diagnosis/budget.py",
    )
    budget_of_design: float = setting(
        0.75,
        "Part of the budget after which isolability and the next test are not begun.",
        unit="budget",
        origin="chosen",
        used_in="diagnosis/diagnose.py",
    )


SEARCH = SearchSettings()
