"""LS-DYNA: ``*MAT_GENERAL_VISCOELASTIC`` (MAT_076), moduli and decay constants in fields of 10 columns."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.exporting.formats.keyword_cards import data_under
from probation.exporting.header import commented
from probation.exporting.kind import Format
from probation.exporting.numbers import field
from probation.exporting.prony import PRONY, PronySeries

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.request import Request

MOST_TERMS = 18
"""One of them is the relaxed modulus, which does not decay."""

_WIDTH = 10


def _write(request: Request, content: PronySeries, header: Sequence[str]) -> str:
    terms = [(content.relaxed, 0.0), *zip(content.modulus.tolist(), (1.0 / content.time).tolist(), strict=True)]
    return (
        "*KEYWORD\n"
        + commented(header, "$")
        + "*MAT_GENERAL_VISCOELASTIC_TITLE\n"
        + f"{request.name}\n"
        + "$      MID        RO      BULK\n"
        + f"{1:>{_WIDTH}}{field(request.density, _WIDTH)}{field(content.bulk, _WIDTH)}\n"
        + "$     LCID        NT    BSTART     TRAMP     LCIDK       NTK   BSTARTK    TRAMPK\n"
        + f"{0:>{_WIDTH}}\n"
        + "$       GI     BETAI\n"
        + "".join(field(modulus, _WIDTH) + field(decay, _WIDTH) + "\n" for modulus, decay in terms)
        + "*END\n"
    )


def _read(text: str) -> PronySeries:
    _, first, _, *rows = data_under(text, "*MAT_GENERAL_VISCOELASTIC", comment="$")
    bulk = float(first[2 * _WIDTH : 3 * _WIDTH])
    terms = np.array([[float(row[:_WIDTH]), float(row[_WIDTH : 2 * _WIDTH])] for row in rows])
    decaying = terms[:, 1] > 0.0
    return PronySeries(terms[decaying, 0], 1.0 / terms[decaying, 1], float(terms[~decaying, 0].sum()), bulk)


FORMAT = Format(
    "ls-dyna-prony",
    ".k",
    "LS-DYNA *MAT_GENERAL_VISCOELASTIC (MAT_076): the linear part at one rate",
    PRONY,
    _write,
    _read,
    most_modes=MOST_TERMS - 1,
)
