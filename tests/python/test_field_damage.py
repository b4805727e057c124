"""Stores that are damaged, lack a chunk or hold what they should not: one line that names store, array and chunk."""

import errno
import json
import shutil

import numpy as np
import pytest
import xarray as xr
import zarr

from probation.cli import main
from probation.errors import InputError
from probation.field import identify_field, open_field, open_maps
from probation.field.chunks import read, write
from probation.field.example.make import make_example

PIXELS = 64


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with field.zarr, truth.zarr and maps.zarr in four blocks of 8 x 8 pixels."""
    folder = tmp_path_factory.mktemp("made")
    field, _ = make_example(folder, size=16, times=40, processes=1)
    identify_field(field, folder / "maps.zarr", pixels=PIXELS, processes=1, threads=1)
    return folder


@pytest.fixture
def folder(made, tmp_path):
    return shutil.copytree(made, tmp_path / "copy")


def flip(path, bit=0):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1 << bit
    path.write_bytes(content)


def truncate(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def fill_with_rubbish(path):
    path.write_bytes(b"\x00" * 7)


def empty(path):
    path.write_bytes(b"")


def refused(capsys, arguments, *said):
    """The command ends with status 2 and one line, but for those of its progress."""
    capsys.readouterr()
    assert main(["field", *map(str, arguments)]) == 2
    lines = capsys.readouterr().err.splitlines()
    (line,) = [each for each in lines if not each.startswith("identifying: ")]
    assert line.startswith("probation: ")
    for part in said:
        assert part in line
    assert "unexpected" not in line


DAMAGES = [flip, truncate, fill_with_rubbish, empty]


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("name", ["hardening_modulus/c/1/0", "status/c/0/0", "y/c/0", "block_crc32/c/0/1"])
def test_a_damaged_chunk_of_the_maps_is_named(folder, capsys, damage, name):
    damage(folder / "maps.zarr" / name)
    array, _, chunk = name.partition("/")
    refused(capsys, ["map", folder / "maps.zarr"], f"maps.zarr: {array}: chunk {chunk}: found it damaged")


def test_flipped_bits_anywhere_in_a_chunk_are_found(folder):
    """Every 23rd of them; 23 is prime to 8, so that each of a byte's bits has its turn."""
    chunk = folder / "maps.zarr" / "status" / "c" / "0" / "0"
    whole = chunk.read_bytes()
    for at in range(0, 8 * len(whole), 23):
        content = bytearray(whole)
        content[at // 8] ^= 1 << at % 8
        chunk.write_bytes(content)
        with pytest.raises(InputError, match="status: chunk c/0/0: found it damaged"):
            read(str(folder / "maps.zarr"), "status")


def test_an_absent_chunk_of_the_maps_is_no_pixel_without_data(folder, capsys):
    (folder / "maps.zarr" / "hardening_modulus" / "c" / "0" / "1").unlink()
    said = "maps.zarr: hardening_modulus: found no chunk c/0/1, expected it; probation field identify, called again"
    refused(capsys, ["map", folder / "maps.zarr"], said)


def test_a_chunk_of_another_block_is_not_what_was_written(folder, capsys):
    chunks = folder / "maps.zarr" / "hardening_modulus" / "c"
    shutil.copy(chunks / "0" / "1", chunks / "1" / "1")
    refused(capsys, ["map", folder / "maps.zarr"], "maps.zarr: block (1, 1): found maps that are not what was written")


@pytest.mark.parametrize("damage", [*DAMAGES, lambda path: path.unlink()])
@pytest.mark.parametrize("name", ["hardening_modulus/c/1/0", "block_crc32/c/0/1"])
def test_a_damaged_block_is_done_anew(folder, damage, name):
    before = open_maps(folder / "maps.zarr").maps
    damage(folder / "maps.zarr" / name)
    done = identify_field(folder / "field.zarr", folder / "maps.zarr", pixels=PIXELS, processes=1, threads=1)
    assert (done.now, done.before) == (1, 3)
    for key, values in open_maps(folder / "maps.zarr").maps.items():
        np.testing.assert_array_equal(values, before[key], err_msg=key)


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("name", ["true_stress/c/2/1/0", "true_strain/c/0/0/0", "time/c/0"])
def test_a_damaged_chunk_of_the_field_is_named(folder, capsys, damage, name):
    damage(folder / "field.zarr" / name)
    array, _, chunk = name.partition("/")
    said = "found it damaged" if array != "time" else "found"
    arguments = ["identify", folder / "field.zarr", "--out", folder / "new.zarr", "--processes", "1"]
    refused(capsys, arguments, "field.zarr: ", *([f"{array}: chunk {chunk}: {said}"] if array != "time" else []))


@pytest.mark.parametrize("name", ["true_stress/c/2/1/0", "true_strain/c/0/0/0", "time/c/0"])
def test_an_absent_chunk_of_the_field_is_named(folder, capsys, name):
    """The corner holds no specimen: its chunk of NaN is written, too."""
    (folder / "field.zarr" / name).unlink()
    array, _, chunk = name.partition("/")
    arguments = ["identify", folder / "field.zarr", "--out", folder / "new.zarr"]
    refused(capsys, arguments, f"field.zarr: {array}: found no chunk {chunk}, expected it; where the writer leaves")
    assert not (folder / "new.zarr").exists()


def test_a_sparse_field_is_read_where_that_is_said_and_its_fill_value_is_nan(folder, capsys):
    (folder / "field.zarr" / "true_stress" / "c" / "2" / "1" / "0").unlink()
    source = open_field(folder / "field.zarr", sparse=True)
    _, stress = source.read(slice(8, 12), slice(4, 8))
    assert np.isnan(stress).all()
    metadata = folder / "field.zarr" / "true_stress" / "zarr.json"
    metadata.write_text(metadata.read_text().replace('"fill_value": "NaN"', '"fill_value": 0.0'))
    arguments = ["identify", folder / "field.zarr", "--out", folder / "new.zarr", "--sparse"]
    refused(
        capsys, arguments, "true_stress: found no chunk c/2/1/0, which would read as 0.0, expected a fill value of NaN"
    )


@pytest.mark.parametrize("damage", [flip, lambda path: path.unlink()])
def test_damage_to_the_truth_is_named(folder, capsys, damage):
    damage(folder / "truth.zarr" / "tau_max" / "c" / "0" / "0")
    refused(capsys, ["map", folder / "maps.zarr", "--truth", folder / "truth.zarr"], "truth.zarr: tau_max: ", "c/0/0")


def edit(path, change):
    content = json.loads(path.read_text())
    change(content)
    path.write_text(json.dumps(content))


def put(*keys, value):
    def change(content):
        for key in keys[:-1]:
            content = content[key]
        content[keys[-1]] = value

    return change


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("", put("attributes", "run", "scheme", value=7), "run: found scheme 7"),
        ("", put("attributes", "run", "block", value=[0, 8]), "run: found block [0, 8]"),
        ("", put("attributes", "run", "law", value="A-1"), "run: found law 'A-1'"),
        ("", put("attributes", "schema", value=1), "found the schema 1"),
        ("status", put("shape", value=[16, 17]), "found"),
        ("status", put("shape", value=[16]), "status: found"),
        ("tau_max", put("shape", value=[16, 15]), "tau_max: found float64 of the shape (16, 15), expected float64"),
        (
            "tau_max",
            put("data_type", value="float32"),
            "tau_max: found float32 of the shape (16, 16), expected float64",
        ),
        ("tau_max", put("data_type", value="nonsense"), "tau_max: found no array that can be opened"),
        ("tau_max", put("codecs", value=[]), "tau_max: found no array that can be opened"),
        ("x", put("shape", value=[3]), "x: found float64 of the shape (3,), expected float64 of (16,)"),
    ],
)
def test_odd_values_in_a_store_of_maps_are_named(folder, capsys, name, change, said):
    edit(folder / "maps.zarr" / name / "zarr.json", change)
    refused(capsys, ["map", folder / "maps.zarr"], "maps.zarr", said)


@pytest.mark.parametrize("name", ["tau_max", "status", "block_crc32", "x"])
def test_an_array_that_lacks_is_named(folder, capsys, name):
    shutil.rmtree(folder / "maps.zarr" / name)
    refused(capsys, ["map", folder / "maps.zarr"], f"maps.zarr: {name}: found no array that can be opened")


def test_a_disk_that_fills_up_is_one_line_and_what_is_done_is_kept(folder, capsys, monkeypatch):
    """It is full in the third block; with room again, the run goes on."""
    room = iter([None] * 35)

    def writes(path, name, at, values):
        if next(room, "full") == "full":
            raise OSError(errno.ENOSPC, "No space left on device", path)
        write(path, name, at, values)

    arguments = ["identify", folder / "field.zarr", "--out", folder / "new.zarr", "--pixels", "64", "--processes", "1"]
    with monkeypatch.context() as full:
        full.setattr("probation.field.store.write", writes)
        refused(capsys, arguments, "new.zarr: cannot be written: No space left on device; what is done is kept")
    done = open_maps(folder / "new.zarr").blocks_done
    assert 0 < done < 4
    assert main(["field", *map(str, arguments)]) == 0
    assert f"{4 - done} blocks done now, {done} before" in capsys.readouterr().out


TIME = np.linspace(0.0, 19.0, 20)


@pytest.mark.parametrize(
    ("name", "values", "attributes", "said"),
    [
        (
            "time",
            np.where(TIME == 5.0, np.nan, TIME),
            {"units": "s"},
            "time[5]: found nan after 4 s, expected increasing",
        ),
        ("time", np.minimum(TIME, 7.0), {"units": "s"}, "time[8]: found 7 after 7 s, expected increasing times"),
        ("time", TIME, {"units": 5}, "time: found"),
        ("time", TIME, {"units": ["s"]}, "time: found"),
        ("time", TIME, {"units": {}}, "time: found"),
        ("time", TIME > 3.0, {"units": "s"}, "time: found values of type bool"),
        (
            "true_stress",
            np.zeros((2, 2, 20), dtype=complex),
            {"units": "MPa"},
            "true_stress: found values of type complex",
        ),
        ("true_stress", np.zeros((2, 2, 20)), {"units": "MPa", "scale_factor": "ten"}, "field.zarr"),
        ("true_stress", np.zeros((2, 2, 20)), {"units": None}, "true_stress: found no attribute units"),
    ],
)
def test_odd_values_in_a_field_are_named(tmp_path, capsys, name, values, attributes, said):
    arrays = {
        "time": (TIME, ("time",), {"units": "s"}),
        "true_strain": (np.full((2, 2, 20), 0.1), ("y", "x", "time"), {}),
        "true_stress": (np.full((2, 2, 20), 1.0), ("y", "x", "time"), {"units": "MPa"}),
    }
    arrays[name] = (values, arrays[name][1], attributes)
    group = zarr.open_group(tmp_path / "field.zarr", mode="w")
    with zarr.config.set({"array.write_empty_chunks": True}):
        for key, (each, dimensions, told) in arrays.items():
            array = group.create_array(
                key, shape=each.shape, dtype=each.dtype, dimension_names=dimensions, attributes=told
            )
            array[...] = each
    refused(capsys, ["identify", tmp_path / "field.zarr", "--out", tmp_path / "maps.zarr"], "field.zarr", said)


def test_a_store_of_the_second_format_is_looked_over_too(tmp_path, capsys):
    """Its chunks are named 0.0.0."""
    ramp = np.broadcast_to(0.01 * TIME, (2, 2, 20))
    data = xr.Dataset(
        {
            "time": ("time", TIME, {"units": "s"}),
            "true_strain": (("y", "x", "time"), ramp),
            "true_stress": (("y", "x", "time"), 50.0 * ramp, {"units": "MPa"}),
        }
    )
    data.to_zarr(tmp_path / "field.zarr", zarr_format=2, consolidated=False)
    chunk = tmp_path / "field.zarr" / "true_stress" / "0.0.0"
    truncate(chunk)
    arguments = ["identify", tmp_path / "field.zarr", "--out", tmp_path / "maps.zarr", "--processes", "1"]
    refused(capsys, arguments, "field.zarr: true_stress: chunk 0.0.0: found it damaged")
    chunk.unlink()
    refused(capsys, arguments, "field.zarr: true_stress: found no chunk 0.0.0")
