"""The bytes of a file, once read: what every import profile starts from."""

import gzip
import hashlib
import io
import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from probation._complaint import bad_input
from probation._files import read_whole
from probation.errors import InputError
from probation.limits import INFLATED_BYTES, MEBIBYTE
from probation.records.encoding import decode

_GZIP_MAGIC = b"\x1f\x8b"


@dataclass(frozen=True)
class Source:
    """A file's content, decompressed when it was gzipped.

    Attributes
    ----------
    path : Path
        As the caller named it.
    data : bytes
        The content; after decompression for a ``.gz``.
    sha256 : str
        Hash of the file as it lies on disk, in hexadecimal.
    """

    path: Path
    data: bytes
    sha256: str

    @classmethod
    def open(cls, path: Path) -> "Source":
        """Read a file whole.

        Raises
        ------
        InputError
            If the file is missing, no regular file, unreadable, empty, too large, or a damaged gzip.
        """
        stored = read_whole(path)
        data = _decompressed(path, stored) if stored.startswith(_GZIP_MAGIC) else stored
        if not data.strip():
            raise _empty(path)
        return cls(path=path, data=data, sha256=hashlib.sha256(stored).hexdigest())

    @property
    def text(self) -> str:
        """The content as text, without byte-order mark."""
        return self._decoded[0]

    @property
    def encoding(self) -> str:
        """The encoding that the text was decoded from, as Python names it."""
        return self._decoded[1]

    @property
    def first_line(self) -> str:
        """The first line with anything on it."""
        return self.text.lstrip().split("\n", 1)[0].rstrip()

    @cached_property
    def _decoded(self) -> tuple[str, str]:
        text, encoding = decode(self.path, self.data)
        if not text.strip():
            raise _empty(self.path)
        return text, encoding


def _empty(path: Path) -> InputError:
    return bad_input(path, "an empty file", "a table with headings and at least ten rows")


def _decompressed(path: Path, stored: bytes) -> bytes:
    try:
        data = gzip.GzipFile(fileobj=io.BytesIO(stored)).read(INFLATED_BYTES + 1)
    except (OSError, EOFError, zlib.error):
        raise bad_input(path, "a damaged gzip file", "a complete one", remedy="fetch it again") from None
    if len(data) > INFLATED_BYTES:
        limit = f"{INFLATED_BYTES // MEBIBYTE} MiB"
        raise bad_input(path, f"a gzip file of more than {limit} unpacked", f"at most {limit}", remedy="split it")
    return data
