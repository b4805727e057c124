"""The files that the test house hands over."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import numpy as np

from probation._files import make_folder, write_whole
from probation_studies.blind.laboratories.industry.memory import FloatArray


@dataclass(frozen=True, eq=False)
class Record:
    """A record as it is handed over: time [s], true strain, true stress [MPa]."""

    id: str
    control: str
    held_out: bool
    specimen: str
    time: FloatArray
    strain: FloatArray
    stress: FloatArray
    noise: Mapping[str, float]


def write_campaign(
    folder: str | Path,
    name: str,
    records: Sequence[Record],
    companion: tuple[float, float] | None,
    notes: Sequence[str],
    *,
    alike: bool,
) -> Path:
    """Write campaign.toml and one CSV file per record.

    Raises
    ------
    InputError, OSError
        If the folder cannot be written.
    """
    place = make_folder(folder)
    lines = [*(f"# {note}" for note in notes), f"name = {json.dumps(name)}", "", "[law]", "modes = 50", "decades = 6.0"]
    if companion is not None:
        lines += ["[law.companion]", 'form = "weissenberg"']
        lines += [f"slope = {companion[0]!r}", f"intercept = {companion[1]!r}"]
    if alike:
        lines += ["", "[specimens]", 'scatter = "none"']
    for record in records:
        text = StringIO()
        text.write("time_s,true_strain,true_stress_MPa\n")
        np.savetxt(text, np.column_stack([record.time, record.strain, record.stress]), fmt="%.10g", delimiter=",")
        write_whole(place / f"{record.id}.csv", text.getvalue())
        role = "held-out" if record.held_out else "identify"
        lines += ["", "[[record]]", f'id = "{record.id}"', f'file = "{record.id}.csv"']
        lines += [f'specimen_id = "{record.specimen}"', f'control = "{record.control}"', f'role = "{role}"']
        if record.noise:
            lines.append("noise = { " + ", ".join(f"{key} = {value!r}" for key, value in record.noise.items()) + " }")
    write_whole(place / "campaign.toml", "\n".join(lines) + "\n")
    return place
