"""`probation.compare`: what changed between two campaigns of the same material."""

from __future__ import annotations

from dataclasses import replace
from math import log
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import logsumexp

from probation._arrays import as_threads
from probation.comparison.evidence import Tangent
from probation.comparison.faults import considered
from probation.comparison.headline import headline
from probation.comparison.measured_law import MeasuredLaw
from probation.comparison.noise import change_noise, missed_by_smoother, own_residual, record_noises
from probation.comparison.pairing import pair
from probation.comparison.reference import Reference
from probation.comparison.result import ChangeCurves, ChangedParameter, ChangeExplanation, Comparison
from probation.comparison.search import ChangeSearch, Found
from probation.diagnosis.probabilities import leading
from probation.effects.record_view import views_of
from probation.inference.model import CampaignModel
from probation.inference.thinning import thin
from probation.inference.view_residual import residual_of
from probation.parallel import usual_threads
from probation.settings.comparison import COMPARISON
from probation.smoothing.excitation import excite

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.comparison.result import Verdict
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.campaign import Campaign


SPECIMENS = "by how much specimens differ is not allowed for: of other specimens, the answer may be theirs"


Z95 = 1.959963984540054


def compare(
    campaign: Campaign,
    against: Campaign | Reference,
    scheme: Scheme | SchemeName = "sa3",
    *,
    pairs: Mapping[str, str | Sequence[str]] | None = None,
    effects: Iterable[str] | None = None,
    threads: int | None = None,
) -> Comparison:
    """Ask what changed between two campaigns of the same material: nothing, which fault of the rig, the material.

    The base law need not describe the material: what it leaves unexplained on the reference is carried over to the
    other campaign at the same point of every specimen's way. By how much specimens differ is not allowed for: hold the
    same specimens against themselves (another channel, another export, a repeat that changes nothing in them), or take
    the answer for that of these specimens.

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
    threads : int, optional

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        For records that do not belong together, an unknown effect, or as `probation.fit`.
    """
    workers = as_threads(threads) or usual_threads()
    reference = against if isinstance(against, Reference) else Reference.of(against, scheme)
    against = reference.campaign
    together = pair(campaign, against, pairs)
    campaign, thinned = thin(campaign)
    kept = replace(campaign, records=tuple(replace(r, role="identify") for r in campaign.records if r.id in together))
    search = _prepared(kept, reference, together, effects, workers)
    singles = search.singles()
    explanations = _weighed(search, singles, search.pairs(singles))
    best = explanations[0][1]
    shown = tuple(each for each, _ in explanations)
    verdict: Verdict = "nothing_changed" if not shown[0].effects else "changed"
    if shown[0].effects == ("unknown",):
        verdict = "unknown_change"
    answers = leading(shown)
    curves = _curves(search, best)
    return Comparison(
        campaign=campaign.name,
        reference=against.name,
        verdict=verdict,
        headline=headline(shown[0], len(kept.records), against.name),
        pairs=together,
        explanations=shown,
        answer_set=answers,
        rms_MPa={name: float(np.sqrt(np.mean(each.change**2))) for name, each in curves.items()},
        noise_MPa={name: float(np.sqrt(np.mean(each.noise**2))) for name, each in curves.items()},
        curves=curves,
        warnings=(*thinned, SPECIMENS),
    )


def _prepared(
    campaign: Campaign,
    reference: Reference,
    together: Mapping[str, tuple[str, ...]],
    effects: Iterable[str] | None,
    threads: int,
) -> ChangeSearch:
    """The records minus what their references predict, and the noise of that."""
    predicted = {name: [reference.branches[other] for other in others] for name, others in together.items()}
    law = MeasuredLaw(reference.law, predicted)
    excitations = {record.id: excite(record) for record in campaign.records}
    views = views_of(campaign, excitations=excitations, scheme=reference.scheme)
    own = record_noises([own_residual(view, reference.law) for view in views])
    model = CampaignModel(law, views).quietened(law.start)
    noises = tuple(
        change_noise(
            view,
            noise,
            law,
            [reference.noises[other] for other in together[view.id]],
            missed_by_smoother(record, excitations[view.id]),
        )
        for view, noise, record in zip(model.views, own, campaign.records, strict=True)
    )
    raw = model.residual(law.start)
    residuals = tuple(residual_of(view, raw[part], np.zeros((len(view.data), 0))) for view, part in model.parts)
    return ChangeSearch(model, noises, residuals, considered(model.views, effects), threads)


def _weighed(
    search: ChangeSearch, singles: Sequence[Found], pairs: Sequence[Found]
) -> list[tuple[ChangeExplanation, Found | None]]:
    """Explanations by probability; forms of one cause in the same records are summed."""
    ids = tuple(view.id for view in search.model.views)
    count = len(search.effects)
    scores: list[tuple[tuple[str, ...], tuple[str, ...], float, Found | None]] = [
        ((), (), log(COMPARISON.nothing), None)
    ]
    for each in singles:
        score = log(COMPARISON.one_cause / count) + _place(each, ids) + each.log_evidence
        scores.append((each.effects, each.records, score, each))
    for each in singles[:2]:
        beside = search.with_unknown(each)
        score = log(COMPARISON.unknown_with_one / count) + _place(each, ids) + beside.log_evidence_with_unknown
        scores.append((tuple(sorted((*each.effects, "unknown"))), each.records, score, each))
    for each in pairs:
        share = COMPARISON.two_causes / max(count * (count - 1) / 2, 1)
        records = tuple(name for name in ids if name in each.records)
        scores.append((each.effects, records, log(share) + _place(each, ids) + each.log_evidence, each))
    share = log(COMPARISON.unknown_change / (1 if len(ids) == 1 else 2))
    for name, own in zip(ids, search.unknown, strict=True):
        scores.append((("unknown",), (name,), share - log(len(ids)) + own, None))
    if len(ids) > 1:
        scores.append((("unknown",), ids, share + sum(search.unknown), None))
    total = float(logsumexp([score for _, _, score, _ in scores]))
    merged: dict[tuple[tuple[str, ...], tuple[str, ...]], list[tuple[float, Found | None]]] = {}
    for effects, records, score, found in scores:
        merged.setdefault((effects, records), []).append((score, found))
    result = []
    for (effects, records), forms in merged.items():
        found = max(forms, key=lambda form: form[0])[1]
        probability = float(np.exp(logsumexp([score for score, _ in forms]) - total))
        sizes = _parameters(search, found) if probability > COMPARISON.reported else ()
        result.append((ChangeExplanation(effects, records, probability, sizes), found))
    return sorted(result, key=lambda each: -each[0].probability)


def _place(found: Found, ids: tuple[str, ...]) -> float:
    """Log share of the causes' forms and places among those that they may have."""
    total = 0.0
    for cause in found.causes:
        total -= log(len(cause.effect.forms))
        places = cause.effect.placements(cause.form) if len(ids) > 1 else ("all",)
        total -= log(len(places)) + (log(len(ids)) if cause.records is not None else 0.0)
    return total


def _parameters(search: ChangeSearch, found: Found | None) -> tuple[ChangedParameter, ...]:
    """Sizes with their intervals, that of a logarithm's exponential."""
    if found is None:
        return ()
    result = []
    for refit in found.refits:
        at = 0
        whole = search.interval(refit) if len(refit.parameters) == 1 else None
        x = refit.coordinates.of(refit.parameters)
        deviation = np.sqrt(np.diag(Tangent.of(refit).covariance))
        everywhere = tuple(view.id for view in refit.model.views)
        for cause in refit.model.causes:
            for parameter in cause.form.parameters:
                ends = [x[at] - Z95 * deviation[at], x[at] + Z95 * deviation[at]]
                ends = [float(np.exp(end)) if parameter.log else float(end) for end in ends]
                ends = [max(ends[0], parameter.lower), min(ends[1], parameter.upper)]
                result.append(
                    ChangedParameter(
                        cause.effect.name,
                        parameter.name,
                        parameter.unit,
                        cause.records or everywhere,
                        float(refit.parameters[at]),
                        whole or (ends[0], ends[1]),
                    )
                )
                at += 1
    return tuple(result)


def _curves(search: ChangeSearch, best: Found | None) -> dict[str, ChangeCurves]:
    raw = search.model.residual(search.model.law.start)
    explained: dict[str, FloatArray] = {}
    for refit in best.refits if best is not None else ():
        with_causes = refit.model.predict(refit.parameters)
        without = refit.model.with_causes(()).predict(search.model.law.start)
        explained |= {name: with_causes[name] - without[name] for name in with_causes}
    curves = {}
    for (view, part), noise in zip(search.model.parts, search.noises, strict=True):
        level = noise.arma.deviation * noise.profile
        curves[view.id] = ChangeCurves(view.time, view.true_strain, -raw[part], level, explained.get(view.id))
    return curves
