"""The strain of a test from a second file, on a clock of its own: a video extensometer, image correlation."""

from collections.abc import Mapping
from pathlib import Path
from typing import cast

from probation._complaint import quoted, suggestion
from probation.errors import InputError
from probation.records.joining import Film
from probation.records.options import ReadingKeys
from probation.records.strain_history import read_strain_history

KEYS = ("file", "shift_s", "columns", "units", "specimen", "specimen_index", "sheet", "profile")
"""Those of ``strain_from``."""


def read_film(path: Path, given: Mapping[str, object]) -> Film:
    """Read the strain file that goes with a force file.

    Parameters
    ----------
    path : Path
        The force file; a relative name of the strain file is looked for beside it.
    given : mapping
        ``file``, perhaps ``shift_s``, and how it is read.

    Raises
    ------
    InputError
        If a key is unknown, no file is named, or it cannot be read.
    """
    for key in given:
        if key not in KEYS:
            raise InputError(f"{path}: strain_from: found the unknown key {quoted(key)}; {suggestion(key, KEYS)}")
    name, shift = given.get("file"), given.get("shift_s")
    if not isinstance(name, str) or not name:
        raise InputError(f"{path}: strain_from: found no file, expected the name of the strain file, file = …")
    if shift is not None and (isinstance(shift, bool) or not isinstance(shift, int | float) or not abs(shift) < 1e9):
        raise InputError(f"{path}: strain_from: found shift_s = {shift!r}, expected a number of seconds")
    how = cast("ReadingKeys", {key: value for key, value in given.items() if key not in ("file", "shift_s")})
    history = read_strain_history(path.parent / name, **how)
    return Film(
        history.file.name,
        history.time,
        history.true_strain,
        history.warnings,
        None if shift is None else float(shift),
    )
