"""Whether a field is still the one that a run began with."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation.field.source import FieldSource

PIECE, PIECES = 4096, 64
"""Bytes of a piece, and pieces of a large file."""

COVERS = (
    f"times, units, and the names, sizes and bytes of the field's files: whole up to {PIECE * PIECES // 1024} KiB, "
    f"of larger ones {PIECES} evenly spaced pieces of {PIECE // 1024} KiB, the first and the last among them"
)
"""What `fingerprint` covers."""


def fingerprint(source: FieldSource) -> str:
    """SHA-256, in hexadecimal, of what `COVERS` says.

    A terabyte takes as long as its files take to open. Chunks are compressed as a rule, and a change of their content
    changes their length or most of what follows; a change of a few bytes within a large file that is not compressed
    may go unseen.
    """
    digest = hashlib.sha256()
    for role in sorted(source.names):
        digest.update(f"{role}={source.names[role]}*{source.factors[role]!r}\n".encode())
    digest.update(source.time.astype("<f8").tobytes())
    root = Path(source.path)
    for path in _files(root, source.names.values()):
        size = path.stat().st_size
        digest.update(f"{path.relative_to(root).as_posix()} {size}\n".encode())
        with path.open("rb") as stream:
            for start in _starts(size):
                stream.seek(start)
                digest.update(stream.read(PIECE))
    return digest.hexdigest()


def _files(root: Path, names: Iterable[str]) -> list[Path]:
    """The file itself, or those of a store's variables and its own metadata."""
    if root.is_file():
        return [root]
    own = (path for path in root.iterdir() if path.is_file())
    of_variables = (path for name in set(names) for path in (root / name).rglob("*") if path.is_file())
    return sorted({*own, *of_variables})


def _starts(size: int) -> list[int]:
    """Where pieces begin."""
    if size <= PIECE * PIECES:
        return list(range(0, size, PIECE))
    return [at * (size - PIECE) // (PIECES - 1) for at in range(PIECES)]
