"""What the baselines start from: the base law's refit, a screen of the catalogue, and whether there is a gap."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

import numpy as np

import probation
from probation.detection.gap_test import GapTester
from probation.detection.sharp_gap import with_sharp
from probation.effects.registry import effects
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.base_fit import BaseFit
from probation.inference.candidate import WhitenedColumns
from probation.inference.screen import screen
from probation.inference.thinning import thin
from probation.records.as_tested import as_tested

Scored: TypeAlias = "tuple[str, float, tuple[str, ...] | None]"

NONE: Scored = ("", 0.0, None)


@dataclass(frozen=True, eq=False)
class Survey:
    """A campaign before any effect is refitted.

    Attributes
    ----------
    campaign : str
    base : BaseFit
    columns : WhitenedColumns
        Of the score screen, with starts that are read off the residual.
    gap : bool
        Whether the gap test says that there is one.
    """

    campaign: str
    base: BaseFit
    columns: WhitenedColumns
    gap: bool


@lru_cache(maxsize=1)
def survey(folder: Path) -> Survey:
    """Survey a campaign; the last one is kept, since all baselines ask for it in turns.

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    campaign, _ = thin(as_tested(probation.Campaign.load(folder)))
    catalogue = effects()
    base = base_fit(campaign, plain_fit(campaign)).screened(catalogue)
    gap = with_sharp(GapTester(base.whitened, base.smooth_columns.by_effect())(), base.whitened).rejected
    residual = base.model.residual(base.parameters)
    columns = screen(base.model, base.parameters, catalogue, residual=residual)
    return Survey(campaign.name, base, WhitenedColumns.of(columns, base.whitener, len(base.whitened)), gap)


def answer(found: Survey, scored: Iterable[Scored]) -> dict[str, object]:
    """What a baseline has to say, as docs/formats.md has it.

    Parameters
    ----------
    found : Survey
    scored : iterable of Scored
        Name of a single effect ("" for none), the logarithm of its weight, and where it was placed (None for all
        records); the best of each name counts. Probabilities are in proportion to the weights.
    """
    log_weight: dict[str, float] = {}
    records: dict[str, tuple[str, ...] | None] = {}
    for name, each, placed in scored:
        if each > log_weight.get(name, -np.inf):
            log_weight[name], records[name] = each, placed
    names = sorted(log_weight, key=lambda name: -log_weight[name])
    weight = np.exp(np.array([log_weight[name] for name in names]) - log_weight[names[0]])
    probability = weight / weight.sum()
    everywhere = tuple(view.id for view in found.base.model.views)
    causes: list[dict[str, object]] = [
        {
            "effects": [name] if name else [],
            "records": list(records.get(name) or everywhere) if name else [],
            "probability": float(each),
            "parameters": {},
        }
        for name, each in zip(names, probability, strict=True)
    ]
    causes.append({"effects": ["unknown"], "records": list(everywhere), "probability": 0.0, "parameters": {}})
    covered = int(np.searchsorted(np.cumsum(probability), 0.95)) + 1
    best = names[0]
    return {
        "schema": "probation.diagnosis/1",
        "campaign": found.campaign,
        "verdict": "explained" if best else "no_gap",
        "headline": f"Best by this baseline: {best or 'none'}.",
        "causes": causes,
        "answer_set": [[name] if name else [] for name in names[:covered]],
        "where": [],
        "shrink": {"identify": None, "held_out": None},
    }
