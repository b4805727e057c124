"""`probation.diagnose`: where a simulation departs from reality, which effect causes it, how far the gap shrinks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.design.isolability import isolability
from probation.design.next_test import helps
from probation.detection.place_left_out import place_left_out
from probation.detection.where import locate
from probation.diagnosis.attribution import attribution
from probation.diagnosis.budget import Budget
from probation.diagnosis.causes import causes_of
from probation.diagnosis.explain import base_parameters, explanations_of, regions_of
from probation.diagnosis.headline import headline, with_budget, with_remainder
from probation.diagnosis.held_out import all_but_one, made_worse
from probation.diagnosis.next import is_stretched, next_test_of, one_after_the_other
from probation.diagnosis.other_measure import other_measure
from probation.diagnosis.probabilities import answer_set, with_unseen
from probation.diagnosis.remainder import is_left, remainder_of
from probation.diagnosis.remainder_tests import remainder_tests
from probation.diagnosis.result import Diagnosis
from probation.diagnosis.signatures import signatures
from probation.diagnosis.skipped import Skipping
from probation.effects.registry import effects as catalogue
from probation.effects.visible import visible
from probation.errors import InputError
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.base_fit import BaseFit, fit_law
from probation.inference.calibration_check import check_calibration
from probation.inference.gap import as_tolerance, find_gap
from probation.inference.prediction import predictions
from probation.inference.thinning import thin
from probation.inference.unknown import UNKNOWN
from probation.law.schemes import identifying
from probation.noise.whitening import Whitened
from probation.parallel import at_once, both, without_blas_threads
from probation.progress import Part, shows_progress
from probation.records.as_tested import as_tested
from probation.records.signal import require_signal
from probation.records.unlike_others import unlike_others
from probation.settings.detection import DETECTION
from probation.settings.evidence import EVIDENCE
from probation.settings.noise import NOISE
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from probation.design.isolability_result import Isolability
    from probation.detection.where import Where
    from probation.diagnosis.causes import Causes
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.remainder import Remainder
    from probation.diagnosis.result import NextTest
    from probation.effects.effect import Effect
    from probation.inference.gap import Gap
    from probation.inference.protocol import GapLaw
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.campaign import Campaign


@shows_progress
@without_blas_threads
def diagnose(
    campaign: Campaign,
    scheme: Scheme | SchemeName = "sa3",
    *,
    effects: Iterable[str] | None = None,
    hold: Mapping[str, float] | None = None,
    law: GapLaw | None = None,
    seed: int = 0,
    threads: int | None = None,
    design: bool = True,
    budget: float | None = None,
    tolerance: float = DETECTION.tolerance,
    progress: Callable[[float], None] | None = None,
) -> Diagnosis:
    """Diagnose the gap between the campaign's base law and its records.

    Parameters
    ----------
    campaign : Campaign
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
        Its own error must not pass for an effect: the less accurate, the more steps it takes from sample to sample, and
        no fewer than ``SA3(substeps=4)`` says.
    effects : iterable of str, optional
        Names of those to be considered; all of the catalogue if left out.
    hold : dict of str to float, optional
        Parameters that are not identified, by name with unit; on top of the campaign's own.
    law : GapLaw, optional
        Another law than the campaign's, such as a `probation.CallableLaw`; effects that it does not understand
        are left out.
    seed : int
        Of the bootstraps.
    threads : int, optional
        Refits at once, in copies of this process (`fork`), on Linux; by default one. A law that runs threads of its own
        must not be copied.
    design : bool
        Whether to say, too, what these tests could discriminate at all, and which test to do next.
    budget : float, optional [s]
        Time after which the best answer so far is given; `skipped` says what was not tried. The base fit and the test
        for a gap are always done.
    tolerance : float
        A gap below so much of the largest stress of every record does not matter: the headline says so and names no
        cause. By default 0.1 %, a fifth of what the force of a testing machine of class 0.5 (ISO 7500-1) may err by.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    Diagnosis

    Raises
    ------
    InputError
        For an unknown effect or parameter, suggesting the nearest, for a budget or a tolerance that is not positive,
        and for `hold` together with `law`.
    """
    deadline = Budget(budget)
    as_tolerance(tolerance)
    if law is not None and hold:
        raise InputError(
            f"hold: found {', '.join(hold)} together with law=, expected one of the two; a law of your own holds what "
            "it does not give as a parameter"
        )
    scheme_name = identifying(scheme)[0].name
    known = catalogue(effects)
    workers = at_once(threads)

    for record in campaign.records:
        require_signal(record)
    campaign = as_tested(campaign)
    campaign, thinned = thin(campaign)

    def done(part: float, doing: str = "") -> None:
        if progress:
            progress(Part(part, doing))

    skipping = Skipping()

    def based_on(chosen: Campaign) -> BaseFit:
        own = base_fit(chosen, plain_fit(chosen, scheme, hold)) if law is None else fit_law(law, chosen, scheme)
        return own.screened(visible(known, own.model.views), workers, skipping.screened)

    done(0.0, "fitting the law")
    fitted = based_on(campaign)
    done(0.05, "testing for a gap")
    gap, place = both(
        lambda: find_gap(fitted, visible(known, fitted.model.views), threads=workers, seed=seed),
        lambda: locate(fitted.whitened, seed=seed),
        workers,
    )
    done(0.12, "locating the gap")
    case = _case(campaign, fitted, gap, place, based_on, seed)
    base, where, p_value = case.base, case.where, case.p_value
    considered = _visible(known, base, skipping, asked=effects is not None)
    calibration = check_calibration(base)
    done(0.15, "trying causes")
    causes = causes_of(
        base,
        considered,
        p_value,
        gap=gap.exists,
        threads=workers,
        seed=seed,
        skipping=skipping,
        budget=deadline,
        progress=lambda part: done(0.15 + 0.55 * part, "trying causes"),
        calibration=calibration,
    )
    beyond_the_law = causes.not_among(considered)
    base, considered, hypotheses = causes.base, causes.considered, causes.found
    if causes.weighed[0].effects == (UNKNOWN,) and not case.predicted_only:
        where = locate(place_left_out(base.whitened, where.located), seed=seed)
    done(0.7, "measuring what causes close")
    causes, shrink, curves = causes.shrunk(where.located, skipping, seed=seed)
    weighed = causes.weighed
    chosen = answer_set(weighed)
    if gap.exists:
        weighed = causes.with_untried(with_unseen(weighed, considered))
    best, explanations = weighed[0], explanations_of(weighed, causes.checks)
    parts = attribution(base, weighed, causes.nearest, hypotheses, shrink.identify, workers)
    alone = best.effects == (UNKNOWN,)
    unclosed = replace(shrink.identify, after_MPa=shrink.identify.before_MPa) if alone else shrink.identify
    left = _left(base, best.hypothesis, unclosed, campaign) if gap.exists else None
    causes = causes.judged_by(shrink, left)
    verdict = causes.verdict
    acts = regions_of(best.hypothesis, base, p_value) if best.hypothesis.causes and gap.exists else ()
    done(0.75, "choosing the next test")
    following, apart = (
        _designed(base, (*considered, *beyond_the_law), causes, chosen, left, skipping, deadline, workers, seed, done)
        if design
        else ((), None)
    )
    done(1.0)
    return Diagnosis(
        campaign=campaign.name,
        verdict="not_predicted" if case.predicted_only else verdict,
        headline=with_budget(
            with_remainder(
                headline(
                    verdict,
                    explanations,
                    parts,
                    chosen,
                    shrink,
                    gap,
                    worse=made_worse(causes.nearest, base, seed=seed) if gap.exists else (),
                    judge=case.judge,
                    tolerance=tolerance,
                    cut=causes.cut is not None,
                    chosen=effects is not None,
                    rough_MPa=base.rough_MPa,
                ),
                left if gap.matters(tolerance) else None,
            ),
            causes.cut_text if gap.matters(tolerance) else "",
        ),
        law=_law_text(campaign) if law is None else f"another law, of {', '.join(law.parameter_names)}",
        scheme=scheme_name,
        base=base_parameters(fitted if case.predicted_only else base),
        gap=gap.test,
        held_out=gap.held_out,
        size=gap.size,
        tolerance=tolerance,
        matters=gap.matters(tolerance),
        judged_on=case.judge,
        rms_MPa=fitted.misfit[0] if case.predicted_only else shrink.identify.before_MPa,
        noise_MPa=fitted.misfit[1] if case.predicted_only else shrink.identify.noise_MPa,
        located=acts
        if 0 < len(explanations[0].records) < len(base.model.views)
        and verdict == "explained"
        and acts
        and not case.predicted_only
        else where.located,
        where=where,
        acts=acts,
        signatures=signatures(base, best.hypothesis) if gap.exists else (),
        explanations=explanations,
        effects=parts.effects,
        answer_set=answer_set(causes.with_untried(causes.weighed)),
        shrink=shrink,
        next_test=following[0] if following else None,
        next_tests=following,
        curves=curves,
        warnings=(
            *(other_measure(base) if gap.in_fitted and gap.matters(tolerance) else ()),
            *campaign.warnings,
            *thinned,
            *unlike_others(campaign.records),
            *_warnings(base, gap.test.robust),
            *_in_order_of_rates(base, parts.named),
            *_not_followed(beyond_the_law, of=len(considered) + len(beyond_the_law)),
            *calibration.warnings,
        ),
        data_sha256=campaign.data_hash,
        seed=seed,
        isolability=apart,
        remainder=left,
        skipped=causes.skipped(skipping),
        scatter=base.scatter,
        gap_if_alike=gap.if_alike,
        trend=gap.trend,
        calibration=calibration,
        leaves_a_gap=verdict == "unexplained",
    )


def _visible(known: Sequence[Effect], base: BaseFit, skipping: Skipping, *, asked: bool) -> tuple[Effect, ...]:
    """Effects that the records could show; takes note of the others where they were asked for by name."""
    kept = visible(known, base.model.views)
    if asked:
        for effect in known:
            if effect.name not in {visible_effect.name for visible_effect in kept}:
                skipping.part(effect.name, f"no record could show it; it shows in {effect.shows_in}")
    return kept


@dataclass(frozen=True, eq=False)
class _Case:
    """What is to be explained.

    Attributes
    ----------
    base : BaseFit
        On the records that causes are fitted to.
    where : Where
    p_value : float
        Of the gap.
    predicted_only : bool
        Whether only predicted records hold it.
    judge : str or None
        The record that is kept to judge by, then.
    """

    base: BaseFit
    where: Where
    p_value: float
    predicted_only: bool = False
    judge: str | None = None


def _case(
    campaign: Campaign, fitted: BaseFit, gap: Gap, place: Where, based_on: Callable[[Campaign], BaseFit], seed: int
) -> _Case:
    """The records that causes are fitted to: those of the base fit, or all but one where only predictions fail."""
    if gap.in_fitted or not gap.in_held_out:
        return _Case(fitted, place, gap.test.p_value)
    joint, judge = all_but_one(campaign, gap)
    where = locate(_with_predictions(fitted), seed=seed)
    base = replace(based_on(joint), reference=fitted.parameters)
    return _Case(base, where, gap.held_out_p_value, predicted_only=True, judge=judge)


def _left(base: BaseFit, best: Hypothesis, closure: Closure, campaign: Campaign) -> Remainder | None:
    """What the best explanation leaves, described; None where that is noise."""
    specimens = {record.id: record.specimen_id for record in campaign.records}
    return remainder_of(base, best.refit, closure, specimens) if is_left(closure) else None


def _designed(
    base: BaseFit,
    considered: tuple[Effect, ...],
    causes: Causes,
    chosen: Sequence[tuple[str, ...]],
    left: Remainder | None,
    skipping: Skipping,
    budget: Budget,
    threads: int,
    seed: int,
    done: Callable[[float, str], None],
) -> tuple[tuple[NextTest, ...], Isolability | None]:
    """The next tests, and what these tests can discriminate."""
    if budget.spent(SEARCH.budget_of_design):
        skipping.part("the next test, and what these tests can discriminate", budget.why)
        return (), None
    following: tuple[NextTest, ...] = ()
    if is_stretched(base):
        of_causes = skipping.tried(
            "the next test",
            lambda: next_test_of(
                base,
                causes.weighed,
                chosen,
                causes.found,
                causes.trust,
                threads=threads,
                seed=seed,
                progress=lambda part: done(0.75 + 0.1 * part, "choosing the next test"),
            ),
        )
        of_rest = None
        if left is not None and (causes.verdict == "unexplained" or not of_causes):
            of_rest = skipping.tried("the next test", lambda: remainder_tests(base, left, threads=threads, seed=seed))
        following = one_after_the_other(of_rest or (), of_causes or ())
        if causes.verdict == "no_gap":  # there is nothing to discriminate, unless a test helps
            following = tuple(each for each in following if helps(each.probability_after, each.probability_before))
    apart = skipping.tried(
        "what these tests can discriminate",
        lambda: isolability(
            base.model,
            base.parameters,
            base.whitened.noises,
            considered,
            threads=threads,
            progress=lambda part: done(0.85 + 0.15 * part, "what these tests can discriminate"),
        ),
    )
    return following, apart


def _law_text(campaign: Campaign) -> str:
    settings = campaign.law
    companion = "constant tau_max" if settings.companion is None else f"companion relation: {settings.companion.form}"
    modes = f"{settings.modes} modes over {settings.decades:g} decades"
    if settings.accuracy is not None:
        modes += f", fewer to {settings.accuracy:g}"
    return f"modal (DNLR) law, {modes}, {companion}"


def _outliers_text(count: int) -> str:
    if count == 1:
        return "1 reading is an outlier and was left out"
    return f"{count} readings are outliers and were left out"


def _with_predictions(base: BaseFit) -> Whitened:
    """The fitted records and the others together, nothing of which is refitted to the latter."""
    records, noises = predictions(base)
    return Whitened.of([*base.whitened.records, *records], [*base.whitened.noises, *noises])


def _not_followed(beyond_the_law: Sequence[Effect], of: int) -> tuple[str, ...]:
    """One sentence where the law cannot follow effects, of so many that the records could show; else empty."""
    if not beyond_the_law:
        return ()
    others = [effect.title for effect in beyond_the_law]
    text = (
        f"the law cannot follow {len(others)} of the {of} effects that these records could show "
        f"({', '.join(others)}): none of them was considered, and what one of them does may look like another cause; "
        "give the law more capabilities"
    )
    return (text,)


BETWEEN_TESTS = "change_between_tests"
"""The effect that goes by the order of the tests."""


def _in_order_of_rates(base: BaseFit, named: Sequence[str]) -> tuple[str, ...]:
    """What a change from test to test is not told from, where one is named."""
    rates = [float(np.median(view.rate)) for view in base.model.views]
    steps = np.diff(np.log(rates))
    up, down = (bool(np.any(sign * steps > np.log(EVIDENCE.other_rate))) for sign in (1.0, -1.0))
    if up == down or len(rates) < 3 or BETWEEN_TESTS not in named:
        return ()
    return (
        "the tests were made in the order of their rates, or are listed so: what changes from test to test cannot be "
        "told from what depends on the rate; repeat the first test",
    )


def _warnings(base: BaseFit, robust: bool) -> tuple[str, ...]:
    warnings = []
    if not robust:
        warnings.append("whether there is a gap hangs on the noise level: the verdict changes at 0.8 or 1.25 times it")
    if not is_stretched(base):
        warnings.append("no record is stretched: no next test is looked for, since only tension tests are planned")
    if len(base.whitened.records) == 1:
        warnings.append(
            "one record only: nothing can be left out, and a cause that acts alike in it cannot be discriminated"
        )
    for view, noise in zip(base.model.views, base.whitened.noises, strict=True):
        stated = view.record.noise.stress_MPa
        if stated and noise.sigma > NOISE.not_as_stated * stated:
            warnings.append(
                f"{noise.name}: the noise of the stress is {noise.sigma:.2g} MPa in the record, {stated:.2g} MPa as "
                "stated; the larger one counts"
            )
        if noise.outliers:
            warnings.append(f"{noise.name}: {_outliers_text(len(noise.outliers))}")
    levels = np.array([noise.sigma for noise in base.whitened.noises])
    if levels.size > 1 and levels.max() > NOISE.tenfold * levels.min():
        warnings.append("the noise of the records differs more than tenfold; each is weighed by its own")
    return tuple(warnings)
