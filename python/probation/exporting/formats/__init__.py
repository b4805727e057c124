"""The formats, one per file; a new one is one file and one line here."""

from __future__ import annotations

from typing import Any

from probation.exporting.formats import (
    abaqus_plastic,
    abaqus_prony,
    abaqus_umat,
    ansys_prony,
    c_abi,
    calculix,
    ls_dyna_mat_024,
    ls_dyna_prony,
    mgis,
    number_list,
)
from probation.exporting.kind import Format

FORMATS: dict[str, Format[Any]] = {
    module.FORMAT.name: module.FORMAT
    for module in (
        abaqus_umat,
        calculix,
        mgis,
        c_abi,
        number_list,
        abaqus_prony,
        ansys_prony,
        ls_dyna_prony,
        abaqus_plastic,
        ls_dyna_mat_024,
    )
}
"""By name, in the order of the list for people."""
