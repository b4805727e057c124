"""What a release's test split must be: large enough, of a seed that was not used before, scored once."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import cast

from probation._files import write_whole
from probation.errors import InputError
from probation.origin import commit, now
from probation_studies.blind.seal import read_object

LEAST_CAMPAIGNS, LEAST_NULLS = 600, 250

SEEDS_FILE = Path(__file__).parent / "test_seeds.json"
"""Seeds of test splits that were scored; nothing is written before, since a seed gives the truths away."""


def shortfall(campaigns: int, nulls: int) -> str | None:
    """What a test split lacks for a release; None if nothing."""
    if campaigns >= LEAST_CAMPAIGNS and nulls >= LEAST_NULLS:
        return None
    return (
        f"{campaigns} campaigns with {nulls} nulls: too few for a release, which takes {LEAST_CAMPAIGNS} or more with "
        f"{LEAST_NULLS} nulls or more"
    )


def spent_seeds(path: Path = SEEDS_FILE) -> dict[int, Mapping[str, object]]:
    """Test splits that were scored, by seed.

    Raises
    ------
    InputError
        If the file holds something else.
    """
    entries = read_object(path).get("test")
    if not isinstance(entries, list) or not all(isinstance(entry, dict) and "seed" in entry for entry in entries):
        raise InputError(f"{path}: found no list 'test' of objects with a seed")
    return {cast("int", entry["seed"]): entry for entry in entries}


def check_seed(seed: int, path: Path = SEEDS_FILE) -> None:
    """Refuse a seed whose truths are known.

    Raises
    ------
    InputError
        If a test split of that seed was scored.
    """
    spent = spent_seeds(path).get(seed)
    if spent is not None:
        raise InputError(
            f"seed: found {seed}, whose test split was scored ({spent.get('at', 'when?')}), expected a seed that was "
            "not used before"
        )


def spend_seed(seed: int, campaigns: int, path: Path = SEEDS_FILE) -> bool:
    """Write down that a test split was scored; False where it is known already, or there is no source tree to keep it.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    if seed in spent_seeds(path) or not commit():
        return False
    entries = [*spent_seeds(path).values(), {"seed": seed, "campaigns": campaigns, "commit": commit(), "at": now()}]
    write_whole(path, json.dumps({"test": entries}, indent=1) + "\n")
    return True
