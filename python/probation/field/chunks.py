"""Arrays of zarr stores, chunk by chunk: what is written has checksums and lacks no chunk, what is read is looked over.

A chunk that is not there would read as the array's fill value, as a pixel that was not measured does; one whose bytes
have changed may read as other numbers where it has no checksum.
"""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np

from probation.errors import InputError
from probation.field.extra import load

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import zarr
    from numpy.typing import NDArray

Region: TypeAlias = tuple[slice, ...]


def create(
    group: zarr.Group,
    name: str,
    shape: tuple[int, ...],
    dimensions: tuple[str, ...],
    *,
    chunks: tuple[int, ...] | None = None,
    dtype: str = "<f8",
    fill: float = np.nan,
    attributes: Mapping[str, Any] | None = None,
) -> zarr.Array[Any]:
    """A new array, compressed, each chunk with its CRC-32C."""
    codecs = load("zarr.codecs")
    return group.create_array(
        name,
        shape=shape,
        chunks=chunks or shape,
        dtype=dtype,
        fill_value=fill,
        compressors=(codecs.ZstdCodec(), codecs.Crc32cCodec()),
        dimension_names=dimensions,
        attributes=dict(attributes or {}),
    )


def write(path: str, name: str, at: Any, values: Any) -> None:
    """Write a region, also the chunks of it that hold nothing but the fill value.

    Parameters
    ----------
    path : str
        Of the store.
    """
    with load("zarr").config.set({"array.write_empty_chunks": True}):
        array_of(path, name, "r+")[at] = values


def read(path: str, name: str, at: Region | None = None, *, sparse: bool = False) -> NDArray[Any]:
    """A region of an array, or all of it; where `sparse`, chunks that are not there read as its fill value.

    Raises
    ------
    InputError
        If the array or one of its chunks is not there or is damaged, naming store, array and chunk.
    """
    array = array_of(path, name)
    if not sparse:
        require_chunks(path, name, at)
    try:
        return np.asarray(array[_whole(array) if at is None else at])
    except Exception as failure:
        raise damage(path, name, at, failure) from None


def require_chunks(path: str, name: str, at: Region | None = None) -> None:
    """Raise an InputError where a chunk of the region is not there."""
    lacking = first_absent(path, name, at)
    if lacking is not None:
        raise InputError(f"{path}: {name}: found no chunk {lacking}, expected it")


def first_absent(path: str, name: str, at: Region | None = None) -> str | None:
    """The first chunk of a region, or of the array, that is not there."""
    array = array_of(path, name)
    keys = (key for key, _ in _chunks(array, _whole(array) if at is None else at))
    return next((key for key in keys if not (Path(path) / name / key).is_file()), None)


def damage(path: str, name: str, at: Region | None, failure: Exception) -> InputError:
    """The error to raise where a region could not be read: it names the chunk.

    Any codec may have raised anything; chunks are read again, one by one, to find which it was.
    """
    array = array_of(path, name)
    for key, part in _chunks(array, _whole(array) if at is None else at):
        try:
            array[part]
        except Exception as reason:
            return InputError(
                f"{path}: {name}: chunk {key}: found it damaged ({_reason(reason)}), expected it as it was written"
            )
    return InputError(f"{path}: {name}: cannot be read: {_reason(failure)}")


def array_of(path: str, name: str, mode: str = "r") -> zarr.Array[Any]:
    """The array of a store.

    Raises
    ------
    InputError
        If there is none by that name that can be opened.
    """
    try:
        with np.errstate(over="ignore"):  # a fill value beyond the array's precision is infinite there
            found = load("zarr").open_array(path, path=name, mode=mode)
    except Exception as failure:
        raise InputError(
            f"{path}: {name}: found no array that can be opened ({_reason(failure)}), expected one"
        ) from None
    return cast("zarr.Array[Any]", found)


def _whole(array: zarr.Array[Any]) -> Region:
    return tuple(slice(0, size) for size in array.shape)


def _chunks(array: zarr.Array[Any], at: Region) -> Iterator[tuple[str, Region]]:
    """The files of a region, by their key below the array, and what of the array each holds."""
    sizes = array.shards or array.chunks
    counts = [range(part.start // size, -(-part.stop // size)) for part, size in zip(at, sizes, strict=True)]
    for place in product(*counts):
        part = tuple(
            slice(number * size, min((number + 1) * size, all_))
            for number, size, all_ in zip(place, sizes, array.shape, strict=True)
        )
        yield array.metadata.encode_chunk_key(place), part


def _reason(failure: Exception) -> str:
    return " ".join(str(failure).split()).rstrip(".") or type(failure).__name__
