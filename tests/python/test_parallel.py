"""Work on many things in copies of this process: nothing is lost, whatever happens to a copy."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import probation
from probation import parallel
from probation.errors import InputError
from probation.parallel import Copies, at_once, both, in_parallel

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are copied on Linux alone")


FIRST = os.getpid()


def in_a_copy():
    """Whether this is not the first process."""
    return os.getpid() != FIRST


def no_copies_left():
    """Whether this process has no child."""
    try:
        return os.waitpid(-1, os.WNOHANG) == (0, 0)
    except ChildProcessError:
        return True


def within(seconds, script):
    """The exit code and output of a Python script that is given so long."""
    done = subprocess.run([sys.executable, "-c", script], timeout=seconds, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


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


def test_short_work_is_done_here_and_shared_again_once_it_is_long():
    """A copy costs more than some milliseconds of work; what an item took the last time may mislead."""

    def work(seconds):
        time.sleep(seconds)
        return os.getpid()

    in_parallel(work, [0.001] * 4, 2)
    assert set(in_parallel(work, [0.001] * 4, 2)) == {os.getpid()}
    assert len(set(in_parallel(work, [0.05] * 6, 2))) == 2


def test_two_works_side_by_side():
    """The first one is worked on here, or in a copy that hands back the same."""
    assert both(lambda: slowly(2)[0], lambda: "other", 2) == (4, "other")
    assert both(lambda: slowly(2)[0], lambda: "other", 1) == (4, "other")


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
    assert no_copies_left()


def test_copies_end_when_this_process_is_interrupted():
    def interrupted(item):
        if in_a_copy():
            time.sleep(60.0)
        raise KeyboardInterrupt

    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        in_parallel(interrupted, range(4), 3)
    assert no_copies_left()
    assert time.monotonic() - started < 30.0


def test_a_copy_goes_on_while_this_process_is_busy():
    """Results larger than a pipe holds wait there; the copy does not."""

    def work(_):
        if not in_a_copy():
            time.sleep(2.0)
        return os.getpid(), bytes(300_000)

    results = in_parallel(work, range(12), 2)
    assert [process for process, _ in results].count(FIRST) == 1
    assert all(len(data) == 300_000 for _, data in results)


def test_progress_counts_every_item_once():
    seen = []
    in_parallel(slowly, range(10), 3, seen.append)
    assert seen == [number / 10 for number in range(1, 11)]


def test_more_items_than_a_pipe_holds():
    assert in_parallel(lambda item: -item, range(20_000), 2) == [-item for item in range(20_000)]


def test_how_many_at_once():
    assert at_once(3) == 3
    assert at_once(None) == 1
    with pytest.raises(InputError, match="threads is 0; expected at least 1"):
        at_once(0)


def test_a_copy_that_hangs_is_not_waited_for():
    def hangs(item):
        time.sleep(3600.0 if in_a_copy() else 0.01)
        return item

    started = time.monotonic()
    assert in_parallel(hangs, range(4), 3) == list(range(4))
    assert time.monotonic() - started < 30.0
    assert no_copies_left()


def test_a_lock_of_another_thread_does_not_stop_a_copy_for_ever():
    """In a copy nobody is left who would release it."""
    script = """
import threading, time
from probation.parallel import in_parallel

lock, going = threading.Lock(), True

def hold():
    while going:
        with lock:
            time.sleep(0.05)
        time.sleep(0.001)

def work(item):
    with lock:
        return item

threading.Thread(target=hold).start()
time.sleep(0.02)
assert in_parallel(work, range(4), 3) == list(range(4))
going = False
"""
    assert within(60.0, script) == (0, "")


def test_without_a_further_file_or_process_all_is_worked_out_here():
    script = """
import resource
from probation.parallel import in_parallel
resource.setrlimit(resource.RLIMIT_NOFILE, (10, 10))
assert in_parallel(lambda item: item, range(50), 8) == list(range(50))
"""
    assert within(60.0, script) == (0, "")


def test_a_result_that_cannot_be_read_is_worked_out_here():
    class OddError(ValueError):
        def __init__(self, one, other):
            super().__init__(f"{one} {other}")

    def odd(item):
        time.sleep(0.02)
        return OddError(item, item)

    assert [str(each) for each in in_parallel(odd, range(6), 2)] == [f"{item} {item}" for item in range(6)]


def test_no_descriptor_is_left_open():
    before = descriptors()
    for _ in range(50):
        in_parallel(lambda item: item, range(3), 3)
    assert descriptors() == before
    assert no_copies_left()


def test_copies_go_on_to_the_next_batch_until_they_are_closed():
    """Items that were not known when the copies were made are handed over."""

    def work(item):
        time.sleep(0.02)
        return item.sum(), os.getpid()

    with Copies(work, 3) as copies:
        batches = [copies.results([np.full(1000, number + size) for number in range(9)]) for size in (0.5, 1.5)]
    processes = [{process for _, process in batch} for batch in batches]
    assert processes[0] == processes[1]
    assert len(processes[0]) == 3
    assert [total for total, _ in batches[1]] == [1000 * (number + 1.5) for number in range(9)]
    assert no_copies_left()


def test_a_batch_after_one_whose_copies_were_lost_is_worked_out():
    def fatal(item):
        time.sleep(0.02)
        if in_a_copy() and item < 4:
            os.kill(os.getpid(), signal.SIGKILL)
        return item

    with Copies(fatal, 2) as copies:
        assert copies.results(range(4)) == list(range(4))
        assert copies.results(range(4, 8)) == list(range(4, 8))
    assert no_copies_left()


def test_an_item_that_fails_in_a_copy_alone_is_worked_out_here_at_once():
    def fails(item):
        time.sleep(0.02)
        if in_a_copy():
            raise ArithmeticError(f"item {item}")
        return item

    with Copies(fails, 2) as copies:
        started = time.monotonic()
        assert copies.results(range(10)) == copies.results(range(10)) == list(range(10))
        assert time.monotonic() - started < 1.5


def descriptors():
    return len(list(Path("/proc/self/fd").iterdir()))


def test_where_python_knows_no_files_in_memory_copies_work_too(monkeypatch):
    monkeypatch.delattr(os, "memfd_create")
    before = descriptors()
    with Copies(slowly, 2) as copies:
        assert len({process for _, process in copies.results(range(8))}) == 2
    assert descriptors() == before


def test_items_that_are_no_data_are_worked_out_here():
    with Copies(lambda item: (item(), time.sleep(0.02), os.getpid())[2], 2) as copies:
        assert set(copies.results([lambda: None] * 6)) == {os.getpid()}


def test_an_interrupt_while_copies_are_made_leaves_none(monkeypatch):
    known, made, before = parallel._fork, [], descriptors()

    def fork():
        if made:
            raise KeyboardInterrupt
        made.append(known())
        return made[-1]

    monkeypatch.setattr(parallel, "_fork", fork)
    with pytest.raises(KeyboardInterrupt):
        in_parallel(slowly, range(20), 3)
    assert made
    assert no_copies_left()
    assert descriptors() == before


def test_copies_end_with_the_first_process():
    """Also where it is killed and closes nothing."""
    script = """
import os, signal, time
from probation.parallel import Copies
copies = Copies(lambda item: (time.sleep(0.05), os.getpid())[1], 2)
(other,) = set(copies.results(range(6))) - {os.getpid()}
print(other, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""
    _, output = within(60.0, script)
    deadline = time.monotonic() + 10.0
    while Path(f"/proc/{int(output)}").exists() and "State:\tZ" not in Path(f"/proc/{int(output)}/status").read_text():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_plans_and_isolability_are_the_same_to_the_last_digit():
    """What the engine's solvers keep from solve to solve must not depend on which process had which."""
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    ramps = {f"{rate}": probation.named_history("ramp", rate=rate, strain=1.5) for rate in (0.001, 0.02)}
    alone, together = (probation.plan(law, ramps, noise=0.5, threads=threads).to_json() for threads in (1, 3))
    assert alone == together
