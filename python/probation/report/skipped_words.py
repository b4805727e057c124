"""What a diagnosis or a comparison left out, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.comparison.faults import MATERIAL
from probation.diagnosis.headline import title
from probation.wording import listed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.diagnosis.skipped import Skipped

MOST = 4
"""Entries on a terminal."""


def skipped_lines(skipped: Sequence[Skipped], most: int | None = None) -> list[str]:
    """One phrase for everything that was left out; at most so many."""
    lines = [_text(entry) for entry in skipped]
    if most is None or len(lines) <= most:
        return lines
    return [*lines[:most], f"… and {len(lines) - most} more (--json and --report list them)"]


def _text(skipped: Skipped) -> str:
    if not skipped.effects:
        return skipped.why
    more = f" ({skipped.count} forms and places)" if skipped.count > 1 else ""
    names = (MATERIAL.title if name == MATERIAL.name else title(name) for name in skipped.effects)
    return f"{listed(list(names), 'and')}{more}: {skipped.why}"
