"""CalculiX: a material whose name begins with ``@``, which loads the external behaviour."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.export.constants import MaterialConstants, state_size
from probation.export.formats import abaqus_umat
from probation.export.formats.keyword_cards import listed
from probation.export.header import commented
from probation.export.kind import Format
from probation.export.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.export.request import Request

LIBRARY, FUNCTION = "PROBATION", "DNLR"
"""Upper-case, no underscore in the library's name: CalculiX splits ``@LIBRARY_FUNCTION`` at the first one."""


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    return (
        commented(header, "**")
        + "** Every *SOLID SECTION that uses it names this material. It needs a ccx with external behaviours.\n"
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
