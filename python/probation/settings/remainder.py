"""On what a remainder depends: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import chosen


@dataclass(frozen=True)
class RemainderSettings:
    """On what a remainder depends."""

    function_sizes: tuple[int, ...] = chosen(
        (2, 4, 6),
        "coefficients",
        "Coefficients of the free functions that are fitted to a remainder: a straight line, and cubic splines.",
    )
    left_out_parts: int = chosen(
        8, "parts", "Contiguous parts of a record that are left out one by one where whole records cannot be."
    )
    linearisations: int = chosen(
        3, "rounds", "Linearisations of the law, each jointly with the best function of the one before."
    )
    certain: float = chosen(
        4.0, "standard errors", "Standard errors of the noise's mean square by which a remainder must exceed it."
    )
    mostly: float = chosen(
        0.5,
        "remainder",
        "Part of what is left that a function of one variable closes, where it was not fitted, from which on what is "
        "left is no noise.",
    )
    least_part: float = chosen(0.2, "remainder", "Part of the remainder that a variable must explain to be reported.")
    most_variables: int = chosen(4, "variables", "Variables that are reported.")
    least_remainder: float = chosen(
        0.25, "noise variance", "Mean square left beyond the noise's, over it, from which on a remainder is described."
    )
    planned_variables: int = chosen(3, "variables", "Variables that a test is planned for.")
    planned_instants: int = chosen(
        40, "samples", "Instants of a planned test that count as independent: a free function changes slowly."
    )
    planned_warming: float = chosen(15.0, "°C", "Change of temperature of a planned test.")
    least_in_phase: float = chosen(
        0.02,
        "samples",
        "Part of its samples that a planned test must have in the phase in which the leading function acts.",
    )
    doubt: float = chosen(
        0.05, "remainder", "Added to the part that each function leaves, in the odds between variables."
    )
    least_of_its_own: float = chosen(
        0.3,
        "function",
        "Part of a function, by its root mean square, that refitted parameters must leave: else only what they leave "
        "is shown.",
    )
    not_discriminated: float = chosen(
        0.05,
        "remainder",
        "Difference of the parts that two variables explain below which the records do not discriminate them.",
    )
    least_moving_rate: float = chosen(
        0.02, "largest rate", "Strain rate, over the record's largest, below which the strain is held."
    )
    least_below: float = chosen(
        0.003, "largest strain", "Distance of the strain below its largest so far from which on it reloads."
    )
    rate_window: int = chosen(60, "-", "The strain rate is a mean over one over this of a record.")
    least_range: float = chosen(1e-3, "-", "Range of a variable, over its largest value, below which it is one value.")
    ridge: float = chosen(
        1e-6, "mean information", "Precision of a coefficient of a free function: none where samples are."
    )
    smoothness: float = chosen(
        1e-4,
        "mean information",
        "Precision of its difference from the mean of its neighbours: where no sample is, a function runs straight.",
    )
    per_coefficient: float = chosen(0.002, "remainder", "What a function must explain more for each coefficient.")
    per_phase: float = chosen(0.01, "remainder", "What it must explain more for acting in one phase only.")
    on_parts: float = chosen(
        0.2,
        "remainder",
        "What it must explain more where it was judged on parts of records though there are several.",
    )
    least_phase: float = chosen(
        0.03, "samples", "Part of all samples that a phase must hold, and that must lie outside it."
    )
    fewest_of_a_phase: int = chosen(20, "samples", "Samples that it must hold, and that must lie outside it.")


REMAINDER = RemainderSettings()
