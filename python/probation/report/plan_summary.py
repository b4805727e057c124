"""What planned tests will say, in words: the verdict, the parameters, the effects, the tests."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.parameter import SYMBOLS
from probation.report.fit_summary import estimate_text
from probation.report.isolability_table import HOW_TO_READ, in_words, isolability_table
from probation.report.table import Table
from probation.wording import percentage

if TYPE_CHECKING:
    from probation.design.plan import Plan
    from probation.inference.parameter import Parameter

EXPECTED = "Expected of a fit of all tests together, if the law is right"


def plan_verdict(plan: Plan) -> str:
    """How well the parameters would be known, and which effects could be named."""
    tests = "This test" if len(plan.tests) == 1 else f"These {len(plan.tests)} tests"
    errors = [f"{SYMBOLS[name]} {_relative(parameter)}" for name, parameter in plan.parameters.items()]
    effects = in_words(plan.isolability.headline, plan.isolability)
    return f"{tests} would give standard errors of {', '.join(errors)}. {effects}"


def plan_summary(plan: Plan) -> str:
    """The verdict, parameters, effects, tests."""
    effects = isolability_table(plan.isolability)
    warnings = "\n".join(f"warning: {warning}" for warning in plan.warnings)
    parts = [plan_verdict(plan), _parameters(plan), effects.text(), HOW_TO_READ, tests_table(plan).text(), warnings]
    return "\n\n".join(part for part in parts if part)


def parameter_table(plan: Plan) -> Table:
    """What a fit of all tests is expected to give: value and standard error of parameters and their product."""
    named = [
        *((SYMBOLS[name], parameter) for name, parameter in zip(plan.names, plan.parameters.values(), strict=True)),
        ("·".join(SYMBOLS[name] for name in plan.law.parameter_names[:2]), plan.product),
    ]
    rows = []
    for symbol, estimate in named:
        label = f"{symbol} [{estimate.unit}]" if estimate.unit else symbol
        value, _, interval = estimate_text(estimate).partition(", 95 % ")
        rows.append((label, value, interval, estimate.status.replace("_", " ")))
    return Table(
        ("parameter", "value ± standard error", "95 % interval", "by the tests"), tuple(rows), EXPECTED, left=4
    )


def correlations(plan: Plan) -> str:
    """Of the estimates, by pairs: "E_u–τ_max −0.9"; empty where there is no pair."""
    names = [SYMBOLS[name] for name in plan.names]
    known = [at for at, parameter in enumerate(plan.parameters.values()) if parameter.se is not None]
    return ", ".join(f"{names[i]}–{names[j]} {plan.correlation[i, j]:+.3f}" for i in known for j in known if j < i)


def _parameters(plan: Plan) -> str:
    pairs = correlations(plan)
    return parameter_table(plan).text() + (f"\n  correlations: {pairs}" if pairs else "")


def tests_table(plan: Plan) -> Table:
    """The tests as they were planned."""
    rows = tuple(
        (
            test.id,
            test.history,
            f"{test.samples}",
            f"{test.duration:.4g}",
            f"{test.largest_strain:.3g}",
            f"{test.stress_noise:.3g}",
            f"{test.strain_noise:.2g}" + ("" if test.smoothing == "raw" else f"\n{test.smoothing}"),
        )
        for test in plan.tests
    )
    headings = ("test", "history", "samples", "time [s]", "max. strain", "noise [MPa]", "of strain [–]")
    return Table(headings, rows, f"The tests, solved by {plan.scheme}", left=2)


def _relative(parameter: Parameter) -> str:
    if parameter.se is None or parameter.status == "not_identifiable":
        return "not identifiable"
    return (
        f"{percentage(parameter.se / abs(parameter.value))} %"
        if parameter.value
        else f"{parameter.se:.2g} {parameter.unit}"
    )
