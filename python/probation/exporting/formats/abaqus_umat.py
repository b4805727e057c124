"""Abaqus: ``*USER MATERIAL`` for ``umat_``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.exporting.constants import MaterialConstants, state_size
from probation.exporting.formats.keyword_cards import data_under, listed, numbers
from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    return (
        commented(header, "**")
        + f"*MATERIAL, NAME={request.name.upper()}\n"
        + f"*USER MATERIAL, CONSTANTS={len(content.values)}, UNSYMM\n"
        + listed(content.values)
        + f"*DEPVAR\n{state_size(content.modes)}\n"
        + f"*DENSITY\n{listed([request.density])}"
    )


def read(text: str) -> MaterialConstants:
    """The constants of a ``*USER MATERIAL`` block."""
    return MaterialConstants(tuple(numbers(data_under(text, "*USERMATERIAL"))))


FORMAT = Format("abaqus-umat", ".inp", "Abaqus *USER MATERIAL for the UMAT: the whole law", USER_MATERIAL, _write, read)
