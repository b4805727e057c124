"""`probation.compare`: what changed between two campaigns of the same material, a diagnosis against a measured base."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.comparison.base import measured_base
from probation.comparison.faults import considered
from probation.comparison.headline import headline
from probation.comparison.pairing import pair
from probation.comparison.reference import Reference
from probation.comparison.result import ChangeCurves, ChangedParameter, ChangeExplanation, Comparison
from probation.detection.gap_test import GapTester
from probation.diagnosis.attribution import attribution
from probation.diagnosis.budget import Budget
from probation.diagnosis.causes import causes_of
from probation.diagnosis.headline import with_budget
from probation.diagnosis.probabilities import leading
from probation.diagnosis.skipped import Skipping
from probation.effects.visible import visible
from probation.inference.calibration_check import check_calibration
from probation.inference.gap import misfit_over_noise
from probation.inference.thinning import thin
from probation.inference.unknown import UNKNOWN
from probation.normal import TWO_SIDED_95
from probation.parallel import at_once, without_blas_threads
from probation.progress import Part, shows_progress
from probation.records.as_tested import as_tested
from probation.records.signal import require_signal
from probation.settings.comparison import COMPARISON
from probation.wording import percent

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from probation.comparison.result import Verdict
    from probation.detection.gap_test import GapTest
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.probabilities import Weighed
    from probation.inference.base_fit import BaseFit
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.campaign import Campaign


@shows_progress
@without_blas_threads
def compare(
    campaign: Campaign,
    against: Campaign | Reference,
    scheme: Scheme | SchemeName = "sa3",
    *,
    pairs: Mapping[str, str | Sequence[str]] | None = None,
    effects: Iterable[str] | None = None,
    seed: int = 0,
    threads: int | None = None,
    budget: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Comparison:
    """Ask what changed between two campaigns of the same material: nothing, which fault of the rig, the material.

    A diagnosis (`probation.diagnose`) whose base is not a fitted law but what the reference measured: what the law
    leaves unexplained there is carried over to the other campaign at the same point of every specimen's way. Search,
    priors and probabilities are the same. Specimens may differ, except where both campaigns name the same one
    (`specimen_id`) or one of them states that specimens are alike (``scatter = "none"``). A fault of one sign (slack,
    compliance) that the reference's rig has, and this one has not, is found by exchanging the campaigns.

    Parameters
    ----------
    campaign : Campaign
    against : Campaign or Reference
        The reference: the same tests, whose rig is trusted. Its law is taken.
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
        With one step from sample to sample: both campaigns are compared sample by sample.
    pairs : dict of str to str or sequence of str, optional
        Reference records by record id; those of the same id if left out.
    effects : iterable of str, optional
        Names of the changes that are considered.
    seed : int
        Of the bootstraps.
    threads : int, optional
        Refits at once, in copies of this process (`fork`), on Linux; by default one.
    budget : float, optional [s]
        Time after which the best answer so far is given; `skipped` says what was not tried.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        For records that do not belong together, an unknown effect, a budget that is not positive, or as
        `probation.fit`.
    """
    deadline, skipping = Budget(budget), Skipping()
    advance = progress or (lambda part: None)
    advance(Part(0.0, "identifying the reference"))
    workers = at_once(threads)
    reference = against if isinstance(against, Reference) else Reference.of(against, scheme)
    together = pair(campaign, reference.campaign, pairs)
    campaign, of_reference = as_tested(campaign), as_tested(reference.campaign).warnings
    campaign, thinned = thin(campaign)
    kept = replace(campaign, records=tuple(replace(r, role="identify") for r in campaign.records if r.id in together))
    for record in kept.records:
        require_signal(record)
    known = considered(effects)
    advance(Part(0.1, "pairing the records"))
    base = measured_base(kept, reference, together)
    changes = visible(known, base.model.views)
    base = base.screened(changes, workers, skipping.screened)
    advance(Part(0.2, "testing for a change"))
    # Without lines and strain periods: those of both rigs are in both campaigns, each with its own phase.
    tester = GapTester(base.whitened, base.smooth_columns.by_effect(), scatter=base.uncertain_scatter, seed=seed)
    calibration = check_calibration(base)
    test = tester(level=calibration.gap_level(misfit_over_noise(base.whitened)))
    causes = causes_of(
        base,
        changes,
        test.p_value,
        gap=test.rejected,
        threads=workers,
        seed=seed,
        skipping=skipping,
        budget=deadline,
        progress=lambda part: advance(Part(0.3 + 0.55 * part, "trying causes")),
        calibration=calibration,
    )
    advance(Part(0.9, "measuring what causes close"))
    causes, shrink, curves = causes.shrunk((), skipping, seed=seed)
    weighed = causes.with_untried(causes.weighed)
    explanations = tuple(_explanation(each, test, fitted=causes.verdict != "no_gap") for each in weighed)
    parts = None
    if len(causes.weighed[0].effects) > 1 and UNKNOWN not in causes.weighed[0].effects:
        parts = attribution(causes.base, weighed, causes.nearest, causes.found, shrink.identify, workers)
    verdict: Verdict = "nothing_changed" if causes.verdict == "no_gap" else "changed"
    if explanations[0].effects == (UNKNOWN,):
        verdict = "unknown_change"
    return Comparison(
        campaign=campaign.name,
        reference=reference.campaign.name,
        verdict=verdict,
        headline=with_budget(
            headline(
                explanations,
                parts,
                len(kept.records),
                reference.campaign.name,
                specimens=_as_specimens_may(causes.base, shrink.records) if causes.base.scatter.any else "",
                left=causes.verdict == "unexplained",
            ),
            causes.cut_text,
        ),
        pairs=together,
        explanations=explanations,
        answer_set=leading(explanations),
        rms_MPa={name: closure.before_MPa for name, closure in shrink.records.items()},
        noise_MPa={name: closure.noise_MPa for name, closure in shrink.records.items()},
        curves={
            name: ChangeCurves(
                record_curves.time,
                record_curves.true_strain,
                record_curves.data - record_curves.base,
                record_curves.noise,
                None
                if record_curves.explained is None or verdict == "unknown_change"
                else record_curves.explained - record_curves.base,
            )
            for name, record_curves in curves.items()
        },
        skipped=causes.skipped(skipping),
        scatter=causes.base.scatter,
        warnings=(
            *campaign.warnings,
            *(f"{reference.campaign.name}, {note}" for note in of_reference),
            *thinned,
            *calibration.warnings,
        ),
        calibration=calibration,
        leaves_a_gap=causes.verdict == "unexplained",
    )


def _as_specimens_may(base: BaseFit, records: Mapping[str, Closure]) -> str:
    """How far apart the campaigns are before specimens may differ, as a clause; empty where that is no more."""
    raw = base.model.residual(base.parameters)
    apart = {view.id: float(np.sqrt(np.mean(raw[rows] ** 2))) for view, rows in base.model.parts}
    farthest = max(apart, key=lambda name: apart[name] / max(records[name].before_MPa, 1e-300))
    if apart[farthest] <= COMPARISON.taken_for_specimens * records[farthest].before_MPa:
        return ""
    largest = float(np.max(np.abs(base.view(farthest).data)))
    return (
        f"; {farthest} is {apart[farthest]:.3g} MPa rms off, {percent(apart[farthest] / largest)} of its largest "
        f"stress, as specimens may be ({base.scatter.text})"
    )


def _explanation(weighed: Weighed, test: GapTest, *, fitted: bool) -> ChangeExplanation:
    """With sizes where changes were fitted: without a gap they are only weighed, each from a size of zero."""
    sizes = _sizes(weighed.hypothesis) if fitted and weighed.probability > COMPARISON.reported else ()
    records = weighed.hypothesis.records
    if not records and weighed.effects:
        records = _changed(weighed.hypothesis, test)
    return ChangeExplanation(weighed.effects, records, weighed.probability, sizes)


def _changed(base: Hypothesis, test: GapTest) -> tuple[str, ...]:
    """Records that depart from their references by themselves; all, where none does."""
    ids = tuple(view.id for view in base.refit.model.views)
    return tuple(name for name in ids if test.p_values.get(f"record {name}", 1.0) * len(ids) < test.level) or ids


def _sizes(hypothesis: Hypothesis) -> tuple[ChangedParameter, ...]:
    """The causes' parameters with their intervals, that of a logarithm's exponential."""
    refit = hypothesis.refit
    x = refit.coordinates.of(refit.parameters)
    own = np.where(refit.coordinates.log, 0.0, COMPARISON.size_error * x)
    deviation = np.sqrt(np.maximum(np.diag(hypothesis.evidence.covariance), 0.0) + own**2)
    everywhere = tuple(view.id for view in refit.model.views)
    first = refit.model.base_count
    named = [(cause, parameter) for cause in hypothesis.causes for parameter in cause.form.parameters]
    return tuple(
        ChangedParameter(
            cause.effect.name,
            parameter.name,
            parameter.unit,
            cause.records or everywhere,
            value,
            (
                max(parameter.from_search(at - TWO_SIDED_95 * spread), parameter.lower),
                min(parameter.from_search(at + TWO_SIDED_95 * spread), parameter.upper),
            ),
        )
        for (cause, parameter), value, at, spread in zip(
            named, refit.parameters[first:].tolist(), x[first:], deviation[first:], strict=True
        )
    )
