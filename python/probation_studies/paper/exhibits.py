"""The exhibits, in the order of the page; a new one is a file and a line here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.histories.named import nearest
from probation_studies.paper import (
    certificate,
    figure_1,
    figure_2,
    figure_3,
    figure_4,
    figure_5,
    figure_6,
    figure_s1,
    figure_s2,
    figures_s3_to_s8,
    hardening_modulus,
    slips,
    table_1_exhibit,
    table_2,
    table_3,
    table_4,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation_studies.paper.exhibit import Exhibit, Settings


@dataclass(frozen=True)
class Entry:
    """An exhibit by its name on the command line."""

    name: str
    make: Callable[[Settings], Exhibit]


EXHIBITS: tuple[Entry, ...] = (
    Entry("figure-1", figure_1.exhibit),
    Entry("figure-2", figure_2.exhibit),
    Entry("table-1", table_1_exhibit.exhibit),
    Entry("table-2", table_2.exhibit),
    Entry("figure-3", figure_3.exhibit),
    Entry("figure-4a", figure_4.figure_4a),
    Entry("figure-4b", figure_4.figure_4b),
    Entry("table-3", table_3.exhibit),
    Entry("figure-5", figure_5.exhibit),
    Entry("table-4", table_4.exhibit),
    Entry("figure-6", figure_6.exhibit),
    Entry("figure-s1", figure_s1.exhibit),
    Entry("figure-s2", figure_s2.exhibit),
    Entry("figures-s3-s8", figures_s3_to_s8.exhibit),
    Entry("certificate", certificate.exhibit),
    Entry("hardening-modulus", hardening_modulus.exhibit),
    Entry("slips", slips.exhibit),
)


_TOGETHER = tuple(f"figure-s{number}" for number in range(3, 9))
"""Names of single figures that are made as one exhibit, "figures-s3-s8"."""


def named_exhibits(names: Sequence[str]) -> tuple[Entry, ...]:
    """Those exhibits, in the order of the page; all of them if no name is given.

    Raises
    ------
    InputError
        For an unknown name.
    """
    known = [entry.name for entry in EXHIBITS]
    names = ["figures-s3-s8" if name in _TOGETHER else name for name in names]
    for name in names:
        if name not in known:
            raise InputError(f"--only: found {name!r}; {nearest(name, known)}")
    return tuple(entry for entry in EXHIBITS if not names or entry.name in names)
