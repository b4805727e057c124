"""Figure S2: τ_max of Table 2 over the strain rate, with the relations (11) and (12)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.calibration.companion_forms import FORMS
from probation.calibration.regression import regress
from probation.identify.fit import fit
from probation.law.companion import EXPONENTIAL_AS_PRINTED, WEISSENBERG_AS_PRINTED
from probation.law.settings import CompanionSettings, LawSettings
from probation.published.numbers import EXPONENTIAL_R_SQUARED, FICTITIOUS_ERROR, WEISSENBERG_R_SQUARED
from probation.records.campaign import Campaign
from probation.report.figures import styled_figure
from probation.report.style import colour, series_colour
from probation.report.table import Table
from probation_studies.paper.exhibit import Drawing, Exhibit, Settings, compare
from probation_studies.paper.grip_tests import GRIPS, OPTIONS, PUBLISHED, identified, twin
from probation_studies.paper.relations import RATE_TABLE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation.law.companion import Companion
    from probation_studies.paper.grip_tests import Grip

_WHY_INTERCEPT = (
    "the printed intercept is not that of the regression of Table 2: a line of the printed slope through experiment 1 "
    "(5.207 s at 0.005 1/s) has it, and Tables 3 and 4 were computed with it"
)


def exhibit(settings: Settings) -> Exhibit:
    """Regress both relations on Table 2, and ask Tables 3 and 4 which of (11) they were made with."""
    eq_11, eq_12 = regress(FORMS["weissenberg"], RATE_TABLE), regress(FORMS["exponential"], RATE_TABLE)
    slope, intercept = (float(parameter) for parameter in eq_11.parameters)
    coefficient, exponent = (float(parameter) for parameter in eq_12.parameters)
    comparisons = [
        compare("(11), slope", WEISSENBERG_AS_PRINTED.slope, slope),
        compare("(11), intercept", WEISSENBERG_AS_PRINTED.intercept, intercept, because=_WHY_INTERCEPT),
        compare("(11), R²", WEISSENBERG_R_SQUARED, eq_11.r_squared),
        compare("(12), coefficient", EXPONENTIAL_AS_PRINTED.coefficient, coefficient, unit="s"),
        compare("(12), exponent", EXPONENTIAL_AS_PRINTED.exponent, exponent),
        compare("(12), R²", EXPONENTIAL_R_SQUARED, eq_12.r_squared),
    ]
    ratios, rows = {}, []
    for number in GRIPS:
        printed = PUBLISHED[number].identifications
        paper = printed[2].time.value / printed[3].time.value
        found = identified(number, settings.seed)
        with_12 = found[3].law.alpha or np.nan
        own, other = (found[2].law.alpha or np.nan) / with_12, _alpha(number, settings, slope, intercept) / with_12
        ratios[f"experiment-{number}"] = {"paper": paper, "as_printed": own, "as_regressed": other}
        comparisons.append(compare(f"α by (11) over α by (12), experiment {number}", paper, own))
        rows.append((f"experiment {number}", f"{paper:.3f}", f"{own:.3f}", f"{other:.3f}"))
    drawn: dict[str, Companion] = {
        "(11) as printed": WEISSENBERG_AS_PRINTED,
        "(12) as printed": EXPONENTIAL_AS_PRINTED,
        "(11) regressed on Table 2": eq_11.relation,
    }
    percent = {
        name: 100.0 * (each.relaxation_time(RATE_TABLE.rates) / RATE_TABLE.tau_max - 1.0)
        for name, each in drawn.items()
    }
    low = -percent["(11) as printed"]
    fast = ", ".join(f"{each:+.1f}" for each in percent["(12) as printed"][-3:])
    return Exhibit(
        title="Figure S2: the companion relations beside Table 2",
        says="Both relations capture the dependence on the strain rate, though (11) underestimates τ_max at very low "
        "rates; (12) represents it perfectly.",
        explanation=f"(11) as printed lies {low.min():.0f} to {low.max():.0f} % below Table 2 at every rate, outside "
        f"the fictitious error bars of 10 % of the figure; its regression, with the intercept {intercept:.4f}, does "
        f"not. (12) errs by {fast} % at the three fastest rates, which R² does not see beside 420 s. Tables 3 and 4 "
        "tell that the printed intercept is no misprint: the ratio of their α is that of the synthetic data with it, "
        "and is not with the regression's. `probation companion` chooses among forms by cross-validation and carries "
        "their covariance.",
        comparisons=tuple(comparisons),
        parts=(
            Drawing(
                "figure-s2",
                _figure(drawn),
                "Figure S2: τ_max and Weissenberg number of Table 2 over the strain rate, with fictitious error bars "
                "of 10 % as in the paper, and the relations.",
            ),
            Table(
                ("α by (11) over α by (12)", "paper", "synthetic, (11)", "(11) regressed on Table 2"),
                tuple(rows),
                "Which intercept Tables 3 and 4 were computed with",
            ),
        ),
        answer={"percent": percent, "alpha_ratios": ratios},
    )


def _alpha(number: Grip, settings: Settings, slope: float, intercept: float) -> float:
    """α of experiment 2 or 3 with another (11)."""
    relation = CompanionSettings("weissenberg", {"slope": slope, "intercept": intercept})
    law = LawSettings(companion=relation, fixed=OPTIONS[2].fixed)
    test = twin(number, settings.seed)
    return fit(Campaign(name=test.name, records=(test.record(),), law=law), gap=False).law.alpha or np.nan


def _figure(drawn: dict[str, Companion]) -> Figure:
    with styled_figure(7.2, 3.6) as figure:
        times, numbers = figure.subplots(1, 2)
        rates = np.geomspace(3e-5, 2e-2, 200)
        points = {"color": colour("data"), "fmt": "o", "ms": 4.5, "capsize": 2.5, "lw": 1.0, "zorder": 3}
        table = RATE_TABLE
        weissenberg = table.tau_max * table.rates
        times.errorbar(table.rates, table.tau_max, FICTITIOUS_ERROR * table.tau_max, label="Table 2", **points)
        numbers.errorbar(table.rates, weissenberg, FICTITIOUS_ERROR * weissenberg, **points)
        for at, (name, each) in enumerate(drawn.items()):
            style = ("--", "-", ":")[at]
            times.plot(rates, each.relaxation_time(rates), style, color=series_colour(at), label=name)
            numbers.plot(rates, each.weissenberg_number(rates), style, color=series_colour(at))
        times.set(xscale="log", yscale="log", xlabel="true strain rate [1/s]", ylabel="τ_max [s]")
        numbers.set(xscale="log", xlabel="true strain rate [1/s]", ylabel="We = τ_max·ε̇ [–]")
        times.legend(loc="lower left")
    return figure
