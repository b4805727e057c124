"""CalculiX: a material whose name begins with ``@``, which loads the external behaviour."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.exporting.constants import NAMES, MaterialConstants, state_size
from probation.exporting.formats import abaqus_umat
from probation.exporting.formats.keyword_cards import listed
from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request

LIBRARY, FUNCTION = "PROBATION", "DNLR"
"""Upper-case, no underscore in the library's name: CalculiX splits ``@LIBRARY_FUNCTION`` at the first one."""

MOST_CONSTANTS = 21
"""That CalculiX passes to a behaviour."""


def _modes_that_fit(request: Request) -> int:
    """Ratio and weight of each beside the constants that have a name."""
    return (MOST_CONSTANTS - len(NAMES) - (request.stress_tolerance > 0.0)) // 2


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    if len(content.values) > MOST_CONSTANTS:
        raise InputError(
            f"modes: found {len(content.values)} constants, expected at most {MOST_CONSTANTS} in CalculiX; write the "
            f"format list and compile it into the behaviour, or take at most {_modes_that_fit(request)} modes"
        )
    return (
        commented(header, "**")
        + "** To be named by *SOLID SECTION. It needs a ccx with external behaviours.\n"
        + f"*MATERIAL, NAME=@{LIBRARY}_{FUNCTION}\n"
        + f"*USER MATERIAL, CONSTANTS={len(content.values)}\n"
        + listed(content.values)
        + f"*DEPVAR\n{state_size(content.modes)}\n"
        + f"*DENSITY\n{listed([request.density])}"
    )


FORMAT = Format(
    "calculix", ".inp", "CalculiX @ material for the external behaviour: the whole law", USER_MATERIAL, _write,
    abaqus_umat.read,
)  # fmt: skip
