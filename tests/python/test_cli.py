"""The command line as a whole: help, exit statuses, one line for every error."""

import os
import re
import subprocess
import sys
import time

import pytest

from probation import cli, simulation
from probation.commands.progress import shown
from probation.errors import ConvergenceError, InputError
from probation.records import assembly

LAW = ["--set", "unrelaxed_modulus_MPa=3220", "--set", "tau_max_s=5.2", "--set", "hardening_modulus_MPa=2.5"]


@pytest.fixture
def failing(monkeypatch):
    """Let the preview command raise that exception."""

    def arrange(error):
        def run(options):
            raise error

        monkeypatch.setattr(cli.preview, "run", run)
        return cli.main(["preview", "any.csv"])

    return arrange


def one_line(text):
    return text.endswith("\n") and text.count("\n") == 1 and "Traceback" not in text


def test_without_arguments_the_help_teaches_by_example(capsys):
    assert cli.main([]) == 0
    out = capsys.readouterr().out
    assert "probation simulate --history ramp" in out
    assert all(command.NAME in out for command in cli.commands())


@pytest.mark.parametrize("command", [command.NAME for command in cli.commands()])
def test_every_command_has_help_with_an_example(command, capsys):
    assert cli.main([command, "--help"]) == 0
    assert f"\n  probation {command}" in capsys.readouterr().out


def test_a_command_of_the_studies_stands_in_the_place_of_the_librarys_with_its_name():
    names = [command.NAME for command in cli.commands()]
    assert names[: len(cli.COMMANDS)] == [command.NAME for command in cli.COMMANDS]
    assert len(set(names)) == len(names)
    there = {command.NAME: command.__name__.split(".")[0] for command in cli.commands()}
    assert there["companion"] == there["excitation"] == "probation_studies"


def test_without_the_studies_the_library_has_its_own_commands(monkeypatch, capsys):
    monkeypatch.setattr(cli, "entry_points", lambda group: ())
    monkeypatch.setattr(cli, "commands", cli.commands.__wrapped__)
    assert cli.commands() == cli.COMMANDS
    assert cli.main(["companion", "--table-2"]) == 2
    assert "--table-2" in capsys.readouterr().err
    assert cli.main(["companion", "--help"]) == 0


def test_the_version_is_that_of_the_package(capsys):
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out == f"probation {cli.__version__}\n"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["simulat"], "did you mean 'simulate'?"),
        (["simulate", "--scheme", "be3"], "invalid choice: 'be3'"),
        (["simulate", "--nonsense"], "--nonsense"),
        (["preview"], "FILE"),
        (["fit"], "CAMPAIGN"),
        (["fit", "no-such-folder"], "no-such-folder"),
        (["crosscheck", "--set", "tau_max_s=3"], "without a campaign"),
        (["preview", "a.csv", "--plot", "a.bmp"], "expected a file that ends in .png"),
        (["preview", "a.csv", "--unit", "force"], "--unit: found 'force', expected ROLE=…"),
        (["preview", "a.csv", "--column", "time=1", "--column", "time=2"], "found time twice"),
        (["preview", "no-such.csv"], "no-such.csv: found no such file"),
        (["demo", "--no-files", "--out", "x"], "not allowed with"),
    ],
)
def test_bad_arguments_are_told_in_one_line_with_status_2(arguments, told, capsys):
    assert cli.main(arguments) == 2
    err = capsys.readouterr().err
    assert one_line(err)
    assert err.startswith("probation: ")
    assert told in err


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (InputError("a.csv, row 3: found 'x',\nexpected a number"), 2),
        (ConvergenceError("stopped at t = 3 s"), 1),
        (RuntimeError("an invariant broke"), 1),
        (KeyboardInterrupt(), 130),
        (BrokenPipeError(), 141),
    ],
)
def test_each_kind_of_failure_has_its_status_and_no_traceback(error, status, failing, capsys):
    assert failing(error) == status
    err = capsys.readouterr().err
    assert err == "" if status == 141 else one_line(err)


def test_an_unexpected_error_tells_how_to_see_where(failing, capsys):
    failing(RuntimeError("an invariant broke"))
    assert "PROBATION_DEBUG=1" in capsys.readouterr().err


def test_debugging_shows_where_an_error_arose(failing, capsys, monkeypatch):
    monkeypatch.setenv("PROBATION_DEBUG", "1")
    assert failing(RuntimeError("an invariant broke")) == 1
    assert "Traceback" in capsys.readouterr().err


def test_a_warning_of_a_library_is_one_line_on_standard_error(monkeypatch, capsys):
    def run(options):
        import warnings  # noqa: PLC0415

        warnings.simplefilter("always")
        warnings.warn("mind the gap", stacklevel=1)
        return 0

    monkeypatch.setattr(cli.preview, "run", run)
    assert cli.main(["preview", "any.csv"]) == 0
    assert capsys.readouterr().err == "warning: mind the gap\n"


def run_as_process(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "probation", *arguments],
        capture_output=True,
        text=True,
        encoding="utf-8",
        env={**os.environ, **environment},
        check=False,
    )


def test_as_a_process_bad_input_leaves_status_2_and_an_empty_standard_output():
    done = run_as_process("simulate", "no-such.csv", *LAW)
    assert (done.returncode, done.stdout) == (2, "")
    assert one_line(done.stderr)


def test_as_a_process_a_simulation_goes_to_standard_output():
    done = run_as_process("simulate", "--history", "ramp:samples=11", *LAW, "-o", "-")
    assert done.returncode == 0
    assert done.stdout.splitlines()[0] == "time_s,true_strain,true_stress_MPa"
    assert len(done.stdout.splitlines()) == 12


def test_a_terminal_without_unicode_shows_question_marks_instead_of_failing():
    done = run_as_process("simulate", "--history", "ramp:samples=11", *LAW, PYTHONIOENCODING="ascii")
    assert done.returncode == 0


def test_a_reader_that_goes_away_is_no_error_to_speak_of():
    command = f'"{sys.executable}" -m probation simulate --history ramp:samples=20001 {" ".join(LAW)} -o - | head -1'
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert done.stdout == "time_s,true_strain,true_stress_MPa\n"
    assert done.stderr == ""


def test_progress_shows_on_a_terminal_where_something_lasts(capsys, monkeypatch):
    with shown("working") as advance:
        advance(1, 2, "half")
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    with shown("working") as advance:
        advance(1, 2, "half")
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("probation.commands.progress.SHOWN_AFTER", 0.0)
    with shown("working") as advance:
        advance(1, 2, "half")
        time.sleep(0.3)
    told = capsys.readouterr().err
    assert "working: half" in told
    assert "left" in told


def test_a_long_simulation_shows_what_is_being_done(capsys, monkeypatch):
    simulate = simulation.simulate

    def slow(*arguments):
        time.sleep(0.3)
        return simulate(*arguments)

    monkeypatch.setattr(simulation, "simulate", slow)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setattr("probation.commands.progress.SHOWN_AFTER", 0.0)
    assert cli.main(["simulate", "--history", "ramp:samples=11", *LAW]) == 0
    assert "simulating ramp" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["preview", "fit"])
def test_a_large_file_shows_that_it_is_being_read(capsys, monkeypatch, tmp_path, command):
    rows = "".join(f"{at},{0.001 * at},{0.9 * at}\n" for at in range(50))
    (tmp_path / "large.csv").write_text("time_s,true_strain,true_stress_MPa\n" + rows)
    extract = assembly.extract

    def slow(*arguments, **options):
        time.sleep(0.3)
        return extract(*arguments, **options)

    monkeypatch.setattr(assembly, "extract", slow)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setattr("probation.commands.progress.SHOWN_AFTER", 0.0)
    monkeypatch.chdir(tmp_path)
    assert cli.main([command, "large.csv"]) == 0
    assert "reading large.csv" in capsys.readouterr().err


def test_a_log_is_not_silent_for_minutes(capsys, monkeypatch):
    monkeypatch.setattr("probation.commands.progress.LOGGED_AFTER", 0.0)
    instants = iter([0.0, 10.0, 30.0, 90.0, 100.0, 151.0])
    monkeypatch.setattr("probation.commands.progress.time.monotonic", lambda: next(instants))
    with shown("diagnosis") as advance:
        for done in (10, 11, 12, 13, 14):
            advance(done, 100, "trying causes")
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(",")[0] for line in lines] == ["diagnosis: 10 %", "diagnosis: 12 %", "diagnosis: 14 %"]


def test_a_log_gets_a_line_at_every_tenth_of_what_lasts(capsys, monkeypatch):
    monkeypatch.setattr("probation.commands.progress.LOGGED_AFTER", 0.0)
    with shown("working") as advance:
        for done in range(101):
            advance(done, 100, "")
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 10
    assert re.fullmatch(r"working: 40 %, \d+:\d\d so far, about \d+:\d\d left", lines[3])
    assert re.fullmatch(r"working: 100 %, \d+:\d\d so far", lines[-1])


def test_the_verdict_is_bold_on_a_terminal(capsys, monkeypatch):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert cli.main(["simulate", "--history", "ramp:samples=11", *LAW]) == 0
    assert capsys.readouterr().out.startswith("\x1b[1mSimulated ramp")
