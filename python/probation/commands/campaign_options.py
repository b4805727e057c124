"""A campaign from the command line: a folder, its campaign.toml, or data files that stand in for one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

    from probation.records import Campaign


def add_campaign(parser: argparse.ArgumentParser) -> None:
    """Add CAMPAIGN."""
    parser.add_argument(
        "campaign",
        metavar="CAMPAIGN",
        nargs="+",
        help="a folder with a campaign.toml, or that file; or data files, each specimen of which becomes a record",
    )


def add_control(parser: argparse.ArgumentParser) -> None:
    """Add ``--control``, for data files."""
    parser.add_argument(
        "--control",
        choices=("strain-rate", "displacement-rate", "hold", "cyclic", "other"),
        default="other",
        help="how the tests in data files were driven (other)",
    )


def campaign_from(options: argparse.Namespace) -> Campaign:
    """The campaign that the options name.

    Raises
    ------
    InputError
        At the first thing that is wrong in it.
    """
    from probation.records import Campaign  # noqa: PLC0415 - see the package

    first = Path(options.campaign[0])
    if len(options.campaign) > 1 or (first.is_file() and first.suffix != ".toml"):
        return Campaign.from_files(options.campaign, control=options.control)
    return Campaign.load(first)
