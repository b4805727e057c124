"""The plain C interface: an array to include."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.exporting.constants import NAMES, MaterialConstants, state_size
from probation.exporting.header import c_comment
from probation.exporting.kind import Format
from probation.exporting.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    name, values = request.name.lower(), content.values
    comments = [*NAMES, *[""] * (len(values) - len(NAMES))]
    rows = [
        f"    {value!r}," + (f"  /* {index + 1}: {comment} */" if comment else "") + "\n"
        for index, (value, comment) in enumerate(zip(values, comments, strict=True))
    ]
    sizes = f"{name}_constants_count = {len(values)}, {name}_state_size = {state_size(content.modes)}"
    array = f"static const double {name}_constants[{len(values)}] = {{\n"
    return c_comment(header) + f"enum {{ {sizes} }};\n" + array + "".join(rows) + "};\n"


def _read(text: str) -> MaterialConstants:
    found = re.search(r"_constants\[\d+\] = \{(.*?)\};", text, re.DOTALL)
    if found is None:
        raise InputError("found no array of constants in the text, expected one")
    numbers = re.sub(r"/\*.*?\*/", "", found[1])
    return MaterialConstants(tuple(float(entry) for entry in numbers.split(",") if entry.strip()))


FORMAT = Format("c", ".h", "C array for the plain C interface: the whole law", USER_MATERIAL, _write, _read)
