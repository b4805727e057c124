"""A campaign: the records of one material, and the base law that they put to the test."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Unpack

from probation._complaint import quoted, suggestion
from probation._text import printable
from probation.errors import InputError
from probation.law.settings import LawSettings
from probation.records.campaign_file import load_campaign_file
from probation.records.options import ReadingKeys
from probation.records.reading import read_records
from probation.records.record import Record
from probation.records.saving import save_campaign
from probation.records.specimens import Specimens


@dataclass(frozen=True)
class Campaign:
    """Records that share one material, and the base law put to the test on them.

    Load one with `load`, or make one in memory: ``Campaign(name="twin", records=(record, …))``.

    Attributes
    ----------
    name : str
        One printable line, in which control characters are escaped.
    records : tuple of Record
        In the order of the campaign file.
    law : LawSettings
    specimens : Specimens
        How far specimens differ; ``Specimens("none")`` for a virtual campaign.
    path : Path or None
        The campaign.toml; None for a campaign made in memory.
    file_sha256 : str
        Hash of the campaign.toml; empty for a campaign made in memory.

    Raises
    ------
    InputError
        If there are no records, two share an id, or none is to be identified on.
    """

    name: str
    records: tuple[Record, ...]
    law: LawSettings = field(default_factory=LawSettings)
    specimens: Specimens = field(default_factory=Specimens)
    path: Path | None = None
    file_sha256: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", printable(self.name))
        object.__setattr__(self, "records", tuple(self.records))
        if not self.records:
            raise InputError(f"campaign {quoted(self.name)}: found no records, expected at least one")
        ids = [record.id for record in self.records]
        for record_id in ids:
            if ids.count(record_id) > 1:
                raise InputError(
                    f"campaign {quoted(self.name)}: found the id {quoted(record_id)} more than once, "
                    "expected unique ids; rename one"
                )
        if not self.identify:
            raise InputError(
                f'campaign {quoted(self.name)}: found only held-out records, expected at least one with role "identify"'
            )

    @classmethod
    def load(cls, path: str | PathLike[str]) -> "Campaign":
        """Read a campaign folder, or its campaign.toml.

        Raises
        ------
        InputError
            At the first thing that is wrong in the campaign or in one of its files, naming
            file, row, column, what was found and what was expected.
        """
        read = load_campaign_file(Path(path))
        return cls(
            name=read.name,
            records=read.records,
            law=read.law,
            specimens=read.specimens,
            path=read.path,
            file_sha256=read.sha256,
        )

    @classmethod
    def from_files(
        cls,
        paths: Sequence[str | PathLike[str]],
        *,
        control: str = "other",
        name: str | None = None,
        **how: Unpack[ReadingKeys],
    ) -> "Campaign":
        """Take every specimen of some data files as a record to identify on, with a constant tau_max.

        Parameters
        ----------
        paths : sequence of path-like
            Read as `read_records` does, by the import profiles.
        control : {"strain-rate", "displacement-rate", "hold", "cyclic", "other"}
            How the tests were driven.
        name : str, optional
            The first file's name if left out.
        **how
            How each of the files is read, as in `preview`: ``profile``, ``columns``, ``units``, ``specimen``,
            ``specimen_index``, ``sheet``.

        Raises
        ------
        InputError
            If there is none, or at the first thing that is wrong in one of them.
        """
        if not paths:
            raise InputError("found no files, expected at least one")
        records = [record for path in paths for record in read_records(path, control=control, **how)]
        return cls(name=name or Path(paths[0]).name.split(".")[0], records=tuple(records))

    def save(self, folder: str | PathLike[str]) -> Path:
        """Write campaign.toml and one CSV per record, every digit kept.

        Each file appears whole or not at all, and campaign.toml last.

        Parameters
        ----------
        folder : path-like
            Made if need be.

        Returns
        -------
        Path
            The campaign.toml.
        """
        return save_campaign(Path(folder), self.name, self.law, self.specimens, self.records)

    @property
    def identify(self) -> tuple[Record, ...]:
        """The records that parameters are identified on."""
        return tuple(record for record in self.records if record.role == "identify")

    @property
    def held_out(self) -> tuple[Record, ...]:
        """The records that are never fitted, only predicted."""
        return tuple(record for record in self.records if record.role == "held-out")

    @property
    def warnings(self) -> tuple[str, ...]:
        """The warnings of all records, each with its record's id in front."""
        return tuple(f"{record.id}: {warning}" for record in self.records for warning in record.warnings)

    @property
    def data_hash(self) -> str:
        """SHA-256 over campaign.toml, settings, files and samples, in hexadecimal."""
        digest = hashlib.sha256(repr((self.file_sha256, self.name, self.law, self.specimens)).encode())
        for record in self.records:
            facts = (
                record.id,
                record.specimen_id,
                record.role,
                record.control,
                record.noise,
                record.sha256,
                record.samples_sha256,
            )
            digest.update(repr(facts).encode())
        return digest.hexdigest()

    def record(self, record_id: str) -> Record:
        """Find the record of that id.

        Raises
        ------
        InputError
            If there is none.
        """
        for record in self.records:
            if record.id == printable(record_id):
                return record
        hint = suggestion(record_id, [record.id for record in self.records])
        raise InputError(f"campaign {quoted(self.name)}: found no record {quoted(record_id)}; {hint}")
