"""Every option that writes, of every command: a full disk, a bad place, a kill, a reader that goes away.

The commands and their options are those of the parser. A new command needs a line in `RUNS`, a new option that names a
file one of the types that `delivery` has for them; without, a test here fails.
"""

import argparse
import contextlib
import functools
import importlib
import re
import resource
import signal
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import pytest

import probation
from probation import _files, cli
from probation.commands.delivery import OUTPUT_TYPES, output_folder, plot_file
from probation.errors import InputError

OLD = "what was there before\n"
LAW = ["--set", "unrelaxed_modulus_MPa=3220", "--set", "tau_max_s=5.2", "--set", "hardening_modulus_MPa=2.5"]
MAKE = ["--seed", "7", "--count", "1", "--processes", "1"]
READ = {"--strain-file", "--truth", "--require", "--truths", "--answers", "--beside"}
"""Options that name files or folders and only read them; --truths and --answers, where `blind score` has them."""


@dataclass(frozen=True)
class Run:
    """A quick run of a command.

    Attributes
    ----------
    arguments : list of str
        In the folder of `material`.
    computes : str
        The function that takes the time, as module:name; it is called once.
    instead : dict
        Arguments that an option needs instead.
    """

    arguments: list[str]
    computes: str = ""
    instead: dict[str, list[str]] = field(default_factory=dict)


RUNS = {
    "demo": Run([], "probation.demo:demonstrate", {"--json": ["--no-files"]}),
    "preview": Run(["one/a.csv"]),
    "init": Run(["one/a.csv", "--yes"]),
    "excitation": Run(["one"]),
    "fit": Run(["one"], "probation.identify.fit:fit"),
    "companion": Run(["--table-2"], "", {"--apply": ["rates", "--form", "power"]}),
    "certify": Run(["two"], "probation.certificate.certify:certify"),
    "diagnose": Run(["two", "--effects", "force_offset"], "probation.diagnosis.diagnose:diagnose"),
    "plan": Run(["--history", "ramp:samples=60", *LAW, "--noise", "0.04"], "probation.design.plan:plan"),
    "crosscheck": Run([], "probation.schemes.crosscheck:crosscheck"),
    "simulate": Run(["--history", "ramp:samples=400", *LAW]),
    "export": Run([*LAW, "--format", "abaqus-umat"]),
    "coverage": Run(["--draws", "1"], "probation_studies.coverage.study:_judge"),
    "paper": Run(["--only", "figure-5", "--report", "/dev/null"], "probation_studies.paper.reproduction:reproduce"),
    "blind make": Run([*MAKE, "--out", "made"], "", {"--out": MAKE}),
    "blind solve": Run(["split", "--solver", "no-gap", "--processes", "1"]),
    "blind score": Run(["solved"], "probation_studies.blind.score:score_split"),
    "field example": Run(["--size", "8", "--times", "30", "--processes", "1"]),
    "field identify": Run(["field/field.zarr", "--processes", "1"]),
    "field map": Run(["field/maps.zarr"]),
}


def _commands(parser=None, names=()):
    """Every parser that does something, by the words that call it."""
    parser = parser or cli.build_parser()
    steps = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    if not steps:
        yield " ".join(names), parser
    for name, step in steps[0].choices.items() if steps else ():
        yield from _commands(step, (*names, name))


def _options():
    return [
        pytest.param(
            name, action.option_strings[-1], action.type, id=f"{name.replace(' ', '-')}{action.option_strings[-1]}"
        )
        for name, parser in _commands()
        for action in parser._actions
        if action.type in OUTPUT_TYPES
    ]


each_option = pytest.mark.parametrize(("command", "option", "kind"), _options())


@pytest.fixture(scope="module")
def material(tmp_path_factory):
    """Campaigns, a split of the benchmark and a field, small."""
    folder = tmp_path_factory.mktemp("material")
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    records = []
    for name, rate in (("a", 0.005), ("b", 0.01), ("c", 0.02)):
        made = probation.simulate(law, probation.named_history("ramp", rate=rate, strain=0.5, samples=60))
        noise = probation.Noise(stress_MPa=0.05)
        records.append(
            probation.Record(name, made.time, made.true_strain, made.true_stress, control="strain-rate", noise=noise)
        )
    for name, some in (("one", records[:1]), ("two", records[:2]), ("rates", records)):
        probation.Campaign(name, tuple(some)).save(folder / name)
    with contextlib.chdir(folder):
        for arguments in (
            ["blind", "make", *MAKE, "--out", "split"],
            ["blind", "make", *MAKE, "--out", "solved"],
            ["blind", "solve", "solved", "--solver", "no-gap", "--processes", "1"],
            ["blind", "score", "solved"],
            ["field", "example", "--size", "8", "--times", "30", "--processes", "1", "--out", "field"],
            ["field", "identify", "field/field.zarr", "--out", "field/maps.zarr", "--processes", "1"],
        ):
            assert cli.main(arguments) == 0
    return folder


_computed: dict[str, object] = {}


@pytest.fixture
def run(material, tmp_path, monkeypatch):
    """Run a command with an option in the folder of the material; what it computes is computed once."""
    monkeypatch.chdir(material)

    def go(command, option, place):
        chosen = RUNS[command]
        if chosen.computes:
            module, name = chosen.computes.split(":")
            within = importlib.import_module(module)
            compute = getattr(within, name)

            @functools.wraps(compute)
            def once(*arguments, **options):
                if name == "demonstrate":  # its first step alone
                    monkeypatch.setattr(within, "STEPS", within.STEPS[:1])
                if chosen.computes not in _computed:
                    _computed[chosen.computes] = compute(*arguments, **options)
                return _computed[chosen.computes]

            with monkeypatch.context() as patch:
                patch.setattr(within, name, once)
                return _main(command, option, place)
        return _main(command, option, place)

    def _main(command, option, place):
        chosen = RUNS[command]
        return cli.main([*command.split(), *chosen.instead.get(option, chosen.arguments), option, str(place)])

    return go


@pytest.fixture
def place(tmp_path, kind):
    """Where an option writes: a file that is there already, or a folder with such a file."""
    where = tmp_path / "out"
    where.mkdir()
    if kind is output_folder:
        return where / "made"
    return where / ("old.png" if kind is plot_file else "old.txt")


def lines(text):
    assert "Traceback" not in text
    assert "unexpected" not in text
    return [line for line in text.splitlines() if line.startswith("probation: ")]


@contextlib.contextmanager
def full_disk(size=16):
    """No file grows beyond so many bytes: what a full disk does, for anybody, in this process alone."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_every_command_has_a_run_here():
    assert {name for name, _ in _commands()} == set(RUNS)


def test_every_option_that_names_a_file_is_known_to_write_or_to_read():
    names = re.compile(r"FILE|DIR|FOLDER|\.(csv|html|json|zarr)")
    unknown = {
        f"{name} {action.option_strings[-1]}"
        for name, parser in _commands()
        for action in parser._actions
        if action.option_strings and names.search(str(action.metavar)) and action.type not in OUTPUT_TYPES
        if action.option_strings[-1] not in READ or name == "blind make"
    }
    assert unknown == set()


@each_option
def test_a_place_that_cannot_be_written_is_refused_before_anything_is_computed(
    command, option, kind, tmp_path, run, monkeypatch, capsys
):
    monkeypatch.setitem(RUNS, command, Run(["no-such-thing"] if command in RUNS else []))
    blocking = tmp_path / "file.png"
    blocking.write_text(OLD)
    bad = [blocking / "below.png"]
    if kind is not output_folder:
        (tmp_path / "folder.png").mkdir()
        bad += [tmp_path / "folder.png", tmp_path / "nowhere" / "a.png"]
    for place in bad:
        assert run(command, option, place) == 2
        told = lines(capsys.readouterr().err)
        assert len(told) == 1
        assert option in told[0]
        assert "found" in told[0]
    assert blocking.read_text() == OLD


@each_option
def test_a_full_disk_is_one_line_with_status_1_and_leaves_what_was_there(command, option, kind, place, run, capsys):
    if kind is not output_folder and option != "--state":
        place.write_text(OLD)
    with full_disk():
        status = run(command, option, place)
    captured = capsys.readouterr()
    told = lines(captured.err)
    assert (status, len(told)) == (1, 1), captured.err
    assert "cannot be written: File too large" in told[0]
    assert str(place) in told[0]
    if kind is not output_folder and option != "--state":
        assert place.read_text() == OLD
        assert [each.name for each in place.parent.iterdir()] == [place.name]


@each_option
def test_a_file_that_was_there_is_replaced_whole_before_anything_is_printed(
    command, option, kind, place, run, monkeypatch, opened_for_writing
):
    """A reader that is gone ends the command at the first thing printed; the file is there all the same."""
    if kind is not output_folder and option != "--state":
        place.write_text(OLD)

    def gone(text):
        raise BrokenPipeError

    monkeypatch.setattr(sys.stdout, "write", gone)
    with opened_for_writing() as opened:
        status = run(command, option, place)
    silent = command in ("blind make", "field example")  # print nothing on standard output
    assert status == (0 if silent else 141)
    if kind is output_folder:
        assert any(each.is_file() for each in place.rglob("*"))
    elif option != "--state":
        assert place.read_bytes() != OLD.encode()
        assert [each.name for each in place.parent.iterdir()] == [place.name]
        assert str(place) not in opened


KILLED = """
import os, signal, sys
from probation import _files
done = _files.Path.replace
def killed(*arguments):
    os.kill(os.getpid(), signal.SIGKILL)
if sys.argv[1] == "before":
    _files.Path.replace = killed
else:
    _files.Path.replace = lambda *arguments: (done(*arguments), killed())
_files.write_whole("out.json", "new" * 100000)
"""


@pytest.mark.parametrize(("moment", "found"), [("before", "old"), ("after", "new" * 100000)])
def test_a_kill_leaves_the_old_file_or_the_new_one(moment, found, tmp_path):
    """That every option writes by `write_whole` alone is tested above: what was there is opened by nobody."""
    (tmp_path / "out.json").write_text("old")
    done = subprocess.run([sys.executable, "-c", KILLED, moment], cwd=tmp_path, check=False)
    assert done.returncode == -signal.SIGKILL
    assert (tmp_path / "out.json").read_text() == found


_opened: list[set[str]] = []


def _watch(event, arguments):
    if _opened and event == "open" and isinstance(arguments[0], str | Path):
        path, mode, flags = arguments
        if (isinstance(mode, str) and set(mode) & set("wax+")) or (flags or 0) & 3:
            _opened[-1].add(str(path))


@pytest.fixture(scope="module")
def watched():
    sys.addaudithook(_watch)  # stays as long as the process


@pytest.fixture
def opened_for_writing(watched):
    """The paths that are opened for writing within a block: a file that is only ever replaced is not among them."""

    @contextlib.contextmanager
    def watching():
        _opened.append(set())
        try:
            yield _opened[-1]
        finally:
            _opened.pop()

    return watching


def test_what_was_not_asked_to_be_a_file_goes_to_the_device_itself(material, monkeypatch, capsys):
    monkeypatch.chdir(material)
    assert cli.main(["simulate", "--history", "ramp:samples=20", *LAW, "--json", "/dev/full"]) == 1
    captured = capsys.readouterr()
    assert captured.out.startswith("Simulated ramp")
    assert lines(captured.err) == ["probation: /dev/full: cannot be written: No space left on device"]


def test_one_file_that_cannot_be_written_costs_neither_the_others_nor_the_summary(
    material, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(material)
    table = tmp_path / "out.csv"
    arguments = ["simulate", "--history", "ramp:samples=20", *LAW, "--json", "/dev/full", "-o", str(table)]
    assert cli.main(arguments) == 1
    captured = capsys.readouterr()
    assert captured.out.startswith("Simulated ramp")
    assert table.read_text().startswith("time_s,")
    assert f"wrote CSV {table}" in captured.err


def test_a_file_without_permission_is_refused(tmp_path, monkeypatch):
    """Asked as anybody but root would be answered."""
    place = tmp_path / "a.json"
    monkeypatch.setattr(_files.os, "access", lambda path, mode: False)
    with pytest.raises(PermissionError, match="cannot be written: Permission denied") as refused:
        _files.write_whole(place, "{}")
    assert refused.value.filename == str(place)
    assert cli.main(["simulate", "--history", "ramp:samples=20", *LAW, "--json", str(place)]) == 1
    assert not place.exists()


def test_links_that_lead_to_each_other_give_way_to_the_file(tmp_path):
    (tmp_path / "a").symlink_to(tmp_path / "b")
    (tmp_path / "b").symlink_to(tmp_path / "a")
    _files.write_whole(tmp_path / "a", "x")
    assert (tmp_path / "a").read_text() == "x"


def test_a_name_as_long_as_the_disk_allows_is_written(tmp_path):
    place = tmp_path / ("a" * 250)
    _files.write_whole(place, "x")
    assert place.read_text() == "x"
    with pytest.raises(InputError, match="File name too long"):
        _files.write_whole(tmp_path / ("a" * 256), "x")
