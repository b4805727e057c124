"""On what a remainder depends: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class RemainderSettings:
    """On what a remainder depends."""

    function_sizes: tuple[int, ...] = setting(
        (2, 4, 6),
        "Coefficients of the free functions that are fitted to a remainder: a straight line, and cubic splines.",
        unit="coefficients",
        origin="chosen",
        used_in="diagnosis/free_function.py",
    )
    left_out_parts: int = setting(
        8,
        "Contiguous parts of a record that are left out one by one where whole records cannot be.",
        unit="parts",
        origin="chosen",
        used_in="diagnosis/free_function.py",
    )
    linearisations: int = setting(
        3,
        "Linearisations of the law, each jointly with the best function of the one before.",
        unit="rounds",
        origin="chosen",
        used_in="diagnosis/remainder.py",
    )
    certain: float = setting(
        4.0,
        "Standard errors of the noise's mean square by which a remainder must exceed it.",
        unit="standard errors",
        origin="chosen",
        used_in="diagnosis/free_function.py",
    )
    least_part: float = setting(
        0.2,
        "Part of the remainder that a variable must explain to be reported.",
        unit="remainder",
        origin="chosen",
        used_in="diagnosis/remainder.py",
    )
    most_variables: int = setting(
        4,
        "Variables that are reported.",
        unit="variables",
        origin="chosen",
        used_in="diagnosis/remainder.py",
    )
    least_remainder: float = setting(
        0.25,
        "Mean square left beyond the noise's, over it, from which on a remainder is described.",
        unit="noise variance",
        origin="chosen",
        used_in="diagnosis/remainder.py",
    )
    planned_variables: int = setting(
        3,
        "Variables that a test is planned for.",
        unit="variables",
        origin="chosen",
        used_in="diagnosis/remainder_tests.py",
    )
    planned_instants: int = setting(
        40,
        "Instants of a planned test that count as independent: a free function changes slowly.",
        unit="samples",
        origin="chosen",
        used_in="diagnosis/remainder_tests.py",
    )
    planned_warming: float = setting(
        15.0,
        "Change of temperature of a planned test.",
        unit="°C",
        origin="chosen",
        used_in="diagnosis/remainder_tests.py",
    )
    least_in_phase: float = setting(
        0.02,
        "Part of its samples that a planned test must have in the phase in which the leading function acts.",
        unit="samples",
        origin="chosen",
        used_in="diagnosis/remainder_tests.py",
    )
    doubt: float = setting(
        0.05,
        "Added to the part that each function leaves, in the odds between variables.",
        unit="remainder",
        origin="chosen",
        used_in="diagnosis/remainder_tests.py",
    )
    not_discriminated: float = setting(
        0.05,
        "Difference of the parts that two variables explain below which the records do not discriminate them.",
        unit="remainder",
        origin="chosen",
        used_in="diagnosis/remainder_words.py",
    )
    least_moving_rate: float = setting(
        0.02,
        "Strain rate, over the record's largest, below which the strain is held.",
        unit="largest rate",
        origin="chosen",
        used_in="diagnosis/variables.py",
    )
    least_below: float = setting(
        0.003,
        "Distance of the strain below its largest so far from which on it reloads.",
        unit="largest strain",
        origin="chosen",
        used_in="diagnosis/variables.py",
    )
    rate_window: int = setting(
        60,
        "The strain rate is a mean over one over this of a record.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/variables.py",
    )
    least_range: float = setting(
        1e-3,
        "Range of a variable, over its largest value, below which it is one value.",
        unit="-",
        origin="chosen",
        used_in="diagnosis/variables.py",
    )


REMAINDER = RemainderSettings()
