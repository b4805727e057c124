"""What the institute hands over: campaign.toml and one CSV file per record; the truth stays."""

from __future__ import annotations

import json
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation._files import make_folder, write_whole

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation_studies.blind.laboratories.institute.modal import FloatArray
    from probation_studies.blind.laboratories.institute.series import Specimen


@dataclass(frozen=True)
class Truth:
    """What is withheld; keys as in the benchmark's other truths."""

    content: Mapping[str, object]

    def to_json(self) -> str:
        """As JSON text, in full precision."""
        return json.dumps({"schema": "probation.blind.truth/1", **self.content}, allow_nan=False, indent=1) + "\n"


@dataclass(frozen=True, eq=False)
class Record:
    """A record: time [s], true strain, true stress [MPa] and, where it is seen, the specimen's temperature [°C]."""

    id: str
    control: str
    held_out: bool
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    temperature: FloatArray | None
    strain_noise: float | None

    def toml(self) -> list[str]:
        """Its lines."""
        lines = ["", "[[record]]", f'id = "{self.id}"', f'file = "{self.id}.csv"', f'specimen_id = "P{self.id[:2]}"']
        lines += [f'control = "{self.control}"', f'role = "{"held-out" if self.held_out else "identify"}"']
        return lines if self.strain_noise is None else [*lines, f"noise = {{ strain = {self.strain_noise!r} }}"]

    def csv(self) -> str:
        """Its samples."""
        columns = {"time_s": self.time, "true_strain": self.true_strain, "true_stress_MPa": self.true_stress}
        if self.temperature is not None:
            columns["temperature_C"] = self.temperature
        text = StringIO()
        text.write(",".join(columns) + "\n")
        np.savetxt(text, np.column_stack(list(columns.values())), fmt="%.12g", delimiter=",")
        return text.getvalue()


@dataclass(frozen=True, eq=False)
class Made:
    """A campaign and its truth.

    Attributes
    ----------
    name : str
    records : tuple of Record
    companion : tuple of float, optional
    scatter : Specimen, optional
        Standard deviations of specimens that differ; None where they are alike.
    stated : bool
        Whether campaign.toml says by how much they differ.
    truth : Truth
    """

    name: str
    records: tuple[Record, ...]
    companion: tuple[float, float] | None
    scatter: Specimen | None
    stated: bool
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
        if self.companion is not None:
            lines += ["[law.companion]", 'form = "weissenberg"']
            lines += [f"{key} = {value!r}" for key, value in zip(("slope", "intercept"), self.companion, strict=True)]
        if self.scatter is None:
            lines += ["", "[specimens]", 'scatter = "none"']
        elif self.stated:
            names = "unrelaxed_modulus", "tau", "hardening_modulus", "area"
            said = ", ".join(f"{key} = {value:.3f}" for key, value in zip(names, self.scatter.values, strict=True))
            lines += ["", "[specimens]", f"scatter = {{ {said} }}"]
        for record in self.records:
            write_whole(place / f"{record.id}.csv", record.csv())
            lines += record.toml()
        write_whole(place / "campaign.toml", "\n".join(lines) + "\n")
        return place
