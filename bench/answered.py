"""The campaigns of a sealed folder that are answered; their truths are opened."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from probation_studies.blind.scores.answer import NO_ANSWER, read_answer
from probation_studies.blind.scores.case import Case
from probation_studies.blind.seal import read_truth

if TYPE_CHECKING:
    from collections.abc import Iterator

    from probation_studies.blind.layout import Layout


def answered(layout: Layout) -> Iterator[tuple[Case, dict[str, Any] | None]]:
    """Each campaign with its diagnosis; an answer that failed has none, and is wrong in everything."""
    for path in sorted(layout.answers.glob("*-[0-9]*.json")):
        diagnosis = json.loads(path.read_text()).get("diagnosis")
        answer = NO_ANSWER if diagnosis is None else read_answer(diagnosis, str(path))
        yield Case(path.stem, json.loads(read_truth(layout.truths / path.name).text), answer), diagnosis
