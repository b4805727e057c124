"""A `repr` of a dataclass that fits a line, however long its arrays are."""

from dataclasses import fields
from typing import Any

import numpy as np

_LONGEST = 50  # letters of a value; of what is longer the type is shown
_FEW = 4  # values of an array that are shown


class ShortRepr:
    """Base of a dataclass that holds curves: of an array its shape is shown, of a long value its type."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):  # in the class itself, so that a dataclass makes none of its own
            cls.__repr__ = ShortRepr.__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        shown = (f"{one.name}={_short(getattr(self, one.name))}" for one in fields(self) if one.repr)  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(shown)})"


def _short(value: object) -> str:
    if isinstance(value, np.ndarray) and value.size > _FEW:
        return f"<array of {' × '.join(map(str, value.shape))}>"
    text = repr(value)
    return text if len(text) <= _LONGEST and "\n" not in text else f"<{type(value).__name__}>"
