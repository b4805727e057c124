"""Stores of fields and of maps: metadata, attributes, chunks. Maps have checksums: damage never changes an answer."""

from __future__ import annotations

import copy
import json
import math
import tempfile
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fuzz import odd
from fuzz.bytes_damage import damaged
from fuzz.case import Case
from fuzz.content import from_bytes, to_bytes, write

if TYPE_CHECKING:
    from random import Random

    from fuzz.content import Content

NAME, SHARE = "field store", 4

_ROWS, _COLUMNS, _TIMES = 2, 3, 24
IDENTIFY = (
    "field",
    "identify",
    "field.zarr",
    "--out",
    "maps.zarr",
    "--processes",
    "1",
    "--threads",
    "1",
    "--raw-strain",
)
MAP = ("field", "map", "maps.zarr", "--json", "-")


def make(chance: Random) -> Case:
    """A store that went wrong in one or two of its files."""
    maps = chance.random() < 0.5
    files = dict(maps_store() if maps else field_store())
    layers = {chance.choice(("metadata", "chunks")) for _ in range(2)}
    for _ in range(chance.choice((1, 1, 2))):
        for layer in layers:
            _change(files, layer, chance)
    if not maps:
        return Case(NAME, IDENTIFY, files)
    return Case(NAME, MAP, files, answer=maps_answer() if layers == {"chunks"} else {})


@cache
def field_store() -> dict[str, Content]:
    """A small field, by file."""
    import numpy as np  # noqa: PLC0415
    import zarr  # noqa: PLC0415

    from probation import Law  # noqa: PLC0415

    time = np.linspace(0.0, 46.0, _TIMES)
    law = Law(unrelaxed_modulus=2800.0, tau_max=5.0, hardening_modulus=2.0, modes=50)
    noise = 0.05 * np.sin(37.0 * np.arange(_ROWS * _COLUMNS * _TIMES) ** 2).reshape(_ROWS, _COLUMNS, _TIMES)
    strain = np.broadcast_to(0.01 * time, noise.shape).astype("<f4")
    stress = law.stress(time, 0.01 * time, "exact") + noise
    with tempfile.TemporaryDirectory() as folder:
        group = zarr.open_group(f"{folder}/field.zarr", mode="w")
        dimensions = {"time": ("time",), "true_strain": ("y", "x", "time"), "true_stress": ("y", "x", "time")}
        for name, values, unit in (
            ("time", time, "s"),
            ("true_strain", strain, "1"),
            ("true_stress", stress.astype("<f4"), "MPa"),
        ):
            array = group.create_array(
                name,
                shape=values.shape,
                dtype=values.dtype,
                dimension_names=dimensions[name],
                attributes={"units": unit},
            )
            array[...] = values
        return _files(Path(folder))


@cache
def maps_store() -> dict[str, Content]:
    """What `field identify` makes of that field, by file; the folder's own name is left out."""
    from probation.field.identify import identify_field  # noqa: PLC0415

    with tempfile.TemporaryDirectory() as folder:
        _write(Path(folder), field_store())
        identify_field(f"{folder}/field.zarr", f"{folder}/maps.zarr", smoothing=False, processes=1, threads=1)
        files = _files(Path(folder))
        return {
            name: content.replace(folder, "folder") if isinstance(content, str) else content
            for name, content in files.items()
            if name.startswith("maps.zarr")
        }


@cache
def maps_answer() -> dict[str, Any]:
    """What `field map` says of those maps, but for how long they took and where they are."""
    from probation.field.maps import open_maps  # noqa: PLC0415

    with tempfile.TemporaryDirectory() as folder:
        _write(Path(folder), maps_store())
        told = json.loads(open_maps(f"{folder}/maps.zarr").to_json())
    return {
        key: told[key] for key in ("pixels", "beyond_noise", "parameters", "rms_residual_MPa", "noise_MPa", "blocks")
    }


def _write(folder: Path, files: dict[str, Content]) -> None:
    for name, content in files.items():
        write(folder / name, content)


def _files(folder: Path) -> dict[str, Content]:
    return {
        path.relative_to(folder).as_posix(): from_bytes(path.read_bytes())
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def _change(files: dict[str, Content], layer: str, chance: Random) -> None:
    """One file of a store that went wrong: a chunk, or what describes them."""
    names = [name for name in files if name.endswith("zarr.json") == (layer == "metadata")]
    if not names:
        return
    name, other = chance.choice(names), chance.choice(names)
    match chance.choice(("odd",) * 6 + ("lost", "swapped", "empty", "all lost")):
        case "odd" if layer == "metadata":
            try:
                tree = json.loads(to_bytes(files[name]))
            except ValueError:
                return
            files[name] = json.dumps(_odd_value_in(tree, chance), indent=1)
        case "odd":
            files[name] = from_bytes(damaged(to_bytes(files[name]), chance))
        case "lost":
            del files[name]
        case "swapped":
            files[name], files[other] = files[other], files[name]
        case "empty":
            files[name] = chance.choice(("", "{}", "[]", "null", "\x00"))
        case "all lost":
            array = name.split("/c/")[0].removesuffix("/zarr.json")
            for each in [each for each in names if each.startswith(array)]:
                del files[each]


def _odd_value_in(tree: Any, chance: Random) -> Any:
    """The tree with one of its values replaced, or lost."""
    tree = copy.deepcopy(tree)
    holder, key = tree, None
    while isinstance(holder, dict | list) and holder:
        place, key = holder, chance.choice(list(holder) if isinstance(holder, dict) else list(range(len(holder))))
        holder = holder[key]
        if chance.random() < 0.3:
            break
    if key is None:
        return tree
    if chance.random() < 0.2:
        del place[key]
        return tree
    place[key] = copy.deepcopy(chance.choice((*_likely(place[key]), *odd.JSON_VALUES)))
    return tree


def _likely(value: Any) -> tuple[Any, ...]:
    """Values of the same type, a few times over so that they are not rare."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        return ()
    if isinstance(value, str):
        return (
            "float64",
            "int8",
            "<f4",
            "S8",
            "complex64",
            "bytes",
            "zstd",
            "gzip",
            "crc32c",
            "kPa",
            "%",
            "min",
            *odd.UNITS[:8],
        )
    return (
        tuple(
            each for each in (0, 1, 3, 7, -1, 10**6, 10**9, 2**31, 2**63, value + 1, value * 2) if math.isfinite(each)
        )
        * 2
    )
