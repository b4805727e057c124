"""`probation.calibrate_companion`: from tests at several rates to a companion relation."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation._arrays import FloatArray, one_of
from probation.calibration.calibrated import CalibratedCompanion
from probation.calibration.companion_forms import CHOOSABLE, FORMS, NAMEABLE, Form
from probation.calibration.constant_time import why_constant
from probation.calibration.cross_validation import apart, best, leave_one_rate_out
from probation.calibration.direct import HARDENINGS, DirectRoute, Hardening
from probation.calibration.left_out import leave_one_rate_out as predict
from probation.calibration.left_out import record_alpha
from probation.calibration.rate_table import RateTable, rate_groups
from probation.calibration.record_fits import (
    MODULI,
    Modulus,
    RecordFits,
    RecordRate,
    fit_records,
    record_rate,
    spread_warnings,
)
from probation.calibration.regression import Regression, excess_scatter, regress
from probation.calibration.result import CalibratedForm, Calibration
from probation.errors import InputError
from probation.law.schemes import DIFFERENTIABLE, Scheme, SchemeName, at_samples
from probation.progress import shows_progress
from probation.provenance import samples_sha256
from probation.records.as_tested import as_tested
from probation.records.campaign import Campaign
from probation.settings.companion import COMPANION
from probation.smoothing.excitation import excite_each

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from probation.calibration.cross_validation import Score
    from probation.calibration.direct import DirectFit
    from probation.calibration.left_out import Predicted

    Progress = Callable[[int, int, str], None]

Route = Literal["auto", "by-rate", "direct"]
ROUTES: tuple[Route, ...] = ("auto", "by-rate", "direct")


@shows_progress
def calibrate_companion(
    source: Campaign | RateTable,
    scheme: Scheme | SchemeName = "sa3",
    *,
    form: str = "auto",
    route: Route = "auto",
    modulus: Modulus = "shared",
    hardening: Hardening = "by-record",
    progress: Progress | None = None,
) -> Calibration:
    """Calibrate companion relations on tests at several strain rates.

    Parameters
    ----------
    source : Campaign or RateTable
        Records at several rates (those with role "identify"), or relaxation times that were identified on some.
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
        With one step from sample to sample.
    form : str
        "auto" takes the form with the lowest error on rates left out; else "weissenberg" (11), "exponential" (12),
        "power" or "table".
    route : {"auto", "by-rate", "direct"}
        Of a campaign. "by-rate" fits each record alone with a constant tau_max and regresses these, and is refused
        where a rate is not nearly constant; "direct" identifies the relation's parameters on all records at once,
        through the law with alpha = 1; "auto" takes by-rate where it can, and checks it by the direct route.
    modulus : {"shared", "free"}
        Whether E_u is one for all records (the default: it belongs to the material, and E_u and tau_max of one record
        are all but collinear) or each record's own. The direct route always shares it. `law.fixed` wins over both.
    hardening : {"by-record", "shared"}
        G in the direct route. Each record its own by default: in Table 2 it grows by 60 % with the rate, and one G for
        all would bias the relation.
    progress : callable, optional
        Called with ``(done, total, what)``.

    Returns
    -------
    Calibration

    Raises
    ------
    InputError
        For an unknown option, one strain rate only, or a record whose rate does not suit the route.

    References
    ----------
    André et al., section 5.1, Table 2, eqs. (10)-(12), Figure S2.

    Examples
    --------
    >>> found = calibrate_companion(TABLE_2, form="weissenberg")
    >>> found.companion.parameters.round(4)
    array([0.0046, 0.0406])
    """
    if form != "auto":
        one_of(form, "form", ("auto", *NAMEABLE))
    one_of(route, "route", ROUTES)
    one_of(modulus, "modulus", MODULI)
    one_of(hardening, "hardening", HARDENINGS)
    chosen = at_samples(scheme, DIFFERENTIABLE)
    if isinstance(source, RateTable):
        return _on_table(source, form)
    if not isinstance(source, Campaign):
        raise InputError(f"source is {source!r}; expected a Campaign or a RateTable")
    advance = progress or (lambda done, total, what: None)
    source, driven = as_tested(source), []
    for at, drive in enumerate(excite_each(source.identify, further=source.held_out)):
        driven.append(drive)
        advance(at + 1, len(source.identify), f"strain rate of {source.identify[at].id}")
    rates = tuple(record_rate(record, excitation) for record, excitation in zip(source.identify, driven, strict=True))
    steady = all(rate.spread <= COMPANION.nearly_constant for rate in rates)
    if route == "by-rate" and not steady:
        worst = max(rates, key=lambda rate: rate.spread)
        raise InputError(
            f"campaign {source.name!r}, record {worst.id!r}: found strain rates from {worst.slow:.2g} to "
            f"{worst.fast:.2g} 1/s (5 to 95 % of the record), expected a nearly constant one (within a factor of "
            f"{COMPANION.nearly_constant:g}): a tau_max of its own is confounded with the relation; use the direct "
            "route"
        )
    if route == "direct" or not steady:
        _need_spread(source, rates)
        return _direct(
            source, DirectRoute.of(source.identify, source.law, chosen, hardening, driven), rates, form, advance
        )
    _need_two_rates(source, rates)
    fits = fit_records(source, rates, modulus=modulus, scheme=chosen, progress=advance)
    rms = [fitted.rms_MPa for fitted in fits.fits]
    direct = DirectRoute.of(source.identify, source.law, chosen, hardening, driven, rms)
    return _by_rate(source, fits, direct, form, advance)


def _on_table(table: RateTable, form: str) -> Calibration:
    regressions = _regressions(table, form)
    scores = leave_one_rate_out(table, regressions) if len(table.groups) >= COMPANION.fewest_rates else {}
    chosen, how, clear = _choice(form, scores)
    samples = [table.rates, table.tau_max] + ([] if table.se is None else [table.se])
    return Calibration(
        source=table.source,
        route="table",
        table=table,
        candidates={name: _candidate(regression, scores.get(name), None) for name, regression in regressions.items()},
        chosen=chosen,
        chosen_by=how,
        discriminated=clear,
        why_constant=why_constant(table, scores),
        warnings=tuple(_table_warnings(table, regressions[chosen])),
        data_sha256=samples_sha256(*samples),
    )


def _by_rate(campaign: Campaign, fits: RecordFits, direct: DirectRoute, form: str, progress: Progress) -> Calibration:
    table, rates = fits.table, fits.rates
    regressions = _regressions(table, form)
    scores = leave_one_rate_out(table, regressions) if len(table.groups) >= COMPANION.fewest_rates else {}
    chosen, how, clear = _choice(form, scores)
    warnings = [*campaign.warnings, *spread_warnings(rates), *_table_warnings(table, regressions[chosen])]
    check = None
    if chosen != "table":
        progress(1, 1, "all records at once, as a check")
        try:
            check = direct.fit(FORMS[chosen], [regressions[chosen].parameters], table.range)
        except InputError as error:  # at a rate within a record that is slower than its median
            warnings.append(f"the check on all records at once is left out: {error}")
    if fits.modulus_spread > COMPANION.modulus_scatter:
        warnings.append(
            f"E_u of the records alone scatters by {100 * fits.modulus_spread:.0f} % more than its standard errors: "
            "sharing it moves τ_max of each record by as much the other way"
        )
    return Calibration(
        source=campaign.name,
        route="by-rate",
        table=table,
        candidates={name: _candidate(regression, scores.get(name), fits) for name, regression in regressions.items()},
        chosen=chosen,
        chosen_by=how,
        discriminated=clear,
        why_constant=why_constant(table, scores),
        record_rates=rates,
        record_fits=fits,
        check=check,
        warnings=tuple(warnings),
        data_sha256=campaign.data_hash,
    )


def _direct(
    campaign: Campaign, direct: DirectRoute, rates: tuple[RecordRate, ...], form: str, progress: Progress
) -> Calibration:
    if form == "table":
        raise InputError(
            "form is 'table'; the direct route needs a form with parameters: weissenberg, power, exponential"
        )
    whole = _range(rates)
    labels = tuple(rate.id for rate in rates)
    medians = np.array([rate.rate for rate in rates])
    groups = rate_groups(medians)
    forms = {name: other for name, other in FORMS.items() if name != "table" and (not other.same_as or name == form)}
    leaving = len(groups) >= COMPANION.fewest_rates
    total = len(forms) * (1 + len(groups) * leaving)
    done = 0

    def advance(what: str) -> None:
        nonlocal done
        progress(done, total, what)
        done += 1

    coarse = direct.thinned()
    anchor = _anchor(coarse, whole)
    fits: dict[str, DirectFit] = {}
    for name, candidate_form in forms.items():
        advance(f"{name} on all records")
        fits[name] = _from_coarse(direct, coarse, candidate_form, _starts(candidate_form, anchor, whole), whole)
    scores: dict[str, Score] = {}
    predicted: tuple[Predicted, ...] = ()
    if leaving:
        scores, predicted = predict(
            coarse,
            groups,
            forms,
            lambda relation_form: _starts(relation_form, anchor, whole),
            lambda kept: _range([rates[at] for at in kept]),
            advance,
        )
    left = {name: float(np.sqrt(np.mean(np.square(fitted.rms)))) for name, fitted in fits.items()}
    chosen, how, clear = _choice(form, scores, left)
    warnings = list(campaign.warnings)
    if len(groups) == 1:
        warnings.append(
            f"all records run at one rate ({medians.min():.2g} to {medians.max():.2g} 1/s): the relation is read from "
            "how their rate changes with strain, and is confounded with whatever else changes with strain"
        )
    return Calibration(
        source=campaign.name,
        route="direct",
        table=None,
        candidates={
            name: _direct_candidate(coarse, FORMS[name], fitted, scores.get(name), labels)
            for name, fitted in fits.items()
        },
        chosen=chosen,
        chosen_by=how,
        discriminated=clear,
        why_constant=why_constant(None, scores),
        record_rates=rates,
        predicted=predicted,
        hardening=direct.hardening,
        warnings=tuple(warnings),
        data_sha256=campaign.data_hash,
    )


def _from_coarse(
    direct: DirectRoute, coarse: DirectRoute, form: Form, starts: list[FloatArray], whole: tuple[float, float]
) -> DirectFit:
    """Search on few samples, end on all of them."""
    begun = coarse.fit(form, starts, whole).companion.parameters
    try:
        return direct.fit(form, [begun], whole)
    except InputError:  # a sample that was left out has a rate at which that relation gives no positive time
        return direct.fit(form, starts, whole)


def _regressions(table: RateTable, form: str) -> dict[str, Regression]:
    """Every form that this table can have; of two that are one function here, only one unless it was asked for."""
    regressions = {}
    for name, candidate_form in FORMS.items():
        if table.se is not None and candidate_form.same_as and name != form:
            continue
        if candidate_form.count(len(table.groups)) <= len(table.groups):
            regressions[name] = regress(candidate_form, table)
    return regressions


def _choice(
    form: str, scores: Mapping[str, Score], left: Mapping[str, float] | None = None
) -> tuple[str, str, tuple[str, ...]]:
    """The form, how it was chosen, and which others are discriminated from it; `left`: rms of each form's fit [MPa]."""
    lowest = best(scores)
    if form != "auto":
        return form, "request", ()
    if lowest is None:
        if left:
            return min((name for name in CHOOSABLE if name in left), key=lambda name: left[name]), "fit", ()
        return CHOOSABLE[0], "preference", ()
    others = [name for name in CHOOSABLE if name in scores and name != lowest]
    return lowest, "cross-validation", tuple(name for name in others if apart(scores[lowest], scores[name]))


def _candidate(regression: Regression, score: Score | None, fits: RecordFits | None) -> CalibratedForm:
    """The regression, its covariance widened by that of the shared E_u."""
    covariance, modulus = regression.covariance, None
    if fits is not None and fits.unrelaxed_modulus is not None and covariance is not None:
        modulus = fits.unrelaxed_modulus
        slope = fits.log_slope
        if len(slope) != regression.gain.shape[1]:  # a table: replicates are one row
            slope = np.array([fits.log_slope[group].mean() for group in fits.table.groups])
        along = np.append(regression.gain @ slope / modulus, 1.0)  # with E_u, per MPa
        covariance = np.pad(covariance, (0, 1)) + fits.unrelaxed_modulus_se**2 * np.outer(along, along)
    return CalibratedForm(
        regression.form,
        CalibratedCompanion(regression.relation, covariance, regression.log_scatter, modulus, regression.form),
        regression.table.labels,
        regression.percent_residual,
        regression.r_squared,
        score,
        degrees=regression.degrees if _scattered(regression) else None,
    )


def _scattered(regression: Regression) -> bool:
    """Whether the covariance is mostly a scatter that few rows tell: its intervals are Student's."""
    error = regression.table.log_error
    return regression.log_scatter > (0.0 if error is None else float(np.median(error)))


def _direct_candidate(
    direct: DirectRoute, form: Form, fitted: DirectFit, score: Score | None, labels: tuple[str, ...]
) -> CalibratedForm:
    """The fit, and the scatter around it that each record's own alpha shows."""
    relation = fitted.companion.relation
    own = [record_alpha(direct, at, relation, fitted.unrelaxed_modulus) for at in range(len(labels))]
    residual = np.array([-correction.log_alpha for correction in own])
    degrees = len(labels) - len(form.parameter_names)
    errors = np.array([correction.se for correction in own])
    scatter = excess_scatter(residual, errors, degrees) if degrees > 0 and np.all(np.isfinite(errors)) else 0.0
    companion = replace(fitted.companion, log_scatter=scatter)
    return CalibratedForm(form, companion, labels, 100.0 * np.expm1(residual), float("nan"), score, fitted)


def _table_warnings(table: RateTable, chosen: Regression) -> list[str]:
    warnings = []
    if chosen.covariance is None:
        warnings.append(
            "as many rates as parameters and no standard errors: the relation goes through every point, and nothing is "
            "known of its uncertainty"
        )
    elif chosen.degrees == 0 and chosen.form.parameter_names:
        warnings.append(
            f"{len(table)} rates for {len(chosen.parameters)} parameters: the relation goes through every point, and "
            "its errors are those of the points alone; a third rate would put the form to the test"
        )
    return warnings


def _need_two_rates(campaign: Campaign, rates: Sequence[RecordRate]) -> None:
    """Refuse records at one rate, before anything is fitted."""
    RateTable(
        np.array([rate.rate for rate in rates]),
        np.ones(len(rates)),
        labels=tuple(f"record {rate.id!r}" for rate in rates),
        source=f"campaign {campaign.name!r}",
    )


def _need_spread(campaign: Campaign, rates: Sequence[RecordRate]) -> None:
    """Refuse one rate, unless it changes within the records."""
    slowest, fastest = _range(rates)
    if fastest < COMPANION.nearly_constant * slowest:
        _need_two_rates(campaign, rates)


def _range(rates: Sequence[RecordRate]) -> tuple[float, float]:
    return min(rate.slow for rate in rates), max(rate.fast for rate in rates)


def _anchor(direct: DirectRoute, whole: tuple[float, float]) -> float:
    """A constant tau_max that fits all records best [s], for the searches to begin from."""
    form = FORMS["constant"]
    shortest, longest = direct.time_bounds()
    starts = [np.array([value]) for value in np.geomspace(100.0 * shortest, 1e-3 * longest, 6)]
    return float(direct.fit(form, starts, whole).companion.parameters[0])


def _starts(form: Form, anchor: float, whole: tuple[float, float]) -> list[FloatArray]:
    """Relations through the anchor at the middle rate, steep and flat."""
    ends = np.array(whole)
    middle = np.sqrt(whole[0] * whole[1])
    exponents = (-1.0, -0.6, -0.2) if len(form.parameter_names) > 1 else (0.0,)
    return [form.start(ends, anchor * (ends / middle) ** exponent) for exponent in exponents]
