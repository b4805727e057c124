"""MGIS: material properties of the generic behaviour, as JSON.

The library declares how many there are: a list that is longer than 11 needs it compiled with the definitions stated.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from probation.answers import json_answer
from probation.exporting.constants import MaterialConstants, state_size
from probation.exporting.kind import Format
from probation.exporting.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request

BEHAVIOUR = "ProbationDNLR"

PROPERTIES = (
    "UnrelaxedModulus",
    "HardeningModulus",
    "BulkModulus",
    "Form",
    "TauMaxOrAlpha",
    "FirstCoefficient",
    "SecondCoefficient",
    "RateFloor",
    "RateFilter",
    "Modes",
    "Decades",
)
"""The constants as the behaviour declares them; what follows is called Kernel[0], Kernel[1], …"""

_BUILT_FOR_MODES, _BUILT_FOR_CONSTANTS = 50, len(PROPERTIES)


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    modes, count = max(content.modes, _BUILT_FOR_MODES), len(content.values)
    definitions = {"PROBATION_MGIS_CONSTANTS": count, "PROBATION_MGIS_MODES": modes}
    as_it_comes = (count, modes) == (_BUILT_FOR_CONSTANTS, _BUILT_FOR_MODES)
    return json_answer(
        "probation.mgis/1",
        {
            "header": list(header),
            "material": request.name,
            "behaviour": BEHAVIOUR,
            "hypothesis": "Tridimensional",
            "compile_definitions": {} if as_it_comes else definitions,
            "material_properties": dict(zip(_names(count), content.values, strict=True)),
            "internal_state_variables": state_size(modes),
            "density_t_per_mm3": request.density,
        },
    )


def _names(count: int) -> list[str]:
    return [*PROPERTIES, *(f"Kernel[{index}]" for index in range(count - len(PROPERTIES)))]


def _read(text: str) -> MaterialConstants:
    return MaterialConstants(tuple(map(float, json.loads(text)["material_properties"].values())))


FORMAT = Format("mgis", ".json", "MGIS generic behaviour, as JSON: the whole law", USER_MATERIAL, _write, _read)
