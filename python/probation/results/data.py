"""Results to JSON and back, field by field, whatever their class.

An answer in JSON has the keys of docs/formats.md, made for people and programs, and under ``result`` the same answer
as the fields of its dataclasses, made for `from_json`. The second part is written and read here, by what the
dataclasses themselves declare: a field that is added to a result needs nothing else to come back.

- A field that is as long as a record says ``field(metadata=CURVE)``: it is written only with ``curves=True``.
- A number that is made of curves is a `from_curves` instead of a property: it is written where the curves are not.
- A field that holds an entry of a table says ``field(metadata=named_in("module.TABLE"))``: its name is written.
- A field that cannot be written, such as a function, says ``field(metadata=LEFT_OUT)`` and has a default.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Set
from dataclasses import MISSING, fields, is_dataclass
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

import numpy as np

from probation.answers import json_answer, plain
from probation.errors import InputError
from probation.results.reading import answer_in

if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import Field

    from numpy.typing import NDArray

CURVE: Mapping[str, Any] = {"curve": True}
"""Metadata of a field that is as long as a record."""

LEFT_OUT: Mapping[str, Any] = {"left_out": True}
"""Metadata of a field that never leaves the program; it has a default."""

KEY = "result"
"""Of an answer: its fields."""

Value = TypeVar("Value")


def named_in(table: str) -> Mapping[str, Any]:
    """Metadata of a field that holds a named entry of a table, such as "calibration.companion_forms.FORMS"."""
    return {"named_in": table}


class from_curves(cached_property[Value]):  # noqa: N801 - used as `property` is
    """A property that needs curves to be computed, and that is kept in JSON where they are not."""


class WithCurves:
    """A dataclass some of whose fields are curves; asked for one that was not written, it says so."""

    if not TYPE_CHECKING:  # or every attribute would seem to exist

        def __getattr__(self, name: str) -> Any:
            if any(name == declared.name and "curve" in declared.metadata for declared in fields(self)):
                raise InputError(
                    f"{type(self).__name__}.{name}: found no curves, as it was read from JSON without them; "
                    "write it with to_json(curves=True), or compute it again"
                )
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)


class Stored:
    """A result that goes to JSON and comes back.

    Attributes
    ----------
    SCHEMA : str
        Such as "probation.fit/1".
    """

    SCHEMA: ClassVar[str]

    def to_dict(self) -> dict[str, Any]:
        """The keys of docs/formats.md as Python objects."""
        raise NotImplementedError

    def to_json(self, *, curves: bool = False) -> str:
        """The answer as JSON text: the keys of docs/formats.md, then `result` for `from_json`.

        Parameters
        ----------
        curves : bool
            Whether to write what is as long as a record, so that what is read back can be plotted.
        """
        return json_answer(self.SCHEMA, {**self.to_dict(), KEY: encoded(self, curves=curves)})

    @classmethod
    def from_json(cls, text: str) -> Self:
        """The result that `to_json` wrote; its `to_json` and `summary` give the same text again.

        Parameters
        ----------
        text : str
            What is written without curves has everything but these; `plot` and `report` need them.

        Raises
        ------
        InputError
            If the text is not what `to_json` writes, or its keys do not belong to its `result`.
        """
        with answer_in(text, cls.SCHEMA) as answer:
            found = decoded(answer[KEY], cls.__module__.partition(".")[0])
            if not isinstance(found, cls):
                raise TypeError(f"a {type(found).__name__} under {KEY!r}")
            for key, value in found.to_dict().items():
                if key in answer and plain(value) != answer[key]:
                    raise ValueError(f"another {key!r} than the one under {KEY!r}")
            return found


def encoded(value: object, *, curves: bool = False) -> Any:
    """A value in the types that JSON has, from which `decoded` makes it again.

    Parameters
    ----------
    value : object
        Numbers, text, sequences, mappings, arrays and dataclasses of the package, within each other.
    curves : bool
        Whether to keep curves.

    Raises
    ------
    TypeError
        For another type; the field that holds it has no metadata for that.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, bool | str | int) or (isinstance(value, float) and math.isfinite(value)):
        return value
    if is_dataclass(value) and not isinstance(value, type):
        return _fields_of(value, curves=curves)
    for types, written in _WRITTEN:
        if isinstance(value, types):
            return written(value, lambda inner: encoded(inner, curves=curves))
    raise TypeError(f"{type(value).__name__} has no form in JSON")


def _written_mapping(value: Mapping[Any, Any], inner: Callable[[Any], Any]) -> dict[str, Any]:
    if "is" not in value and all(isinstance(key, str) for key in value):
        return {key: inner(entry) for key, entry in value.items()}
    return {"is": "mapping", "values": [[inner(key), inner(entry)] for key, entry in value.items()]}


def _written_array(value: NDArray[Any], inner: Callable[[Any], Any]) -> dict[str, Any]:
    values = [inner(number) for number in value.ravel().tolist()]
    return {"is": "array", "type": value.dtype.name, "shape": list(value.shape), "values": values}


def _read_array(content: Mapping[str, Any], inner: Callable[[Any], Any]) -> NDArray[Any]:
    kind = np.dtype(content["type"])
    if kind.kind not in "biuf":
        raise TypeError(f"an array of {kind.name}")
    return np.array([inner(number) for number in content["values"]], dtype=kind).reshape(content["shape"])


_WRITTEN: tuple[tuple[Any, Callable[[Any, Callable[[Any], Any]], Any]], ...] = (
    (float, lambda value, _: {"is": "number", "value": str(value)}),
    (tuple, lambda value, inner: [inner(entry) for entry in value]),
    (list, lambda value, inner: {"is": "list", "values": [inner(entry) for entry in value]}),
    (Set, lambda value, inner: {"is": "set", "values": [inner(entry) for entry in sorted(value)]}),
    (slice, lambda value, inner: {"is": "slice", "values": [inner(value.start), inner(value.stop), inner(value.step)]}),
    (Path, lambda value, _: {"is": "path", "value": str(value)}),
    (np.ndarray, _written_array),
    (Mapping, _written_mapping),
)
"""What `encoded` writes of each type."""

_READ: dict[str, Callable[[Any, Callable[[Any], Any]], Any]] = {
    "number": lambda content, _: float(content["value"]),
    "list": lambda content, inner: [inner(entry) for entry in content["values"]],
    "set": lambda content, inner: frozenset(inner(entry) for entry in content["values"]),
    "slice": lambda content, inner: slice(*(inner(bound) for bound in content["values"])),
    "path": lambda content, _: Path(content["value"]),
    "array": _read_array,
    "mapping": lambda content, inner: {inner(key): inner(entry) for key, entry in content["values"]},
}
"""What `decoded` makes of each of them; any other name is that of a class."""


def _fields_of(value: Any, *, curves: bool) -> dict[str, Any]:
    kind = type(value)
    found: dict[str, Any] = {"is": f"{kind.__module__}.{kind.__qualname__}".removeprefix("probation.")}
    for each in fields(value):
        if "left_out" in each.metadata or not each.init:
            continue
        if "named_in" in each.metadata:
            found[each.name] = getattr(value, each.name).name
        elif curves or "curve" not in each.metadata:
            found[each.name] = encoded(getattr(value, each.name), curves=curves)
    if not curves:
        found |= {name: encoded(getattr(value, name)) for name in _kept(kind)}
    return found


def _kept(kind: type) -> list[str]:
    """Names of a class's numbers that are made of curves."""
    names = {name: attribute for base in reversed(kind.__mro__) for name, attribute in vars(base).items()}
    return [name for name, attribute in names.items() if isinstance(attribute, from_curves)]


def decoded(value: Any, package: str = "probation") -> Any:
    """What `encoded` was given; sequences come back as tuples.

    Parameters
    ----------
    package : str
        Whose dataclasses may be made, beside those of the library.

    Raises
    ------
    KeyError, TypeError, ValueError
        If it was not written by `encoded`.
    """

    def inner(entry: Any) -> Any:
        return decoded(entry, package)

    if isinstance(value, list):
        return tuple(inner(entry) for entry in value)
    if not isinstance(value, dict):
        return value
    kind = value.get("is")
    if kind is None:
        return {key: inner(entry) for key, entry in value.items()}
    if not isinstance(kind, str):
        raise TypeError(f"{kind!r} as a kind of value")
    return _READ[kind](value, inner) if kind in _READ else _from_fields(_class_named(kind, package), value, inner)


def _from_fields(kind: Any, content: Mapping[str, Any], inner: Callable[[Any], Any]) -> Any:
    values: dict[str, Any] = {}
    missing = []
    for each in fields(kind):
        if each.name in content and "named_in" in each.metadata:
            values[each.name] = _entry(each, content[each.name])
        elif each.name in content:
            values[each.name] = inner(content[each.name])
        elif "curve" in each.metadata:
            missing.append(each.name)
        elif each.default is MISSING and each.default_factory is MISSING and each.init:
            raise KeyError(each.name)
    if missing:  # so that its own checks, which are about curves, cannot be made
        made = object.__new__(kind)
        vars(made).update(
            {declared.name: _default(declared) for declared in fields(kind) if declared.name not in missing}, **values
        )
    else:
        made = kind(**values)
    kept = [name for name in _kept(kind) if missing or name in content]
    if kept:
        vars(made).update({name: inner(content[name]) for name in kept})
    return made


def _default(field: Field[Any]) -> Any:
    if field.default_factory is not MISSING:
        return field.default_factory()
    return None if field.default is MISSING else field.default


def _entry(field: Field[Any], name: object) -> Any:
    module, _, table = field.metadata["named_in"].rpartition(".")
    return getattr(import_module(f"probation.{module}"), table)[name]


def _class_named(name: str, package: str) -> type:
    """A frozen dataclass of the library or of that package; nothing else can be made from a text."""
    module, _, known = name.rpartition(".")
    if not all(part.isidentifier() and not part.startswith("_") for part in name.split(".")) or not module:
        raise ValueError(f"{name!r} as a kind of value")
    try:
        place = module if name.startswith(f"{package}.") else f"probation.{module}"
        found = getattr(import_module(place), known)
    except (ImportError, AttributeError):
        raise ValueError(f"{name!r} as a kind of value") from None
    if not (isinstance(found, type) and is_dataclass(found) and found.__dataclass_params__.frozen):  # type: ignore[attr-defined]
        raise ValueError(f"{name!r} as a kind of value")
    return found
