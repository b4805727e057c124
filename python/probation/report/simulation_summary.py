"""A simulated test in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.law.answer import law_answer
from probation.records.text_plot import text_plot

if TYPE_CHECKING:
    from probation.simulation import Simulation


def simulation_summary(found: Simulation, *, picture: bool = True) -> str:
    """What came out, with a plot for the terminal unless `picture` is off."""
    strain = f"true strain from {_number(found.true_strain.min())} to {_number(found.true_strain.max())}"
    stress = f"true stress from {_number(found.true_stress.min())} to {_number(found.true_stress.max())} MPa"
    outcome, imposed = (strain, stress) if found.stress_imposed else (stress, strain)
    parameters = ", ".join(f"{key} {value:g}" for key, value in law_answer(found.law)["parameters"].items())
    if found.stress_imposed:
        curve = (found.time, found.true_strain, "time [s]", "true strain [–]")
    else:
        curve = (found.true_strain, found.true_stress, "true strain [–]", "true stress [MPa]")
    lines = [
        f"Simulated {found.name}: {outcome}.",
        f"  {len(found.time)} instants over {_number(found.time[-1] - found.time[0])} s, {imposed}; {how(found)}",
        f"  {parameters}{_companion(found)}",
    ]
    return "\n".join([*lines, text_plot(*curve)] if picture else lines)


def how(found: Simulation) -> str:
    """The scheme, for people."""
    return f"scheme {found.scheme}" + (f", start {found.start}" if found.scheme == "be2" else "")


def _companion(found: Simulation) -> str:
    return "" if found.law.companion is None else f", companion relation {found.law.companion.form}"


def _number(value: float) -> str:
    return f"{value + 0.0:.4g}"  # + 0.0: no "-0"
