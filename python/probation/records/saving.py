"""Records and settings to files: campaign.toml and default CSVs, whole or not at all."""

import json
import re
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path

from probation._files import make_folder, write_whole
from probation.law.settings import CompanionSettings, LawSettings
from probation.records.record import Record
from probation.records.specimens import Specimens


def save_campaign(folder: Path, name: str, law: LawSettings, specimens: Specimens, records: Sequence[Record]) -> Path:
    """Write the CSVs, then the campaign.toml that names them.

    Returns
    -------
    Path
        The campaign.toml.
    """
    make_folder(folder)
    file_names = _file_names([record.id for record in records])
    for record, file_name in zip(records, file_names, strict=True):
        write_whole(folder / file_name, csv_text(record))
    path = folder / "campaign.toml"
    write_whole(path, campaign_text(name, law, specimens, records, file_names))
    return path


def csv_text(record: Record) -> str:
    """Write a record in the default CSV form; each number the shortest text that reads back the same."""
    lines = [",".join(record.columns)]
    columns = [values.tolist() for values in record.columns.values()]
    lines += [",".join(map(repr, row)) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def campaign_text(
    name: str, law: LawSettings, specimens: Specimens, records: Sequence[Record], file_names: Sequence[str]
) -> str:
    """Write the campaign.toml of records saved under these file names."""
    modes = {"modes": law.modes, "decades": law.decades}
    if law.accuracy is not None:
        modes["accuracy"] = law.accuracy
    parts = [lines_of({"name": name}), "[law]\n" + lines_of(modes)]
    if law.companion is not None:
        parts.append(companion_text(law.companion))
    if law.fixed:
        parts.append("[law.fixed]\n" + lines_of(law.fixed))
    if specimens != Specimens():
        parts.append("[specimens]\n" + lines_of({"scatter": specimens.scatter}))
    for record, file_name in zip(records, file_names, strict=True):
        noise = {"stress_MPa": record.noise.stress_MPa, "strain": record.noise.strain}
        known = {key: level for key, level in noise.items() if level is not None}
        entry = {"id": record.id, "file": file_name, "control": record.control, "role": record.role}
        specimen = {"specimen_id": record.specimen_id} if record.specimen_id is not None else {}
        parts.append("[[record]]\n" + lines_of({**entry, **specimen, **({"noise": known} if known else {})}))
    return "\n".join(parts)


def companion_text(companion: CompanionSettings) -> str:
    """Write the [law.companion] of a campaign.toml."""
    entry: dict[str, object] = {"form": companion.form, **companion.parameters}
    known = companion.calibration
    if known is not None:
        optional = {
            "calibrated_rates_per_s": known.rates,
            "log_scatter": known.log_scatter or None,
            "unrelaxed_modulus_MPa": known.unrelaxed_modulus_MPa,
            "covariance": known.covariance,
        }
        entry |= {key: value for key, value in optional.items() if value is not None}
    return "[law.companion]\n" + lines_of(entry)


def lines_of(values: Mapping[str, object]) -> str:
    """Keys and values as lines of TOML."""
    return "".join(f"{key} = {_toml(value)}\n" for key, value in values.items())


def _toml(value: object) -> str:
    match value:
        case str():
            return "".join(map(_escaped, json.dumps(value, ensure_ascii=False)))
        case Mapping():
            return "{ " + ", ".join(f"{key} = {_toml(entry)}" for key, entry in value.items()) + " }"
        case tuple():
            return "[" + ", ".join(map(_toml, value)) + "]"
    return repr(value)


def _escaped(character: str) -> str:
    """What does not print, or turns the order of what is read, as TOML escapes it; blanks stay."""
    if character.isprintable() or unicodedata.category(character) == "Zs":
        return character
    return f"\\u{ord(character):04x}" if ord(character) < 0x10000 else f"\\U{ord(character):08x}"


def _file_names(ids: Sequence[str]) -> list[str]:
    """Make a safe file name for each id, unique even where the disk folds capitals."""
    names: list[str] = []
    for record_id in ids:
        stem = re.sub(r"[^\w.\-]+", "_", record_id).strip("._")[:80] or "record"
        name, number = f"{stem}.csv", 2
        while name.casefold() in (taken.casefold() for taken in names):
            name, number = f"{stem}-{number}.csv", number + 1
        names.append(name)
    return names
