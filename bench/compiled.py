"""Where is what bench/cpp holds, built against the engine that is measured?"""

import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

from bench.machine import build_tree

FMA, SOLVES = "probation_bench_fma", "probation_bench_solves"


@cache
def built(target: str) -> tuple[Path | None, str]:
    """The file of a target of bench/cpp, brought up to date in the newest build tree; or None, and why."""
    tree, cmake = build_tree(), Path(sys.executable).with_name("cmake")
    command = str(cmake) if cmake.exists() else shutil.which("cmake")
    if tree is None or command is None:
        return None, "it is built in build/editable, by cmake: make bench"
    for arguments in (["-DPROBATION_BENCH=ON", str(tree)], ["--build", str(tree), "--target", target]):
        done = subprocess.run([command, *arguments], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return None, (done.stderr + done.stdout).strip().splitlines()[-1]
    files = [path for path in (tree / "bench" / "cpp").glob(f"{target}*") if path.is_file()]
    return (files[0], "") if files else (None, f"{target} was not found after it was built")
