"""What a kind of export is: how its content is made from a law, checked against it, and spoken of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from probation.exporting.check import Check
    from probation.exporting.request import Request

Content = TypeVar("Content")


@dataclass(frozen=True)
class Kind(Generic[Content]):
    """User-material constants, a linear part, or a table of curves.

    Attributes
    ----------
    make : callable
        The content of a request; raises InputError where the kind cannot represent the law.
    check : callable
        The errors of what was read back from the text.
    say : callable
        What the user must know, for the header.
    """

    make: Callable[[Request], Content]
    check: Callable[[Request, Content], Sequence[Check]]
    say: Callable[[Request, Content], Sequence[str]]


@dataclass(frozen=True)
class Format(Generic[Content]):
    """One format: a file of a code.

    Attributes
    ----------
    name : str
        As ``--format`` has it.
    ending : str
        Of the file's name.
    what : str
        One line for people.
    write : callable
        The text of a content under the lines of a header.
    read : callable
        The content back from the text.
    most_modes : int or None
        That the format holds.
    """

    name: str
    ending: str
    what: str
    kind: Kind[Content]
    write: Callable[[Request, Content, Sequence[str]], str]
    read: Callable[[str], Content]
    most_modes: int | None = None
