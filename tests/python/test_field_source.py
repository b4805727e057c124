"""What a field may look like, and what is said where it does not."""

import builtins

import numpy as np
import pytest
import xarray as xr

import probation
from probation.field import extra, open_field
from probation.field.fingerprint import fingerprint
from probation.field.grid import block_grid

ROWS, COLUMNS, TIMES = 4, 6, 20
TIME = np.linspace(0.0, 19.0, TIMES)


def strains():
    """Every pixel its own: row, column and instant can be distinguished."""
    y, x, t = np.meshgrid(np.arange(ROWS), np.arange(COLUMNS), TIME, indexing="ij")
    return 1e-3 * t * (1.0 + y + 10.0 * x)


def dataset(**changes):
    variables = {
        "time": ("time", TIME, {"units": "s"}),
        "true_strain": (("y", "x", "time"), strains(), {}),
        "true_stress": (("y", "x", "time"), 100.0 * strains(), {"units": "MPa"}),
    }
    variables.update(changes)
    return xr.Dataset({name: each for name, each in variables.items() if each is not None})


def saved(folder, data):
    data.to_zarr(folder / "field.zarr", consolidated=False)
    return folder / "field.zarr"


def pixel(values, row, column):
    return values.reshape(ROWS, COLUMNS, TIMES)[row, column]


def test_a_block_holds_its_own_pixels(tmp_path):
    strain, stress = open_field(saved(tmp_path, dataset())).read(slice(1, 3), slice(2, 6))
    assert strain.shape == stress.shape == (8, TIMES)
    assert strain[5] == pytest.approx(strains()[2, 3])
    assert stress[5] == pytest.approx(100.0 * strains()[2, 3])


def test_single_precision_stays_single(tmp_path):
    data = dataset()
    data["true_strain"], data["true_stress"] = (data[name].astype("f4") for name in ("true_strain", "true_stress"))
    strain, stress = open_field(saved(tmp_path, data)).read(slice(0, 4), slice(0, 6))
    assert strain.dtype == stress.dtype == np.float32


def test_units_and_the_order_of_dimensions_are_the_laboratory_s_own(tmp_path):
    data = dataset(
        time=("time", TIME / 60.0, {"units": "min"}),
        true_strain=(("time", "y", "x"), 100.0 * strains().transpose(2, 0, 1), {"units": "%"}),
        true_stress=(("y", "x", "time"), 0.1 * strains(), {"units": "GPa"}),
    )
    source = open_field(saved(tmp_path, data))
    strain, stress = source.read(slice(0, 4), slice(0, 6))
    assert source.time == pytest.approx(TIME)
    assert pixel(strain, 3, 4) == pytest.approx(strains()[3, 4])
    assert pixel(stress, 3, 4) == pytest.approx(100.0 * strains()[3, 4])


def test_force_over_the_initial_section_becomes_true_stress(tmp_path):
    """F / A0 times the stretch: 50 N on 10 mm^2 at a stretch of 1.2 are 6 MPa; one force, a section per row."""
    data = dataset(
        true_strain=None,
        true_stress=None,
        stretch=(("y", "x", "time"), np.full((ROWS, COLUMNS, TIMES), 1.2), {}),
        load=("time", np.full(TIMES, 0.05), {"units": "kN"}),
        initial_area=("y", [10.0, 10.0, 10.0, 20.0], {"units": "mm2"}),
    )
    strain, stress = open_field(saved(tmp_path, data), {"force": "load"}).read(slice(0, 4), slice(0, 6))
    assert strain == pytest.approx(np.log(1.2))
    assert pixel(stress, 0, 5) == pytest.approx(6.0)
    assert pixel(stress, 3, 5) == pytest.approx(3.0)


def test_netcdf_is_read_too(tmp_path):
    dataset().to_netcdf(tmp_path / "field.nc", engine="scipy")
    strain, _ = open_field(tmp_path / "field.nc").read(slice(0, 4), slice(0, 6))
    assert pixel(strain, 2, 5) == pytest.approx(strains()[2, 5])


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"true_stress": None}, r"stress: found none \(time, true_strain\).*true_stress, engineering_stress, force"),
        ({"time": ("time", TIME, {})}, "time: found no attribute units"),
        ({"time": ("time", TIME, {"units": "mm"})}, "time: found the unit 'mm', expected a unit like 's'"),
        ({"time": ("time", TIME[::-1], {"units": "s"})}, r"time\[1\]: found 18 after 19 s, expected increasing"),
        ({"true_strain": (("time", "point"), np.zeros((TIMES, 3)), {})}, r"found the dimensions \(time, point\)"),
        ({"true_stress": ("time", TIME, {"units": "MPa"})}, r"true_stress: .* expected \(y, x, time\)"),
        ({"stretch": (("y", "x", "time"), 1.0 + strains(), {})}, "strain: found true_strain and stretch"),
    ],
)
def test_what_does_not_fit_is_named_with_its_file(tmp_path, changes, said):
    path = saved(tmp_path, dataset(**changes))
    with pytest.raises(probation.InputError, match=said) as caught:
        open_field(path)
    assert "field.zarr" in str(caught.value)


def test_a_field_that_is_not_there_or_is_something_else_is_named(tmp_path):
    with pytest.raises(probation.InputError, match=r"none\.zarr: found no such file"):
        open_field(tmp_path / "none.zarr")
    (tmp_path / "text.nc").write_text("time, strain\n")
    with pytest.raises(probation.InputError, match=r"text\.nc: expected a zarr store or a netCDF file"):
        open_field(tmp_path / "text.nc")
    path = saved(tmp_path, dataset())
    with pytest.raises(probation.InputError, match="found no variable 'eyy' for true_strain; there are"):
        open_field(path, {"true_strain": "eyy"})
    with pytest.raises(probation.InputError, match="found the role 'strain', expected one of time, true_strain"):
        open_field(path, {"strain": "true_strain"})


def test_without_xarray_it_is_said_what_to_install(monkeypatch, tmp_path):
    def none(name, *rest):
        raise ImportError(name)

    monkeypatch.setattr(extra.importlib, "import_module", none)
    with pytest.raises(probation.InputError, match=r"found no xarray.*pip install 'probation\[field\]'"):
        open_field(tmp_path)


def test_the_package_itself_needs_neither_xarray_nor_zarr(monkeypatch):
    """`probation --help` on a plain installation."""
    real = builtins.__import__

    def without(name, *rest, **more):
        if name.partition(".")[0] in ("xarray", "zarr", "distributed", "dask"):
            raise ImportError(name)
        return real(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    from probation.cli import build_parser  # noqa: PLC0415

    assert "full fields" in build_parser().format_help()


@pytest.mark.parametrize("name", ["true_strain", "time"])
def test_a_changed_sample_changes_the_fingerprint(tmp_path, name):
    path = saved(tmp_path, dataset())
    before = fingerprint(open_field(path))
    assert fingerprint(open_field(path)) == before
    data = dataset()
    data[name] = data[name].copy(data=data[name].values + 1e-4 * (np.arange(TIMES) == 7))
    data["time"].attrs["units"] = "s"
    data.to_zarr(path, mode="w", consolidated=False)
    assert fingerprint(open_field(path)) != before


def test_blocks_lie_along_the_chunks_and_cover_every_pixel_once():
    """Large chunks are halved, small ones joined, whatever remains at the border."""
    assert block_grid((256, 256), (256, 256), 4096).block == (64, 64)
    assert block_grid((256, 256), (8, 8), 1024).block == (32, 32)
    assert block_grid((5, 7), (100, 100), 4096).block == (5, 7)
    grid = block_grid((37, 50), (16, 16), 256)
    assert grid.block == (16, 16)
    seen = np.zeros(grid.shape, dtype=int)
    for block in grid.blocks():
        seen[grid.slices(block)] += 1
    assert (seen == 1).all()
