"""A campaign: the records of one material, and the base law that they put to the test."""

import hashlib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from os import PathLike
from pathlib import Path
from typing import Any, Unpack

from numpy.typing import ArrayLike

from probation._complaint import quoted, suggestion
from probation._text import printable
from probation.errors import InputError
from probation.law.settings import LawSettings
from probation.records.campaign_file import load_campaign_file
from probation.records.in_memory import records_from_arrays, records_from_frame
from probation.records.options import ReadingKeys
from probation.records.reading import read_records
from probation.records.record import Noise, Record
from probation.records.said_once import said_once
from probation.records.saving import save_campaign
from probation.records.specimens import Specimens
from probation.results.frames import by_record
from probation.results.rendering import InOneLine


@dataclass(frozen=True)
class Campaign(InOneLine):
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
            The first file's name and how many more there are if left out.
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
        if name is None:
            name = Path(paths[0]).name.split(".")[0] + (f" and {len(paths) - 1} more" if len(paths) > 1 else "")
        return cls(name=name, records=tuple(records))

    @classmethod
    def from_arrays(
        cls,
        time: ArrayLike,
        *,
        true_strain: ArrayLike | None = None,
        engineering_strain: ArrayLike | None = None,
        stretch: ArrayLike | None = None,
        displacement: ArrayLike | None = None,
        true_stress: ArrayLike | None = None,
        engineering_stress: ArrayLike | None = None,
        force: ArrayLike | None = None,
        strain_rate: ArrayLike | None = None,
        transverse_strain: ArrayLike | None = None,
        temperature: ArrayLike | None = None,
        record: str | Iterable[object] = "record",
        units: Mapping[str, str] | None = None,
        specimen: Mapping[str, float] | Mapping[str, Mapping[str, float]] | None = None,
        control: str | Mapping[str, str] = "other",
        role: str | Mapping[str, str] = "identify",
        specimen_id: str | Mapping[str, str] | None = None,
        noise: Noise | Mapping[str, Noise] | None = None,
        start: str | Mapping[str, str] = "auto",
        name: str = "arrays",
        law: LawSettings | None = None,
        specimens: Specimens | None = None,
    ) -> "Campaign":
        """Take arrays as one record or several, by the checks and conversions that files go through.

        Parameters
        ----------
        time : array_like, shape (n_times,) [s]
        true_strain, engineering_strain, stretch, displacement : array_like, shape (n_times,) [-], [-], [-], [mm]
            One of them. Of several the truest is taken, as from a file.
        true_stress, engineering_stress, force : array_like, shape (n_times,) [MPa], [MPa], [N]
            One of them.
        strain_rate, transverse_strain, temperature : array_like, shape (n_times,) [1/s], [-], [°C], optional
        record : str or sequence of str, length n_times
            The record's id; or that of each sample, where the arrays hold several records one after the other.
        units : mapping of str to str, optional
            Unit of an argument that is in another one, such as ``{"force": "kN", "engineering_strain": "%"}``.
        specimen : mapping of str to float, optional
            For a force ``area_mm2``, or ``width_mm`` and ``thickness_mm``, or ``diameter_mm``; for a displacement
            ``gauge_length_mm``. Or such a mapping for each record, by its id.
        control, role, specimen_id, noise, start : optional
            As in `Record` and campaign.toml, for all records, or mappings by the record's id. `noise` is a
            `probation.Noise`.
        name : str
            Of the campaign.
        law : LawSettings, optional
        specimens : Specimens, optional

        Returns
        -------
        Campaign

        Raises
        ------
        InputError
            At the first thing that is wrong, naming argument and row (counted from 1), what was found and what was
            expected.
        """
        arrays: dict[str, Any] = {
            "time": time,
            "true_strain": true_strain,
            "engineering_strain": engineering_strain,
            "stretch": stretch,
            "displacement": displacement,
            "true_stress": true_stress,
            "engineering_stress": engineering_stress,
            "force": force,
            "strain_rate": strain_rate,
            "transverse_strain": transverse_strain,
            "temperature": temperature,
        }
        records = records_from_arrays(
            arrays,
            record=record,
            units=units,
            specimen=specimen,
            control=control,
            role=role,
            specimen_id=specimen_id,
            noise=noise,
            start=start,
        )
        return cls(name=name, records=records, law=law or LawSettings(), specimens=specimens or Specimens())

    @classmethod
    def from_dataframe(
        cls,
        frame: Any,
        *,
        record: str | None = None,
        columns: Mapping[str, str | int] | None = None,
        units: Mapping[str, str] | None = None,
        specimen: Mapping[str, float] | Mapping[str, Mapping[str, float]] | None = None,
        control: str | Mapping[str, str] = "other",
        role: str | Mapping[str, str] = "identify",
        specimen_id: str | Mapping[str, str] | None = None,
        noise: Noise | Mapping[str, Noise] | None = None,
        start: str | Mapping[str, str] = "auto",
        name: str = "data frame",
        law: LawSettings | None = None,
        specimens: Specimens | None = None,
    ) -> "Campaign":
        """Take the columns of a data frame as one record or several, as those of a file.

        Parameters
        ----------
        frame : data frame
            Of pandas or polars, a mapping of names to arrays, a structured array: anything with named columns. Their
            names are read as headings of files are: ``time_s``, ``"Force [kN]"``, ``engineering_strain``.
        record : str, optional
            The column that says which record a row belongs to. Left out, all rows are one record of the campaign's
            name.
        columns : mapping of str to (str or int), optional
            Name (or position counted from 1) of the column for each role, as in `preview`; by default found by the
            names.
        units, specimen, control, role, specimen_id, noise, start, name, law, specimens
            As in `from_arrays`; a unit that the column's name states need not be repeated.

        Returns
        -------
        Campaign

        Raises
        ------
        InputError
            At the first thing that is wrong, naming column and row (counted from 1), what was found and what was
            expected.
        """
        records = records_from_frame(
            frame,
            record=record,
            name=name,
            columns=columns,
            units=units,
            specimen=specimen,
            control=control,
            role=role,
            specimen_id=specimen_id,
            noise=noise,
            start=start,
        )
        return cls(name=name, records=records, law=law or LawSettings(), specimens=specimens or Specimens())

    def to_dataframe(self) -> Any:
        """All records as one pandas DataFrame, with a column "record"; `from_dataframe` takes it back.

        Raises
        ------
        InputError
            Where pandas is not installed.
        """
        return by_record({record.id: record.columns for record in self.records})

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

    def identified_on(self, ids: Collection[str]) -> tuple[Record, ...]:
        """Its records, these with role "identify" and the others held out: those tell of the extensometer."""
        roles = [(record, "identify" if record.id in ids else "held-out") for record in self.records]
        return tuple(record if record.role == role else replace(record, role=role) for record, role in roles)

    @property
    def held_out(self) -> tuple[Record, ...]:
        """The records that are never fitted, only predicted."""
        return tuple(record for record in self.records if record.role == "held-out")

    @property
    def warnings(self) -> tuple[str, ...]:
        """The warnings of all records, each once, with the ids of its records in front."""
        return said_once(self.records)

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
