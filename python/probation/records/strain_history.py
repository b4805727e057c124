"""Strain over time alone, as `simulate` and the excitation take it: files that need no stress."""

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Unpack

import numpy as np
from numpy.typing import NDArray

from probation._complaint import bad_input
from probation.records.extraction import extract
from probation.records.opening import chosen_tables, open_file, several_specimens
from probation.records.options import ReadingKeys, read_options

FloatArray = NDArray[np.float64]

_MINIMUM_SAMPLES = 2
"""Samples of a history, at least: a straight line."""


@dataclass(frozen=True, eq=False)
class StrainRecord:
    """The strain of a test, measured or imagined.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
        Strictly increasing, at least two samples.
    true_strain : ndarray, shape (n,) [-]
    strain_rate : ndarray, shape (n,) [1/s], or None
        True strain rate, where the file gives it.
    file : Path
    warnings : tuple of str
    """

    time: FloatArray
    true_strain: FloatArray
    strain_rate: FloatArray | None
    file: Path
    warnings: tuple[str, ...]


def read_strain_history(path: str | PathLike[str], **how: Unpack[ReadingKeys]) -> StrainRecord:
    """Read ``time_s,true_strain`` and perhaps ``strain_rate_per_s``; `how` as in `read_records`.

    Raises
    ------
    InputError
        At the first thing that is wrong, naming file, row, column, what was found and expected.
    """
    path = Path(path)
    options = read_options(path, **how)
    _, _, reading = open_file(path, options)
    if reading.auxiliary:
        raise bad_input(path, reading.auxiliary, "a strain history", remedy="name another file")
    tables = chosen_tables(path, reading, options.specimen_index)
    if len(tables) > 1:
        raise several_specimens(path, len(tables))
    _, table = tables[0]
    extracted = extract(table, reading, options, with_stress=False, minimum=_MINIMUM_SAMPLES)
    return StrainRecord(
        time=extracted.samples["time"],
        true_strain=extracted.true_strain,
        strain_rate=extracted.samples.get("strain_rate"),
        file=path,
        warnings=extracted.warnings,
    )
