"""The numbers that the paper prints, each with its place.

Kept as they are printed, slips included; `slips` recomputes what can be recomputed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Printed:
    """A parameter as a table prints it.

    Attributes
    ----------
    change : str
        The relative change to the table's reference beside it [%], as printed; empty for a dash.
    """

    value: float
    change: str = ""


@dataclass(frozen=True)
class PrintedIdentification:
    """A row of Tables 1, 3 and 4.

    Attributes
    ----------
    unrelaxed_modulus : Printed [MPa]
    time : Printed
        tau_max [s] in Table 1, alpha [-] in Tables 3 and 4.
    hardening_modulus : Printed [MPa]
    cost : float or None
        Sum of squared residuals [MPa^2].
    """

    name: str
    unrelaxed_modulus: Printed
    time: Printed
    hardening_modulus: Printed
    cost: float | None = None


@dataclass(frozen=True)
class GripTable:
    """Table 3 or 4, and what the text says of it.

    Attributes
    ----------
    number : int
        Of the table.
    experiment : {2, 3}
    grip_speed : float [mm/s]
    regressed_hardening : float [MPa]
        G by regression on e_HT; the reference of the table.
    identifications : dict of int to PrintedIdentification
        By their number, 2 to 4.
    largest_residual : float [MPa]
        Section 5.3.
    """

    number: int
    experiment: Literal[2, 3]
    grip_speed: float
    regressed_hardening: float
    identifications: dict[int, PrintedIdentification]
    largest_residual: float


@dataclass(frozen=True)
class RateRow:
    """A row of Table 2: strain rate [1/s], tau_max [s], We [-], G [MPa]."""

    strain_rate: float
    tau_max: float
    weissenberg: float
    hardening_modulus: float


TABLE_1: dict[int, PrintedIdentification] = {
    1: PrintedIdentification("analytical (7)", Printed(3112.0, "-3.5"), Printed(5.394, "+3.6"), Printed(2.552, "-0.2")),
    2: PrintedIdentification("bE2, as measured", Printed(3224.0), Printed(5.207), Printed(2.556)),
    3: PrintedIdentification("bE2, filtered", Printed(3215.0, "-0.3"), Printed(5.22, "-0.25"), Printed(2.55, "0")),
    4: PrintedIdentification("SA3, filtered", Printed(3218.0, "-0.2"), Printed(5.22, "-0.25"), Printed(2.557, "0")),
}
"""Table 1, experiment 1; the reference is identification 2."""

TABLE_2: tuple[RateRow, ...] = (
    RateRow(5e-5, 419.72, 0.0209, 1.53),
    RateRow(4e-4, 63.23, 0.0253, 1.85),
    RateRow(2.5e-3, 11.02, 0.0276, 2.31),
    RateRow(5e-3, 6.01, 0.0301, 2.31),
    RateRow(1e-2, 3.21, 0.0321, 2.46),
)
"""Table 2, fits at constant strain rates: averages over specimens; no standard errors were published."""

FICTITIOUS_ERROR = 0.10
"""Relative error bars of Figure S2, "a fictitious 10 % uncertainty"."""

TABLE_3 = GripTable(
    number=3,
    experiment=2,
    grip_speed=0.02,
    regressed_hardening=1.56,
    identifications={
        2: PrintedIdentification("α·(11)", Printed(3220.0), Printed(1.11, "+11"), Printed(1.761, "+16"), 1155.0),
        3: PrintedIdentification("α·(12)", Printed(3220.0), Printed(0.928, "-7"), Printed(1.764, "+16"), 1191.0),
        4: PrintedIdentification(
            "α·(11), E_u free", Printed(3428.0, "+6.5"), Printed(1.045, "+4.5"), Printed(1.765, "+16"), 1138.0
        ),
    },
    largest_residual=2.5,
)

TABLE_4 = GripTable(
    number=4,
    experiment=3,
    grip_speed=0.08,
    regressed_hardening=1.64,
    identifications={
        2: PrintedIdentification("α·(11)", Printed(3220.0), Printed(1.045, "+4.5"), Printed(1.85, "+12.6"), 2100.0),
        3: PrintedIdentification("α·(12)", Printed(3220.0), Printed(0.855, "-14"), Printed(1.86, "+12.6"), 2250.0),
        4: PrintedIdentification(
            "α·(11), E_u free", Printed(4374.0, "+36"), Printed(0.764, "-24"), Printed(1.85, "+12.6"), 1665.0
        ),
    },
    largest_residual=3.4,
)

UNRELAXED_MODULUS = 3220.0
"""E_u taken as known for experiments 2 and 3 [MPa], section 5.2."""

STRAIN_RATE = 0.005
"""Of experiment 1 [1/s], section 3."""

PEAK_RATE = 1.7e-2
"""Largest strain rate of experiment 3 [1/s], section 5.3."""

RATE_RATIO = (5.0, 10.0)
"""By how many times local strain rates evolve during a test between grips, abstract."""

CONSTANT_TIME_MODULUS = 60000.0
"""E_u identified without companion relation [MPa], section 5.2."""

CONSTANT_TIME_ONSET = 2.0
"""Yield stress of that model [MPa], section 5.2."""

PREDICTION_ERROR = 10.0
"""Largest error of the direct predictions of Figures 4a and 4b [MPa], section 5.2."""

WEISSENBERG_R_SQUARED = 0.976
"""R^2 printed with eq. (11)."""

EXPONENTIAL_R_SQUARED = 1.0
"""R^2 printed with eq. (12)."""

COST_REDUCTION = 25.0
"""By how much identification 4 reduces the cost in experiment 3 [%], section 5.3."""
