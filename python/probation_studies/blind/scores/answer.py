"""What the scorer reads in an answer of ``probation diagnose --json``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, cast

from probation.errors import InputError

Names: TypeAlias = "tuple[str, ...]"
"""An explanation: sorted names; () for none, ("unknown",) for outside the catalogue."""

UNKNOWN = "unknown"
_SUM_TOLERANCE = 0.02


@dataclass(frozen=True)
class Region:
    """A region of a gap."""

    record: str
    start: float
    end: float


@dataclass(frozen=True)
class Shrink:
    """A closure and its interval, and the residual's root mean square before and after [MPa]; None where not said."""

    closure: float | None = None
    interval: tuple[float, float] | None = None
    before: float | None = None
    after: float | None = None


@dataclass(frozen=True)
class Answer:
    """An answer.

    Attributes
    ----------
    probability : dict
        Of every explanation; entries of one explanation in several placements are added up.
    records : dict
        Of the most probable entry of every explanation.
    answer_set : tuple of Names
        Best first.
    gap : bool
        Whether a gap was declared.
    where : tuple of Region
    base : dict
        Value and standard error of the base law's parameters.
    identify, held_out : Shrink
    parameters : mapping
        Value and standard error of the most probable entry's parameters, where known.
    scatter : str or None
        Where it has it from how far specimens differ: "replicates", "assumed" or "stated"; None where they are alike.
    """

    probability: dict[Names, float]
    records: dict[Names, frozenset[str]]
    answer_set: tuple[Names, ...]
    gap: bool
    where: tuple[Region, ...] = ()
    base: dict[str, tuple[float, float]] | None = None
    identify: Shrink = Shrink()
    held_out: Shrink = Shrink()
    parameters: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scatter: str | None = None

    @property
    def top(self) -> Names:
        """The most probable explanation."""
        return max(self.probability, key=lambda names: self.probability[names])

    @property
    def unknown(self) -> float:
        """Probability that something outside the catalogue acts."""
        return sum(value for names, value in self.probability.items() if UNKNOWN in names)


NO_ANSWER = Answer({("no_answer",): 1.0}, {}, (), gap=False)
"""Of a solver that failed: wrong in everything."""


def read_answer(diagnosis: Mapping[str, object], source: str) -> Answer:
    """Read an answer.

    Parameters
    ----------
    diagnosis : mapping
        As docs/formats.md has it.
    source : str
        Its file, for complaints.

    Raises
    ------
    InputError
        If something that docs/formats.md demands is missing or is something else.
    """
    try:
        return _read(diagnosis)
    except (KeyError, TypeError, ValueError) as failure:
        raise InputError(f"{source}: found no answer in the form of `probation.diagnosis/1`: {failure!r}") from None


def _read(diagnosis: Mapping[str, object]) -> Answer:
    probability: dict[Names, float] = {}
    best: dict[Names, tuple[float, frozenset[str], Mapping[str, Mapping[str, object]]]] = {}
    for each in _mappings(diagnosis["causes"]):
        names = _names(each["effects"])
        value = _number(each["probability"])
        if not -1e-9 <= value <= 1.0 + 1e-9:
            raise ValueError(f"probability {value}")
        probability[names] = probability.get(names, 0.0) + value
        if names not in best or value > best[names][0]:
            records = frozenset(str(record) for record in cast("list[object]", each.get("records") or []))
            best[names] = value, records, cast("Mapping[str, Mapping[str, object]]", each.get("parameters") or {})
    if not probability or abs(sum(probability.values()) - 1.0) > _SUM_TOLERANCE:
        raise ValueError(f"probabilities that sum to {sum(probability.values())}")
    verdict = diagnosis["verdict"]
    if verdict not in ("no_gap", "not_predicted", "explained", "unexplained"):
        raise ValueError(f"verdict {verdict!r}")
    base = cast("Mapping[str, Mapping[str, object]]", diagnosis.get("base") or {})
    shrink = cast("Mapping[str, object]", diagnosis.get("shrink") or {})
    scatter = cast("Mapping[str, Mapping[str, object]]", diagnosis.get("scatter") or {})
    return Answer(
        probability=probability,
        records={names: records for names, (_, records, _) in best.items()},
        answer_set=tuple(_names(each) for each in cast("list[object]", diagnosis["answer_set"])),
        gap=verdict != "no_gap",
        where=tuple(_region(each) for each in _mappings(diagnosis.get("where") or [])),
        base=_with_errors(cast("Mapping[str, Mapping[str, object]]", base.get("parameters") or {})),
        identify=_shrink(shrink.get("identify")),
        held_out=_shrink(shrink.get("held_out")),
        parameters=_with_errors(best[max(probability, key=lambda names: probability[names])][2]),
        scatter=next((str(each["source"]) for each in scatter.values()), None),
    )


def _mappings(value: object) -> list[Mapping[str, object]]:
    if not isinstance(value, list) or not all(isinstance(each, Mapping) for each in value):
        raise TypeError(f"{value!r} in place of a list of objects")
    return value


def _names(value: object) -> Names:
    if not isinstance(value, list):
        raise TypeError(f"{value!r} in place of a list of names")
    return tuple(sorted(str(name) for name in value))


def _number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise TypeError(f"{value!r} in place of a number")
    return float(value)


def _region(each: Mapping[str, object]) -> Region:
    start, end = cast("list[object]", each["time_s"])
    return Region(str(each["record"]), _number(start), _number(end))


def _with_errors(parameters: Mapping[str, Mapping[str, object]]) -> dict[str, tuple[float, float]]:
    known = {name: parameter for name, parameter in parameters.items() if parameter.get("se") is not None}
    return {name: (_number(each["value"]), _number(each["se"])) for name, each in known.items()}


def _shrink(value: object) -> Shrink:
    if not isinstance(value, Mapping) or value.get("closure") is None:
        return Shrink()
    interval = value.get("interval")
    bounds = None if interval is None else tuple(_number(each) for each in cast("list[object]", interval))
    before, after = (None if value.get(name) is None else _number(value[name]) for name in ("before_MPa", "after_MPa"))
    return Shrink(_number(value["closure"]), cast("tuple[float, float] | None", bounds), before, after)
