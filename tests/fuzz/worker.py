"""One worker: cases in on standard input, outcomes out on standard output, a line of JSON each.

A process of its own, so that a case may hang, crash or flood the memory without an end of the run. What a case prints
is caught below Python, at the file descriptors, since LAPACK prints there.
"""

from __future__ import annotations

import gc
import json
import os
import resource
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from fuzz.asked import ask
from fuzz.content import write

MEMORY = 6 << 30
"""Address space that a case may take [bytes]: a flood ends as a MemoryError."""
MOST_PRINTED = 1 << 20
"""Of each stream of a case, so much is handed on [bytes]."""


def main() -> None:
    """Serve until standard input ends."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    answers = os.fdopen(os.dup(1), "w", encoding="ascii")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    questions = os.fdopen(os.dup(0), encoding="ascii")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    _load_libraries()
    print("ready", file=answers, flush=True)
    for line in questions:
        print(json.dumps(_outcome(json.loads(line))), file=answers, flush=True)


def _load_libraries() -> None:
    """What the program loads when it needs it: no part of the time of the first case that does."""
    import matplotlib.figure  # noqa: F401, PLC0415
    import openpyxl  # noqa: F401, PLC0415
    import xarray  # noqa: F401, PLC0415
    import zarr  # noqa: F401, PLC0415

    gc.collect()
    gc.freeze()  # or each collection between two cases would walk through all of it


def _outcome(case: dict[str, Any]) -> dict[str, Any]:
    home = Path.cwd()
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        for name, content in case["files"].items():
            write(Path(folder) / name, content)
        os.chdir(folder)
        try:
            return _asked(case["command"])
        finally:
            os.chdir(home)
            gc.collect()


def _asked(command: list[str]) -> dict[str, Any]:
    streams = [tempfile.TemporaryFile() for _ in range(2)]  # noqa: SIM115 - closed below
    kept = [os.dup(1), os.dup(2)]
    try:
        for number, stream in enumerate(streams, start=1):
            os.dup2(stream.fileno(), number)
        begun = time.perf_counter()
        status = ask(command)
        seconds = time.perf_counter() - begun
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        for number, descriptor in enumerate(kept, start=1):
            os.dup2(descriptor, number)
            os.close(descriptor)
    texts = [_text(stream) for stream in streams]
    return {"status": status, "out": texts[0], "err": texts[1], "seconds": seconds}


def _text(stream: Any) -> str:
    stream.seek(0)
    text: str = stream.read(MOST_PRINTED + 1).decode("utf-8", "replace")
    stream.close()
    return text


if __name__ == "__main__":
    main()
