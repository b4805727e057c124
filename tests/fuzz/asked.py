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
_COMPUTING = ("fit", "companion", "certify", "diagnose", "crosscheck", "field", "excitation")


def limit_s(command: tuple[str, ...]) -> float:
    """How long a command may take."""
    return COMPUTING_S if command[0] in _COMPUTING else READING_S


def ask(command: list[str]) -> int:
    """Run a command; returns its exit status."""
    if command[0] not in ("read", "load"):
        return main(command)
    try:
        (_read if command[0] == "read" else _load)(*command[1:])
    except InputError as error:
        print(f"probation: {error}", file=sys.stderr)
        return 2
    except Exception as error:
        print(f"probation: unexpected {type(error).__name__}: {error}", file=sys.stderr)
        return 1
    return 0


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
