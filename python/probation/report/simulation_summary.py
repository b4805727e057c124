"""A simulated test in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.law.answer import law_answer
from probation.records.text_plot import text_plot

if TYPE_CHECKING:
    from probation.simulation import Simulation


def simulation_summary(simulation: Simulation, *, picture: bool = True) -> str:
    """What came out, with a plot for the terminal unless `picture` is off."""
    strain = f"true strain from {_number(simulation.true_strain.min())} to {_number(simulation.true_strain.max())}"
    stress = f"true stress from {_number(simulation.true_stress.min())} to {_number(simulation.true_stress.max())} MPa"
    outcome, imposed = (strain, stress) if simulation.stress_imposed else (stress, strain)
    parameters = ", ".join(f"{key} {value:g}" for key, value in law_answer(simulation.law)["parameters"].items())
    if simulation.stress_imposed:
        curve = (simulation.time, simulation.true_strain, "time [s]", "true strain [–]")
    else:
        curve = (simulation.true_strain, simulation.true_stress, "true strain [–]", "true stress [MPa]")
    lines = [
        f"Simulated {simulation.name}: {outcome}.",
        f"  {len(simulation.time)} instants over {_number(simulation.time[-1] - simulation.time[0])} s, {imposed}; "
        f"{how(simulation)}",
        f"  {parameters}{_companion(simulation)}",
    ]
    return "\n".join([*lines, text_plot(*curve)] if picture else lines)


def how(simulation: Simulation) -> str:
    """The scheme, for people."""
    return f"scheme {simulation.scheme}" + (f", start {simulation.start}" if simulation.scheme == "be2" else "")


def _companion(simulation: Simulation) -> str:
    return "" if simulation.law.companion is None else f", companion relation {simulation.law.companion.form}"


def _number(value: float) -> str:
    return f"{value + 0.0:.4g}"  # + 0.0: no "-0"
