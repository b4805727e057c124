"""How much processor time does it take to build the package from source?

`python -m bench.from_source` builds a wheel in a new folder, as `pip install .` does, with the build tools of this
environment, and says which files took longest. It takes a minute or two, so that a run of the bench leaves it out.
"""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

GOAL = 120.0
"""Seconds of processor time, user and system."""


def build(folder: Path) -> float:
    """Build a wheel below `folder`; return the seconds of processor time, user and system."""
    command = [sys.executable, "-m", "pip", "--quiet", "wheel", "--no-deps", "--no-build-isolation", "--no-cache-dir"]
    command += ["--wheel-dir", str(folder), f"--config-settings=build-dir={folder}/build", str(ROOT)]
    # As a shell in which the environment is active: CMake and Ninja are looked for on the path.
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    begin = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, env=os.environ | {"PATH": path})
    end = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (end.ru_utime - begin.ru_utime) + (end.ru_stime - begin.ru_stime)


def slowest(ninja_log: str, count: int) -> list[tuple[float, str]]:
    """The steps that took longest: seconds of wall time, and what they made."""
    lines = (line.split("\t") for line in ninja_log.splitlines() if not line.startswith("#"))
    steps = ((int(end) - int(begin), made) for begin, end, _, made, _ in lines)
    return [(milliseconds / 1000, made) for milliseconds, made in sorted(steps, reverse=True)[:count]]


def main() -> int:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        seconds = build(folder)
        log = next(folder.glob("**/.ninja_log")).read_text(encoding="utf-8")
    print(f"build from source: {seconds:.0f} s of processor time (wanted: at most {GOAL:.0f} s)")
    print("longest, in seconds of wall time:")
    for wall, made in slowest(log, 8):
        print(f"{wall:8.1f}  {made}")
    return 0 if seconds <= GOAL else 1


if __name__ == "__main__":
    sys.exit(main())
