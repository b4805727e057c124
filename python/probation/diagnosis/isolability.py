"""What the tests of a campaign could discriminate, whatever they show; `probation diagnose --isolability`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from probation.design.isolability import isolability
from probation.effects.registry import effects as known_effects
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.parallel import at_once, without_blas_threads
from probation.progress import Part
from probation.records.as_tested import as_tested
from probation.results.data import Stored
from probation.results.rendering import Result

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from probation.design.isolability_result import Isolability
    from probation.law.schemes import SchemeName
    from probation.records.campaign import Campaign


@dataclass(frozen=True, eq=False)
class CampaignIsolability(Result, Stored):
    """What the tests of a campaign could discriminate.

    `plot` draws how probably each effect would be named rightly against each other.

    Attributes
    ----------
    campaign : str
    scheme : str
    found : Isolability
    data_sha256 : str
    """

    SCHEMA: ClassVar[str] = "probation.isolability/1"

    campaign: str
    scheme: str
    found: Isolability
    data_sha256: str

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects, `probation.isolability/1`."""
        content: dict[str, Any] = {"campaign": self.campaign, "data_sha256": self.data_sha256, "scheme": self.scheme}
        return content | self.found.to_dict()


@without_blas_threads
def campaign_isolability(
    campaign: Campaign,
    scheme: SchemeName = "sa3",
    *,
    hold: Mapping[str, float] | None = None,
    effects: Iterable[str] | None = None,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> CampaignIsolability:
    """Which effects the identify records of a campaign could discriminate.

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
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Raises
    ------
    InputError
        For an unknown effect, or as `probation.fit`.
    """
    advance = progress or (lambda part: None)
    advance(Part(0.0, "fitting the law"))
    campaign = as_tested(campaign)
    base = base_fit(campaign, plain_fit(campaign, scheme, hold))
    advance(Part(0.3, "comparing effects"))
    effect_isolability = isolability(
        base.model,
        base.parameters,
        base.whitened.noises,
        known_effects(effects),
        threads=at_once(threads),
        progress=lambda part: advance(Part(0.3 + 0.7 * part, "comparing effects")),
    )
    return CampaignIsolability(campaign.name, scheme, effect_isolability, campaign.data_hash)
