"""A campaign from the command line: a folder, its campaign.toml, or data files that stand in for one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from probation._files import kind_of
from probation.commands.progress import shown
from probation.commands.reading_options import add_reading, reading_from, refuse_reading
from probation.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from probation.records.campaign import Campaign

CONTROLS = ("strain-rate", "displacement-rate", "hold", "cyclic", "other")


def add_campaign(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """Add CAMPAIGN; `optional` for a command that can do something without."""
    parser.add_argument(
        "campaign",
        metavar="CAMPAIGN",
        nargs="*" if optional else "+",
        help="a folder with a campaign.toml, or that file; or data files, each specimen of which becomes a record",
    )


def add_data_files(parser: argparse.ArgumentParser) -> None:
    """Add ``--control`` and how files are read, for data files."""
    add_reading(parser).add_argument(
        "--control", choices=CONTROLS, default="other", help="how the tests in data files were driven (other)"
    )


def add_held_out(parser: argparse.ArgumentParser) -> None:
    """Add ``--held-out``."""
    parser.add_argument(
        "--held-out",
        metavar="ID",
        action="append",
        default=[],
        help="predict this record and identify on all others, whatever their roles; may be given several times",
    )


def with_held_out(campaign: Campaign, held_out: Sequence[str]) -> Campaign:
    """The campaign with those records held out and all others to identify on; as it is where none is named.

    Raises
    ------
    InputError
        For an unknown record, or if none is left to identify on.
    """
    if not held_out:
        return campaign
    for name in held_out:
        try:
            campaign.record(name)
        except InputError as error:
            raise InputError(f"--held-out: {error}") from None
    if len(set(held_out)) == len(campaign.records):
        raise InputError("--held-out: found every record, expected at least one left to identify on")
    roles = {record.id: "held-out" if record.id in held_out else "identify" for record in campaign.records}
    return replace(campaign, records=tuple(replace(record, role=roles[record.id]) for record in campaign.records))


def campaign_from(options: argparse.Namespace) -> Campaign:
    """The campaign that `options.campaign` names."""
    return campaign_at(options.campaign, options)


def campaign_at(paths: Sequence[str], options: argparse.Namespace) -> Campaign:
    """A campaign, or data files that stand in for one.

    Parameters
    ----------
    paths : sequence of str
        A folder or campaign.toml; or data files, one or more.
    options : argparse.Namespace
        With those of `add_data_files`.

    Raises
    ------
    InputError
        At the first thing that is wrong in it.
    """
    from probation.records.campaign import Campaign  # noqa: PLC0415 - see the package

    if len(paths) > 1 or is_data_file(paths[0]):
        with shown(f"reading {paths[0] if len(paths) == 1 else f'{len(paths)} files'}"):
            return Campaign.from_files(paths, control=options.control, **reading_from(options))
    refuse_reading(options, f"the campaign {paths[0]}", "its campaign.toml says how its files are read")
    with shown(f"reading {paths[0]}"):
        return Campaign.load(paths[0])


def is_data_file(path: str) -> bool:
    """Whether it is there, and neither a folder nor a campaign.toml."""
    return kind_of(path) not in (None, "a folder") and Path(path).suffix != ".toml"
