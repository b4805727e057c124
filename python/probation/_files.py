"""Files written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from probation.errors import InputError


def write_whole(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write a temporary file beside `path` and rename it, so that nobody ever reads half a file.

    A path that is no regular file (a pipe, ``/dev/stdout``) is written to directly.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    data = content.encode() if isinstance(content, str) else content
    target = Path(path)
    try:
        if target.exists() and not target.is_file():
            target.write_bytes(data)
            return
        _replace(target.resolve(), data)
    except OSError as failure:
        raise InputError(f"{target}: cannot be written: {failure.strerror or failure}") from None


def _replace(target: Path, data: bytes) -> None:
    if not target.parent.is_dir():
        raise InputError(f"{target}: cannot be written: found no folder {target.parent}; make it first")
    mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}-")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        Path(temporary).chmod(mode)
        Path(temporary).replace(target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _umask() -> int:
    current = os.umask(0)
    os.umask(current)
    return current
