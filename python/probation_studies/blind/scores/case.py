"""A campaign's truth beside an answer to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias, cast

from probation_studies.blind.scores.answer import UNKNOWN, Answer, Names, Region

Truth: TypeAlias = "Mapping[str, object]"

DETECTABILITIES: tuple[tuple[str, float, float], ...] = (
    ("3", 0.0, 4.0),
    ("5", 4.0, 6.4),
    ("8", 6.4, 11.0),
    ("15", 11.0, 25.0),
    ("40", 25.0, 65.0),
    ("100", 65.0, float("inf")),
)
"""Classes of sqrt(lambda): what was aimed at, and bounds of what was reached."""

OUTSIDE_ENOUGH = 8.0
"""sqrt(lambda) outside the catalogue from which on "unknown" is asked for; less is scored as unresolvable."""

LEVEL = 0.95
"""Of the oracle's answer sets, whatever level its laboratory wrote them at."""


@dataclass(frozen=True)
class Case:
    """A truth and an answer.

    Attributes
    ----------
    name : str
    truth : mapping
        As the laboratory wrote it.
    answer : Answer
    """

    name: str
    truth: Truth
    answer: Answer

    @property
    def stratum(self) -> str:
        """One of none, single, pair, outside, mimic; replicates of a null are nulls."""
        stratum = str(self.truth["stratum"])
        return "none" if stratum == "replicates" else stratum

    @property
    def specimens_differ(self) -> bool:
        """Whether the truth says by how much, in keys that begin with "scatter", its own or its noise's."""
        said = {**self.truth, **cast("Mapping[str, object]", self.truth.get("noise") or {})}
        return any(name.startswith("scatter") and bool(value) for name, value in said.items())

    @property
    def strain_noise(self) -> float:
        """Standard deviation of the recorded strain; 0 where the truth says nothing."""
        return float(cast("Mapping[str, float]", self.truth.get("noise") or {}).get("strain", 0.0))

    @property
    def explanation(self) -> Names:
        """What is true."""
        return tuple(cast("list[str]", self.truth["explanation"]))

    @property
    def admitted(self) -> tuple[Names, ...]:
        """What counts as right in an answer set: the truth; for a mimic also what it cannot be discriminated from."""
        mimicked = str(self.truth.get("mimics") or "")
        return (self.explanation, (mimicked,)) if mimicked else (self.explanation,)

    @property
    def detectability(self) -> float:
        """sqrt(lambda) of all that acts."""
        return float(cast("float", self.truth["detectability"]))

    @property
    def detectability_class(self) -> str:
        """One of `DETECTABILITIES`."""
        return next(name for name, low, high in DETECTABILITIES if low <= self.detectability < high)

    @property
    def causes(self) -> list[Mapping[str, object]]:
        """What acts."""
        return cast("list[Mapping[str, object]]", self.truth["causes"])

    @property
    def left(self) -> float:
        """Detectability that the nearest cause of the catalogue leaves of what acts; 0 of nothing."""
        return min((float(cast("float", cause["left_by_best_other"])) for cause in self.causes), default=0.0)

    @property
    def oracle(self) -> Mapping[str, object]:
        """What could have been found out."""
        return cast("Mapping[str, object]", self.truth["oracle"])

    @property
    def clear(self) -> bool:
        """Whether what lies outside the catalogue, if anything does, shows in addition to the nearest cause of it."""
        return self.stratum not in ("outside", "mimic") or self.left >= OUTSIDE_ENOUGH

    @property
    def resolvable(self) -> bool:
        """Whether the oracle is right in 95 % of repeats; of what lies outside, only what no cause comes near."""
        return bool(self.oracle["resolvable"]) and self.clear

    @property
    def right(self) -> bool:
        """Whether the most probable explanation is the true one."""
        return self.answer.top == self.explanation

    @property
    def covered(self) -> bool:
        """Whether the answer set holds what is admitted."""
        return any(names in self.answer.answer_set for names in self.admitted)

    @property
    def probability(self) -> float:
        """Given to the truth."""
        return self.answer.probability.get(self.explanation, 0.0)

    def squares(self, name: str, role: str) -> float | None:
        """Mean square [MPa^2] over the records of a role of what the truth says of each; None where it does not."""
        known = cast("Mapping[str, float]", self.truth.get(name) or {})
        records = cast("Mapping[str, Mapping[str, object]]", self.truth["records"])
        ours = {record: cast("int", each.get("samples", 1)) for record, each in records.items() if each["role"] == role}
        if not ours or not known.keys() >= ours.keys():
            return None
        return sum(count * known[record] ** 2 for record, count in ours.items()) / sum(ours.values())

    @property
    def durations(self) -> dict[str, float]:
        """Of the records [s]."""
        records = cast("Mapping[str, Mapping[str, object]]", self.truth["records"])
        return {name: float(cast("float", record["duration_s"])) for name, record in records.items()}

    @property
    def windows(self) -> tuple[Region, ...]:
        """Where localised causes show."""
        found = []
        for cause in self.causes:
            for window in cast("list[Mapping[str, object]]", cause["windows"]):
                start, end = cast("list[float]", window["time_s"])
                found.append(Region(str(window["record"]), float(start), float(end)))
        return tuple(found)

    @property
    def localised(self) -> bool:
        """Whether all that acts shows in a part of the record."""
        return bool(self.causes) and all(bool(cause["localised"]) for cause in self.causes)


def oracle_answer(truth: Truth) -> Answer:
    """The oracle's answer to a truth; its set is the shortest that holds `LEVEL` of its probability."""
    oracle = cast("Mapping[str, object]", truth["oracle"])
    known = sorted(cast("Mapping[str, float]", oracle["posterior"]).items(), key=lambda each: -each[1])
    whole = sum(value for _, value in known)
    posterior = {tuple(name.split("+")) if name else (): value / whole for name, value in known}
    answer_set: list[Names] = []
    held = 0.0
    for names, value in posterior.items():
        if held >= LEVEL:
            break
        answer_set.append(names)
        held += value
    return Answer(posterior, {}, tuple(answer_set), gap=answer_set[0] != ())


__all__ = ["DETECTABILITIES", "LEVEL", "UNKNOWN", "Case", "Truth", "oracle_answer"]
