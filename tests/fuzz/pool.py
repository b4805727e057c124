"""Workers: cases to outcomes on every core; a worker that hangs or dies is replaced."""

from __future__ import annotations

import json
import os
import select
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from fuzz.asked import limit_s

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fuzz.case import Case

T = TypeVar("T")
_STARTING_S = 300.0  # a loaded machine takes its time to import


@dataclass(frozen=True)
class Outcome:
    """What became of a case.

    Attributes
    ----------
    status : int or None
        Exit status; None where the case hung or the process died.
    out, err : str
        What was printed.
    seconds : float
    ended : str
        "by itself", "stopped after its time", or how the process died.
    """

    status: int | None
    out: str = ""
    err: str = ""
    seconds: float = 0.0
    ended: str = "by itself"


class Worker:
    """One process that runs one case after the other, in folders below `scratch`."""

    def __init__(self, scratch: str) -> None:
        tests = str(Path(__file__).parents[1])
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join([tests, *filter(None, [os.environ.get("PYTHONPATH")])]),
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
            "PYTHONWARNINGS": "default",
            "PROBATION_DEBUG": "0",
            "COLUMNS": "100",
            "TMPDIR": scratch,
        }
        self._process = subprocess.Popen(
            [sys.executable, "-m", "fuzz.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
        )
        if self._line(_STARTING_S) != b"ready\n":
            self.close()
            raise RuntimeError("a worker does not start: python -m fuzz.worker, with tests/ on PYTHONPATH, says why")

    def run(self, case: Case, limit: float | None = None) -> Outcome | None:
        """The outcome of a case; None where the process is of no more use and the case is to blame."""
        question = json.dumps({"command": case.command, "files": case.files}) + "\n"
        assert self._process.stdin is not None
        self._process.stdin.write(question.encode("ascii"))
        self._process.stdin.flush()
        line = self._line(limit_s(case.command) if limit is None else limit)
        return None if line is None else Outcome(**json.loads(line)) if line else self._death()

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.communicate()

    @property
    def alive(self) -> bool:
        """Whether it can take another case."""
        return self._process.poll() is None

    def _death(self) -> Outcome:
        return Outcome(None, ended=f"the process died with status {self._process.wait()}")

    def _line(self, limit: float) -> bytes | None:
        """The next answer; None after the time, empty where there will be none."""
        assert self._process.stdout is not None
        there, _, _ = select.select([self._process.stdout], [], [], limit)
        return self._process.stdout.readline() if there else None


class Workers:
    """As many workers as asked for; to be used in a ``with``.

    Parameters
    ----------
    count : int, optional
        All cores if left out.
    """

    def __init__(self, count: int | None = None) -> None:
        self.count = count or len(os.sched_getaffinity(0))
        self._own = threading.local()
        self._started: list[Worker] = []
        self._threads = ThreadPoolExecutor(self.count)
        self._scratch = tempfile.TemporaryDirectory(prefix="fuzz-")  # a worker that is stopped leaves its folder behind

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        self._threads.shutdown(cancel_futures=True)
        for worker in self._started:
            worker.close()
        self._scratch.cleanup()

    def run(self, case: Case, limit: float | None = None) -> Outcome:
        """The outcome of a case, in the worker of this thread.

        A case that runs out of time has twice the time once more before it is called a hang: the machine may have been
        busy.
        """
        outcome = self._attempt(case, limit)
        if outcome.ended.startswith("stopped"):
            return self._attempt(case, 2.0 * (limit_s(case.command) if limit is None else limit))
        return outcome

    def map(self, judged: Callable[[T], object], jobs: Iterable[T]) -> Iterator[object]:
        """Call a function on each job, on all workers; results in the order of the jobs."""
        return self._threads.map(judged, jobs)

    def _attempt(self, case: Case, limit: float | None) -> Outcome:
        worker = getattr(self._own, "worker", None)
        if worker is None or not worker.alive:
            worker = self._own.worker = Worker(self._scratch.name)
            self._started.append(worker)
        outcome = worker.run(case, limit)
        if outcome is None:
            worker.close()
            return Outcome(None, ended="stopped after its time", seconds=limit or limit_s(case.command))
        return outcome
