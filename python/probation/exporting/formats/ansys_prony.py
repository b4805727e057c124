"""ANSYS: ``TB,PRONY`` with ``MP,EX`` and ``MP,NUXY``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.numbers import within
from probation.exporting.prony import PRONY, PronySeries

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request

MOST_PAIRS = 100
_PAIRS_PER_COMMAND = 3  # TBDATA takes six values
_WIDTH = 16


def _write(request: Request, content: PronySeries, header: Sequence[str]) -> str:
    fraction = content.modulus / content.instantaneous
    pairs = np.column_stack([fraction, content.time])
    rows = []
    for first in range(0, len(pairs), _PAIRS_PER_COMMAND):
        values = ",".join(within(value, _WIDTH) for value in pairs[first : first + _PAIRS_PER_COMMAND].ravel())
        rows.append(f"TBDATA,{2 * first + 1},{values}\n")
    return (
        commented(header, "!")
        + "! Material 1; the moduli are those at t = 0.\n"
        + f"MP,EX,1,{within(content.young, _WIDTH)}\n"
        + f"MP,NUXY,1,{within(content.poisson_ratio, _WIDTH)}\n"
        + f"MP,DENS,1,{within(request.density, _WIDTH)}\n"
        + f"TB,PRONY,1,,{len(pairs)},SHEAR\n"
        + "".join(rows)
    )


def _read(text: str) -> PronySeries:
    commands = [line.split(",") for line in text.splitlines() if line and not line.startswith("!")]
    constants = {row[1]: float(row[3]) for row in commands if row[0] == "MP"}
    values = [float(entry) for row in commands if row[0] == "TBDATA" for entry in row[2:]]
    return PronySeries.of_fractions(constants["EX"], constants["NUXY"], np.array(values[::2]), np.array(values[1::2]))


FORMAT = Format(
    "ansys-prony", ".mac", "ANSYS TB,PRONY: the linear part at one rate", PRONY, _write, _read, most_modes=MOST_PAIRS
)
