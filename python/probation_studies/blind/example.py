"""The simplest solver: what an answer must hold at least."""

from __future__ import annotations

from pathlib import Path

import probation


def no_gap(folder: Path) -> dict[str, object]:
    """Say of every campaign that the law leaves nothing out.

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    campaign = probation.Campaign.load(folder)
    everywhere = [record.id for record in campaign.records]
    return {
        "schema": "probation.diagnosis/1",
        "campaign": campaign.name,
        "verdict": "no_gap",
        "headline": "No effect is needed.",
        "causes": [
            {"effects": [], "records": [], "probability": 0.98, "parameters": {}},
            {"effects": ["unknown"], "records": everywhere, "probability": 0.02, "parameters": {}},
        ],
        "answer_set": [[]],
        "where": [],
        "shrink": {"identify": None, "held_out": None},
    }
