"""The constants between commas: to compile into a library, as CalculiX needs it for more than 21."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from probation.exporting.constants import MaterialConstants
from probation.exporting.header import c_comment
from probation.exporting.kind import Format
from probation.exporting.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    use = "to be compiled into the behaviour: -DPROBATION_CONSTANTS='\"this file\"'"
    return c_comment([*header, "", use]) + ",\n".join(map(repr, content.values)) + "\n"


def _read(text: str) -> MaterialConstants:
    numbers = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    return MaterialConstants(tuple(map(float, numbers.split(","))))


FORMAT = Format(
    "list", ".inc", "constants between commas, to compile into a library: the whole law", USER_MATERIAL, _write, _read
)
