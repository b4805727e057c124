"""What the paper's own printed numbers do not bear out, each recomputed from them."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation.law.companion import EXPONENTIAL_AS_PRINTED, WEISSENBERG_AS_PRINTED, Weissenberg
from probation.law.modal import Law
from probation.law.ramp import ramp_stress
from probation.published.numbers import (
    COST_REDUCTION,
    EXPONENTIAL_R_SQUARED,
    PEAK_RATE,
    STRAIN_RATE,
    TABLE_1,
    TABLE_2,
    TABLE_3,
    TABLE_4,
    UNRELAXED_MODULUS,
    WEISSENBERG_R_SQUARED,
)
from probation.report.table import Table
from probation_studies.paper.exhibit import Exhibit, Settings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from probation._arrays import FloatArray
    from probation.published.numbers import GripTable, Printed


@dataclass(frozen=True)
class Slip:
    """Something that the paper prints and its own numbers say otherwise.

    Attributes
    ----------
    where : str
    printed, recomputed : str
    how : str
        From what it was recomputed, and how much it matters.
    """

    where: str
    printed: str
    recomputed: str
    how: str


def exhibit(settings: Settings) -> Exhibit:
    """All of them."""
    found = slips()
    rows = tuple((each.where, each.printed, each.recomputed, each.how) for each in found)
    return Exhibit(
        title="Slips of the paper",
        says="",
        explanation=f"{len(found)} things that the paper prints and its own numbers do not bear out, recomputed from "
        "the printed numbers by this program. None touches the paper's method. Two matter to whoever uses the numbers: "
        "the intercept of (11), which is not the regression of Table 2 and is what Tables 3 and 4 were made with, and "
        "G, which is raised by 13 % by identification and not by 16 %.",
        parts=(Table(("where", "printed", "recomputed", "how"), rows, left=4), *CROSS_REFERENCES),
        answer={"slips": [vars(each) for each in found]},
    )


CROSS_REFERENCES = (
    "Cross-references that lead elsewhere: section 5.1 calls Table 2 “Table 1” and Figure S2 “Figure S1”; section 5.2 "
    "calls Figure S1 “Figs S2a and S2b”; section 4 calls Figure 2 “Fig. 1”; section 5.3 refers to a section 4.2, which "
    "there is not (5.2); the captions of Figures 5 and 6 repeat that of Figure 4b.",
)


@lru_cache(maxsize=1)
def slips() -> tuple[Slip, ...]:
    """Every slip, in the order of the paper."""
    return tuple(slip for source in SOURCES for slip in source())


def table_1_changes() -> Iterator[Slip]:
    """The relative errors of Table 1."""
    reference = TABLE_1[2]
    for number, row in TABLE_1.items():
        where = f"Table 1, identification {number}"
        columns = (
            ("E_u", reference.unrelaxed_modulus, row.unrelaxed_modulus, 1),
            ("τ_max", reference.time, row.time, 2),
            ("G", reference.hardening_modulus, row.hardening_modulus, 1),
        )
        for name, base, entry, digits in columns:
            yield from _change(f"{where}, {name}", entry, base.value, digits)


def table_2_weissenberg() -> Iterator[Slip]:
    """We of Table 2, eq. (10)."""
    for row in TABLE_2:
        exact = Decimal(repr(row.strain_rate)) * Decimal(repr(row.tau_max))
        if _rounded(exact, 4) != Decimal(repr(row.weissenberg)):
            yield Slip(
                f"Table 2, We at {row.strain_rate:g} 1/s",
                f"{row.weissenberg:g}",
                f"{_rounded(exact, 4)}",
                f"{row.tau_max:g} s × {row.strain_rate:g} 1/s = {float(exact):.6f}; cut off, not rounded",
            )


def table_2_against_table_1() -> Iterator[Slip]:
    """The rate of experiment 1 stands in Table 2 too."""
    row = next(row for row in TABLE_2 if row.strain_rate == STRAIN_RATE)
    first = TABLE_1[2]
    tau, hardening = row.tau_max / first.time.value - 1.0, row.hardening_modulus / first.hardening_modulus.value - 1.0
    yield Slip(
        f"Table 2 beside Table 1 at {STRAIN_RATE:g} 1/s",
        f"τ_max {row.tau_max:g} s, G {row.hardening_modulus:g} MPa",
        f"τ_max {first.time.value:g} s, G {first.hardening_modulus.value:g} MPa",
        f"the same rate, {100 * tau:+.1f} % and {100 * hardening:+.1f} %: Table 2 holds averages over other tests; so "
        "much two sets of tests differ",
    )


def decades_of_table_2() -> Iterator[Slip]:
    """We "varies … over 3 decades"."""
    decades = np.log10(TABLE_2[-1].strain_rate / TABLE_2[0].strain_rate)
    rise = TABLE_2[-1].weissenberg / TABLE_2[0].weissenberg - 1.0
    yield Slip(
        "section 5.1, range of Table 2",
        "over 3 decades",
        f"over {decades:.1f} decades",
        f"5e-5 to 1e-2 1/s; the rise of We by more than 50 % holds ({100 * rise:.0f} %)",
    )


def equation_7() -> Iterator[Slip]:
    """The ramp, and where its closed form is not defined."""
    law = Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)
    time = np.linspace(1.0, 400.0, 400)
    apart = float(np.abs(equation_7_as_printed(law, STRAIN_RATE, time) - ramp_stress(law, STRAIN_RATE, time)).max())
    yield Slip(
        "eq. (7), the command",
        "ε(t) = ε̇₀",
        "ε(t) = ε̇₀ t",
        f"t is missing; for the ramp ε̇₀ t, (7) as printed is right (within {apart:.1g} MPa on experiment 1)",
    )
    singular = Law(unrelaxed_modulus=3224.0, tau_max=1.0 / STRAIN_RATE, hardening_modulus=2.556)
    with np.errstate(divide="ignore", invalid="ignore"):
        there = equation_7_as_printed(singular, STRAIN_RATE, np.array([100.0]))[0]
        still = equation_7_as_printed(law, 0.0, np.array([100.0]))[0]
    hardening, early = Law(unrelaxed_modulus=0.0, tau_max=5.207, hardening_modulus=2.556), np.array([1e-6])
    lost = equation_7_as_printed(hardening, STRAIN_RATE, early) / ramp_stress(hardening, STRAIN_RATE, early) - 1.0
    yield Slip(
        "eq. (7), its limits",
        "for every ε̇₀ and τ_j",
        f"{there:g} at τ_j = 1/ε̇₀, {still:g} at ε̇₀ = 0",
        f"0/0 there; its hardening part at t = 1e-6 s is off by {100 * abs(lost[0]):.1g} %, as differences cancel. The "
        "closed form used here has none of these limits",
    )


def equation_11() -> Iterator[Slip]:
    """The Weissenberg relation beside the table that it was regressed on."""
    rates = np.array([row.strain_rate for row in TABLE_2])
    times = np.array([row.tau_max for row in TABLE_2])
    slope, intercept = np.polyfit(np.log10(rates), rates * times, 1)
    r_squared = _r_squared(rates * times, slope * np.log10(rates) + intercept)
    printed = WEISSENBERG_AS_PRINTED
    yield Slip(
        "eq. (11), coefficients",
        f"{printed.slope:g} log ε̇ + {printed.intercept:g}, R² {WEISSENBERG_R_SQUARED:g}",
        f"{slope:.5f} log ε̇ + {intercept:.4f}, R² {r_squared:.3f}",
        "regression of τ_max·ε̇ of Table 2. The printed intercept is not the regression's, but it gives "
        f"{printed.relaxation_time([STRAIN_RATE])[0]:.3f} s at {STRAIN_RATE:g} 1/s, experiment 1's "
        f"{TABLE_1[2].time.value:g} s: the slope seems anchored there. Tables 3 and 4 were computed with it: their α "
        f"by (11) over α by (12) is {_alpha_ratio(TABLE_3):.3f} and {_alpha_ratio(TABLE_4):.3f}; (12) over (11) at the "
        f"peak rates of these tests is {_at_peaks(printed)} with the printed intercept, "
        f"{_at_peaks(Weissenberg(float(slope), float(intercept)))} with the regression's",
    )
    under = 100.0 * (printed.relaxation_time(rates) / times - 1.0)
    yield Slip(
        "section 5.1, (11) beside Table 2",
        "too low at very low rates",
        f"too low by {-under.max():.0f} to {-under.min():.0f} % at every rate",
        "τ_max by (11) as printed, at the five rates: " + ", ".join(f"{each:+.1f} %" for each in under),
    )


def equation_12() -> Iterator[Slip]:
    """The exponential relation beside the table that it was fitted to."""
    rates = np.array([row.strain_rate for row in TABLE_2])
    times = np.array([row.tau_max for row in TABLE_2])
    model = EXPONENTIAL_AS_PRINTED.relaxation_time(rates)
    errors = ", ".join(f"{100.0 * each:+.1f} %" for each in model / times - 1.0)
    yield Slip(
        "eq. (12), perfect representation",
        f"R² {EXPONENTIAL_R_SQUARED:g}",
        f"R² {_r_squared(times, model):.5f}; errs by {errors}",
        "from the slowest rate to the fastest: τ_max spans a factor of 130, R² sees the slowest points only; in ln "
        f"τ_max R² is {_r_squared(np.log(times), np.log(model)):.4f}",
    )


def logarithms() -> Iterator[Slip]:
    """The base of the logarithms is not said."""
    row = TABLE_2[0]
    natural = EXPONENTIAL_AS_PRINTED.coefficient * np.exp(
        EXPONENTIAL_AS_PRINTED.exponent * np.log(1e3 * row.strain_rate)
    )
    decimal = float(EXPONENTIAL_AS_PRINTED.relaxation_time([row.strain_rate])[0])
    yield Slip(
        "eqs. (11), (12), log",
        "log",
        "log10",
        f"(12) at {row.strain_rate:g} 1/s gives {decimal:.0f} s with log10, {natural:.0f} s with ln; Table 2 has "
        f"{row.tau_max:g} s",
    )


def grip_table_changes() -> Iterator[Slip]:
    """The relative variations of Tables 3 and 4, and the unit of α."""
    yield Slip("Table 3, α", "(s)", "–", "a factor of τ_max has no unit")
    for table in (TABLE_3, TABLE_4):
        for number, row in table.identifications.items():
            where = f"Table {table.number}, identification {number}"
            yield from _change(f"{where}, E_u", row.unrelaxed_modulus, UNRELAXED_MODULUS)
            yield from _change(f"{where}, α", row.time, 1.0)
            yield from _change(f"{where}, G", row.hardening_modulus, table.regressed_hardening)


def costs() -> Iterator[Slip]:
    """What the text says of the cost functions."""
    third = [row.cost for row in TABLE_3.identifications.values() if row.cost is not None]
    yield Slip(
        "section 5.3, costs of Table 3",
        "the same value at convergence",
        f"{max(third) / min(third) - 1:.1%} apart".replace("%", " %"),
        ", ".join(f"{cost:g}" for cost in third),
    )
    second, other, fourth = (TABLE_4.identifications[number].cost for number in (2, 3, 4))
    assert second is not None
    assert other is not None
    assert fourth is not None
    yield Slip(
        "section 5.3, cost of Table 4",
        f"reduced by {COST_REDUCTION:g} %",
        f"by {100 * (1 - fourth / second):.1f} %",
        f"{fourth:g} against {second:g} of identification 2; {100 * (1 - fourth / other):.1f} % against {other:g} of "
        "identification 3",
    )


def which_relation_is_sounder() -> Iterator[Slip]:
    """Section 5.3 prefers (11) for its smaller correction."""

    def corrections(table: GripTable) -> str:
        return " against ".join(f"{100 * (table.identifications[each].time.value - 1):+.1f} %" for each in (2, 3))

    yield Slip(
        "section 5.3, (11) sounder than (12)",
        f"for it is corrected less: {corrections(TABLE_4)}",
        f"in experiment 2 it is corrected more: {corrections(TABLE_3)}",
        f"α moves from one experiment to the other by {_alpha_drift(2):.1f} % with (11), {_alpha_drift(3):.1f} % with "
        "(12)",
    )


SOURCES: tuple[Callable[[], Iterator[Slip]], ...] = (
    equation_7,
    table_1_changes,
    table_2_weissenberg,
    table_2_against_table_1,
    decades_of_table_2,
    equation_11,
    equation_12,
    logarithms,
    grip_table_changes,
    costs,
    which_relation_is_sounder,
)
"""Where slips are looked for, in the order of the paper."""


def equation_7_as_printed(law: Law, strain_rate: float, time: FloatArray) -> FloatArray:
    """Stress of a ramp by eq. (7) exactly as printed, limits and all, shape (n_times,) [MPa]."""
    assert law.spectrum is not None
    assert law.tau_max is not None
    rate, t = strain_rate, time[:, np.newaxis]
    tau, weight = law.tau_max * law.spectrum.relaxation_ratio, law.spectrum.modal_weight
    hardening = (
        3.0 * weight * rate * np.exp(-t / tau)
        - weight * (2.0 * rate + 1.0 / tau) * np.exp(-rate * t)
        + weight * (1.0 / tau - rate) * np.exp(2.0 * rate * t)
    ) / (tau * rate * (1.0 / tau - rate) * (2.0 * rate + 1.0 / tau))
    modal = rate * (weight * tau * law.unrelaxed_modulus * (1.0 - np.exp(-t / tau)) + law.hardening_modulus * hardening)
    stress: FloatArray = modal.sum(axis=1)
    return stress


def _change(where: str, entry: Printed, reference: float, digits: int = 0) -> Iterator[Slip]:
    """A printed relative change that is not the rounded one; a bare 0 is read with the `digits` of its column."""
    if not entry.change:
        return
    value, base, printed = Decimal(repr(entry.value)), Decimal(repr(reference)), Decimal(entry.change)
    exact = 100 * (value / base - 1)
    decimals = _decimals(printed) if printed else digits
    if _rounded(exact, decimals) == printed:
        return
    # The printed values are themselves rounded; by how much could that move the change?
    half_value, half_base = _half_digit(value), _half_digit(base) if base != 1 else Decimal(0)
    low = 100 * ((value - half_value) / (base + half_base) - 1)
    high = 100 * ((value + half_value) / (base - half_base) - 1)
    half = Decimal(5).scaleb(-decimals - 1)
    possible = low <= printed + half and printed - half <= high
    shown = max(decimals, 2 if abs(exact) < 1 else 1)
    yield Slip(
        where,
        f"{entry.change} %".replace("-", "−"),
        f"{float(exact):+.{shown}f} %".replace("-", "−"),
        f"{entry.value:g} against {reference:g}; "
        + ("could come from unrounded values" if possible else "more than rounding explains"),
    )


def _decimals(number: Decimal) -> int:
    exponent = number.as_tuple().exponent
    assert isinstance(exponent, int)
    return max(-exponent, 0)


def _half_digit(number: Decimal) -> Decimal:
    """Half a unit of the last printed digit; 3220.0 was printed 3220."""
    return Decimal(5).scaleb(-_decimals(number.normalize()) - 1)


def _rounded(number: Decimal, decimals: int) -> Decimal:
    return number.quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP)


def _r_squared(values: FloatArray, model: FloatArray) -> float:
    return float(1.0 - np.sum((values - model) ** 2) / np.sum((values - values.mean()) ** 2))


def _alpha_ratio(table: GripTable) -> float:
    return table.identifications[2].time.value / table.identifications[3].time.value


def _at_peaks(relation: Weissenberg) -> str:
    """(12) over (11) at the peak rates of experiments 2 and 3."""
    peaks = [PEAK_RATE * table.grip_speed / TABLE_4.grip_speed for table in (TABLE_3, TABLE_4)]
    ratios = EXPONENTIAL_AS_PRINTED.relaxation_time(peaks) / relation.relaxation_time(peaks)
    return " and ".join(f"{ratio:.3f}" for ratio in ratios)


def _alpha_drift(identification: int) -> float:
    one, other = (table.identifications[identification].time.value for table in (TABLE_3, TABLE_4))
    return 100.0 * (one / other - 1.0)
