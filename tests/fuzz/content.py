"""The content of a file as JSON can hold it: short where the file is long, readable where the file is text.

A content is one of

- text, encoded as UTF-8;
- ``{"base64": text}``: bytes;
- ``{"repeat": content, "times": n}``: the content n times, so that a long file is a short entry of the corpus;
- ``{"gzip": content}``: compressed;
- ``{"zip": {name: content}}``: an archive, such as an .xlsx workbook;
- a list of contents, one after the other;
- ``{"fifo": true}``: no regular file but a named pipe that nobody writes to;
- ``{"link": path}``: a symbolic link, for example to a device.
"""

from __future__ import annotations

import base64
import gzip
import io
import os
import zipfile
from pathlib import Path
from typing import Any

Content = Any  # JSON


def from_bytes(data: bytes) -> Content:
    """Bytes as a content: text where they are UTF-8."""
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return {"base64": base64.b64encode(data).decode("ascii")}


def to_bytes(content: Content) -> bytes:
    """The bytes of a content that is a regular file."""
    match content:
        case str():
            return content.encode("utf-8", "surrogatepass")
        case list():
            return b"".join(map(to_bytes, content))
        case {"base64": text}:
            return base64.b64decode(text)
        case {"repeat": part, "times": times}:
            return to_bytes(part) * int(times)
        case {"gzip": part}:
            return gzip.compress(to_bytes(part), mtime=0)
        case {"zip": members}:
            return zipped({name: to_bytes(part) for name, part in members.items()})
    raise ValueError(f"no content of a file: {content!r}")


def zipped(members: dict[str, bytes]) -> bytes:
    """A zip archive that is the same at every time of the day."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def write(path: Path, content: Content) -> None:
    """Put a content where it is asked for, in folders that are made if need be."""
    path.parent.mkdir(parents=True, exist_ok=True)
    match content:
        case {"fifo": _}:
            os.mkfifo(path)
        case {"link": target}:
            path.symlink_to(target)
        case _:
            path.write_bytes(to_bytes(content))
