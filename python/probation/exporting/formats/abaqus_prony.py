"""Abaqus: ``*VISCOELASTIC, TIME=PRONY`` with ``*ELASTIC, MODULI=INSTANTANEOUS``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.exporting.formats.keyword_cards import data_under, listed, numbers
from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.prony import PRONY, PronySeries

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request


def _write(request: Request, content: PronySeries, header: Sequence[str]) -> str:
    if content.relaxed <= 0.0:
        raise InputError("hardening_modulus: found 0, expected more: Abaqus wants fractions that sum to less than 1")
    fraction = content.modulus / content.instantaneous
    rows = [listed([g, 0.0, time]) for g, time in zip(fraction.tolist(), content.time.tolist(), strict=True)]
    return (
        commented(header, "**")
        + f"*MATERIAL, NAME={request.name.upper()}\n"
        + "*ELASTIC, MODULI=INSTANTANEOUS\n"
        + listed([content.young, content.poisson_ratio])
        + "*VISCOELASTIC, TIME=PRONY\n"
        + "".join(rows)
        + f"*DENSITY\n{listed([request.density])}"
    )


def _read(text: str) -> PronySeries:
    young, poisson_ratio = numbers(data_under(text, "*ELASTIC"))
    rows = np.array([numbers([line]) for line in data_under(text, "*VISCOELASTIC")])
    return PronySeries.of_fractions(young, poisson_ratio, rows[:, 0], rows[:, 2])


FORMAT = Format(
    "abaqus-prony", ".inp", "Abaqus *VISCOELASTIC, TIME=PRONY: the linear part at one rate", PRONY, _write, _read
)
