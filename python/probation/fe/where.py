"""Where the installed package keeps what C++ needs."""

from __future__ import annotations

from pathlib import Path

from probation import _core


def cmake_prefix() -> Path:
    """Folder for CMAKE_PREFIX_PATH: find_package(probation) then gives probation::material."""
    return Path(str(_core.__file__)).resolve().parent / "cpp"


def include_path() -> Path:
    """Folder for the compiler's -I: <probation/material/point.hpp>, <probation.h>."""
    return cmake_prefix() / "include"


def interface_path() -> Path:
    """Folder with the sources of the interfaces: abaqus.cpp, calculix.cpp, mgis.cpp, c_abi.cpp."""
    return cmake_prefix() / "share" / "probation" / "interfaces"


def library_path() -> Path:
    """The compiled C interface, probation.h."""
    return cmake_prefix() / "lib" / "libprobation_c.so"


def calculix_library() -> Path:
    """The compiled CalculiX routine; ccx finds it by its name, libPROBATION.so, on the library path."""
    return cmake_prefix() / "lib" / "libPROBATION.so"
