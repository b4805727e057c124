"""No file hangs the reader, floods the memory or ends in an unexpected error: it is refused in one line."""

import gzip
import io
import os
import socket
import time
import zipfile

import numpy as np
import openpyxl
import pytest

from probation import cli, limits
from probation._files import kind_of, read_json, read_whole, write_whole
from probation.errors import InputError
from probation.exporting.exporting import export
from probation.histories.file import read_history
from probation.law.settings import CompanionSettings, LawSettings
from probation.records.campaign import Campaign
from probation.records.profiles import excel
from probation.records.reading import read_record
from probation.records.record import Noise, Record
from probation.records.units import is_unit, parse_unit

HEADINGS = "time_s,true_strain,true_stress_MPa"
ROWS = [f"{0.5 * at},{0.01 * at:.2f},{1.5 * at}" for at in range(12)]


def table(headings=HEADINGS, **changed):
    """A good table, with rows replaced by their number as an editor shows it: ``row6="…"``."""
    lines = [headings, *ROWS]
    for name, text in changed.items():
        lines[int(name.removeprefix("row")) - 1] = text
    return "\n".join(lines) + "\n"


@pytest.fixture
def refusal(tmp_path):
    """The one-line complaint about a data file of this content."""

    def read(content, name="exp.csv", reader=read_record):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        with pytest.raises(InputError) as caught:
            reader(path)
        message = str(caught.value)
        assert message.startswith(str(path))
        assert "\n" not in message
        assert len(message) < len(str(path)) + 300
        return message.removeprefix(str(path))

    return read


@pytest.fixture
def campaign(tmp_path):
    """Load a campaign whose first lines, and further lines of whose record, are these."""
    (tmp_path / "exp.csv").write_text(table())

    def load(top="", record=""):
        text = f'{top}\n[[record]]\nid = "a"\nfile = "exp.csv"\n{record}\n'
        (tmp_path / "campaign.toml").write_text(text)
        return Campaign.load(tmp_path)

    return load


# Units.


@pytest.mark.parametrize(
    "unit",
    ["s**9**9**9", "10**10**10 s", "s" * 10_000, "m*" * 15 + "m**99", "(s)", "s**-", "1e9 s", "s^-", "s^0"],
)
def test_a_unit_is_never_evaluated(unit):
    before = time.perf_counter()
    assert not is_unit(unit)
    assert time.perf_counter() - before < 0.1


def test_a_power_tower_in_a_heading_is_refused_by_its_column(refusal):
    message = refusal(table("time (s**9**9**9),true_strain,true_stress_MPa"))
    assert ", row 1, column 'time (s**9**9**9)': found unknown unit 's**9**9**9', expected a time unit" in message


@pytest.mark.parametrize(
    ("unit", "factor", "powers"),
    [
        ("N/mm²", 1e6, {"kg": 1, "m": -1, "s": -2}),
        ("kgf/cm^2", 98066.5, {"kg": 1, "m": -1, "s": -2}),
        ("N·mm⁻²", 1e6, {"kg": 1, "m": -1, "s": -2}),
        ("MN m**-2", 1e6, {"kg": 1, "m": -1, "s": -2}),
        ("psi", 6894.757293168361, {"kg": 1, "m": -1, "s": -2}),
        ("kilonewtons", 1e3, {"kg": 1, "m": 1, "s": -2}),
        ("mm/m", 1e-3, {}),
        ("µε", 1e-6, {}),
        ("per min", 1.0 / 60.0, {"s": -1}),
        ("µs", 1e-6, {"s": 1}),
        ("inches", 0.0254, {"m": 1}),
    ],
)
def test_units_are_products_of_prefixed_symbols(unit, factor, powers):
    found = parse_unit(unit)
    assert float(found.factor) == pytest.approx(factor, rel=1e-15)
    assert found.powers == powers


# Files that are none.


@pytest.fixture(params=["fifo", "device", "socket", "folder"])
def no_file(request, tmp_path):
    """A path that is there and no regular file, and what it is called."""
    path = tmp_path / f"{request.param}.json"
    match request.param:
        case "fifo":
            os.mkfifo(path)
            yield path, "a pipe"
        case "device":
            path.symlink_to("/dev/zero")
            yield path, "a device"
        case "socket":
            with socket.socket(socket.AF_UNIX) as server:
                server.bind(os.path.relpath(path))  # a socket's name has 107 bytes at most
                yield path, "a socket"
        case "folder":
            path.mkdir()
            yield path, "a folder"


def test_only_regular_files_are_read_wherever_one_is_read(no_file, tmp_path):
    path, what = no_file
    (tmp_path / "exp.csv").write_text(table())
    (tmp_path / "campaign.toml").write_text(f'[[record]]\nid = "a"\nfile = "{path.name}"\n')
    for read in (read_whole, read_record, read_history, lambda path: export(path, "c")):
        with pytest.raises(InputError, match=f"found {what}, expected a regular file"):
            read(path)
    with pytest.raises(InputError, match=f"found {what}, expected a regular file"):
        Campaign.load(tmp_path)


def test_a_campaign_that_is_a_pipe_is_refused(tmp_path):
    os.mkfifo(tmp_path / "campaign.toml")
    for path in (tmp_path, tmp_path / "campaign.toml"):
        with pytest.raises(InputError, match=r"campaign\.toml: found a pipe, expected a regular file"):
            Campaign.load(path)


@pytest.mark.parametrize("name", ["x" * 300, "a\0b", "x/" * 3000])
@pytest.mark.parametrize("command", ["preview", "fit", "simulate", "export"])
def test_a_name_that_no_file_can_have_is_bad_input(command, name, capfd):
    assert cli.main([command, name, *(["--format", "c", "-o", "x"] if command == "export" else [])]) == 2
    error = capfd.readouterr().err
    assert error.startswith("probation: ")
    assert "unexpected" not in error


def test_a_campaign_may_name_a_file_of_impossible_name(campaign):
    for name in ("x" * 300, "a\\u0000b"):
        with pytest.raises(InputError, match=r"row 5: found temperature_file = .*, expected a file that exists"):
            campaign(record=f'temperature_file = "{name}"')


def test_a_result_whose_name_is_long_or_impossible_is_written_or_refused(tmp_path):
    write_whole(tmp_path / ("x" * 250), "whole")
    assert (tmp_path / ("x" * 250)).read_text() == "whole"
    for name in ("x" * 300, "a\0b"):
        with pytest.raises(InputError, match="cannot be written"):
            write_whole(tmp_path / name, "whole")
        with pytest.raises(InputError, match="cannot be made a folder"):
            Campaign("x", (Record("a", *(np.linspace(0.0, 1.0, 10),) * 3),)).save(tmp_path / name)
    assert kind_of(tmp_path / "a\0b") is None


@pytest.mark.parametrize("arguments", [["--folder"], ["-o"]])
def test_a_place_that_cannot_be_written_to_is_bad_input(arguments, capfd):
    law = [f"--set={name}=2" for name in ("unrelaxed_modulus_MPa", "hardening_modulus_MPa", "tau_max_s")]
    assert cli.main(["export", *law, "--format", "c", *arguments, "x" * 300]) == 2
    assert "unexpected" not in capfd.readouterr().err


# Floods.


def test_a_file_beyond_the_limit_is_refused_before_it_is_read_whole(tmp_path):
    path = tmp_path / "sparse.csv"
    with path.open("wb") as stream:
        stream.truncate(limits.FILE_BYTES + 1)
    with pytest.raises(InputError, match=r"found a file of 128 MiB, expected at most 128 MiB"):
        read_whole(path)
    path.write_bytes(b"#" * 5 * limits.MEBIBYTE)
    with pytest.raises(InputError, match="found a file of 5 MiB, expected at most 4 MiB"):
        Campaign.load(path)


def test_a_gzip_bomb_is_refused(refusal):
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb", compresslevel=1) as stream:
        for _ in range(129):
            stream.write(b"0" * limits.MEBIBYTE)
    assert "found a gzip file of more than 128 MiB unpacked" in refusal(packed.getvalue(), "exp.csv.gz")


def workbook(rows=()):
    book = openpyxl.Workbook()
    for row in [HEADINGS.split(","), *([float(cell) for cell in line.split(",")] for line in ROWS), *rows]:
        book.active.append(row)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def repacked(content, replace, *, name="xl/worksheets/sheet1.xml"):
    """A workbook with one of its parts replaced."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as old,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, True, 1) as new,
    ):
        for entry in old.infolist():
            data = old.read(entry)
            new.writestr(entry.filename, replace(data) if entry.filename == name else data)
    return stream.getvalue()


def test_a_zip_bomb_is_refused(refusal, monkeypatch):
    monkeypatch.setattr(excel, "INFLATED_BYTES", limits.MEBIBYTE)
    bomb = repacked(workbook(), lambda sheet: sheet + b" " * limits.MEBIBYTE)
    assert "found a workbook of more than 1 MiB unpacked, expected at most 1 MiB" in refusal(bomb, "exp.xlsx")


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        (b'r="13"', b'r="999999999999"', "more than 2000000 rows"),
        (b'r="C13"', b'r="ZZZ13"', "more than 16384 columns"),
    ],
)
def test_a_cell_at_the_end_of_the_world_is_refused(refusal, old, new, complaint):
    assert complaint in refusal(repacked(workbook(), lambda sheet: sheet.replace(old, new)), "exp.xlsx")


@pytest.mark.parametrize("seed", range(4))
def test_a_damaged_workbook_is_refused_wherever_it_is_damaged(tmp_path, seed):
    """Bytes flipped, parts cut short, XML broken: BadZipFile, zlib.error, ParseError, KeyError, …"""
    random = np.random.default_rng(seed)
    content = workbook()
    parts = zipfile.ZipFile(io.BytesIO(content)).namelist()
    path = tmp_path / "exp.xlsx"
    for at in range(12):
        if at < 6:
            damaged = bytearray(content)
            for place in random.integers(4, len(content), 8):
                damaged[place] ^= 1 << random.integers(8)
        elif at < 8:
            damaged = content[: random.integers(10, len(content))]
        else:
            name = parts[random.integers(len(parts))]
            damaged = repacked(content, lambda data: data[: len(data) // 2] + b"<\xff&x;", name=name)
        path.write_bytes(damaged)
        try:
            read_record(path)
        except InputError as error:
            assert str(error).startswith(str(path))  # noqa: PT017 - a part that is not read may be damaged


@pytest.mark.parametrize("cut", [12, 60, -9, -3])
def test_a_damaged_gzip_is_refused(refusal, cut):
    packed = gzip.compress(table().encode())
    assert "found a damaged gzip file" in refusal(packed[:cut], "exp.csv.gz")


def test_a_cell_beyond_the_limit_is_named_by_its_row(refusal):
    message = refusal(table(row6="2.0," + "1" * 200_000 + ",3"))
    assert ", row 6: found text that is no CSV (a cell of more than 131072 characters)" in message


def test_an_endless_line_is_refused(refusal):
    assert ", row 6: found a line of 1200000 characters, expected at most 1000000" in refusal(
        table(row6="1," * 600_000)
    )


def test_a_flood_of_rows_columns_or_cells_is_refused(refusal, monkeypatch):
    assert ", row 2000001: found more than 2000000 rows" in refusal("\n" * 2_000_001 + table())
    assert ", row 6: found more than 16384 columns" in refusal(table(row6="1," * 20_000))
    monkeypatch.setattr("probation.records.grid.CELLS", 30)
    assert ", row 11: found more than 30 cells" in refusal(table())


def test_empty_cells_do_not_slow_the_reading_down(tmp_path):
    """The search for decimal commas once took a time that grew with the square of their number."""
    path = tmp_path / "exp.csv"
    path.write_text(table() + ",,\n" * 100_000)
    before = time.perf_counter()
    assert len(read_record(path)) == 12
    assert time.perf_counter() - before < 5.0


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("x = " + "[" * 100_000, "nested deeper than 32"),
        ("x = " + "{a=" * 100_000, "nested deeper than 32"),
        (".".join("a" * 100_000) + " = 1", "nested deeper than 32"),
        ("[" + ".".join("a" * 100_000) + "]", "nested deeper than 32"),
        ("x = " + "9" * 5000, "a number of more than 100 digits"),
        ("x = 0x" + "f" * 5000, "a whole number beyond 64 bits in 'x'"),
        ("[law]\nmodes = " + "9" * 80, "a whole number beyond 64 bits in 'law.modes'"),
        ("[law.fixed]\ntau_max_s = 1e200", "tau_max_s = 1e+200 in [law.fixed], expected a magnitude of at most 1e+30"),
        ("[" + " " * 100_000, "no valid TOML"),
    ],
)
def test_a_campaign_file_is_neither_deep_nor_endless(campaign, text, found):
    before = time.perf_counter()
    with pytest.raises(InputError) as caught:
        campaign(text)
    assert found in str(caught.value)
    assert len(str(caught.value)) < 500
    assert time.perf_counter() - before < 2.0


def test_brackets_dots_and_digits_in_text_and_comments_are_no_nesting(campaign):
    name = "[" * 50 + "." * 50 + "1" * 150
    assert campaign(f'# {name}\nname = "{name}"  # {name}').name == name
    assert campaign(f"name = '''{name}'''").name == name


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("[" * 100_000, "row 1: lists and objects nested deeper than 32"),
        ('{"a":' * 100_000, "nested deeper than 32"),
        ('\n{"a": ' + "9" * 5000 + "}", "a whole number of 5000 digits, more than 100"),
        ('{"a": "' + '\\"' * 100_000, "found no JSON"),
        (b"\xff\xfe\x00", "found no JSON"),
    ],
)
def test_a_json_file_is_neither_deep_nor_endless(refusal, text, found):
    before = time.perf_counter()
    assert found in refusal(text, "fit.json", lambda path: export(path, "c"))
    assert time.perf_counter() - before < 2.0


def test_json_within_the_limits_is_read(tmp_path):
    path = tmp_path / "a.json"
    path.write_text('{"a": ["[[[[", "\\"", 1, 2.5, true]}')
    assert read_json(path, "an object") == {"a": ["[[[[", '"', 1, 2.5, True]}


# Numbers beyond physics.


@pytest.mark.parametrize(
    ("row", "column", "found"),
    [
        ("1e13,0.12,3", "time_s", "1e+13 s, expected at most 1e+12 s in magnitude"),
        ("6.0,0.12,-2e9", "true_stress_MPa", "-2e+09 MPa, expected at most 1e+09 MPa in magnitude"),
        ("6.0,400,3", "true_strain", "400, expected at most 300 in magnitude; strain in percent?"),
    ],
)
def test_a_number_beyond_physics_is_named_by_row_and_column(refusal, row, column, found):
    assert f", row 13, column '{column}': found {found}" in refusal(table(row13=row))
    if "stress" not in column:
        assert f", row 13, column '{column}': found {found}" in refusal(table(row13=row), reader=read_history)


def test_the_limit_counts_in_the_internal_unit(refusal):
    message = refusal(table("time_s,true_strain,true_stress (GPa)", row6="2.0,0.04,3e6"))
    assert ", row 6, column 'true_stress (GPa)': found 3e+09 MPa" in message


def test_steps_shorter_than_a_femtosecond_are_refused(refusal):
    rows = {f"row{at + 2}": f"{at}e-310,{0.01 * at},{at}" for at in range(12)}
    assert ", row 3, column 'time_s': found 1e-310 s after the sample before, expected at least 1e-15 s" in refusal(
        table(**rows)
    )


def test_strain_and_stress_next_to_nothing_are_refused():
    time = np.linspace(0.0, 1.0, 10)
    for tiny in ("true_strain", "true_stress"):
        with pytest.raises(InputError, match=f"{tiny}, sample 9: found 1e-300 as the largest, expected at least 1e-30"):
            Record("a", **{"time": time, "true_strain": time, "true_stress": time, tiny: 1e-300 * time})


@pytest.mark.parametrize("level", [1e29, 1e-300])
@pytest.mark.parametrize("key", ["stress_MPa", "strain"])
def test_noise_beyond_physics_is_refused_by_its_row(campaign, key, level):
    with pytest.raises(InputError, match=rf"row 5: found {key} = .* expected 0 or a number from 1e-30 to"):
        campaign(record=f"noise = {{ {key} = {level} }}")
    with pytest.raises(InputError, match=rf"noise\.{key}: found"):
        Noise(**{key: level})


def test_parameters_beyond_any_material_are_refused():
    with pytest.raises(InputError, match=r"law\.fixed: found tau_max_s = 1e-300, expected 0 or a magnitude from 1e-30"):
        LawSettings(fixed={"tau_max_s": 1e-300})
    with pytest.raises(InputError, match=r"found decades = 400, expected a positive number of at most 100"):
        LawSettings(decades=400)
    with pytest.raises(InputError, match="found coefficient = 1e-300"):
        CompanionSettings("exponential", {"coefficient": 1e-300, "exponent": -2.0})
    with pytest.raises(InputError, match=r"found 1e\+300 in rates"):
        CompanionSettings("table", {"rates": (1.0, 1e300), "tau_max_s": (1.0, 2.0)})


@pytest.mark.parametrize("encoding", ["utf-32", "utf-32-le", "utf-16", "utf-16-le", "utf-7", "cp500", "shift_jis"])
def test_odd_encodings_are_read_or_refused(tmp_path, encoding):
    path = tmp_path / "exp.csv"
    path.write_bytes(table("時間 time_s,true_strain,true_stress_MPa").encode(encoding, "replace"))
    try:
        assert len(read_record(path, columns={"time": 1})) == 12
    except InputError as error:
        assert str(error).startswith(str(path))  # noqa: PT017 - either will do
