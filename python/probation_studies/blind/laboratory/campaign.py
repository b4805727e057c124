"""A campaign as a laboratory hands it over: campaign.toml and its records."""

from __future__ import annotations

import json
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation._files import make_folder, write_whole

if TYPE_CHECKING:
    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.truth import Truth


@dataclass(frozen=True, eq=False)
class WrittenRecord:
    """What a record's file holds, and what campaign.toml says of it."""

    id: str
    control: str
    held_out: bool
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    noise: dict[str, float]
    temperature: FloatArray | None = None


@dataclass(frozen=True, eq=False)
class SealedCampaign:
    """A campaign and what is withheld of it.

    Attributes
    ----------
    name : str
    records : tuple of WrittenRecord
    companion : tuple of float, or None
        Slope and intercept of a Weissenberg relation.
    truth : Truth
    specimens_differ : bool
        Whether every record has a specimen of its own; else the campaign states that they are alike.
    """

    name: str
    records: tuple[WrittenRecord, ...]
    companion: tuple[float, float] | None
    truth: Truth
    specimens_differ: bool = False

    def write(self, folder: str | Path) -> Path:
        """Write campaign.toml and one CSV file per record; nothing of the truth.

        Raises
        ------
        InputError, OSError
            If the folder cannot be written.
        """
        place = make_folder(folder)
        for record in self.records:
            write_whole(place / f"{record.id}.csv", _csv(record))
        write_whole(place / "campaign.toml", self._toml())
        return place

    def _toml(self) -> str:
        lines = [f"name = {json.dumps(self.name)}", "", "[law]", "modes = 50", "decades = 6.0"]
        if self.companion is not None:
            slope, intercept = self.companion
            lines += ["[law.companion]", 'form = "weissenberg"', f"slope = {slope!r}", f"intercept = {intercept!r}"]
        if not self.specimens_differ:
            lines += ["", "[specimens]", 'scatter = "none"']
        for record in self.records:
            role = "held-out" if record.held_out else "identify"
            lines += ["", "[[record]]", f'id = "{record.id}"', f'file = "{record.id}.csv"']
            lines += [f'control = "{record.control}"', f'role = "{role}"']
            if record.noise:
                inside = ", ".join(f"{name} = {value!r}" for name, value in record.noise.items())
                lines.append(f"noise = {{ {inside} }}")
        return "\n".join(lines) + "\n"


def _csv(record: WrittenRecord) -> str:
    text = StringIO()
    columns = {"time_s": record.time, "true_strain": record.true_strain, "true_stress_MPa": record.true_stress}
    if record.temperature is not None:
        columns["temperature_C"] = record.temperature
    text.write(",".join(columns) + "\n")
    np.savetxt(text, np.column_stack([*columns.values()]), fmt="%.12g", delimiter=",")
    return text.getvalue()
