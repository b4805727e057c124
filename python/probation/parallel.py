"""The same work on many things, several at once in copies of this process where that is asked for.

Threads would not do: a solve of one record is too short, and two threads that take turns at Python between solves take
longer than one. A copy (`fork`) knows all that this process knew when it was made; what it is handed later, and what it
gives back, is data. It is made where processes can be copied, on Linux; elsewhere one thing comes after the other.

A copy may wait for ever: for a lock that another thread of this process had when it was made, for instance. So what a
copy does not hand back in good time is worked out here.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import struct
import sys
import threading
import time
import warnings
from collections import deque
from contextlib import contextmanager, suppress
from functools import wraps
from multiprocessing import Pipe, parent_process
from multiprocessing.connection import Connection, wait
from queue import SimpleQueue
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any, Generic, NoReturn, ParamSpec, Self, TypeVar

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
"""Seconds of work, by what an item of it took the last time, for which a copy is made: making and ending one, and the
pages that either writes again, take some 40 ms of a process that holds half a gigabyte."""

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

    The copies are made for these items alone, which need not be data; else as `Copies.results`.

    Parameters
    ----------
    work : callable
        What it changes in a copy is lost. What it returns is data, without objects that are known by their identity.
    processes : int
        At work, this one among them.
    progress : callable, optional
        Called here with the part of the items that is done, 0 to 1.
    """

    def numbered(number: int) -> Result:
        return work(items[number])

    with Copies(numbered, processes, like=work) as copies:
        return copies.results(range(len(items)), progress)


def both(first: Callable[[], Result], second: Callable[[], Other], processes: int) -> tuple[Result, Other]:
    """What two pieces of work give, side by side; the first one is the longer, and mostly worked on here."""
    works: list[Callable[[], Any]] = [first, second]
    one, other = in_parallel(lambda work: work(), works, processes)
    return one, other


class Copies(Generic[Item, Result]):
    """Copies of this process that work on what they are handed, one batch after the other, until they are closed.

    They are made with the first batch that is worth it, and anew for one that needs more of them, and know what this
    process knew then. One thread has them, and gives them one batch at a time.

    Parameters
    ----------
    work : callable
        What it changes in a copy is lost. What it takes and returns is data, without objects that are known by their
        identity.
    processes : int
        At work, this one among them.
    like : callable, optional
        Whose items take as long, if not those of `work`.
    """

    def __init__(
        self, work: Callable[[Item], Result], processes: int, like: Callable[..., object] | None = None
    ) -> None:
        self._work = work
        self._count = processes - 1
        self._maker = os.getpid()
        self._code = getattr(like or work, "__code__", None)
        self._team: _Team | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the copies; what comes afterwards is done by new ones."""
        team, self._team = self._team, None
        if team is not None and os.getpid() == self._maker:  # a fork of this process has none
            team.close()

    def results(self, items: Sequence[Item], progress: Callable[[float], None] | None = None) -> list[Result]:
        """Results in the order of the items, each worked out here or in a copy of this process.

        Parameters
        ----------
        items : sequence
        progress : callable, optional
            Called here with the part of the items that is done, 0 to 1.

        Raises
        ------
        Exception
            What `work` raises here: an item that fails in a copy, or is lost with it, is worked out here once more.
        """
        batch = _Batch(self._work, items, progress)
        usual = _taken.get(self._code, WORTH_A_COPY)
        try:
            while self._team is None and 0.0 < usual * batch.left < WORTH_A_COPY:
                batch.here(batch.first_left())
                usual = max(usual, batch.usual)
            if batch.left > 1 and (team := self._for(batch.left - 1)) is not None:
                team.work_on(batch)
                if team.late or not team.connections:
                    self.close()
            while batch.left:
                batch.here(batch.first_left())
        except BaseException:
            self.close()
            raise
        finally:
            for forget in BEFORE_EACH:
                forget()
        if batch.usual > 0.0 and self._code is not None:
            _taken[self._code] = batch.usual
        return [batch.done[number] for number in range(len(items))]

    def _for(self, wanted: int) -> _Team | None:
        """So many copies, or as many as there may be, where there can be any."""
        if self._count < 1 or sys.platform != "linux" or _is_copy or parent_process() is not None:
            return None
        count = min(self._count, wanted)
        if self._team is not None and len(self._team.connections) < count:
            self.close()
        if self._team is None:
            self._team = _Team()
            self._team.begin(self._work, count)
        return self._team


class _Batch(Generic[Item, Result]):
    """Items of one call, and what is done of them.

    Attributes
    ----------
    done : dict of int to Result
        By number.
    longest, usual : float
        What an item took in this process, the longest and on the average [s]; 0 as long as it had none.
    """

    def __init__(
        self, work: Callable[[Item], Result], items: Sequence[Item], progress: Callable[[float], None] | None
    ) -> None:
        self.done: dict[int, Result] = {}
        self.items = items
        self.longest, self.usual = 0.0, 0.0
        self._work, self._progress = work, progress
        self._tried, self._first = 0, 0

    @property
    def left(self) -> int:
        """How many are not done."""
        return len(self.items) - len(self.done)

    def first_left(self) -> int:
        """The first that is not done."""
        while self._first in self.done:
            self._first += 1
        return self._first

    def finish(self, number: int, result: Result) -> None:
        """One is done."""
        if number not in self.done:
            self.done[number] = result
            if self._progress is not None:
                self._progress(len(self.done) / len(self.items))

    def here(self, number: int) -> None:
        """Work one out in this process."""
        begun = time.monotonic()
        self.finish(number, _fresh(self._work, self.items[number]))
        took = time.monotonic() - begun
        self.longest = max(self.longest, took)
        self.usual += (took - self.usual) / (self._tried + 1)
        self._tried += 1


def _fresh(work: Callable[[Item], Result], item: Item) -> Result:
    for forget in BEFORE_EACH:
        forget()
    return work(item)


_TICKET = struct.Struct("<IQI")
"""Of an item that is handed out: its number, and where it stands in the file, from which byte and how many."""


class _Team:
    """Copies of this process, and what they are handed.

    Items stand in a file in memory, tickets for them in a pipe: whoever is free takes the next one.

    Attributes
    ----------
    connections : list of Connection
        To copies that are at work.
    late : bool
        Whether a copy has not answered in good time.
    """

    def __init__(self) -> None:
        self.connections: list[Connection[Any, Any]] = []
        self.late = False
        self._failed: list[int] = []
        self._started: list[int] = []
        self._files: list[int] = []
        self._waiting: deque[bytes] = deque()

    def begin(self, work: Callable[[Any], object], count: int) -> None:
        """Make as many copies as can be made."""
        with _interrupts_deferred(), suppress(OSError):  # no further process, or no further file
            self._files += os.pipe()
            self._files.append(_file())
            for each in self._files[:2]:
                os.set_blocking(each, False)
            for _ in range(count):
                here, there = Pipe(duplex=False)
                self.connections.append(here)
                with there:
                    process = _fork()
                    if process == 0:
                        self._serve(work, there)
                self._started.append(process)

    def close(self) -> None:
        """End the copies; none is left."""
        with _interrupts_deferred():
            for process in self._started:
                with suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
                with suppress(ChildProcessError):  # ended, and somebody else has waited for it
                    os.waitpid(process, 0)
            for connection in self.connections:
                connection.close()
            for each in self._files:
                os.close(each)

    def work_on(self, batch: _Batch[Any, Any]) -> None:
        """Work on what is left of a batch, here and in the copies, until it is done or no copy is left."""
        mine = batch.first_left()
        if not self.connections or not self._hand_out(batch, mine + 1):
            return
        batch.here(mine)
        while (number := self._next()) is not None:
            batch.here(number)
            while self._receive(batch, 0.0):
                pass
        while self.connections and batch.left:
            if self._failed:
                batch.here(self._failed.pop())
            elif not self._receive(batch, max(PATIENCE, 3.0 * batch.longest)):
                batch.here(batch.first_left())
                self.late = True
        os.ftruncate(self._files[-1], 0)

    def _hand_out(self, batch: _Batch[Any, Any], first: int) -> bool:
        """Write the items where all can read them, from the first on, and begin with tickets for them; if possible."""
        tickets, offset = [], 0
        try:
            for number in range(first, len(batch.items)):
                written = pickle.dumps(batch.items[number], pickle.HIGHEST_PROTOCOL)
                os.pwrite(self._files[-1], written, offset)
                tickets.append(_TICKET.pack(number, offset, len(written)))
                offset += len(written)
        except Exception:  # no room, or no data: all is worked out here
            return False
        self._waiting.extend(tickets)
        self._give()
        return True

    def _give(self) -> None:
        """As many tickets as the pipe takes."""
        with suppress(BlockingIOError):
            while self._waiting:
                os.write(self._files[1], self._waiting[0])
                self._waiting.popleft()

    def _next(self) -> int | None:
        """The number of the next item for this process; None when all are taken, or no copy is left."""
        if not self.connections:
            return None
        while True:
            self._give()
            try:
                number, _, _ = _TICKET.unpack(os.read(self._files[0], _TICKET.size))
            except BlockingIOError:
                if self._waiting:
                    continue  # the copies have emptied the pipe meanwhile
                return None
            return int(number)

    def _receive(self, batch: _Batch[Any, Any], seconds: float) -> bool:
        """Take what comes within so many seconds, and say whether anything did; connections that have ended go."""
        ready = wait(self.connections, seconds)
        for connection in [each for each in self.connections if each in ready]:
            try:
                message = connection.recv_bytes()
            except (EOFError, OSError):
                self.connections.remove(connection)
                connection.close()
                continue
            number = int.from_bytes(message[:_NUMBER], "little")
            try:
                result = pickle.loads(memoryview(message)[_NUMBER:])
            except Exception:  # of any kind: it is worked out here
                self._failed.append(number)
            else:
                batch.finish(number, result)
        return bool(ready)

    def _serve(self, work: Callable[[Any], object], results: Connection[Any, Any]) -> NoReturn:
        """Be a copy: take a ticket, work, hand the result back, until the first process closes the pipe."""
        global _is_copy  # noqa: PLW0603 - a copy makes no copies
        try:
            _is_copy = True
            # Ctrl-C goes to the first process, which ends this one.
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
            signal.set_wakeup_fd(-1)
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
            reading, writing, file = self._files
            first = os.getppid()
            os.close(writing)
            for each in self.connections:  # so that writing fails when the first process is gone
                each.close()
            # Streams without a lock that another thread may have had.
            sys.stdout, sys.stderr = (open(number, "w", 1, closefd=False) for number in (1, 2))  # noqa: SIM115
            gc.freeze()  # a collection would write to all objects that the processes share, and so copy them
            with _Sender(results) as sender:
                while sender.connected and (ticket := _awaited(reading, first)):
                    number, offset, size = _TICKET.unpack(ticket)
                    try:
                        result = _fresh(work, pickle.loads(os.pread(file, size, offset)))
                        written = pickle.dumps(result, pickle.HIGHEST_PROTOCOL)
                    except Exception:  # it is worked out by the first process
                        written = b""
                    sender.send(number.to_bytes(_NUMBER, "little") + written)
        finally:
            os._exit(0)  # without what this process would do at its end: that is the first one's


def _fork() -> int:
    with warnings.catch_warnings():  # of other threads: what a copy does not hand back is worked out here
        warnings.filterwarnings("ignore", "This process .* is multi-threaded", DeprecationWarning)
        return os.fork()


def _awaited(tickets: int, first: int) -> bytes:
    """The next ticket, once there is one; none when the first process is gone, or has closed the pipe."""
    while os.getppid() == first:
        wait([tickets], PATIENCE)
        with suppress(BlockingIOError):  # none yet, or another copy took it
            return os.read(tickets, _TICKET.size)
    return b""


def _file() -> int:
    """A file in memory, which has no name."""
    if hasattr(os, "memfd_create"):  # not where Python was built for old systems
        return os.memfd_create("handed out")
    with TemporaryFile() as file:
        return os.dup(file.fileno())


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

    def send(self, result: bytes) -> None:
        """Put a result on its way."""
        self._results.put(result)

    def _work(self) -> None:
        while (result := self._results.get()) is not None:
            try:
                self._connection.send_bytes(result)
            except OSError:
                self.connected = False
                return


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
