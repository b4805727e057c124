"""What a file does not say, as questions: one after the other, until it can be read."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from probation._complaint import joined, quoted
from probation.errors import InputError
from probation.records.assignment import assign_columns
from probation.records.opening import chosen_tables, open_file
from probation.records.options import ReadingKeys, read_options, with_area
from probation.records.roles import RIVALS, STRAIN_ROLES, STRESS_ROLES, VAGUE, normalised, role_of
from probation.records.table import Table
from probation.records.units import measures

_DIAMETER = re.compile(r"d\s*=?\s*(\S+)", re.IGNORECASE)
_RECTANGLE = re.compile(r"([^\sx×*]+)\s*[x×*]\s*([^\sx×*]+)")


@dataclass(frozen=True)
class Question:
    """Something that a file leaves open.

    Attributes
    ----------
    file : str
        Name of the file.
    key : str
        What the answer is for: ``area``, ``gauge_length``, ``test_rate``, ``column:ROLE``, ``control``, ``role``.
    text : str
        The question, with the unit of the answer.
    option : str
        What says the answer in advance: ``--specimen area_mm2=…``.
    default : str
        The answer where none is given; empty where there is none to guess.
    choices : tuple of str
        The answers that there are; empty where any text may be one.
    """

    file: str
    key: str
    text: str
    option: str
    default: str = ""
    choices: tuple[str, ...] = ()

    def unanswered(self) -> InputError:
        """Build the error for a question that nobody may be asked."""
        return InputError(f"{self.file}: found no {self.text}, expected {self.option}; it is not in the file")


def unanswerable(path: Path, how: ReadingKeys) -> list[Question]:
    """All that must be known before the file can be read and has no default.

    Raises
    ------
    InputError
        At what no answer mends.
    """
    missing = []
    while (question := next_question(path, how)) is not None:
        if not question.default:
            missing.append(question)
        how = answered(path, how, question, question.default or _STAND_IN[question.key])
    return missing


def refuse_unanswered(questions: Sequence[Question]) -> None:
    """Refuse questions that nobody may be asked, all of them in one line.

    Raises
    ------
    InputError
        If there are any.
    """
    files: dict[tuple[str, str], list[str]] = {}
    for question in questions:
        files.setdefault((question.text, question.option), []).append(question.file)
    if files:
        said = (
            f"{joined(names, 'and')}: found no {text}, expected {option}" for (text, option), names in files.items()
        )
        ending = "it is not in the file" if len(questions) == 1 else "FILE: before a value says it of that file alone"
        raise InputError(f"{'; '.join(said)}; {ending}")


_UNITS = {"stress": "MPa", "strain": "dimensionless"}
_STAND_IN = {"area": "1", "gauge_length": "1", "test_rate": "1 1/s"}
"""Answers with which the other questions of a file are found."""


def next_question(path: Path, how: ReadingKeys) -> Question | None:
    """The first thing that must be known before the file can be read; None where nothing is missing.

    Raises
    ------
    InputError
        At what no answer mends.
    """
    options = read_options(path, **how)
    _, _, reading = open_file(path, options)
    _, table = chosen_tables(path, reading, options.specimen_index)[0]
    if reading.auxiliary:
        raise InputError(f"{path}: found {reading.auxiliary}, expected a stress-strain record; leave the file out")
    named = set(options.columns)
    implied = set(table.roles)
    known_groups = [rivals for rivals in RIVALS if implied & set(rivals)]
    implied |= {role_of(column.name) or "" for column in table.columns} - {role for g in known_groups for role in g}
    if options.test_rate is None and "time" not in named | implied and not _has_lone_unit(table, "s"):
        return Question(
            path.name,
            "test_rate",
            "time column: at what rate did the test go (0.001 1/s, 2 mm/min)",
            '--test-rate "0.001 1/s" (or --column time=HEADING)',
        )
    for quantity, group in (("strain", STRAIN_ROLES), ("stress", STRESS_ROLES)):
        known = (named | implied) & set(group)
        if known == {"displacement"} and "displacement" not in named and not table.roles:
            known = set()  # a strain, should there be one, is nearer to the specimen
        if not known and not (quantity == "strain" and options.strain_from):
            question = _about_column(path, table, quantity)
            if question is not None:
                return question
    columns = assign_columns(table, options)
    stated = {**reading.specimen, **table.specimen, **options.specimen}
    strained = "displacement" in columns and options.strain_from is None
    if (strained or _is_speed(options.test_rate)) and "gauge_length_mm" not in stated:
        return Question(
            path.name,
            "gauge_length",
            "gauge length [mm], which makes strain of a displacement",
            "--specimen gauge_length_mm=…",
        )
    if "force" in columns and "area_mm2" not in stated:
        return Question(
            path.name,
            "area",
            "section of the specimen [mm²] (40, or 10x4, or d7.1 for a diameter)",
            "--specimen area_mm2=… (or width_mm=… and thickness_mm=…, or diameter_mm=…)",
        )
    return None


def answered(path: Path, how: ReadingKeys, question: Question, answer: str) -> ReadingKeys:
    """What is known after an answer.

    Raises
    ------
    InputError
        If the answer is none.
    """
    if question.choices and answer not in question.choices:
        raise InputError(f"{question.file}: found {quoted(answer)}, expected {' or '.join(question.choices)}")
    specimen: Mapping[str, float] = how.get("specimen") or {}
    match question.key.partition(":"):
        case ("gauge_length", _, _):
            changed: dict[str, Any] = {"specimen": {**specimen, "gauge_length_mm": _number(path, answer)}}
        case ("area", _, _):
            changed = {"specimen": {**specimen, **_section(path, answer)}}
        case ("test_rate", _, _):
            changed = {"test_rate": answer}
        case (_, _, heading):
            role = f"{answer}_{question.text.split()[0]}" if answer in ("true", "engineering") else answer
            changed = {"columns": {**(how.get("columns") or {}), role: heading}}
    known = cast("ReadingKeys", {**how, **changed})
    read_options(path, **known)
    return known


def _about_column(path: Path, table: Table, quantity: str) -> Question | None:
    measured = [column for column in table.columns if not column.unit or measures(column.unit, _UNITS[quantity])]
    vague = [column for column in measured if normalised(column.name) in VAGUE[quantity]]
    vague += [column for column in measured if column.unit and role_of(column.name) is None]
    if not vague:
        return None
    label = vague[0].label
    return Question(
        path.name,
        f"column:{label}",
        f"{quantity} that column {quoted(label)} holds, true or engineering",
        f"--column true_{quantity}={quoted(label)} or --column engineering_{quantity}={quoted(label)}",
        "engineering",
        ("engineering", "true"),
    )


def _has_lone_unit(table: Table, unit: str) -> bool:
    return sum(measures(column.unit or column.label, unit) for column in table.columns) == 1


def _is_speed(rate: str | None) -> bool:
    return rate is not None and "mm" in rate


def _section(path: Path, answer: str) -> dict[str, float]:
    if match := _DIAMETER.fullmatch(answer):
        return {"diameter_mm": _number(path, match[1])}
    if match := _RECTANGLE.fullmatch(answer):
        return {"width_mm": _number(path, match[1]), "thickness_mm": _number(path, match[2])}
    return {"area_mm2": _number(path, answer)}


def _number(path: Path, text: str) -> float:
    try:
        value = float(text.strip().replace(",", "."))
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise InputError(f"{path.name}: found {quoted(text)}, expected a positive number")
    with_area(path, {"area_mm2": value})
    return value
