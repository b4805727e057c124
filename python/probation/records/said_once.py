"""Warnings of several records, each said once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.records.record import Record


def of_all(records: Sequence[Record]) -> tuple[str, ...]:
    """Warnings that every one of several records has; none of a single record."""
    if len(records) < 2:
        return ()
    return tuple(text for text in records[0].warnings if all(text in record.warnings for record in records))


def said_once(records: Sequence[Record]) -> tuple[str, ...]:
    """Each warning once, with the ids of its records in front: "all records", where there are several."""
    common = of_all(records)
    ids: dict[str, list[str]] = {}
    for record in records:
        for text in record.warnings:
            ids.setdefault(text, []).append(record.id)
    return tuple(f"{'all records' if text in common else ', '.join(names)}: {text}" for text, names in ids.items())
