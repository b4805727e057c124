"""What was exported, and how far it is from the law."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from probation._files import kind_of, write_whole
from probation.answers import json_answer
from probation.law.answer import law_answer
from probation.results.rendering import Summarised

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    from probation.exporting.check import Check
    from probation.exporting.kind import Format
    from probation.exporting.request import Request


@dataclass(frozen=True, eq=False)
class Export(Summarised):
    """One file for a finite-element code.

    Attributes
    ----------
    format : str
    text : str
        The file.
    content : object
        What the text says, read back: `MaterialConstants`, `PronySeries` or `StressTable`.
    checks : tuple of Check
        Errors against the law; the first is that of the round trip.
    request : Request
    """

    format: str
    text: str
    content: Any
    checks: tuple[Check, ...]
    request: Request
    _format: Format[Any]

    @property
    def file_name(self) -> str:
        """Such as "hdpe-abaqus-umat.inp"."""
        return f"{self.request.name.lower()}-{self.format}{self._format.ending}"

    @property
    def what(self) -> str:
        """The format, for people."""
        return self._format.what

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the file, whole or not at all; into a folder under its own name.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        target = Path(path) / self.file_name if kind_of(path) == "a folder" else Path(path)
        write_whole(target, self.text)
        return target

    def to_dict(self) -> dict[str, Any]:
        """What was exported, as Python objects."""
        reduction = self.request.reduction
        return {
            "format": self.format,
            "source": self.request.source,
            "law": law_answer(self.request.law),
            "reduction": None
            if reduction is None
            else {"modes": reduction.modes, "error": reduction.error, "ramp_error": reduction.ramp_error},
            "checks": {
                check.name: {"what": check.what, "error_MPa": check.error, "relative": check.relative}
                for check in self.checks
            },
        }

    def to_json(self) -> str:
        """The answer as JSON text, schema "probation.export/1"."""
        return exports_json([self])


def exports_json(exports: Sequence[Export]) -> str:
    """Several at once."""
    return json_answer("probation.export/1", {"exports": [each.to_dict() for each in exports]})
