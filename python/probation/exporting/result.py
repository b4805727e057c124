"""What was exported, and how far it is from the law."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from probation._files import kind_of, write_whole
from probation.errors import InputError
from probation.law.answer import law_answer
from probation.results.data import Stored, named_in
from probation.results.rendering import Summarised

if TYPE_CHECKING:
    from os import PathLike

    from probation.exporting.check import Check
    from probation.exporting.kind import Format
    from probation.exporting.request import Request


@dataclass(frozen=True, eq=False)
class Export(Summarised, Stored):
    """One file for a finite-element code.

    Attributes
    ----------
    form : Format
    text : str
        The file.
    checks : tuple of Check
        Errors against the law; the first is that of the round trip.
    request : Request
    """

    form: Format[Any] = field(metadata=named_in("exporting.formats.FORMATS"))
    text: str
    checks: tuple[Check, ...]
    request: Request

    @property
    def format(self) -> str:
        """Its name, such as "abaqus-umat"."""
        return self.form.name

    @cached_property
    def content(self) -> Any:
        """What the text says, read back: `MaterialConstants`, `PronySeries` or `StressTable`."""
        return self.form.read(self.text)

    @property
    def file_name(self) -> str:
        """Such as "hdpe-abaqus-umat.inp"."""
        return f"{self.request.name.lower()}-{self.format}{self.form.ending}"

    @property
    def what(self) -> str:
        """The format, for people."""
        return self.form.what

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

    def to_json(self, *, curves: bool = False) -> str:
        """The answer as JSON text, that of `Exports` with this one in it."""
        return Exports((self,)).to_json(curves=curves)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """The export that `to_json` wrote.

        Raises
        ------
        InputError
            If the text is not what `to_json` writes, or holds several exports: `Exports.from_json` reads those.
        """
        exports = Exports.from_json(text).exports
        if len(exports) != 1 or not isinstance(exports[0], cls):
            raise InputError(f"the text: found {len(exports)} exports, expected one; Exports.from_json reads several")
        return exports[0]


@dataclass(frozen=True, eq=False)
class Exports(Stored):
    """One law in several formats."""

    SCHEMA = "probation.export/1"

    exports: tuple[Export, ...]

    def to_dict(self) -> dict[str, Any]:
        """What was exported, as Python objects."""
        return {"exports": [export.to_dict() for export in self.exports]}
