"""What a worker asks of the program: a command, or one of the two ways to read from Python."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from probation import Campaign
from probation.cli import main
from probation.errors import InputError
from probation.records.reading import read_records

READING_S = 10.0
"""Longest time that reading may take."""
COMPUTING_S = 60.0
"""Longest time that a computation on the few samples of a case may take."""
_COMPUTING = ("init", "fit", "companion", "certify", "diagnose", "crosscheck", "field", "excitation")


def limit_s(command: tuple[str, ...]) -> float:
    """How long a command may take."""
    return COMPUTING_S if command[0] in _COMPUTING else READING_S


def ask(command: list[str]) -> int:
    """Run a command; returns its exit status."""
    asked = {"read": _read, "load": _load, "init": _init}.get(command[0])
    if asked is None:
        return main(command)
    try:
        return asked(*command[1:]) or 0
    except InputError as error:
        print(f"probation: {error}", file=sys.stderr)
        return 2
    except Exception as error:
        print(f"probation: unexpected {type(error).__name__}: {error}", file=sys.stderr)
        return 1


def _init(*arguments: str) -> int:
    """Make a campaign; it must load, and hold no character that a terminal or an editor would obey."""
    status = main(["init", *arguments])
    if status == 0:
        folder = Path(arguments[arguments.index("-o") + 1])
        for each in Campaign.load(folder).records:
            print(f"loads: {each.id}")
        print((folder / "campaign.toml").read_text(encoding="utf-8"))
    return status


def _read(path: str, options: str = "{}") -> None:
    """Print the samples of every record of a file, and its warnings, as JSON."""
    records = read_records(Path(path), **json.loads(options))
    print(
        json.dumps(
            [
                {
                    "samples": {name: values.tolist() for name, values in record.samples.items()},
                    "warnings": record.warnings,
                }
                for record in records
            ]
        )
    )


def _load(path: str) -> None:
    """Print how many samples the records of a campaign have."""
    campaign = Campaign.load(path)
    print(json.dumps([len(record) for record in campaign.records]))
