"""Seals: a salted SHA-256 of every truth, published while the truth is kept apart."""

from __future__ import annotations

import hashlib
import json
import secrets
from dataclasses import dataclass
from pathlib import Path

from probation._files import read_json, write_whole
from probation.errors import InputError

SEALS_SCHEMA = "probation.blind.seals/1"
SEALS_FILE = "seals.json"
_SALT_BYTES = 32


@dataclass(frozen=True)
class SealedTruth:
    """A truth's text and the salt that keeps its seal from being guessed.

    Attributes
    ----------
    text : str
        JSON.
    salt : str
        Hexadecimal.
    """

    text: str
    salt: str

    @property
    def seal(self) -> str:
        """SHA-256 of salt and text, in hexadecimal."""
        return hashlib.sha256(bytes.fromhex(self.salt) + self.text.encode()).hexdigest()

    def write(self, path: Path) -> None:
        """Keep it, apart from what is published."""
        write_whole(path, json.dumps({"salt": self.salt, "truth": self.text}, indent=1) + "\n")


def seal_truth(text: str) -> SealedTruth:
    """Seal a truth with a fresh salt."""
    return SealedTruth(text, secrets.token_hex(_SALT_BYTES))


def read_truth(path: Path) -> SealedTruth:
    """Read what `SealedTruth.write` wrote.

    Raises
    ------
    InputError
        If it cannot be read, or is something else.
    """
    content = read_object(path)
    salt, text = content.get("salt"), content.get("truth")
    if not isinstance(salt, str) or not isinstance(text, str):
        raise InputError(f"{path}: found no salt and truth, expected a sealed truth")
    try:
        bytes.fromhex(salt)
    except ValueError:
        raise InputError(f"{path}: found the salt {salt!r}, expected hexadecimal digits") from None
    return SealedTruth(text, salt)


def open_truth(path: Path, seal: str) -> dict[str, object]:
    """The truth, after its seal was checked.

    Raises
    ------
    InputError
        If the seal is broken: the truth is not what was sealed.
    """
    sealed = read_truth(path)
    if sealed.seal != seal:
        raise InputError(
            f"{path}: found a truth whose SHA-256 is {sealed.seal[:12]}…, expected {seal[:12]}… as sealed; "
            "it was changed after it was sealed"
        )
    truth = json.loads(sealed.text)
    assert isinstance(truth, dict)
    return truth


def read_object(path: Path) -> dict[str, object]:
    """A JSON object from a file.

    Raises
    ------
    InputError
        If the file cannot be read or holds something else.
    """
    content = read_json(path, "a JSON object")
    if not isinstance(content, dict):
        raise InputError(f"{path}: found {type(content).__name__}, expected a JSON object")
    return content
