"""The same work on many things, several at once in copies of this process where that is asked for.

Threads would not do: a solve of one record is too short, and two threads that take turns at Python between solves take
longer than one. A copy (`fork`) knows all that this process knows. So it is handed nothing, and gives back what the
work returns. It is made where processes can be copied, on Linux; elsewhere one thing comes after the other.

A copy may wait for ever: for a lock that another thread of this process had when it was made, for instance. So what a
copy does not hand back in good time is worked out here.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import sys
import threading
import time
import warnings
from contextlib import contextmanager, suppress
from functools import wraps
from multiprocessing import Pipe, parent_process
from multiprocessing.connection import Connection, wait
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, NoReturn, ParamSpec, Self, TypeVar

from threadpoolctl import threadpool_limits

from probation._arrays import as_threads

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

Item = TypeVar("Item")
Result = TypeVar("Result")
Other = TypeVar("Other")
Arguments = ParamSpec("Arguments")

BEFORE_EACH: list[Callable[[], None]] = []
"""Called before every item and after the last one: what is kept from solve to solve, if only in the last digit of
numbers, must not depend on which process had which item."""

PATIENCE = 2.0
"""Seconds without any news of the copies after which this process takes an item of theirs, or three times the longest
item that it had itself."""

WORTH_A_COPY = 0.08
"""Seconds of work, by what an item of it took the last time, below which no copy is made: making, serving and ending
one takes some 40 ms of a process that holds half a gigabyte."""

_NUMBER = 4
"""Bytes of the number of an item."""

_is_copy = False

_taken: dict[object, float] = {}
"""Seconds that an item of some work took on the average the last time, by the work's code."""


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


def at_once(threads: int | None) -> int:
    """How many things are worked on at once: as many as are asked for, or one.

    Raises
    ------
    InputError
        If it is neither None nor a whole number of at least 1.
    """
    return as_threads(threads) or 1


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
        At work, this one among them.
    progress : callable, optional
        Called here with the part of the items that is done, 0 to 1.

    Raises
    ------
    Exception
        What `work` raises here: an item that fails in a copy, or is lost with it, is worked out here once more.
    """
    done: dict[int, Result] = {}
    longest, spent, tried = 0.0, 0.0, 0

    def finish(number: int, result: Result) -> None:
        if number not in done:
            done[number] = result
            if progress is not None:
                progress(len(done) / len(items))

    def here(number: int) -> None:
        nonlocal longest, spent, tried
        begun = time.monotonic()
        finish(number, _fresh(work, items[number]))
        took = time.monotonic() - begun
        longest, spent, tried = max(longest, took), spent + took, tried + 1

    code = getattr(work, "__code__", None)
    usual, first = _taken.get(code, WORTH_A_COPY), 0
    try:
        while usual * (len(items) - first) < WORTH_A_COPY and first < len(items):
            here(first)
            usual, first = max(usual, spent / tried), first + 1
        copies = min(processes, len(items) - first) - 1
        if copies > 0 and sys.platform == "linux" and not _is_copy and parent_process() is None:
            with _numbers(first, len(items)) as numbers, _copies(work, items, numbers, copies) as connections:
                while connections and (number := _next(numbers)):
                    here(number - 1)
                    while _receive(connections, finish, 0.0):
                        pass
                while connections and len(done) < len(items):
                    if not _receive(connections, finish, max(PATIENCE, 3.0 * longest)):
                        here(next(number for number in range(len(items)) if number not in done))
        for number in range(len(items)):
            if number not in done:
                here(number)
    finally:
        for forget in BEFORE_EACH:
            forget()
    if tried and code is not None:
        _taken[code] = spent / tried
    return [done[number] for number in range(len(items))]


def both(first: Callable[[], Result], second: Callable[[], Other], processes: int) -> tuple[Result, Other]:
    """What two pieces of work give, side by side; the first one is the longer, and mostly worked on here."""
    works: list[Callable[[], Any]] = [first, second]
    one, other = in_parallel(lambda work: work(), works, processes)
    return one, other


def _fresh(work: Callable[[Item], Result], item: Item) -> Result:
    for forget in BEFORE_EACH:
        forget()
    return work(item)


@contextmanager
def _numbers(first: int, end: int) -> Iterator[int]:
    """A pipe with the numbers from first + 1 to `end`, as many as it holds: whoever is free takes the next one."""
    reading, writing = os.pipe()
    try:
        os.set_blocking(reading, False)
        os.set_blocking(writing, False)
        with suppress(BlockingIOError):
            for number in range(first + 1, end + 1):
                os.write(writing, number.to_bytes(_NUMBER, "little"))
        os.close(writing)
        yield reading
    finally:
        os.close(reading)


def _next(numbers: int) -> int:
    """The next number; 0 when all are taken."""
    try:
        return int.from_bytes(os.read(numbers, _NUMBER), "little")
    except BlockingIOError:  # a process that has nothing to do with this one holds the end for writing
        return 0


@contextmanager
def _copies(
    work: Callable[[Item], Result], items: Sequence[Item], numbers: int, count: int
) -> Iterator[list[Connection[Any, Any]]]:
    """Connections to copies of this process that are at work, as many as can be made; none is left at the end."""
    started: list[int] = []
    connections: list[Connection[Any, Any]] = []
    try:
        with _interrupts_deferred(), suppress(OSError):  # no further process, or no further file
            for _ in range(count):
                here, there = Pipe(duplex=False)
                connections.append(here)
                with there:
                    process = _fork()
                    if process == 0:
                        _work_as_a_copy(work, items, numbers, there, connections)
                started.append(process)
        yield connections
    finally:
        with _interrupts_deferred():
            for process in started:
                with suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
                with suppress(ChildProcessError):  # ended, and somebody else has waited for it
                    os.waitpid(process, 0)
            for connection in connections:
                connection.close()


def _fork() -> int:
    with warnings.catch_warnings():  # of other threads: what a copy does not hand back is worked out here
        warnings.filterwarnings("ignore", "This process .* is multi-threaded", DeprecationWarning)
        return os.fork()


def _work_as_a_copy(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    numbers: int,
    results: Connection[Any, Any],
    others: Sequence[Connection[Any, Any]],
) -> NoReturn:
    """Take a number, work, hand the result back; an item that fails is left to the first process."""
    global _is_copy  # noqa: PLW0603 - a copy makes no copies
    try:
        _is_copy = True
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # Ctrl-C goes to the first process, which ends this
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        for each in others:  # so that writing fails when the first process is gone
            each.close()
        # Streams without a lock that another thread may have had.
        sys.stdout, sys.stderr = (open(number, "w", 1, closefd=False) for number in (1, 2))  # noqa: SIM115
        gc.freeze()  # a collection would write to all objects that the processes share, and so copy them
        with _Sender(results) as sender:
            while (number := _next(numbers)) and sender.connected:
                with suppress(Exception):
                    sender.send((number - 1, _fresh(work, items[number - 1])))
    finally:
        os._exit(0)  # without what this process would do at its end: that is the first one's


class _Sender:
    """Hands results back from a thread: the first process takes them only between two items of its own.

    Attributes
    ----------
    connected : bool
        Whether the first process is still there.
    """

    def __init__(self, connection: Connection[Any, Any]) -> None:
        self.connected = True
        self._connection = connection
        self._results: SimpleQueue[bytes | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._work, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._results.put(None)
        self._thread.join()

    def send(self, result: object) -> None:
        """Put a result on its way; what cannot be pickled fails here."""
        self._results.put(pickle.dumps(result, pickle.HIGHEST_PROTOCOL))

    def _work(self) -> None:
        while (result := self._results.get()) is not None:
            try:
                self._connection.send_bytes(result)
            except OSError:
                self.connected = False
                return


def _receive(connections: list[Connection[Any, Any]], finish: Callable[[int, Any], None], seconds: float) -> bool:
    """Take what comes within so many seconds, and say whether anything did; connections that have ended go."""
    ready = wait(connections, seconds)
    for connection in [each for each in connections if each in ready]:
        try:
            number, result = connection.recv()
        except (EOFError, OSError):
            connections.remove(connection)
            connection.close()
        except Exception:
            continue
        else:
            finish(number, result)
    return bool(ready)


@contextmanager
def _interrupts_deferred() -> Iterator[None]:
    """Act on Ctrl-C at the end of the block; a mask would not do, since another thread would take the signal."""
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGINT) is None:
        yield
        return
    came: list[tuple[int, Any]] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: came.append((number, frame)))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if came and callable(before):
            before(*came[0])
