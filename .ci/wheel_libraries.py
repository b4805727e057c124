"""Build what a wheel links statically, from source: .ci/wheel_libraries.py PREFIX. Untested on macOS and Windows.

cibuildwheel calls it once per machine ([tool.cibuildwheel] in pyproject.toml). Eigen is headers alone; of SUNDIALS
CVODE and its serial vectors are built.
"""

import subprocess
import sys
from pathlib import Path

SOURCES = {
    "eigen": ("https://gitlab.com/libeigen/eigen.git", "3.4.0"),
    "sundials": ("https://github.com/LLNL/sundials.git", "v7.1.1"),
}
OPTIONS = {
    "eigen": ["-DBUILD_TESTING=OFF", "-DEIGEN_BUILD_DOC=OFF"],
    "sundials": [
        *("-DBUILD_SHARED_LIBS=OFF", "-DBUILD_STATIC_LIBS=ON", "-DCMAKE_POSITION_INDEPENDENT_CODE=ON"),
        *("-DBUILD_CVODE=ON", *(f"-DBUILD_{name}=OFF" for name in ("ARKODE", "CVODES", "IDA", "IDAS", "KINSOL"))),
        *("-DEXAMPLES_ENABLE_C=OFF", "-DEXAMPLES_ENABLE_CXX=OFF", "-DEXAMPLES_INSTALL=OFF"),
    ],
}


def run(*command: str | Path) -> None:
    """Run a command; its failure ends the build."""
    subprocess.run([str(part) for part in command], check=True)


def main(prefix: Path) -> None:
    """Fetch, build and install both below `prefix`."""
    for name, (address, tag) in SOURCES.items():
        source, build = prefix / "source" / name, prefix / "build" / name
        if not source.exists():
            run("git", "clone", "--quiet", "--depth", "1", "--branch", tag, address, source)
        run(
            "cmake",
            "-S",
            source,
            "-B",
            build,
            f"-DCMAKE_INSTALL_PREFIX={prefix}",
            "-DCMAKE_BUILD_TYPE=Release",
            *OPTIONS[name],
        )
        run("cmake", "--build", build, "--config", "Release", "--target", "install")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
