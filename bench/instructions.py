"""How many instructions does a kernel take for one mode and step?

Counted by valgrind in a program that solves a case a few times more in one run than in the other: what the runs differ
by belongs to the solves. The count is the same on a busy machine, so that a change of more than 2 % is one of the code.
"""

import re
import shutil
import subprocess
from pathlib import Path

from bench import compiled
from bench.rows import Findings, Progress

CASES = {
    "be2-even": "bE2, even steps",
    "sa2-even": "SA2, even steps",
    "sa3-even": "SA3, even steps",
    "be2-uneven": "bE2, uneven steps",
    "sa2-uneven": "SA2, uneven steps",
    "sa3-uneven": "SA3, uneven steps",
    "be2-rate": "bE2, tau_max by rate",
    "sa3-rate": "SA3, tau_max by rate",
    "be2-tangent": "bE2, stress and three sensitivities",
    "sa3-tangent": "SA3, stress and three sensitivities",
    "be2-stress": "bE2, flow activated by stress",
    "be2-heat": "bE2, self-heating",
    "be2-history": "the history alone, as if per mode",
}
"""As bench/cpp/solves.cpp knows them."""

MODES, STEPS = 50, 2000
FEW, MORE = 2, 4

INSTALL = "install it to have them (Debian: apt-get install valgrind)"


def run(found: Findings, progress: Progress, quick: bool) -> None:
    if quick:
        return
    valgrind = shutil.which("valgrind")
    if valgrind is None:
        found.skipped.append(f"instruction counts: valgrind is not installed; {INSTALL}")
        return
    progress("building the program whose instructions are counted")
    program, why = compiled.built(compiled.SOLVES)
    if program is None:
        found.skipped.append(f"instruction counts: {why}")
        return
    for case, label in CASES.items():
        progress(f"instructions: {label}")
        counts = [_count(valgrind, program, case, times) for times in (FEW, MORE)]
        if None in counts:
            found.skipped.append(f"instruction counts of {label}: valgrind stopped")
            continue
        few, more = (float(count) for count in counts if count is not None)
        found.instructions[case] = (more - few) / (MORE - FEW) / (MODES * STEPS)


def _count(valgrind: str, program: Path, case: str, times: int) -> int | None:
    """Instructions of a whole run."""
    command = [valgrind, "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    done = subprocess.run([*command, str(program), case, str(times)], capture_output=True, text=True, check=False)
    counted = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)
    return int(counted.group(1).replace(",", "")) if done.returncode == 0 and counted else None
