"""MGIS: material properties of the generic behaviour, as JSON."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from probation.answers import json_answer
from probation.export.constants import NAMES, MaterialConstants, state_size
from probation.export.kind import Format
from probation.export.user_material import USER_MATERIAL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.export.request import Request

_MODAL = {"ratio": "relaxation_ratio", "weight": "modal_weight", "rate": "table_rate_per_s", "time": "table_tau_max_s"}


def _write(request: Request, content: MaterialConstants, header: Sequence[str]) -> str:
    return json_answer(
        "probation.mgis/1",
        {
            "header": list(header),
            "material": request.name,
            "hypothesis": "Tridimensional",
            "material_properties": dict(zip(_names(content), content.values, strict=True)),
            "internal_state_variables": state_size(content.modes),
            "density_t_per_mm3": request.density,
        },
    )


def _names(content: MaterialConstants) -> list[str]:
    """Each constant's name; those of the modes and of a table are numbered from 1."""
    named = content.named()
    counts = dict.fromkeys(_MODAL, 0)
    if named["decades"] == 0.0:
        counts["ratio"] = counts["weight"] = content.modes
    points = (len(content.values) - len(NAMES) - counts["ratio"] - counts["weight"]) // 2
    counts["rate"] = counts["time"] = points
    return [*NAMES, *(f"{_MODAL[key]}_{index + 1}" for key, count in counts.items() for index in range(count))]


def _read(text: str) -> MaterialConstants:
    return MaterialConstants(tuple(map(float, json.loads(text)["material_properties"].values())))


FORMAT = Format("mgis", ".json", "MGIS generic behaviour, as JSON: the whole law", USER_MATERIAL, _write, _read)
