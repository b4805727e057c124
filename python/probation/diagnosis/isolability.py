"""What the tests of a campaign could tell apart, whatever they show; `probation diagnose --isolability`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

from probation.answers import json_answer
from probation.design.isolability import isolability
from probation.diagnosis.base_fit import base_fit
from probation.diagnosis.isolability_table import HOW_TO_READ, in_words, isolability_table
from probation.diagnosis.summary import WIDTH
from probation.effects.registry import effects as known_effects

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from os import PathLike

    from matplotlib.figure import Figure

    from probation.design.isolability import Isolability
    from probation.law.schemes import SchemeName
    from probation.records.campaign import Campaign


@dataclass(frozen=True, eq=False)
class CampaignIsolability:
    """What the tests of a campaign could tell apart.

    Attributes
    ----------
    campaign : str
    scheme : str
    found : Isolability
    data_sha256 : str
    """

    campaign: str
    scheme: str
    found: Isolability
    data_sha256: str

    def summary(self) -> str:
        """The headline, then every effect."""
        table = isolability_table(self.found).wrapped({"effect": 36, "these tests": 40})
        return "\n\n".join(
            [f"{self.campaign}: {in_words(self.found.headline, self.found)}", table.text(), fill(HOW_TO_READ, WIDTH)]
        )

    def plot(self) -> Figure:
        """How probably each effect would be named rightly against each other."""
        from probation.report.isolability_figure import isolability_figure  # noqa: PLC0415 - plotting only when asked for

        return isolability_figure(self.found)

    def to_json(self) -> str:
        """The answer as JSON text, `probation.isolability/1`."""
        content: dict[str, Any] = {"campaign": self.campaign, "data_sha256": self.data_sha256, "scheme": self.scheme}
        return json_answer("probation.isolability/1", content | self.found.to_dict())

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a self-contained HTML page and return its path."""
        from probation.report.isolability_page import write_isolability_page  # noqa: PLC0415

        return write_isolability_page(self, Path(path))


def campaign_isolability(
    campaign: Campaign,
    scheme: SchemeName = "sa3",
    *,
    hold: Mapping[str, float] | None = None,
    effects: Iterable[str] | None = None,
    threads: int | None = None,
) -> CampaignIsolability:
    """Which effects the identify records of a campaign could tell apart.

    Of the records' stresses only the noise and the base parameters are taken.

    Parameters
    ----------
    campaign : Campaign
    scheme : {"be2", "sa2", "sa3"}
    hold : dict of str to float, optional
        Parameters of the base law that are not identified.
    effects : iterable of str, optional
        All that are known if left out.
    threads : int, optional

    Raises
    ------
    InputError
        For an unknown effect, or as `probation.fit`.
    """
    base = base_fit(campaign, scheme, hold)
    found = isolability(base.model, base.parameters, base.whitened.noises, known_effects(effects), threads=threads or 2)
    return CampaignIsolability(campaign.name, scheme, found, campaign.data_hash)
