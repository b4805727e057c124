"""Bytes to text: which encoding a laboratory's export was written in."""

import codecs
import re
from pathlib import Path

from probation._complaint import bad_input
from probation.errors import InputError

_BOMS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
_HIGH_BYTES = re.compile(rb"[\x80-\xff]+")
_CONTROL_BYTES = re.compile(rb"[\x00-\x08\x0e-\x1f\x7f]")
# First bytes of the symbols (A1-A9) and the everyday characters (B0-D7) of GB2312.
_EVERYDAY_LEADS = frozenset(range(0xA1, 0xAA)) | frozenset(range(0xB0, 0xD8))
_KANA = re.compile("[\u3041-\u30ff]")
_REMEDY = "save the file again as UTF-8"


def decode(path: Path, data: bytes) -> tuple[str, str]:
    """Decode a text file, and say from which encoding.

    A byte-order mark decides; otherwise UTF-8 when the bytes are valid, GBK when every run of
    non-ASCII bytes is made of everyday Chinese characters, Shift-JIS (cp932) when it decodes to
    kana, which every Japanese text has, and Windows Latin (cp1252, which is Latin-1 with a few more
    signs) when no line contradicts it.

    Raises
    ------
    InputError
        If the bytes are not text, mix two encodings, or fit no encoding.
    """
    for bom, encoding in _BOMS:
        if data.startswith(bom):
            return _strict(path, data, encoding)
    if (encoding_without_bom := _utf16_without_bom(data)) is not None:
        return _strict(path, data, encoding_without_bom)
    if control := _CONTROL_BYTES.search(data):
        raise bad_input(
            path,
            f"byte 0x{control.group()[0]:02X}",
            "a text table",
            row=_row_of(data, control.start()),
            remedy="this looks like a binary file; export it as CSV or .xlsx",
        )
    try:
        return data.decode("utf-8"), "utf-8"
    except UnicodeDecodeError as failure:
        not_utf8 = failure
    # Two bytes of GBK may pass for one Greek letter in UTF-8; three bytes from 0xE0 on for none.
    east_asian = "gbk" if _looks_chinese(data) else "cp932" if _looks_japanese(data) else None
    if (utf8_row := _row_in_utf8(data, from_byte=0xE0 if east_asian else 0x80)) is not None:
        raise bad_input(
            path,
            f"byte 0x{data[not_utf8.start]:02X}, which is not UTF-8, although row {utf8_row} is",
            "one encoding throughout",
            row=_row_of(data, not_utf8.start),
            remedy=f"the file mixes two encodings: {_REMEDY}",
        )
    return _strict(path, data, east_asian or "cp1252")


def _strict(path: Path, data: bytes, encoding: str) -> tuple[str, str]:
    try:
        return data.decode(encoding), encoding
    except UnicodeDecodeError as failure:
        raise _undecodable(path, failure, encoding) from None


def _undecodable(path: Path, failure: UnicodeDecodeError, encoding: str) -> InputError:
    data = failure.object  # without the byte-order mark, as the offset counts
    byte = data[failure.start] if failure.start < len(data) else 0
    return bad_input(
        path,
        f"byte 0x{byte:02X}, which no text in {encoding} holds",
        "UTF-8, UTF-16, GBK, Shift-JIS or Latin-1 text",
        row=_row_of(data, failure.start),
        remedy=_REMEDY,
    )


def _utf16_without_bom(data: bytes) -> str | None:
    """Tell ASCII written as UTF-16: every second byte is zero."""
    head = data[:200]
    zeros_first, zeros_second = head[0::2].count(0), head[1::2].count(0)
    if zeros_second > 0.4 * len(head) and zeros_first == 0:
        return "utf-16-le"
    if zeros_first > 0.4 * len(head) and zeros_second == 0:
        return "utf-16-be"
    return None


def _looks_chinese(data: bytes) -> bool:
    """Tell GBK from Latin-1, whose accented letters mostly stand alone between ASCII letters."""
    runs = _HIGH_BYTES.findall(data)
    if any(len(run) % 2 for run in runs):
        return False
    pairs = [run[at : at + 2] for run in runs for at in range(0, len(run), 2)]
    everyday = sum(pair[0] in _EVERYDAY_LEADS and pair[1] > 0xA0 for pair in pairs)
    return bool(everyday > 0.8 * len(pairs))


def _looks_japanese(data: bytes) -> bool:
    """Tell Shift-JIS from Latin-1, in which the first bytes of kana, 0x82 and 0x83, are rare signs."""
    try:
        return _KANA.search(data.decode("cp932")) is not None
    except UnicodeDecodeError:
        return False


def _row_in_utf8(data: bytes, from_byte: int) -> int | None:
    """Find the first row of valid UTF-8 that holds a byte this high."""
    for row, line in enumerate(data.splitlines(), start=1):
        if max(line, default=0) < from_byte:
            continue
        try:
            line.decode("utf-8")
        except UnicodeDecodeError:
            continue
        return row
    return None


def _row_of(data: bytes, offset: int) -> int:
    return data.count(b"\n", 0, offset) + 1
