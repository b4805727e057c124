"""The opening of the truths: which answers there were is written down first, and later ones are refused."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from probation._files import read_whole, write_whole
from probation.errors import InputError
from probation.origin import now
from probation_studies.blind.layout import Layout
from probation_studies.blind.seal import read_object
from probation_studies.blind.solve import folder_sha256

OPENED_FILE = "opened.json"


@dataclass(frozen=True)
class Handed:
    """Answers that were handed in, all to the data as they are published.

    Attributes
    ----------
    folder : Path
    digests : dict
        SHA-256 of every answer, by campaign.
    commits : dict
        How many each version and commit gave.
    """

    folder: Path
    digests: dict[str, str]
    commits: dict[str, int]


def handed_in(layout: Layout, names: Sequence[str]) -> Handed:
    """The answers in a folder.

    Raises
    ------
    InputError
        If one is missing, or was given to other data.
    """
    digests: dict[str, str] = {}
    commits: Counter[str] = Counter()
    missing = [name for name in names if not (layout.answers / f"{name}.json").is_file()]
    if missing:
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        raise InputError(f"{layout.answers}: found no answer to {missing[0]}{more}; run probation blind solve first")
    for name in names:
        path = layout.answers / f"{name}.json"
        answer = read_object(path)
        if answer.get("campaign_sha256") != folder_sha256(layout.campaigns / name):
            raise InputError(f"{path}: found an answer to other data than {layout.campaigns / name} holds")
        by = cast("Mapping[str, str]", answer.get("answered") or {})
        commits[f"{by.get('version', '?')} {by.get('commit', '')}".strip()] += 1
        digests[name] = hashlib.sha256(read_whole(path)).hexdigest()
    return Handed(layout.answers, digests, dict(commits))


def record_opening(layout: Layout, handed: Sequence[Handed], *, after_opening: bool) -> int:
    """Write down which answers there are, unless the truths were opened before; how many have come since.

    Raises
    ------
    InputError
        If any has come since, unless `after_opening` allows it.
    """
    record = layout.folder / OPENED_FILE
    if not record.exists():
        answers = {str(each.folder.resolve()): each.digests for each in handed}
        write_whole(record, json.dumps({"at": now(), "answers": answers}, indent=1) + "\n")
    opening = read_object(record)
    known = cast("dict[str, dict[str, str]]", opening["answers"])
    there = set().union(*(each.items() for each in known.values()))
    late = [
        (each.folder, name) for each in handed for name, digest in each.digests.items() if (name, digest) not in there
    ]
    if late and not after_opening:
        folder, name = late[0]
        raise InputError(
            f"{folder}: found an answer to {name} that was not there when the truths were opened "
            f"({opening['at']}); such answers are refused"
        )
    return len(late)
