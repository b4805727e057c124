"""The measured base of a comparison: a law put right on reference records, and the noise of both."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.comparison.measured_law import MeasuredLaw
from probation.comparison.noise import change_noise, missed_by_smoother, own_residual, record_noises
from probation.effects.record_view import views_of
from probation.inference.base_fit import BaseFit, residuals_at
from probation.inference.deviations import deviation_columns
from probation.inference.model import CampaignModel
from probation.inference.problem import Problem
from probation.inference.refit import refit
from probation.inference.scatter import scatter_of, with_scatter
from probation.inference.view_residual import residual_of
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.records.specimens import Specimens
from probation.smoothing.excitation import excitations_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation.comparison.reference import Reference
    from probation.effects.record_view import RecordView
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.records.campaign import Campaign
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

ALIKE = Specimens("none")


@dataclass(frozen=True, eq=False)
class _Pair:
    """A record and what its references are."""

    record: Record
    view: RecordView
    excitation: Excitation
    noises: tuple[NoiseModel, ...]
    specimens: frozenset[str]

    @property
    def spread(self) -> float:
        """Standard deviation of the difference of specimens, over that of one: the references scatter, too."""
        return float(np.sqrt(1.0 + 1.0 / len(self.specimens))) if _differs(self.record, self.specimens) else 0.0


@dataclass(frozen=True, eq=False)
class _Noises:
    """The noise of what records have beyond their references: had without an explanation, which changes none of it."""

    pairs: tuple[_Pair, ...]
    noises: tuple[NoiseModel, ...]

    def __call__(self, residuals: Sequence[RecordResidual]) -> tuple[NoiseModel, ...]:
        """With the scatter of the specimens that the residuals have."""
        return tuple(
            noise
            if residual.specimen is None
            else replace(noise, specimen=pair.spread * residual.specimen, specimen_id=pair.record.specimen_id)
            for pair, noise, residual in zip(self.pairs, self.noises, residuals, strict=True)
        )


def _specimens_of(reference: Reference, names: Sequence[str]) -> frozenset[str]:
    """The specimens of reference records: of each its own, where nothing is said."""
    return frozenset(reference.campaign.record(name).specimen_id or f"of {name}" for name in names)


def _differs(record: Record, specimens: frozenset[str]) -> bool:
    """Whether a record may be of a specimen that is none of these: where nothing is said, it is another."""
    return record.specimen_id is None or record.specimen_id not in specimens


def _specimens(campaign: Campaign, reference: Reference, together: Mapping[str, tuple[str, ...]]) -> Specimens:
    """How far specimens differ: as one of the campaigns states; not at all, where all are the references' own."""
    if not any(_differs(campaign.record(name), _specimens_of(reference, others)) for name, others in together.items()):
        return ALIKE
    both = (campaign.specimens, reference.campaign.specimens)
    return next((specimens for specimens in both if specimens.scatter != "estimate"), Specimens())


def measured_base(campaign: Campaign, reference: Reference, together: Mapping[str, tuple[str, ...]]) -> BaseFit:
    """The base fit of what the references measured: nothing to fit but how wrong the law's answer to the rate is.

    Specimens may differ (docs/diagnosis-method.md, section 10) except where a record and its reference name the same
    one, or a campaign states that they are alike.

    Parameters
    ----------
    campaign : Campaign
        The records that have references, all to be explained.
    reference : Reference
    together : dict of str to tuple of str
        Reference records of each record.
    """
    specimens = _specimens(campaign, reference, together)
    law = MeasuredLaw(
        reference.law,
        {name: [reference.branches[other] for other in others] for name, others in together.items()},
        errs=not specimens.alike,
    )
    excitations = excitations_of(campaign.records)
    views = views_of(campaign, excitations=excitations, scheme=reference.scheme)
    model = CampaignModel(law, views).quietened(law.start)
    pairs = tuple(
        _Pair(
            record,
            view,
            excitations[record.id],
            tuple(reference.noises[other] for other in together[record.id]),
            _specimens_of(reference, together[record.id]),
        )
        for record, view in zip(campaign.records, model.views, strict=True)
    )
    raw, slopes = model.residual_and_jacobian(law.start)
    own = record_noises([own_residual(view, view.data - reference.law.stress(view, law.start)) for view in views])
    made = (
        change_noise(pair.view, noise, law, pair.noises, missed_by_smoother(pair.record, pair.excitation))
        for pair, noise in zip(pairs, own, strict=True)
    )
    noises_of = _Noises(pairs, tuple(made))
    residuals = [residual_of(view, raw[part], slopes[part]) for view, part in model.parts]
    noises = noises_of(residuals)
    alike = Whitened.of(residuals, noises)
    columns = [] if specimens.alike else deviation_columns(model, law.start)
    scatter = scatter_of(specimens, law, residuals, noises, columns)
    if scatter.any:
        residuals = with_scatter(residuals, columns, scatter)
        noises = noises_of(residuals)
    fit = refit(Problem(model, Whitener(noises)), law.start)
    return BaseFit(
        law=law,
        views=model.views,
        refit=fit,
        whitened=Whitened.of(residuals_at(residuals, fit), noises),
        specimens=specimens,
        scatter=scatter,
        alike=alike,
        noises_of=noises_of,
        other_starts=(law.start,) if law.errs else (),
        screens_other_starts=True,
        periodic=False,  # teeth of a spindle are in both campaigns, at other strains
    )
