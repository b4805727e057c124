"""Work on many things in copies of this process: nothing is lost, whatever happens to a copy."""

import multiprocessing
import os
import signal
import sys
import time

import pytest

from probation.errors import InputError
from probation.parallel import at_once, in_parallel, processors

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are copied on Linux alone")


def in_a_copy():
    """Whether this is not the first process."""
    return multiprocessing.parent_process() is not None


def slowly(item):
    """Some work, and who did it."""
    time.sleep(0.02)
    return item * item, os.getpid()


def test_results_come_in_the_order_of_the_items_from_several_processes():
    results = in_parallel(slowly, range(20), 3)
    assert [square for square, _ in results] == [item * item for item in range(20)]
    assert len({process for _, process in results}) == 3


def test_one_process_is_this_one():
    assert {process for _, process in in_parallel(slowly, range(3), 1)} == {os.getpid()}


def test_a_copy_makes_no_further_copies():
    def inner(_):
        return {process for _, process in in_parallel(slowly, range(3), 3)}, os.getpid()

    for processes, own in in_parallel(inner, range(4), 2):
        assert own == os.getpid() or processes == {own}


def test_what_a_killed_copy_had_is_worked_out_here():
    def fatal(item):
        time.sleep(0.02)
        if in_a_copy():
            os.kill(os.getpid(), signal.SIGKILL)
        return item

    assert in_parallel(fatal, range(8), 3) == list(range(8))


def test_what_a_copy_cannot_hand_back_is_worked_out_here():
    def closure(item):
        time.sleep(0.02)
        return lambda: item

    assert [result() for result in in_parallel(closure, range(6), 2)] == list(range(6))


def test_an_error_is_that_of_the_work():
    def fails(item):
        time.sleep(0.02)
        raise ArithmeticError(f"item {item}")

    with pytest.raises(ArithmeticError, match="item"):
        in_parallel(fails, range(4), 2)
    assert multiprocessing.active_children() == []


def test_copies_end_when_this_process_is_interrupted():
    def interrupted(item):
        if in_a_copy():
            time.sleep(60.0)
        raise KeyboardInterrupt

    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        in_parallel(interrupted, range(4), 3)
    assert multiprocessing.active_children() == []
    assert time.monotonic() - started < 30.0


def test_progress_counts_every_item_once():
    seen = []
    in_parallel(slowly, range(10), 3, seen.append)
    assert seen == [number / 10 for number in range(1, 11)]


def test_more_items_than_a_pipe_holds():
    assert in_parallel(lambda item: -item, range(20_000), 2) == [-item for item in range(20_000)]


def test_how_many_at_once():
    assert at_once(3) == 3
    assert at_once(None) == min(processors(), 8)
    assert at_once(None, usual=1) == 1
    with pytest.raises(InputError, match="threads is 0; expected at least 1"):
        at_once(0)
