"""What is handed over: campaign.toml and one CSV file per record; the truth stays."""

from __future__ import annotations

import json
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation._files import make_folder, write_whole
from probation_studies.blind.laboratories.test_house.machine import observe

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.test_house.causes import Effect
    from probation_studies.blind.laboratories.test_house.modal import FloatArray
    from probation_studies.blind.laboratories.test_house.plan import Plan
    from probation_studies.blind.laboratories.test_house.trial import Test

_AREA, _GAUGE = 40.0, 30.0  # mm2, mm
_CONTROL = {"necking": "displacement-rate", "unloading": "cyclic"}
_THERMOMETER = 0.02  # degrees


@dataclass(frozen=True)
class Truth:
    """What is withheld; keys as in the benchmark's other truths."""

    content: Mapping[str, object]

    def to_json(self) -> str:
        """As JSON text, in full precision."""
        return json.dumps({"schema": "probation.blind.truth/1", **self.content}, allow_nan=False, indent=1) + "\n"


@dataclass(frozen=True, eq=False)
class Record:
    """A record that was taken.

    Attributes
    ----------
    test : Test
    columns : dict
        What is read, by the heads of the file.
    stress_error, strain_error : ndarray, shape (n,)
        What is wrong with the true stress [MPa] and the true strain.
    """

    test: Test
    columns: dict[str, FloatArray]
    stress_error: FloatArray
    strain_error: FloatArray

    def toml(self, *, alike: bool) -> list[str]:
        """Its lines."""
        name, control = self.test.name, _CONTROL.get(self.test.history.kind, "strain-rate")
        lines = ["", "[[record]]", f'id = "{name}"', f'file = "{name}.csv"', f'control = "{control}"']
        lines += ['role = "identify"', *([] if alike else [f'specimen_id = "{self.test.specimen}"'])]
        if "Load (N)" in self.columns:
            names = dict(zip(("time", "displacement", "force", "temperature"), self.columns, strict=False))
            said = ", ".join(f'{key} = "{head}"' for key, head in names.items())
            lines += [f"columns = {{ {said} }}", 'units = { force = "N", displacement = "mm" }']
            lines.append(f"specimen = {{ area_mm2 = {_AREA}, gauge_length_mm = {_GAUGE} }}")
        return lines

    def csv(self) -> str:
        """Its samples."""
        text = StringIO()
        text.write(",".join(self.columns) + "\n")
        np.savetxt(text, np.column_stack(list(self.columns.values())), fmt="%.9g", delimiter=",")
        return text.getvalue()


def take_records(random: Generator, plan: Plan, effects: Sequence[Effect]) -> tuple[Record, ...]:
    """Test every specimen: strain and stress are read, or travel and force; temperatures where they matter."""
    errors, found = plan.errors, []
    for test in plan.fine:
        strain, force = observe(test, effects)
        noise, slip = errors.draw_stress(random, len(strain)), errors.draw_strain(random, len(strain))
        if errors.force_channel:
            columns = {
                "Time (s)": test.history.time,
                "Extension (mm)": _GAUGE * (np.exp(strain) - 1.0 + slip),
                "Load (N)": _AREA * (force + noise),
            }
            head, off = "Temp (C)", (noise * np.exp(strain), slip * np.exp(-strain))
        else:
            columns = {
                "time_s": test.history.time,
                "true_strain": strain + slip,
                "true_stress_MPa": force * np.exp(strain + slip) + noise,
            }
            head, off = "temperature_C", (noise, slip)
        if plan.with_temperature:
            columns[head] = np.round(test.temperature + random.normal(0, _THERMOMETER, len(strain)), 2)
        found.append(Record(test, columns, *off))
    return tuple(found)


@dataclass(frozen=True, eq=False)
class Made:
    """A campaign and its truth."""

    name: str
    plan: Plan
    records: tuple[Record, ...]
    truth: Truth

    def write(self, folder: str | Path) -> Path:
        """Write what is handed over; nothing of the truth.

        Raises
        ------
        InputError, OSError
            If the folder cannot be written.
        """
        place = make_folder(folder)
        lines = [f"name = {json.dumps(self.name)}", "", "[law]", "modes = 50", "decades = 6.0"]
        if self.plan.law.companion is not None:
            slope, intercept = self.plan.law.companion
            lines += ["[law.companion]", 'form = "weissenberg"', f"slope = {slope!r}", f"intercept = {intercept!r}"]
        alike = self.plan.scatter is None
        if alike:
            lines += ["", "[specimens]", 'scatter = "none"']
        for record in self.records:
            write_whole(place / f"{record.test.name}.csv", record.csv())
            lines += record.toml(alike=alike)
        write_whole(place / "campaign.toml", "\n".join(lines) + "\n")
        return place
