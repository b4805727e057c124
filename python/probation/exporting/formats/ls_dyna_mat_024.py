"""LS-DYNA: ``*MAT_PIECEWISE_LINEAR_PLASTICITY`` (MAT_024) with a ``*DEFINE_TABLE`` of curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.exporting.formats.keyword_cards import blocks
from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.numbers import field
from probation.exporting.stress_table import STRESS_TABLE, StressTable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request

INTERVALS = 1000
"""LS-DYNA divides curves anew into LCINT even intervals, 100 unless stated; the first yield points would be lost."""

_MATERIAL, _TABLE, _FIRST_CURVE = 1, 1000, 1001
_SHORT, _LONG = 10, 20


def _write(request: Request, content: StressTable, header: Sequence[str]) -> str:
    curves = [
        f"*DEFINE_CURVE\n$     LCID      SIDR       SFA       SFO      OFFA      OFFO    DATTYP     LCINT\n"
        f"{_FIRST_CURVE + index:>{_SHORT}}{0:>{_SHORT}}{'1.0':>{_SHORT}}{'1.0':>{_SHORT}}{'0.0':>{_SHORT}}"
        f"{'0.0':>{_SHORT}}{0:>{_SHORT}}{INTERVALS:>{_SHORT}}\n"
        + "".join(
            field(strain, _LONG) + field(value, _LONG) + "\n"
            for strain, value in zip(content.plastic_strain.tolist(), stress.tolist(), strict=True)
        )
        for index, stress in enumerate(content.stress)
    ]
    return (
        "*KEYWORD\n"
        + commented(header, "$")
        + "*MAT_PIECEWISE_LINEAR_PLASTICITY_TITLE\n"
        + f"{request.name}\n"
        + "$      MID        RO         E        PR      SIGY      ETAN      FAIL      TDEL\n"
        + f"{_MATERIAL:>{_SHORT}}{field(request.density, _SHORT)}{field(content.young, _SHORT)}"
        + f"{field(content.poisson_ratio, _SHORT)}\n"
        + "$        C         P      LCSS      LCSR        VP\n"
        + f"{'0.0':>{_SHORT}}{'0.0':>{_SHORT}}{_TABLE:>{_SHORT}}{0:>{_SHORT}}{'1.0':>{_SHORT}}\n"
        + "$     EPS1\n"
        + f"{'0.0':>{_SHORT}}\n"
        + "$      ES1\n"
        + f"{'0.0':>{_SHORT}}\n"
        + "$ Strain rates; their curves follow in the same order.\n"
        + f"*DEFINE_TABLE\n{_TABLE:>{_SHORT}}\n"
        + "".join(field(rate, _LONG) + "\n" for rate in content.rate.tolist())
        + "".join(curves)
        + "*END\n"
    )


def _read(text: str) -> StressTable:
    cards = list(blocks(text, "$"))
    material = next(data for keyword, data in cards if keyword.startswith("*MAT_"))
    table = next(data for keyword, data in cards if keyword == "*DEFINE_TABLE")
    curves = [data for keyword, data in cards if keyword == "*DEFINE_CURVE"]
    points = np.array([[_columns(row, _LONG)[:2] for row in data[1:]] for data in curves])
    _, _, young, poisson_ratio = _columns(material[1], _SHORT)
    return StressTable(
        np.array([float(row) for row in table[1:]]),
        points[0, :, 0],
        points[:, :, 1],
        young,
        poisson_ratio,
        int(_columns(curves[0][0], _SHORT)[7]),
    )


def _columns(row: str, width: int) -> list[float]:
    return [float(row[at : at + width]) for at in range(0, len(row), width)]


FORMAT = Format(
    "ls-dyna-mat-024",
    ".k",
    "LS-DYNA MAT_024 with *DEFINE_TABLE: flow curves by rate",
    STRESS_TABLE,
    _write,
    _read,
)
