"""Abaqus: ``*PLASTIC, RATE=`` with ``*ELASTIC``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.exporting.formats.keyword_cards import NUMBER_WIDTH, blocks, data_under, listed, numbers
from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.numbers import within
from probation.exporting.stress_table import STRESS_TABLE, StressTable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request


def _write(request: Request, content: StressTable, header: Sequence[str]) -> str:
    return (
        commented(header, "**")
        + "** The first block, without a rate, stands for rate 0: it is that of the\n"
        + "** slowest rate.\n"
        + f"*MATERIAL, NAME={request.name.upper()}\n"
        + f"*DENSITY\n{listed([request.density])}"
        + f"*ELASTIC\n{listed([content.young, content.poisson_ratio])}"
        + "*PLASTIC\n"
        + _curve(content, 0)
        + "".join(
            f"*PLASTIC, RATE={within(rate, NUMBER_WIDTH)}\n" + _curve(content, index)
            for index, rate in enumerate(content.rate.tolist())
        )
    )


def _curve(content: StressTable, index: int) -> str:
    pairs = zip(content.stress[index].tolist(), content.plastic_strain.tolist(), strict=True)
    return "".join(listed(pair) for pair in pairs)


def _read(text: str) -> StressTable:
    young, poisson_ratio = numbers(data_under(text, "*ELASTIC"))
    curves = {
        float(keyword.partition("RATE=")[2]): np.array([numbers([line]) for line in data])
        for keyword, data in blocks(text, "**")
        if keyword.startswith("*PLASTIC,RATE=")
    }
    return StressTable(
        np.array(list(curves)),
        next(iter(curves.values()))[:, 1],
        np.array([curve[:, 0] for curve in curves.values()]),
        young,
        poisson_ratio,
    )


FORMAT = Format("abaqus-plastic", ".inp", "Abaqus *PLASTIC, RATE=: flow curves by rate", STRESS_TABLE, _write, _read)
