"""Results read from the JSON that they wrote."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from probation._files import parse_json
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping


@contextmanager
def answer_in(text: str, schema: str) -> Iterator[Mapping[str, Any]]:
    """The content of an answer; what is missing in it, or of another type, is an error of the input within the block.

    Parameters
    ----------
    text : str
        What `to_json` wrote.
    schema : str
        Such as "probation.comparison/1".

    Raises
    ------
    InputError
        If the text is no JSON, of another schema, or lacks what the block asks for.
    """
    expected = f"what to_json writes, schema {schema!r}"
    content = parse_json(text, "the text", expected)
    found = content.get("schema") if isinstance(content, dict) else None
    if found != schema:
        raise InputError(f"the text: found the schema {found!r}, expected {expected}")
    try:
        yield content
    except KeyError as missing:
        raise InputError(f"the text: found no {missing.args[0]!r}, expected {expected}") from None
    except (TypeError, AttributeError, ValueError, StopIteration, IndexError, ArithmeticError) as wrong:
        raise InputError(f"the text: found {' '.join(str(wrong).split())}, expected {expected}") from None
