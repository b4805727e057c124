"""Many independent jobs in processes, results as they come."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Hashable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager, nullcontext
from threading import Thread
from typing import TypeAlias, TypeVar

from probation.errors import InputError
from probation.processors import processors

Progress: TypeAlias = "Callable[[int, int, str], None]"
Key = TypeVar("Key", bound=Hashable)
Result = TypeVar("Result")

_WAITING = 4
"""Jobs handed out at a time, per process."""


class WorkersLostError(RuntimeError):
    """Processes that had jobs died.

    Attributes
    ----------
    keys : tuple
        Of the job that a cluster's workers died of again and again, or of those that had been handed to processes of
        one's own.
    """

    def __init__(self, keys: tuple[Hashable, ...]) -> None:
        super().__init__(f"processes died while they had {', '.join(map(str, keys))}")
        self.keys = keys


_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def run_all(
    job: Callable[..., Result],
    arguments: Mapping[Key, tuple[object, ...]],
    *,
    processes: int | None,
    executor: Executor | None,
    progress: Progress | None,
    on_done: Callable[[Key, Result], None] | None,
) -> None:
    """Run a job for every key; `on_done` gets each result at once, in the order of completion.

    Parameters
    ----------
    job : callable
        Of a module's own, so that another process finds it.
    arguments : mapping
        Of each call.
    processes : int, optional
        As many as processors if left out; 1 stays in this process.
    executor : Executor, optional
        Instead of processes of its own, such as that of a cluster's client; it is handed all jobs at once.

    Raises
    ------
    InputError
        For a number of processes below 1.
    WorkersLostError
        If a process of one's own died, or workers of a cluster did again and again of the same job.
    """
    if processes is not None and processes < 1:
        raise InputError(f"processes: found {processes}, expected at least 1")
    count = processes or processors()
    done = 0

    def finish(key: Key, result: Result) -> None:
        nonlocal done
        done += 1
        if on_done is not None:
            on_done(key, result)
        if progress is not None:
            progress(done, len(arguments), str(key))

    if executor is None and count == 1:
        for key, each in arguments.items():
            finish(key, job(*each))
        return
    for name in _THREADS:  # the jobs are many; processes that are started from here have one thread each
        os.environ.setdefault(name, "1")
    left, order = iter(arguments.items()), {key: number for number, key in enumerate(arguments)}
    waiting: dict[Future[Result], Key] = {}
    most = len(arguments) if executor is not None else _WAITING * count
    with _workers(min(count, len(arguments) or 1)) if executor is None else nullcontext(executor) as own:
        try:
            while True:
                while len(waiting) < most and (item := next(left, None)) is not None:
                    with _interrupts_held():
                        waiting[own.submit(job, *item[1])] = item[0]
                if not waiting:
                    return
                ended = wait(waiting, return_when=FIRST_COMPLETED).done
                for future in sorted(
                    ended, key=lambda each: order[waiting[each]]
                ):  # the one that ran before those behind
                    finish(waiting[future], _result(future, waiting[future]))
                    del waiting[future]
        except BrokenExecutor as failure:
            raise WorkersLostError(tuple(waiting.values())) from failure
        finally:
            if executor is not None:  # processes of one's own end with the block, and their jobs with them
                for future in waiting:
                    future.cancel()


@contextmanager
def _workers(count: int) -> Iterator[Executor]:
    """Processes of one's own; where the block fails, what they are still at is given up at once."""
    own = ProcessPoolExecutor(count, multiprocessing.get_context("spawn"), initializer=_end_with_parent)
    try:
        yield own
    except BaseException:
        for process in list((own._processes or {}).values()):  # kill_workers() from Python 3.14 on
            process.kill()
        raise
    finally:
        own.shutdown(wait=True, cancel_futures=True)


def _result(future: Future[Result], key: Hashable) -> Result:
    """What a job gave."""
    try:
        return future.result()
    except Exception as failure:
        if type(failure).__name__ != "KilledWorker":  # dask's, known only where dask is
            raise
        raise WorkersLostError((key,)) from failure


def _end_with_parent() -> None:
    """Let this process end when the one that started it is killed: nobody is left to take its results."""
    parent = multiprocessing.parent_process()
    assert parent is not None

    def watch() -> None:
        parent.join()
        os._exit(1)

    Thread(target=watch, daemon=True).start()


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Hold Ctrl-C back within the block; a process that is started there never gets one.

    The terminal sends it to all processes of a command. The one that started the others ends them; each of them would
    show a stack.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
