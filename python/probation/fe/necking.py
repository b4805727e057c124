"""A round bar that necks between grips, in felupe: ``python -m probation.fe.necking --plot neck.png``."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.fe.bar import Bar
from probation.fe.neck import neck
from probation.fe.point import MaterialPoint
from probation.law.companion import Weissenberg
from probation.law.modal import Law

if TYPE_CHECKING:
    from collections.abc import Sequence


def add_bar_options(parser: argparse.ArgumentParser, **changed: float | None) -> None:
    """Options of material, geometry, mesh and steps; `changed` gives other defaults, None for an option left out."""
    group = parser.add_argument_group("material, geometry, mesh and steps")
    for name, default, text in (
        ("unrelaxed-modulus", 2000.0, "E_u [MPa]"),
        ("hardening-modulus", 1.5, "G [MPa]"),
        ("bulk-modulus", 2e4, "K [MPa]"),
        ("rate-filter", 0.0, "strain over which the rate is filtered [-]"),
        ("half-length", 15.0, "of the bar [mm]"),
        ("radius", 2.0, "of the bar [mm]"),
        ("imperfection", 0.02, "by which the section at the centre is smaller [-]"),
        ("nominal-rate", 1e-3, "grip speed over half length [1/s]"),
        ("largest-step", 0.01, "largest increment of nominal strain [-]"),
        ("largest-centre-step", 0.2, "increment of the centre's true strain aimed at [-]"),
        ("centre-strain", 1.8, "true strain of the centre at which to stop [-]"),
    ):
        value = changed.get(name.replace("-", "_"), default)
        if value is None:
            continue
        group.add_argument(f"--{name}", type=float, default=value, metavar="X", help=f"{text}; default {value:g}")
    group.add_argument(
        "--elements", type=int, nargs=2, default=(24, 2), metavar=("ALONG", "ACROSS"), help="default 24 2"
    )


def bar_of(given: argparse.Namespace) -> Bar:
    """The bar of the options."""
    return Bar(
        half_length=given.half_length,
        radius=given.radius,
        imperfection=given.imperfection,
        elements=tuple(given.elements),
        nominal_rate=getattr(given, "nominal_rate", Bar.nominal_rate),
        largest_step=given.largest_step,
        largest_centre_step=given.largest_centre_step,
        centre_strain=given.centre_strain,
    )


def law_of(given: argparse.Namespace) -> Law:
    """The law of the options, with eq. (11)."""
    return Law(
        unrelaxed_modulus=given.unrelaxed_modulus,
        hardening_modulus=given.hardening_modulus,
        companion=Weissenberg(0.00464, 0.0367),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the bar with the options of the command line and print its figures."""
    parser = argparse.ArgumentParser(prog="python -m probation.fe.necking", description=__doc__)
    add_bar_options(parser)
    parser.add_argument("--plot", type=Path, metavar="FILE", help="force, centre rate with Figure 1, and the neck")
    parser.add_argument("--json", type=Path, metavar="FILE", help="figures, and time, strain and rate of the centre")
    given = parser.parse_args(arguments)
    try:
        point = MaterialPoint.from_law(law_of(given), given.bulk_modulus, rate_filter=given.rate_filter)
        necking = neck(point, bar_of(given), stages=_STAGES)
    except InputError as error:
        print(f"necking: {error}", file=sys.stderr)
        return 2
    for name, value in necking.figures().items():
        print(f"{name:36s} {value:.6g}")
    if given.plot:
        from probation.fe.neck_pictures import draw_neck  # noqa: PLC0415 -- slow to import

        draw_neck(necking, given.plot)
    if given.json:
        arrays = {name: getattr(necking, name).tolist() for name in ("time", "centre_strain", "centre_rate")}
        given.json.write_text(json.dumps({"figures": necking.figures(), **arrays}))
    return 0


_STAGES = (0.3, 1.0)
"""Centre strains that the picture shows, beside the end."""


if __name__ == "__main__":
    sys.exit(main())
