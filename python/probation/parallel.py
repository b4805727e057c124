"""The same work on many things, several at once where the law lets other threads run while it solves.

The engine does, but a solve of a record is too short: with two threads that take turns at Python between solves, a
diagnosis takes longer than with one.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import wraps
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from threadpoolctl import threadpool_limits

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

Item = TypeVar("Item")
Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")


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


def in_parallel(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    threads: int,
    progress: Callable[[float], None] | None = None,
) -> list[Result]:
    """Results in the order of the items; with one thread, in the caller's.

    Parameters
    ----------
    work : callable
    progress : callable, optional
        Called in the caller's thread with the part of the items that is done, 0 to 1.
    """
    if threads <= 1:
        return _counted(map(work, items), len(items), progress)
    with ThreadPoolExecutor(threads) as pool:
        return _counted(pool.map(work, items), len(items), progress)


def _counted(results: Iterable[Result], count: int, progress: Callable[[float], None] | None) -> list[Result]:
    kept = []
    for result in results:
        kept.append(result)
        if progress is not None:
            progress(len(kept) / count)
    return kept
