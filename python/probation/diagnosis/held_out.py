"""Records that were only predicted: which of them judges an explanation, and what it says of it.

docs/diagnosis-method.md, section 11.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.probabilities import leading, normalised
from probation.inference.model import CampaignModel
from probation.inference.on_all_records import on_all_records
from probation.inference.unknown import UNKNOWN
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.outliers import without_outliers
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.probabilities import Weighed
    from probation.inference.base_fit import BaseFit
    from probation.inference.gap import Gap
    from probation.records.campaign import Campaign


def all_but_one(campaign: Campaign, gap: Gap) -> tuple[Campaign, str | None]:
    """The campaign with every record fitted but one held-out one, and the id of that one.

    The record that is missed most is fitted, since it shows most of the gap; the next one judges. None is kept where
    only one was held out.
    """
    others = [name for name in gap.held_out if name not in gap.missed]
    ranked = [*gap.missed, *sorted(others, key=lambda name: gap.held_out[name].p_value)]
    judge = ranked[1] if len(ranked) > 1 else None
    records = [replace(record, role="held-out" if record.id == judge else "identify") for record in campaign.records]
    return replace(campaign, records=tuple(records)), judge


@dataclass(frozen=True)
class Worse:
    """A held-out record that an explanation predicts worse than the base law does.

    Attributes
    ----------
    record : str
    before_MPa, after_MPa : float
        Root mean square of the prediction's error.
    """

    record: str
    before_MPa: float  # noqa: N815 - as it leaves the program
    after_MPa: float  # noqa: N815

    @property
    def text(self) -> str:
        """Such as "grip2 is predicted worse with it (1.2 instead of 0.5 MPa)"."""
        return f"{self.record} is predicted worse with it ({self.after_MPa:.3g} instead of {self.before_MPa:.3g} MPa)"


def made_worse(hypothesis: Hypothesis, base: BaseFit, *, seed: int = 0) -> tuple[Worse, ...]:
    """Held-out records whose misfit an explanation raises by more than noise and its parameters' uncertainty can do.

    With the change d of a prediction and the error e that is left, the mean square of the misfit rises by
    (2 d e - d d)/n. Were the explanation right, e would be noise, and the misfit would fall by d d/n, give or take
    2 sqrt(d S d)/n by the covariance S of the noise and 2 sqrt(e J C J' e)/n by that of its parameters, C.

    Parameters
    ----------
    hypothesis : Hypothesis
        What acts in every fitted record at an instant of its own may do so in the others; they do not judge it.
    base : BaseFit
    seed : int
        Of the draws of the noise.
    """
    if not base.held_out or not hypothesis.causes:
        return ()
    rng = np.random.default_rng(seed)
    refit = hypothesis.refit
    everywhere = CampaignModel(base.law, base.views)
    explained = on_all_records(refit, base.views)
    if explained.silent:
        return ()
    before = everywhere.residual(base.before)
    try:
        after, jacobian = explained.model.residual_and_jacobian(explained.parameters)
    except UNSOLVABLE:  # what cannot be predicted cannot judge; `shrink_of` takes note of it
        return ()
    spread, directions = np.linalg.eigh(hypothesis.evidence.covariance)
    slopes = refit.coordinates.slopes(refit.parameters)
    columns = (jacobian @ explained.from_fitted * slopes) @ (directions * np.sqrt(np.maximum(spread, 0.0)))
    columns = np.hstack([columns, jacobian * explained.spread])
    worse = []
    for record, noise in zip(base.held_out, base.predicted_noises, strict=True):
        rows = everywhere.rows(record.name)
        first, last = (without_outliers(error[rows], noise.outliers) for error in (before, after))
        change = last - first
        count = len(change)
        rise = float(np.mean(last**2 - first**2))
        if rise <= 0.0:
            continue
        by_noise = float(np.std(noise.simulate(rng, EVIDENCE.held_out_draws) @ change))
        by_parameters = float(np.linalg.norm(columns[rows].T @ last))
        scatter = 2.0 * float(np.hypot(by_noise, by_parameters)) / count
        if rise + float(np.mean(change**2)) > EVIDENCE.held_out_misfit * scatter:
            sizes = (float(np.sqrt(np.mean(error**2))) for error in (first, last))
            worse.append(Worse(record.name, *sizes))
    return tuple(worse)


class HeldToAccount:
    """Explanations judged by the records that were held out; each is predicted once.

    Parameters
    ----------
    base : BaseFit
    seed : int
    """

    def __init__(self, base: BaseFit, *, seed: int) -> None:
        self._base, self._seed = base, seed
        self._known: dict[int, tuple[Worse, ...]] = {}

    def worse(self, hypothesis: Hypothesis) -> tuple[Worse, ...]:
        """As `made_worse`."""
        key = id(hypothesis)
        if key not in self._known:
            self._known[key] = made_worse(hypothesis, self._base, seed=self._seed)
        return self._known[key]

    def ranked(self, weighed: Sequence[Weighed]) -> list[Weighed]:
        """The explanations, most probable first, those less probable that make a held-out record worse.

        Each of these keeps `EVIDENCE.held_out_penalty` of its probability, and all are normalised. Only explanations of
        the answer set without an unknown are judged. Where all of these make one worse, none loses: an explanation
        outside the answer set is far less probable, and no rival.

        Parameters
        ----------
        weighed : sequence of Weighed
        """
        known = [
            explanation
            for explanation in leading(weighed)
            if explanation.effects and UNKNOWN not in explanation.effects
        ]
        refuted = [id(explanation) for explanation in known if self.worse(explanation.hypothesis)]
        if len(refuted) == len(known):
            return list(weighed)
        return normalised(
            [
                replace(explanation, probability=EVIDENCE.held_out_penalty * explanation.probability)
                if id(explanation) in refuted
                else explanation
                for explanation in weighed
            ]
        )
