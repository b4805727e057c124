"""Answers as JSON: plain numbers, no NaN, and where they came from."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from probation._core import __version__
from probation._text import printable_lines

Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"

PARAMETER_KEYS = {
    "unrelaxed_modulus": "unrelaxed_modulus_MPa",
    "tau_max": "tau_max_s",
    "alpha": "alpha",
    "hardening_modulus": "hardening_modulus_MPa",
}
"""Parameters of the law as they are called where they leave the program, with their units."""

_LIST_OF_NUMBERS = re.compile(r"\[[^\[\]{}\"]+\]")  # on one line, however long


def json_answer(schema: str, content: Mapping[str, object]) -> str:
    """An answer as JSON text.

    Parameters
    ----------
    schema : str
        Such as "probation.fit/1"; the first key.
    content : mapping
        Numbers, text, mappings, sequences and arrays; what is not finite becomes null.

    Returns
    -------
    str
        With the version after the schema; ends in a newline. Characters that do not print are escaped.
    """
    answer = {"schema": schema, "version": __version__, **content}
    text = printable_lines(json.dumps(plain(answer), ensure_ascii=False, allow_nan=False, indent=1))
    return _LIST_OF_NUMBERS.sub(lambda numbers: " ".join(numbers[0].split()), text) + "\n"


def plain(value: object) -> Json:
    """`value` in the types that JSON has; NaN and infinities become None.

    Raises
    ------
    TypeError
        For a type that has no such form.
    """
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, np.generic | np.ndarray):
        return plain(value.tolist())
    if isinstance(value, int):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, Sequence):
        return [plain(entry) for entry in value]
    raise TypeError(f"{type(value).__name__} has no form in JSON")
