"""Standard output and standard error closed, full or without a reader; an unknown backend of matplotlib; Ctrl-C."""

import os
import re
import signal
import subprocess
import sys
import time

import pytest

from probation import cli

SIMULATE = [
    "simulate", "--history", "ramp:samples=400",
    "--set", "unrelaxed_modulus_MPa=3220", "--set", "tau_max_s=5.2", "--set", "hardening_modulus_MPa=2.5",
]  # fmt: skip
PROBATION = f'"{sys.executable}" -m probation'


def in_shell(arguments, redirection, folder, **environment):
    """Run a command with its streams led elsewhere; its exit status, what the rest said."""
    command = f"{PROBATION} {' '.join(arguments)} {redirection}"
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        check=False,
    )
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    assert "unexpected" not in done.stderr
    return done


@pytest.mark.parametrize(
    ("redirection", "status", "told"),
    [
        ("2>&-", 0, ""),
        ("2>/dev/full", 0, ""),
        ("2> >(head -0)", 0, ""),
        (">&-", 0, "wrote JSON a.json\n"),
        (">&- 2>&-", 0, ""),
        ("<&- >&- 2>&-", 0, ""),
        (">/dev/full", 1, "wrote JSON a.json\nprobation: standard output: No space left on device\n"),
        ("| head -0; exit ${PIPESTATUS[0]}", 141, "wrote JSON a.json\n"),
    ],
)
def test_whatever_became_of_the_streams_the_file_is_written(redirection, status, told, tmp_path):
    done = in_shell([*SIMULATE, "--json", "a.json"], redirection, tmp_path)
    assert (done.returncode, done.stderr) == (status, told)
    assert (tmp_path / "a.json").read_text().startswith('{\n "schema": "probation.simulation/1"')
    assert (tmp_path / "a.json").read_text().endswith("}\n")


def test_data_asked_for_on_a_closed_standard_output_are_missed(tmp_path):
    done = in_shell([*SIMULATE, "-o", "-"], ">&-", tmp_path)
    assert done.returncode == 1
    assert done.stderr.startswith("probation: standard output: found it closed")
    assert done.stderr.count("\n") == 1


def test_the_help_on_a_full_disk_is_one_line(tmp_path):
    done = in_shell(["--help"], ">/dev/full", tmp_path)
    assert (done.returncode, done.stderr) == (1, "probation: standard output: No space left on device\n")


def test_bad_input_keeps_its_status_where_nobody_can_be_told(tmp_path):
    assert in_shell(["fit", "no-such-folder"], "2>&-", tmp_path).returncode == 2


def test_progress_goes_where_standard_error_goes_and_costs_nothing_where_that_is_closed(tmp_path):
    arguments = ["blind", "make", "--seed", "1", "--count", "1", "--processes", "1", "--out", "split"]
    assert in_shell(arguments, "2>&-", tmp_path).returncode == 0
    assert (tmp_path / "split" / "seals.json").is_file()


def test_plots_need_no_backend_of_the_environment(tmp_path):
    done = in_shell([*SIMULATE, "--plot", "a.svg"], "", tmp_path, MPLBACKEND="nonsense")
    assert (done.returncode, done.stderr) == (0, "wrote plot a.svg\n")
    assert (tmp_path / "a.svg").is_file()


def test_with_an_output_file_no_picture_goes_to_the_terminal(tmp_path, capsys):
    assert cli.main([*SIMULATE, "-o", str(tmp_path / "a.csv")]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Simulated ramp")
    assert "┤" not in out
    assert cli.main(SIMULATE) == 0
    assert "┤" in capsys.readouterr().out


def interrupted(arguments, seconds, folder):
    """Ctrl-C, to all processes of a command as a terminal sends it, after so long; status, standard error, time.

    What a shell starts behind it is deaf to Ctrl-C, and so are its children; here the command hears it.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen(
        [sys.executable, "-m", "probation", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as started:
        signal.signal(signal.SIGINT, before)
        time.sleep(seconds)
        os.killpg(started.pid, signal.SIGINT)
        begun = time.monotonic()
        _, told = started.communicate(timeout=60)
        return started.returncode, told, time.monotonic() - begun


@pytest.mark.parametrize("seconds", [0.2, 0.4, 0.7])
def test_an_interruption_while_loading_shows_no_stack(seconds, tmp_path):
    """Before 0.2 s it may be Python itself that starts."""
    status, told, _ = interrupted(["diagnose", str(tmp_path)], seconds, tmp_path)
    if status == 2:
        pytest.skip("a fast machine: it had ended")
    if status == -signal.SIGINT and not re.search(r"probation/\w+\.py", told):
        pytest.skip("a slow machine: it was Python itself that started")
    assert status == 130
    assert told in ("", "probation: interrupted\n")


@pytest.mark.parametrize(
    "arguments",
    [
        ["coverage", "--draws", "2000", "--processes", "1"],
        ["coverage", "--draws", "2000", "--processes", "2"],
        ["blind", "make", "--seed", "1", "--count", "500", "--processes", "2", "--out", "split"],
        ["field", "example", "--out", "field", "--processes", "2"],
    ],
    ids=lambda arguments: "-".join(arguments[:2]) + arguments[-1],
)
def test_an_interruption_of_work_is_one_line_and_ends_every_process(arguments, tmp_path):
    status, told, took = interrupted(arguments, 2.0, tmp_path)
    told = "".join(line for line in told.splitlines(True) if " of " not in line)  # progress in a log
    assert status == 130
    assert told in ("", "probation: interrupted\n")
    assert took < 10.0
