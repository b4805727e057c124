"""Where a split keeps its campaigns, seals, truths and answers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from probation.errors import InputError
from probation_studies.blind.seal import SEALS_FILE, read_object


@dataclass(frozen=True)
class Layout:
    """The folders of a split.

    Attributes
    ----------
    folder : Path
        What is published: seals.json and campaigns/.
    truth_folder, answer_folder : Path, optional
        truths/ and answers/ in it if left out.
    """

    folder: Path
    truth_folder: Path | None = None
    answer_folder: Path | None = None

    @property
    def campaigns(self) -> Path:
        """One folder per campaign."""
        return self.folder / "campaigns"

    @property
    def truths(self) -> Path:
        """One file per campaign; a solver has no business here."""
        return self.truth_folder or self.folder / "truths"

    @property
    def answers(self) -> Path:
        """One file per campaign."""
        return self.answer_folder or self.folder / "answers"

    @property
    def baselines(self) -> list[str]:
        """Names of the baselines that have answered."""
        return sorted(path.name for path in (self.folder / "baselines").glob("*") if path.is_dir())

    def baseline(self, name: str) -> Layout:
        """The same split with a baseline's answers."""
        return Layout(self.folder, self.truth_folder, self.folder / "baselines" / name)

    def published(self) -> tuple[dict[str, object], dict[str, str]]:
        """What seals.json says, and the seal of every campaign.

        Raises
        ------
        InputError
            If there is none.
        """
        path = self.folder / SEALS_FILE
        if not path.is_file():
            raise InputError(f"{self.folder}: found no {SEALS_FILE}; expected a folder made by probation blind make")
        content = read_object(path)
        seals = content.get("seals")
        if not isinstance(seals, dict) or not seals:
            raise InputError(f"{path}: found no seals, expected one per campaign")
        return content, {str(name): str(seal) for name, seal in seals.items()}
