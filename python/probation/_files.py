"""Files read within limits, and written whole or not at all."""

from __future__ import annotations

import errno
import json
import os
import re
import stat
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from probation.errors import InputError
from probation.limits import FILE_BYTES, MEBIBYTE, NESTING, NUMBER_DIGITS

if TYPE_CHECKING:
    from collections.abc import Iterator

_BAD_PLACE = (errno.ENOENT, errno.ENOTDIR, errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP, errno.EINVAL)
"""What the caller can mend by another name; a full disk or a lacking permission is no fault of the name."""
_SHOWN = 40  # characters of a name that its temporary file keeps: with all of them the name may become too long
_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
_WITHOUT_WAITING = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_JSON_TOKEN = re.compile(r'"(?:[^"\\]+|\\.)*+"?|[\[{]|[\]}]', re.DOTALL)  # an open string reaches to the end


def read_whole(path: str | os.PathLike[str], limit: int = FILE_BYTES) -> bytes:
    """Read a regular file; the only way in which the program reads what a user names.

    Parameters
    ----------
    limit : int [byte]
        Largest size.

    Raises
    ------
    InputError
        If it is missing, no regular file (a folder, pipe, socket or device; opening never waits), too large, or
        cannot be read.
    """
    try:
        handle = os.open(path, os.O_RDONLY | _WITHOUT_WAITING)
    except FileNotFoundError:
        raise InputError(f"{path}: found no such file; check the name and the folder") from None
    except (OSError, ValueError) as failure:  # ValueError: a zero byte in the name
        what = kind_of(path)
        if what not in (None, "a file"):
            raise _no_file(path, what) from None
        raise _unreadable(path, failure) from None
    status = os.fstat(handle)
    if not stat.S_ISREG(status.st_mode):
        os.close(handle)
        raise _no_file(path, _kind(status.st_mode))
    with os.fdopen(handle, "rb") as stream:
        try:
            data = stream.read(limit + 1)
        except OSError as failure:
            raise _unreadable(path, failure) from None
    if len(data) > limit:
        size = max(status.st_size, len(data))
        raise InputError(
            f"{path}: found a file of {_mebibytes(size)}, expected at most {_mebibytes(limit)}; "
            "split it, or leave out what is not needed"
        )
    return data


def read_json(path: str | os.PathLike[str], expected: str) -> Any:
    """Read a JSON file.

    Parameters
    ----------
    expected : str
        What it should hold, for the error: "what fit --json writes".

    Raises
    ------
    InputError
        If it cannot be read, is no JSON, or is nested or has numbers beyond the limits.
    """
    return parse_json(read_whole(path), path, expected)


def parse_json(data: bytes | str, source: str | os.PathLike[str], expected: str) -> Any:
    """What JSON holds.

    Parameters
    ----------
    data : bytes or str
    source : str or path-like
        Where it is from, for the error.
    expected : str
        As in `read_json`.

    Raises
    ------
    InputError
        If it is no JSON, or is nested or has numbers beyond the limits.
    """
    try:
        text = data.decode("utf-8-sig") if isinstance(data, bytes) else data
        _check_nesting(text)
        return json.loads(text, parse_int=_whole_number)
    except ValueError as failure:
        raise InputError(f"{source}: found no JSON ({failure}), expected {expected}") from None


def kind_of(path: str | os.PathLike[str]) -> str | None:
    """What a path names, links followed: "a file", "a folder", "a pipe", "a socket" or "a device".

    None for nothing, also where the name is too long or impossible.
    """
    try:
        return _kind(Path(path).stat().st_mode)
    except (OSError, ValueError):
        return None


def write_whole(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write a temporary file beside `path` and rename it, so that nobody ever reads half a file.

    A path that is no regular file (a pipe, ``/dev/stdout``) is written to directly.

    Raises
    ------
    InputError
        If no file can have that name: its folder does not exist, or it is a folder itself.
    OSError
        If the system refuses: a full disk, no permission. `filename` is the path; what stood there is unchanged.
    """
    check_file_place(path)
    data = content.encode() if isinstance(content, str) else content
    target = Path(path)
    with written_to(target):
        if target.exists() and not target.is_file():
            target.write_bytes(data)
        else:
            _replace(_real(target), data)


def make_folder(path: str | os.PathLike[str]) -> Path:
    """Make a folder and those above it, if they do not exist.

    Raises
    ------
    InputError, OSError
        As `write_whole` does.
    """
    check_folder_place(path)
    with written_to(path):
        Path(path).mkdir(parents=True, exist_ok=True)
    return Path(path)


def check_file_place(path: str | os.PathLike[str]) -> None:
    """Refuse a path to which no file can be written, before anything is computed for it.

    Raises
    ------
    InputError, OSError
        As `write_whole` does.
    """
    target = Path(path)
    with written_to(target):
        if target.is_dir():
            raise InputError(f"{target}: cannot be written: found a folder, expected a file")
        folder = _real(target).parent
        if not folder.exists():
            raise InputError(f"{target}: cannot be written: found no folder {folder}; make it first")
        _check_folder(folder, folder if not target.exists() or target.is_file() else target)
        if target.is_file() and not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


def check_folder_place(path: str | os.PathLike[str]) -> None:
    """Refuse a path that is no folder and cannot become one, and an empty one.

    Raises
    ------
    InputError, OSError
        As `write_whole` does.
    """
    if not os.fspath(path):
        raise InputError("found an empty name, expected a folder")
    target = Path(path)
    with written_to(target):
        there = next(folder for folder in (_real(target), *_real(target).parents) if folder.exists())
        _check_folder(there, there)


def _check_folder(folder: Path, written: Path) -> None:
    if not folder.is_dir():
        raise InputError(f"{folder}: found a file, expected a folder or a new name")
    if not os.access(written, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


@contextmanager
def written_to(target: str | os.PathLike[str]) -> Iterator[None]:
    """Let what the system refuses within the block name the path that was asked for, not one inside or beside it.

    Raises
    ------
    InputError, OSError
        As `write_whole` does.
    """
    try:
        yield
    except InputError:
        raise
    except OSError as failure:
        raise refusal(target, failure) from None
    except ValueError as failure:  # a zero byte in the name
        raise InputError(f"{target}: cannot be written: {failure}") from None


def refusal(target: str | os.PathLike[str], failure: OSError) -> InputError | OSError:
    """What the system says of something inside or beside `target`, said of `target`."""
    said = f"cannot be written: {failure.strerror or failure}"
    if failure.errno in _BAD_PLACE:
        return InputError(f"{target}: {said}")
    return OSError(failure.errno or errno.EIO, said, str(target))


def _replace(target: Path, data: bytes) -> None:
    mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:_SHOWN]}-")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        Path(temporary).chmod(mode)
        Path(temporary).replace(target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _real(path: Path) -> Path:
    """Without links; `Path.resolve` fails, by Python's version, where they lead to each other."""
    return Path(os.path.realpath(path))


def _umask() -> int:
    current = os.umask(0)
    os.umask(current)
    return current


def _kind(mode: int) -> str:
    return "a file" if stat.S_ISREG(mode) else _KINDS.get(stat.S_IFMT(mode), "a device")


def _no_file(path: str | os.PathLike[str], found: str | None) -> InputError:
    remedy = "name a file in it" if found == "a folder" else "copy its content into one"
    return InputError(f"{path}: found {found}, expected a regular file; {remedy}")


def _unreadable(path: str | os.PathLike[str], failure: Exception) -> InputError:
    return InputError(f"{path}: cannot be read: {getattr(failure, 'strerror', None) or failure}")


def _mebibytes(size: int) -> str:
    return f"{size / MEBIBYTE:.4g} MiB"


def _check_nesting(text: str) -> None:
    """Refuse JSON nested beyond the limit before a parser goes down into it."""
    depth = 0
    for token in _JSON_TOKEN.finditer(text):
        if token[0] in ("[", "{"):
            depth += 1
            if depth > NESTING:
                row = text.count("\n", 0, token.start()) + 1
                raise ValueError(f"row {row}: lists and objects nested deeper than {NESTING}")
        elif token[0] in ("]", "}"):
            depth -= 1


def _whole_number(digits: str) -> int:
    if len(digits) > NUMBER_DIGITS:
        raise ValueError(f"a whole number of {len(digits)} digits, more than {NUMBER_DIGITS}")
    return int(digits)
