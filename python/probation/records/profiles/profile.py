"""What an import profile is: how to know a kind of file, and how to find its columns."""

from collections.abc import Callable
from dataclasses import dataclass, field

from probation.records.options import ReadOptions
from probation.records.source import Source
from probation.records.table import Table


@dataclass(frozen=True)
class Reading:
    """What a profile found in a file.

    Attributes
    ----------
    tables : tuple of Table
        One per specimen.
    separator : str
        For people: "comma", "semicolon", "tab", "sheet 'x'".
    specimen : dict of str to float
        ``area_mm2`` and ``gauge_length_mm`` that come with this kind of file.
    metadata : dict of str to str
        What the file says about itself above the headings.
    warnings : tuple of str
    machine : str
        Name of the machine or program that wrote the file, where its tables are known; empty otherwise.
    like_sheets : tuple of str
        Of a workbook, the sheets that have the headings of the one that was read, itself included; empty where a
        sheet was asked for.
    auxiliary : str
        Empty for stress-strain records; otherwise what the file holds instead.
    """

    tables: tuple[Table, ...]
    separator: str
    specimen: dict[str, float] = field(default_factory=dict)
    metadata: dict[str, str] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    machine: str = ""
    like_sheets: tuple[str, ...] = ()
    auxiliary: str = ""


@dataclass(frozen=True)
class Profile:
    """One kind of file.

    Attributes
    ----------
    name : str
        As in ``profile = "…"``.
    title : str
        What it is, in a few words.
    recognises : callable
        Whether a file is of this kind, judged by its content.
    read : callable
        Its columns; raises InputError where the file contradicts the profile.
    """

    name: str
    title: str
    recognises: Callable[[Source], bool]
    read: Callable[[Source, ReadOptions], Reading]
