"""A ccx that can load the routine, and one run of it."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

from probation.errors import InputError
from probation.fe.calculix.printed import Printed, read_printed
from probation.fe.where import calculix_library

BUILT = Path("build", "calculix", "ccx")
"""Where ``make fe`` puts the program that it builds, from the top of the sources."""

HOW = (
    "make fe builds one from Debian's source package; "
    "elsewhere compile CalculiX with -DCALCULIX_EXTERNAL_BEHAVIOURS_SUPPORT and link it with -ldl"
)


def can_load_routines(ccx: Path) -> bool:
    """Whether a ccx was built with external behaviours: then the name of dlopen is in its table of symbols."""
    return ccx.is_file() and os.access(ccx, os.X_OK) and b"\0dlopen\0" in ccx.read_bytes()


def find_ccx(given: Path | None = None) -> Path:
    """The first ccx with external behaviours: `given`, else ``$CCX``, else on ``$PATH``, else what ``make fe`` built.

    Raises
    ------
    InputError
        If there is none, or if the one that was asked for, by `given` or ``$CCX``, is none.
    """
    for name, asked in (("--ccx", given), ("$CCX", os.environ.get("CCX"))):
        if asked:
            found = shutil.which(asked)
            if found is None:
                raise InputError(f"{name} is {asked}: no such program")
            if not can_load_routines(Path(found)):
                raise InputError(f"{name} is {asked}: a ccx built without external behaviours; {HOW}")
            return Path(found).resolve()
    candidates = [Path(place) for place in (shutil.which("ccx"), BUILT) if place]
    for candidate in candidates:
        if can_load_routines(candidate):
            return candidate.resolve()
    stock = [str(candidate) for candidate in candidates if candidate.is_file()]
    found_instead = f" ({', '.join(stock)} was built without)" if stock else ""
    raise InputError(f"no ccx with external behaviours{found_instead}: {HOW}")


def run(ccx: Path, deck: str, folder: Path, *, threads: int = 1) -> dict[tuple[str, str], Printed]:
    """Run a deck and read what it printed.

    Parameters
    ----------
    ccx : Path
        As `find_ccx` returns it.
    deck : str
        The input, as ``probation.fe.calculix.deck`` writes it.
    folder : Path
        Where the files of the run go: job.inp, job.log (what ccx said), job.dat, job.sta.
    threads : int
        Of the stress loop and of the equation solver.

    Returns
    -------
    dict
        Of (quantity, set) to what was printed of it, see `read_printed`.

    Raises
    ------
    InputError
        If ccx cannot load the routine or stopped before the end; with the time that it reached and its last error.
    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "job.inp").write_text(deck)
    paths = [str(calculix_library().parent), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])]
    environment = {
        **os.environ,
        "LD_LIBRARY_PATH": os.pathsep.join(paths),
        "OMP_NUM_THREADS": str(threads),
        "OPENBLAS_NUM_THREADS": "1",
        "CCX_NPROC_STIFFNESS": str(threads),
        "CCX_NPROC_RESULTS": str(threads),
        "CCX_NPROC_EQUATION_SOLVER": str(threads),
    }
    log = folder / "job.log"
    with log.open("w") as said:
        status = subprocess.run(
            [ccx, "-i", "job"], cwd=folder, env=environment, stdout=said, stderr=subprocess.STDOUT, check=False
        ).returncode
    text = log.read_text(errors="replace")
    if "Job finished" not in text:
        raise InputError(_what_happened(ccx, folder, status, text))
    return read_printed(folder / "job.dat")


def _what_happened(ccx: Path, folder: Path, status: int, text: str) -> str:
    """One sentence on a run that stopped early."""
    if not can_load_routines(ccx):
        return f"{ccx} ended without a word on the material routine: it was built without external behaviours; {HOW}"
    errors = re.findall(r"\*ERROR[^\n]*(?:\n +[^\n*]+)*", text)
    last = " ".join(errors[-1].split()) if errors else f"and reported no error; the last it said: {_last_words(text)}"
    reached = _reached(folder / "job.sta")
    return f"ccx stopped at {reached:g} s with the status {status}{':' if errors else ''} {last} ({folder / 'job.log'})"


def _last_words(text: str) -> str:
    return " ".join(text.split()[-12:]) or "nothing"


def _reached(status_file: Path) -> float:
    """Total time of the last increment that converged [s]."""
    if not status_file.is_file():
        return 0.0
    rows = [line.split() for line in status_file.read_text().splitlines()]
    times = [float(row[4]) for row in rows if len(row) == 7 and row[0].isdigit() and not row[2].endswith("U")]
    return times[-1] if times else 0.0
