"""The law in CalculiX: one element against one dimension, a turned one, and a dumbbell that necks.

Needs a ccx with external behaviours: --ccx, else $CCX, else the one on $PATH, else build/calculix/ccx, which make fe
builds. The routine itself, libPROBATION.so, comes with the package.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.fe.calculix.dumbbell import Dumbbell
from probation.fe.calculix.element import stretch_element, turn_element
from probation.fe.calculix.necking import neck
from probation.fe.calculix.program import find_ccx
from probation.law.companion import WEISSENBERG_AS_PRINTED
from probation.law.modal import Law

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from probation.fe.calculix.element import Comparison

_DUMBBELL = Dumbbell()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what the command line asks for; 0, or 1 where a limit is missed, or 2 where nothing could be run."""
    given = _parser().parse_args(arguments)
    try:
        return _WHAT[given.what](given)
    except InputError as error:
        print(f"probation.fe.calculix: {error}", file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    summary, rest = (__doc__ or "").split("\n\n", 1)
    parser = argparse.ArgumentParser(prog="python -m probation.fe.calculix", description=summary, epilog=rest)
    what = parser.add_subparsers(dest="what", required=True)
    which = what.add_parser("which", help="print the ccx that would be run")
    which.add_argument("--ccx", type=Path, help="the program that is asked about")
    elements = (
        ("element", "pull one C3D8 with a rate jump, let it go", 3220.0, 1.8, 1e6),
        ("turn", "pull one C3D8, turn it by a right angle", 3220.0, 1.8, 2e4),
        ("neck", "pull a flat dumbbell at constant grip speed", 2000.0, 1.5, 2e4),
    )
    for name, text, unrelaxed, hardening, bulk in elements:
        each = what.add_parser(name, help=text, description=text)
        each.add_argument("--ccx", type=Path, help="the program; default: $CCX, ccx on $PATH, build/calculix/ccx")
        each.add_argument("--keep", type=Path, metavar="FOLDER", help="where to keep deck, log and results")
        for option, default, unit in (
            ("unrelaxed-modulus", unrelaxed, "E_u [MPa]"),
            ("hardening-modulus", hardening, "G [MPa]"),
            ("bulk-modulus", bulk, "K [MPa]"),
        ):
            each.add_argument(f"--{option}", type=float, default=default, help=f"{unit}; default {default:g}")
    necking = what.choices["neck"]
    for option, text in (
        ("half_gauge", "[mm]"),
        ("half_width", "[mm]"),
        ("half_thickness", "[mm]"),
        ("shoulder", "length [mm]"),
        ("half_head", "half width of the head [mm]"),
        ("imperfection", "fraction of the width"),
        ("nominal_rate", "grip speed over half gauge [1/s]"),
        ("largest_step", "of nominal strain [-]"),
        ("nominal_strain", "at the end [-]"),
    ):
        default = getattr(_DUMBBELL, option)
        necking.add_argument(
            f"--{option.replace('_', '-')}", type=float, default=default, help=f"{text}; default {default:g}"
        )
    necking.add_argument("--rate-filter", type=float, default=0.0, help="a strain [-]; default 0, none")
    necking.add_argument(
        "--elements",
        type=int,
        nargs=4,
        default=_DUMBBELL.elements,
        metavar=("GAUGE", "SHOULDER", "ACROSS", "THROUGH"),
        help=f"of one eighth; default {' '.join(map(str, _DUMBBELL.elements))}",
    )
    necking.add_argument("--threads", type=int, default=1, help="of ccx; default 1")
    necking.add_argument("--plot", type=Path, metavar="FILE", help="force, rate, shape as PNG, SVG or PDF")
    necking.add_argument("--json", type=Path, metavar="FILE", help="figures, time, strain and stress of the centre")
    return parser


def _law(given: argparse.Namespace) -> Law:
    return Law(
        unrelaxed_modulus=given.unrelaxed_modulus,
        hardening_modulus=given.hardening_modulus,
        companion=WEISSENBERG_AS_PRINTED,
    )


@contextmanager
def _folder(given: argparse.Namespace) -> Iterator[Path]:
    """Where the run goes: kept, or gone with it."""
    if given.keep:
        yield given.keep
        return
    with tempfile.TemporaryDirectory(prefix="probation-ccx-") as folder:
        yield Path(folder)


def _compared(run: Callable[[Path, Law, Path, float], tuple[Comparison, ...]]) -> Callable[[argparse.Namespace], int]:
    """The command of a run that ends in comparisons."""

    def command(given: argparse.Namespace) -> int:
        ccx, law = find_ccx(given.ccx), _law(given)
        with _folder(given) as folder:
            comparisons = run(ccx, law, folder, given.bulk_modulus)
        for comparison in comparisons:
            limit = (
                ""
                if comparison.limit is None
                else f"limit {comparison.limit:g}{'' if comparison.holds else '  MISSED'}"
            )
            print(f"{comparison.name:58s} {comparison.found:.2g}  {limit}".rstrip())
        return 0 if all(comparison.holds for comparison in comparisons) else 1

    return command


def _neck(given: argparse.Namespace) -> int:
    names = [name for name in vars(_DUMBBELL) if name != "elements"]
    dumbbell = Dumbbell(elements=tuple(given.elements), **{name: getattr(given, name) for name in names})
    ccx, law = find_ccx(given.ccx), _law(given)
    with _folder(given) as folder:
        necking = neck(
            ccx,
            law,
            folder,
            dumbbell,
            bulk_modulus=given.bulk_modulus,
            rate_filter=given.rate_filter,
            threads=given.threads,
        )
    for name, value in necking.figures().items():
        print(f"{name:36s} {value:.6g}")
    if given.plot:
        from probation.fe.calculix.picture import draw  # noqa: PLC0415 -- slow to import

        draw(necking, given.plot)
    if given.json:
        kept = ("time", "nominal_strain", "nominal_stress", "centre_strain", "centre_rate")
        given.json.write_text(
            json.dumps({"figures": necking.figures(), **{name: getattr(necking, name).tolist() for name in kept}})
        )
    return 0


def _which(given: argparse.Namespace) -> int:
    print(find_ccx(given.ccx))
    return 0


_WHAT = {"which": _which, "element": _compared(stretch_element), "turn": _compared(turn_element), "neck": _neck}


if __name__ == "__main__":
    sys.exit(main())
