"""``python -m probation.fe``: where the C++ headers are, for a compiler's command line."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from probation.fe.where import calculix_library, cmake_prefix, include_path, interface_path, library_path

if TYPE_CHECKING:
    from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the path that was asked for."""
    parser = argparse.ArgumentParser(prog="python -m probation.fe", description=__doc__)
    which = parser.add_mutually_exclusive_group()
    for option, path, text in (
        ("--include", include_path, "for -I (the default)"),
        ("--cmake", cmake_prefix, "for CMAKE_PREFIX_PATH"),
        ("--interfaces", interface_path, "sources of the Abaqus, CalculiX, MGIS and C interfaces"),
        ("--library", library_path, "the compiled C interface"),
        ("--calculix", calculix_library, "the compiled CalculiX routine, whose folder LD_LIBRARY_PATH must name"),
    ):
        which.add_argument(option, dest="path", action="store_const", const=path, help=text)
    parser.set_defaults(path=include_path)
    print(parser.parse_args(arguments).path())
    return 0


if __name__ == "__main__":
    sys.exit(main())
