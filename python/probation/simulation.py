"""What the law answers to an imposed history."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.answers import json_answer
from probation.law.answer import law_answer
from probation.law.creep import creep
from probation.law.modal import Law
from probation.law.schemes import Scheme, SchemeName, as_scheme
from probation.report.provenance import samples_sha256

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.histories import ImposedHistory


@dataclass(frozen=True, eq=False)
class Simulation:
    """A simulated test.

    Attributes
    ----------
    name : str
        Of the history.
    law : Law
    scheme : str
    start : str
        bE2's first step.
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    true_stress : ndarray, shape (n_times,) [MPa]
    stress_imposed : bool
        Creep: the strain is the answer.
    warnings : tuple of str
    """

    name: str
    law: Law
    scheme: str
    start: str
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    stress_imposed: bool
    warnings: tuple[str, ...]

    def summary(self, *, picture: bool = True) -> str:
        """What came out, with a plot for the terminal unless `picture` is off."""
        from probation.records.text_plot import text_plot  # noqa: PLC0415 - records need not be read to simulate

        strain = f"true strain from {_number(self.true_strain.min())} to {_number(self.true_strain.max())}"
        stress = f"true stress from {_number(self.true_stress.min())} to {_number(self.true_stress.max())} MPa"
        found, imposed = (strain, stress) if self.stress_imposed else (stress, strain)
        parameters = ", ".join(f"{key} {value:g}" for key, value in law_answer(self.law)["parameters"].items())
        if self.stress_imposed:
            curve = (self.time, self.true_strain, "time [s]", "true strain [–]")
        else:
            curve = (self.true_strain, self.true_stress, "true strain [–]", "true stress [MPa]")
        lines = [
            f"Simulated {self.name}: {found}.",
            f"  {len(self.time)} instants over {_number(self.time[-1] - self.time[0])} s, {imposed}; {self.how}",
            f"  {parameters}{self._companion()}",
        ]
        return "\n".join([*lines, text_plot(*curve)] if picture else lines)

    @property
    def how(self) -> str:
        """The scheme, for people."""
        return f"scheme {self.scheme}" + (f", start {self.start}" if self.scheme == "be2" else "")

    def plot(self) -> Figure:
        """Stress over strain, and both over time."""
        from probation.report.plots import simulation_plot  # noqa: PLC0415 - plots are slow to load

        return simulation_plot(self)

    def to_csv(self) -> str:
        """``time_s,true_strain,true_stress_MPa``: every number the shortest text that reads back the same."""
        columns = (self.time.tolist(), self.true_strain.tolist(), self.true_stress.tolist())
        rows = [",".join(map(repr, row)) for row in zip(*columns, strict=True)]
        return "\n".join(["time_s,true_strain,true_stress_MPa", *rows]) + "\n"

    def to_json(self) -> str:
        """The answer, schema "probation.simulation/1"."""
        return json_answer(
            "probation.simulation/1",
            {
                "history": self.name,
                "data_sha256": samples_sha256(self.time, self.true_stress if self.stress_imposed else self.true_strain),
                "scheme": self.scheme,
                "start": self.start if self.scheme == "be2" else None,
                "imposed": "true_stress_MPa" if self.stress_imposed else "true_strain",
                "law": law_answer(self.law),
                "warnings": self.warnings,
                "time_s": self.time,
                "true_strain": self.true_strain,
                "true_stress_MPa": self.true_stress,
            },
        )

    def _companion(self) -> str:
        return "" if self.law.companion is None else f", companion relation {self.law.companion.form}"


def simulate(
    law: Law,
    history: ImposedHistory,
    scheme: Scheme | SchemeName = "be2",
) -> Simulation:
    """Simulate a test.

    Parameters
    ----------
    law : Law
    history : ImposedHistory
        From `named_history`, `read_history`, or made of arrays.
    scheme : {"be2", "sa2", "sa3", "exact", "cvode"}, `BE2`, `SA2`, `SA3`, `Exact` or `CVODE`
        As in `Law.stress`; creep is always solved by be2.

    Returns
    -------
    Simulation
        Its `warnings` say where the companion relation is asked outside the rates it was calibrated on.

    Raises
    ------
    InputError
        Naming the argument, what was found and what was expected.
    ConvergenceError
        If CVODE fails.
    """
    chosen = as_scheme(scheme)
    if history.true_stress is not None:
        stress = history.true_stress
        strain = creep(
            law,
            history.time,
            stress,
            start=chosen.start,
            jumps="auto" if history.jumps is None else history.jumps or None,
        )
    else:
        assert history.true_strain is not None
        strain = history.true_strain
        stress = law.stress(history, scheme=chosen)
    rate = history.strain_rate if history.strain_rate is not None else np.diff(strain) / np.diff(history.time)
    extrapolation = None if law.companion is None else law.companion.extrapolation(rate)
    return Simulation(
        name=history.name,
        law=law,
        scheme="be2" if history.true_stress is not None else chosen.name,
        start=chosen.start,
        time=history.time,
        true_strain=strain,
        true_stress=stress,
        stress_imposed=history.true_stress is not None,
        warnings=() if extrapolation is None else (extrapolation,),
    )


def _number(value: float) -> str:
    return f"{value + 0.0:.4g}"  # + 0.0: no "-0"
