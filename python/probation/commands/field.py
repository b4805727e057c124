"""``probation field``: the law on every pixel of a full-field campaign."""

from __future__ import annotations

import argparse
import os
import time

from probation.commands.cluster import add_cluster, cluster
from probation.commands.delivery import (
    add_delivery,
    deliver,
    named_numbers,
    output_folder,
    outputs_with_report,
    said,
    tell,
)
from probation.commands.progress import shown
from probation.commands.scheme_options import add_hold, add_scheme, add_substeps
from probation.commands.streams import say
from probation.errors import InputError

NAME = "field"

_DESCRIPTION = """\
The law on every pixel of a field: a zarr store of strain and stress over (y, x, time), maps of parameters out of it.

  probation field example --out neck/                          a synthetic necking specimen, 256 x 256 pixels
  probation field identify neck/field.zarr --out neck/maps.zarr
  probation field map neck/maps.zarr --truth neck/truth.zarr --report maps.html

An interrupted identification goes on where it stopped when it is called again. --scheduler takes the same call to a
dask cluster whose workers see the same folders.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="full fields: the law on every pixel", description=_DESCRIPTION)
    steps = parser.add_subparsers(title="steps", metavar="STEP", dest="step")
    example = steps.add_parser("example", help="make a synthetic necking field")
    example.add_argument(
        "--out", metavar="DIR", type=output_folder, required=True, help="folder for field.zarr and truth.zarr"
    )
    example.add_argument("--size", type=int, default=256, help="pixels along each side (256)")
    example.add_argument("--times", type=int, default=301, help="instants (301)")
    example.add_argument("--seed", type=int, default=1, help="of the noise (1)")
    identify = steps.add_parser("identify", help="identify the law on every pixel")
    identify.add_argument("field", metavar="FIELD", help="zarr store or netCDF file")
    identify.add_argument(
        "--out", metavar="MAPS.zarr", type=output_folder, required=True, help="store of the maps; gone on with if there"
    )
    identify.add_argument(
        "--column",
        metavar="ROLE=NAME",
        action="append",
        default=[],
        help="variable of a role (time, true_strain, engineering_strain, stretch, true_stress, engineering_stress, "
        "force, initial_area) where it is not named for it; repeatable",
    )
    add_scheme(identify)
    add_substeps(identify)
    identify.add_argument(
        "--method", choices=("variable-projection", "levenberg-marquardt"), default="variable-projection", help="search"
    )
    identify.add_argument(
        "--companion", metavar="FORM:NUMBERS", help="tau_max from the strain rate, as in probation simulate"
    )
    add_hold(identify)
    identify.add_argument(
        "--raw-strain", action="store_true", help="leave the strain's noise in: for no noise, or a discontinuous rate"
    )
    identify.add_argument(
        "--sparse",
        action="store_true",
        help="chunks that are not there hold no data: for a store whose writer leaves out chunks of nothing but NaN",
    )
    identify.add_argument("--pixels", type=int, default=4096, help="of a task, at most (4096)")
    identify.add_argument("--threads", type=int, help="of the engine, with --processes 1 (all processors)")
    identify.add_argument("--afresh", action="store_true", help="remove the maps that are there and begin anew")
    for step in (example, identify):
        add_cluster(step)
    maps = steps.add_parser("map", help="summarise and draw what was identified")
    maps.add_argument("maps", metavar="MAPS.zarr", help="as identify wrote it")
    maps.add_argument("--truth", metavar="TRUTH.zarr", help="what is true, as example writes it")
    add_delivery(maps)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    if options.step is None:
        raise InputError("field: found no step, expected example, identify or map; see probation field --help")
    return {"example": _example, "identify": _identify, "map": _map}[options.step](options)


def _example(options: argparse.Namespace) -> int:
    from probation.field.example.make import make_example  # noqa: PLC0415 - xarray and zarr are an extra

    with shown("making the field") as advance, cluster(options.scheduler) as executor:
        field, truth = make_example(
            options.out,
            size=options.size,
            times=options.times,
            seed=options.seed,
            processes=options.processes,
            executor=executor,
            progress=advance,
        )
    said("field", field)
    said("truth", truth)
    return 0


def _identify(options: argparse.Namespace) -> int:
    from probation.commands.law_options import companion_from  # noqa: PLC0415
    from probation.field.identify import BlockLostError, identify_field  # noqa: PLC0415
    from probation.field.maps import open_maps  # noqa: PLC0415
    from probation.field.source import open_field  # noqa: PLC0415
    from probation.law.modal import Law  # noqa: PLC0415

    columns = {}
    for entry in options.column:
        role, equals, name = (part.strip() for part in entry.partition("="))
        if not equals or not name:
            raise InputError(f"--column: found {entry!r}, expected ROLE=NAME")
        columns[role] = name
    law = None
    if options.companion is not None:
        law = Law(unrelaxed_modulus=1000.0, hardening_modulus=1.0, companion=companion_from(options.companion))
    source = open_field(options.field, columns, sparse=options.sparse)
    begun = time.perf_counter()
    try:
        with shown("identifying") as advance, cluster(options.scheduler) as executor:
            done = identify_field(
                source,
                options.out,
                law,
                options.scheme,
                method=options.method,
                smoothing=not options.raw_strain,
                substeps=options.substeps,
                hold=named_numbers(options.hold, "--hold"),
                pixels=options.pixels,
                processes=options.processes,
                threads=options.threads,
                executor=executor,
                afresh=options.afresh,
                progress=advance,
            )
    except BlockLostError as failure:
        say(f"probation: {failure}")
        return 1
    took = time.perf_counter() - begun
    again = f" ({done.again} of them anew: their maps were not what had been written)" if done.again else ""
    summary = open_maps(done.path).summary()
    said("maps", os.path.relpath(done.path))
    tell(f"{summary}\n  {done.now} blocks done now{again}, {done.before} before; {took:.3g} s")
    return 0


def _map(options: argparse.Namespace) -> int:
    from probation.field.maps import open_maps  # noqa: PLC0415

    with shown("reading the maps") as advance:
        maps = open_maps(options.maps, progress=advance)
        answer = maps if options.truth is None else maps.compared_with(options.truth)
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0
