"""One case: files, what is asked of the program, and what is known of the answer."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from fuzz.content import Content

CORPUS = Path(__file__).parent / "corpus"


@dataclass(frozen=True)
class Case:
    """One case.

    Attributes
    ----------
    kind : str
        Name of the module in kinds/ that makes such cases.
    command : tuple of str
        Arguments of ``probation``; or ``read FILE OPTIONS`` and ``load CAMPAIGN``, as in `fuzz.asked`.
    files : dict of str to content
        By their path below the folder that the command runs in.
    truth : dict of str to list of float, optional
        What a ``read`` must give, by quantity in internal units, where the values in the file are known.
    doubts : dict of str to list of str
        By quantity of the truth, the words (role, heading) that a warning about the unit behind it may name.
    answer : dict
        Entries that a JSON answer must have where there is one.
    outcome : str
        "read" or "refused" where only one of them is right.
    why : str
        What the case is about; for cases of the corpus.
    """

    kind: str
    command: tuple[str, ...]
    files: dict[str, Content]
    truth: dict[str, list[float]] | None = None
    doubts: dict[str, list[str]] = field(default_factory=dict)
    answer: dict[str, Any] = field(default_factory=dict)
    outcome: str = ""
    why: str = ""

    def to_json(self) -> str:
        """The case as text that a person can read."""
        known = {key: value for key, value in asdict(self).items() if value not in ("", None, {}, ())}
        return json.dumps(known, indent=1, ensure_ascii=True) + "\n"

    @classmethod
    def from_json(cls, text: str) -> Case:
        """A case back from text."""
        values: dict[str, Any] = json.loads(text)
        return cls(**{**values, "command": tuple(values["command"])})

    def save(self, name: str) -> Path:
        """Keep the case in the corpus."""
        folder = CORPUS / _slug(self.kind)
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{_slug(name)[:80]}.json"
        path.write_text(self.to_json(), encoding="ascii")
        return path


def _slug(text: str) -> str:
    return re.sub("[^a-z0-9]+", "-", text.casefold()).strip("-")


def corpus() -> list[Path]:
    """Every case that is kept."""
    return sorted(CORPUS.glob("*/*.json"))
