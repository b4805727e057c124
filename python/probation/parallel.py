"""The same work on many things, several at once in copies of this process.

Threads would not do: a solve of one record is too short, and two threads that take turns at Python between solves take
longer than one. A copy (`fork`) knows all that this process knows. So it is handed nothing, and gives back what the
work returns. Where processes cannot be copied safely, on other systems than Linux, one thing comes after the other.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import warnings
from contextlib import contextmanager
from functools import wraps
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from threadpoolctl import threadpool_limits

from probation._arrays import as_threads

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from multiprocessing.context import ForkProcess

Item = TypeVar("Item")
Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")

MOST_COPIES = 8
"""Processes at work where nobody says how many: starting more takes as long as their work."""

_NUMBER = 4
"""Bytes of the number of an item."""


def without_blas_threads(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Let numpy's products and factorisations run in the caller's thread while the function does.

    Those of a diagnosis are of some thousand numbers. Threads that share one and wait for each other double its
    processor time, and on a machine that has other work they make it several times as long.
    """

    @wraps(function)
    def alone(*arguments: Arguments.args, **options: Arguments.kwargs) -> Result:
        with threadpool_limits(limits=1, user_api="blas"):
            return function(*arguments, **options)

    return alone


def processors() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def at_once(threads: int | None, usual: int = MOST_COPIES) -> int:
    """How many things are worked on at once: what was asked for, or as many as there are processors and `usual` says.

    Raises
    ------
    InputError
        If it is neither None nor a whole number of at least 1.
    """
    return as_threads(threads) or min(processors(), usual)


def in_parallel(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    processes: int,
    progress: Callable[[float], None] | None = None,
) -> list[Result]:
    """Results in the order of the items, each worked out here or in a copy of this process.

    Parameters
    ----------
    work : callable
        What it changes in a copy is lost. What it returns is data, without objects that are known by their identity.
    processes : int
        Processes at work; with one, this one.
    progress : callable, optional
        Called here with the part of the items that is done, 0 to 1.

    Raises
    ------
    Exception
        What `work` raises here: an item that fails in a copy, or is lost with it, is worked out here once more.
    """
    done: dict[int, Result] = {}

    def finish(number: int, result: Result) -> None:
        done[number] = result
        if progress is not None:
            progress(len(done) / len(items))

    copies = min(processes, len(items)) - 1
    if copies > 0 and sys.platform == "linux" and multiprocessing.parent_process() is None:
        with _numbers(len(items)) as numbers, _copies(work, items, numbers, copies) as connections:
            while number := _next(numbers):
                finish(number - 1, work(items[number - 1]))
                _received(connections, finish, seconds=0.0)
            while connections:
                _received(connections, finish, seconds=None)
    for number, item in enumerate(items):
        if number not in done:
            finish(number, work(item))
    return [done[number] for number in range(len(items))]


@contextmanager
def _numbers(count: int) -> Iterator[int]:
    """A pipe that holds the numbers 1 to `count`: whoever is free takes the next one."""
    reading, writing = os.pipe()
    try:
        with os.fdopen(writing, "wb") as numbers:
            for number in range(1, min(count, _IN_A_PIPE) + 1):
                numbers.write(number.to_bytes(_NUMBER, "little"))
        yield reading
    finally:
        os.close(reading)


_IN_A_PIPE = 65536 // _NUMBER
"""Numbers that a pipe holds; further items are worked out here."""


def _next(numbers: int) -> int:
    """The next number; 0 when all are taken."""
    return int.from_bytes(os.read(numbers, _NUMBER), "little")


@contextmanager
def _copies(
    work: Callable[[Item], Result], items: Sequence[Item], numbers: int, count: int
) -> Iterator[list[Connection]]:
    """Connections to copies of this process that are at work; none is left when the block ends."""
    context = multiprocessing.get_context("fork")
    started: list[ForkProcess] = []
    connections: list[Connection] = []
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # Ctrl-C goes to this process, which ends them
    try:
        for _ in range(count):
            here, there = context.Pipe(duplex=False)
            copy = context.Process(target=_at_work, args=(work, items, numbers, there), daemon=True)
            with warnings.catch_warnings():  # other threads of this process draw a bar: a copy takes no lock of theirs
                warnings.filterwarnings("ignore", "This process .* is multi-threaded", DeprecationWarning)
                copy.start()
            there.close()
            started.append(copy)
            connections.append(here)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        yield connections
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        for copy in started:
            copy.kill()
            copy.join()
            copy.close()
        for connection in connections:
            connection.close()


def _at_work(work: Callable[[Item], Result], items: Sequence[Item], numbers: int, results: Connection) -> None:
    """What a copy does: take a number, work, hand the result back; an item that fails is left to the first process."""
    try:
        while number := _next(numbers):
            try:
                results.send((number - 1, work(items[number - 1])))
            except Exception:
                continue
    finally:
        os._exit(0)  # without what this process would do at its end: that is the first one's


def _received(connections: list[Connection], finish: Callable[[int, Result], None], seconds: float | None) -> None:
    """Take what has come, and wait so long for something; a connection that has ended is left out from then on."""
    for ready in wait(connections, seconds):
        assert isinstance(ready, Connection)
        try:
            number, result = ready.recv()
        except (EOFError, OSError):
            connections.remove(ready)
            ready.close()
            continue
        finish(number, result)
