"""From an identified law to the file of a finite-element code."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from probation._arrays import one_of
from probation.errors import InputError
from probation.exporting.formats import FORMATS
from probation.exporting.header import header_lines
from probation.exporting.request import BULK_TO_SHEAR, Request
from probation.exporting.result import Export
from probation.exporting.source import law_and_source

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.exporting.kind import Format
    from probation.identify.result import Fit
    from probation.law.modal import Law
    from probation.records.campaign import Campaign


def export(
    source: Law | Fit | Campaign | str | PathLike[str],
    format: str,  # noqa: A002 - as the option is called
    *,
    name: str = "probation",
    rate: float | None = None,
    rates: Sequence[float] | None = None,
    strain: float = 1.5,
    bulk_modulus: float | None = None,
    density: float = 9.5e-10,
    accuracy: float | None = None,
    modes: int | None = None,
    stress_tolerance: float = 0.0,
) -> Export:
    """Write an identified law for a finite-element code, read it back, and solve it again.

    Parameters
    ----------
    source : Law, Fit, Campaign, or path
        A campaign (or its path) is identified first; a path may also be that of the JSON that ``probation fit --json``
        wrote.
    format : str
        One of `probation.exporting.formats.FORMATS`: "abaqus-umat", "calculix", "mgis", "c", "list" (the whole law);
        "abaqus-prony", "ansys-prony", "ls-dyna-prony" (its linear part at one rate); "abaqus-plastic",
        "ls-dyna-mat-024" (flow curves by rate).
    name : str
        Of the material.
    rate : float, optional
        Strain rate whose tau_max a linear part takes [1/s]; needed with a companion relation.
    rates : sequence of float, optional
        Strain rates of flow curves, increasing [1/s]; two per decade of the companion relation's range if left out.
        Also where the whole law is checked.
    strain : float
        Largest true strain of curves and checks [-].
    bulk_modulus : float, optional
        [MPa]; 100 times E_u / 3 if left out.
    density : float
        [t/mm3].
    accuracy, modes : float, int, optional
        Fewer modes, to an accuracy or so many at most, as in `reduce_spectrum`. A format that holds fewer modes than
        the law gets as many as it holds.
    stress_tolerance : float [MPa]
        Of formats that keep the whole law: error of the stress above which an increment asks for a smaller one; 0: its
        size is not looked at.

    Returns
    -------
    Export

    Raises
    ------
    InputError
        If an argument is not possible, or the format cannot represent the law.
    """
    chosen = FORMATS[one_of(format, "format", tuple(FORMATS))]
    law, words = law_and_source(source)
    try:
        request = Request(
            law=law,
            original=law,
            source=words,
            name=name,
            rate=rate,
            rates=None if rates is None else tuple(float(value) for value in rates),
            strain=strain,
            bulk_modulus=_usual_bulk_modulus(law) if bulk_modulus is None else bulk_modulus,
            density=density,
            stress_tolerance=stress_tolerance,
        )
        return export_law(request, chosen, accuracy=accuracy, modes=modes)
    except InputError as error:
        if not isinstance(source, str | PathLike):
            raise
        raise InputError(f"{fspath(source)}: {error}") from None


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # the checks refuse what is not finite
def export_law(
    request: Request, chosen: Format[Any], *, accuracy: float | None = None, modes: int | None = None
) -> Export:
    """One format of a request."""
    request = _with_modes(request, chosen, accuracy, modes)
    content = chosen.kind.make(request)
    checks = tuple(chosen.kind.check(request, chosen.read(chosen.write(request, content, ()))))
    header = header_lines(
        chosen.what, [request.lines(), [check.text for check in checks], list(chosen.kind.say(request, content))]
    )
    return Export(chosen, chosen.write(request, content, header), checks, request)


def _usual_bulk_modulus(law: Law) -> float:
    modulus = BULK_TO_SHEAR * law.unrelaxed_modulus / 3.0
    if not 0.0 < modulus < float("inf"):
        raise InputError(f"unrelaxed_modulus: found {law.unrelaxed_modulus:g} MPa, expected that of a solid")
    return modulus


def _with_modes(request: Request, chosen: Format[Any], accuracy: float | None, modes: int | None) -> Request:
    most = chosen.most_modes
    if accuracy is None and modes is None:
        if most is None or request.law.modes <= most:
            return request
        return request.with_fewer_modes(modes=most)
    fewer = request.with_fewer_modes(accuracy=accuracy, modes=modes)
    if most is not None and fewer.law.modes > most:
        raise InputError(f"modes: found {fewer.law.modes}, expected at most {most} in the format {chosen.name}")
    return fewer
