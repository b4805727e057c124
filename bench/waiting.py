"""How long does a user wait? Wall time of whole programs, and their processor time, user and system.

`python -m bench.waiting [ROW …]`: all rows, or those that are named; each several times in a process of its own, the
least is taken. A diagnosis runs on one processor, then in two copies of the process. Wall time means something only
where nothing else runs. A run of the bench leaves it out: it takes minutes. `bench.from_source` measures the build.

"fresh clone" runs only where it is named: `make demo` in a clone of the last commit, which downloads packages and
builds the engine.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np

import probation
from probation import Campaign, Law, Record
from probation.effects.cause import Cause
from probation.effects.record_view import views_of
from probation.effects.registry import effect
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel

LAW = Law(unrelaxed_modulus=3000.0, tau_max=5.2, hardening_modulus=2.5)
NOISE = 0.05
"""Of the stress [MPa]."""

RATES = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05)
REPEATS = 3
THREADS = (1, 2)
"""Of a diagnosis, side by side."""

ROOT = Path(__file__).resolve().parents[1]
FRESH = "fresh clone"

GOALS = {
    "import": 0.4,
    "help": 0.3,
    "fit": 0.9,
    "certify": 5.0,
    "demo": 120.0,
    FRESH: 120.0,
    "weak gap": 5.0,
    "strong gap": 10.0,
    "replicates": 30.0,
    "replicates with a gap": 30.0,
}
"""Seconds of wall time that were wanted, on two idle cores."""

BOTH = {"rate_dependent_hardening": 2.0, "structural_softening": 2.0}
DIAGNOSED = {
    "weak gap": ({"force_drift": 1.0}, False),
    "strong gap": (BOTH, False),
    "replicates": ({}, True),
    "replicates with a gap": (BOTH, True),
}
"""Effects by size, over the scale of their prior, and whether three specimens a rate are tested, which differ."""


def file_of(folder: Path, name: str, rate: float, count: int) -> str:
    """A ramp to a strain of 0.9 with noise, as a file."""
    time = np.linspace(0.0, 0.9 / rate, count)
    stress = probation.ramp_stress(LAW, rate, time) + NOISE * np.random.default_rng(count).standard_normal(count)
    path = folder / f"{name}.csv"
    columns = np.column_stack([time, rate * time, stress])
    np.savetxt(path, columns, delimiter=",", header="time_s,true_strain,true_stress_MPa", comments="")
    return str(path)


def record(index: int, rate: float, count: int = 1000) -> Record:
    """Every other test a ramp, the others with a hold and unloading; without stress."""
    up, end = 0.6 / rate, 1.1 / rate
    time = np.linspace(0.0, end, count)
    turning = np.interp(time, [0.0, up, 1.5 * up, end], [0.0, 0.6, 0.6, 0.4])
    strain = turning if index % 2 else 0.9 * time / end
    return Record(f"r{index}", time, strain, 1e-6 * np.arange(count), control="strain-rate")


def campaign(sizes: dict[str, float], replicated: bool) -> Campaign:
    """Six records of 1000 samples with effects; or nine of three specimens a rate, which differ by 3 %."""
    rng = np.random.default_rng(1)
    rates = RATES[1::2] * 3 if replicated else RATES
    planned = Campaign(name="waiting", records=tuple(record(i, rate) for i, rate in enumerate(rates)))
    causes = [Cause(effect(name), effect(name).forms[0]) for name in sizes]
    model = CampaignModel(DnlrLaw(LAW), views_of(planned, scheme="sa3"), causes)
    values = [
        (size * cause.form.amplitude.scale, *cause.form.typical[1:])
        for cause, size in zip(causes, sizes.values(), strict=True)
    ]
    records = []
    for each in planned.records:
        differs = 1.0 + 0.03 * rng.standard_normal(3) if replicated else np.ones(3)
        stress = model.predict(model.parameters(LAW.parameters * differs, *values))[each.id]
        noisy = stress + NOISE * rng.standard_normal(len(stress))
        records.append(replace(each, true_stress=noisy, specimen_id=each.id if replicated else None, sha256=""))
    return replace(planned, records=tuple(records))


def seconds(command: list[str]) -> tuple[float, float]:
    """Wall and processor time of a program in a process of its own."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=os.environ | {"OMP_NUM_THREADS": "1"})
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter() - begun
    return wall, (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)


def commands(folder: Path) -> dict[str, list[str]]:
    """What each row runs."""
    program = [sys.executable, "-m", "probation"]
    one, two = file_of(folder, "slow", 0.001, 1000), file_of(folder, "fast", 0.01, 1000)
    itself = [sys.executable, "-m", "bench.waiting", "--diagnose"]
    return {
        "import": [sys.executable, "-c", "import probation"],
        "help": [*program, "--help"],
        "fit": [*program, "fit", file_of(folder, "long", 0.003, 1500)],
        "certify": [*program, "certify", one, two],
        "demo": [*program, "demo", "--out", str(folder / "demo")],
        **{f"{name}, threads={count}": [*itself, name, str(count)] for name in DIAGNOSED for count in THREADS},
        FRESH: ["sh", "-c", 'git clone -q "$0" "$1" && make -C "$1" demo', str(ROOT), str(folder / "clone")],
    }


def main(wanted: list[str]) -> int:
    """Print a line for each row; 1 if one takes longer than wanted."""
    if wanted[:1] == ["--diagnose"]:
        probation.diagnose(campaign(*DIAGNOSED[wanted[1]]), threads=int(wanted[2]))
        return 0
    wanted = wanted or [row for row in GOALS if row != FRESH]
    slow = False
    with tempfile.TemporaryDirectory() as name:
        for row, command in commands(Path(name)).items():
            what = row.split(",")[0]
            if what not in wanted:
                continue
            repeats = 1 if GOALS[what] > REPEATS else REPEATS
            wall, processor = min(seconds(command) for _ in range(repeats))
            slow |= wall > GOALS[what]
            wanted_here = f"wanted: {GOALS[what]:g} s on two idle cores"
            print(f"{row:23} {wall:6.2f} s, of the processor {processor:6.2f} s ({wanted_here})", flush=True)
    return int(slow)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
