"""A campaign as it is handed over, and what is withheld of it."""

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

    from probation_studies.blind.laboratories.university.modal_law import FloatArray

TRUTH_SCHEMA = "probation.blind.truth/1"


@dataclass(frozen=True)
class Truth:
    """What is withheld; the keys are those of the benchmark's truths.

    Attributes
    ----------
    content : mapping
    """

    content: Mapping[str, object]

    def to_json(self) -> str:
        """As JSON text, in full precision."""
        return json.dumps({"schema": TRUTH_SCHEMA, **self.content}, allow_nan=False, indent=1) + "\n"


@dataclass(frozen=True, eq=False)
class Record:
    """A record's file, and what campaign.toml says of it."""

    id: str
    control: str
    held_out: bool
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    declared_strain_noise: float | None = None

    def toml(self) -> list[str]:
        """Its lines."""
        role = "held-out" if self.held_out else "identify"
        lines = ["", "[[record]]", f'id = "{self.id}"', f'file = "{self.id}.csv"']
        lines += [f'control = "{self.control}"', f'role = "{role}"']
        if self.declared_strain_noise is not None:
            lines.append(f"noise = {{ strain = {self.declared_strain_noise!r} }}")
        return lines

    def csv(self) -> str:
        """Its samples."""
        text = StringIO()
        text.write("time_s,true_strain,true_stress_MPa\n")
        np.savetxt(text, np.column_stack([self.time, self.true_strain, self.true_stress]), fmt="%.12g", delimiter=",")
        return text.getvalue()


@dataclass(frozen=True, eq=False)
class SealedCampaign:
    """A campaign and its truth.

    Attributes
    ----------
    name : str
    records : tuple of Record
    companion : tuple of float, or None
        Slope and intercept of a Weissenberg relation.
    alike : bool
        Whether specimens are alike, which campaign.toml then says.
    truth : Truth
    """

    name: str
    records: tuple[Record, ...]
    companion: tuple[float, float] | None
    alike: bool
    truth: Truth

    def write(self, folder: str | Path) -> Path:
        """Write campaign.toml and one CSV file per record; nothing of the truth.

        Raises
        ------
        InputError, OSError
            If the folder cannot be written.
        """
        place = make_folder(folder)
        for record in self.records:
            write_whole(place / f"{record.id}.csv", record.csv())
        lines = [f"name = {json.dumps(self.name)}", "", "[law]", "modes = 50", "decades = 6.0"]
        if self.companion is not None:
            slope, intercept = self.companion
            lines += ["[law.companion]", 'form = "weissenberg"', f"slope = {slope!r}", f"intercept = {intercept!r}"]
        if self.alike:
            lines += ["", "[specimens]", 'scatter = "none"']
        for record in self.records:
            lines += record.toml()
        write_whole(place / "campaign.toml", "\n".join(lines) + "\n")
        return place
