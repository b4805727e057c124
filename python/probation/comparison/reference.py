"""A campaign that another one is held against: its law, what that leaves unexplained, its noise."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation._short_repr import ShortRepr
from probation.comparison.measured_law import reference_branches
from probation.comparison.noise import own_residual, record_noises
from probation.effects.record_view import views_of
from probation.identify.fit import fit
from probation.inference.modal_law import DnlrLaw
from probation.inference.thinning import thin
from probation.law.schemes import DIFFERENTIABLE, at_samples
from probation.records.as_tested import as_tested
from probation.settings.comparison import COMPARISON

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.comparison.measured_law import Branch
    from probation.law.schemes import Scheme, SchemeName
    from probation.noise.model import NoiseModel
    from probation.records.campaign import Campaign


@dataclass(frozen=True, eq=False)
class Reference(ShortRepr):
    """What is known of the reference campaign; make one with `of`, to hold several campaigns against it.

    Attributes
    ----------
    campaign : Campaign
    scheme : Scheme
    law : DnlrLaw
        Fitted to all its records, nothing left to identify.
    branches : dict of str to tuple of Branch
        What the law leaves unexplained, by record.
    noises : dict of str to NoiseModel
    """

    campaign: Campaign
    scheme: Scheme
    law: DnlrLaw
    branches: Mapping[str, tuple[Branch, ...]]
    noises: Mapping[str, NoiseModel]

    @classmethod
    def of(cls, campaign: Campaign, scheme: Scheme | SchemeName = "sa3") -> Reference:
        """Fit the law to all records of a campaign and keep what it leaves.

        Parameters
        ----------
        campaign : Campaign
        scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
            With one step from sample to sample.

        Raises
        ------
        InputError
            As `probation.fit`.
        """
        chosen = at_samples(scheme, DIFFERENTIABLE)
        thinned, _ = thin(as_tested(campaign))
        whole = replace(thinned, records=tuple(replace(record, role="identify") for record in thinned.records))
        identified = fit(whole, chosen, weighting="plain", method="variable-projection", gap=False)
        law = DnlrLaw(identified.law, held=identified.law.parameter_names)
        views = views_of(whole, scheme=chosen)
        left = [view.data - law.stress(view, law.start) for view in views]
        residuals = [own_residual(view, own) for view, own in zip(views, left, strict=True)]
        noises = record_noises(residuals)
        branches = {}
        for view, rough, own in zip(views, residuals, left, strict=True):
            sharp = np.abs(rough.residual) > COMPARISON.sharp_reference * np.median(np.abs(rough.residual))
            branches[view.id] = reference_branches(view, own, sharp)
        return cls(campaign, chosen, law, branches, {noise.name: noise for noise in noises})
