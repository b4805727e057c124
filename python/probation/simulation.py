"""What the law answers to an imposed history."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.answers import json_answer
from probation.law.answer import law_answer, law_from_answer
from probation.law.creep import creep
from probation.law.modal import Law
from probation.law.schemes import Scheme, SchemeName, as_scheme
from probation.provenance import samples_sha256
from probation.results.frames import data_frame, over_time
from probation.results.reading import answer_in
from probation.results.rendering import InOneLine, Plotted, rendered

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.histories import ImposedHistory

SCHEMA = "probation.simulation/1"


@dataclass(frozen=True, eq=False)
class Simulation(Plotted, InOneLine):
    """A simulated test.

    `plot` draws stress over strain, and both over time.

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
        text: str = rendered(self, "summary", picture=picture)
        return text

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame, with the headings of `to_csv`.

        Raises
        ------
        InputError
            Where pandas is not installed.
        """
        return data_frame(self._columns())

    def to_xarray(self) -> Any:
        """As an xarray Dataset over "time_s".

        Raises
        ------
        InputError
            Where xarray is not installed.
        """
        return over_time(self._columns())

    def _columns(self) -> dict[str, FloatArray]:
        return {"time_s": self.time, "true_strain": self.true_strain, "true_stress_MPa": self.true_stress}

    def to_csv(self) -> str:
        """``time_s,true_strain,true_stress_MPa``: every number the shortest text that reads back the same."""
        columns = (self.time.tolist(), self.true_strain.tolist(), self.true_stress.tolist())
        rows = [",".join(map(repr, row)) for row in zip(*columns, strict=True)]
        return "\n".join(["time_s,true_strain,true_stress_MPa", *rows]) + "\n"

    def to_dict(self) -> dict[str, object]:
        """The answer as Python objects."""
        return {
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
        }

    def to_json(self) -> str:
        """The answer, schema "probation.simulation/1"."""
        return json_answer(SCHEMA, self.to_dict())

    @classmethod
    def from_json(cls, text: str) -> Simulation:
        """The simulation that `to_json` wrote.

        Parameters
        ----------
        text : str

        Raises
        ------
        InputError
            If the text is not what `to_json` writes.
        """
        with answer_in(text, SCHEMA) as answer:
            return cls(
                name=answer["history"],
                law=law_from_answer(answer["law"]),
                scheme=answer["scheme"],
                start=answer["start"] or "exponential",
                time=np.array(answer["time_s"], dtype=float),
                true_strain=np.array(answer["true_strain"], dtype=float),
                true_stress=np.array(answer["true_stress_MPa"], dtype=float),
                stress_imposed=answer["imposed"] == "true_stress_MPa",
                warnings=tuple(answer["warnings"]),
            )


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
