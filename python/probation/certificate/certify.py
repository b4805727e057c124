"""`probation.certify`: the probation test, section 5 of the paper."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.calibration.calibrated import CalibratedCompanion
from probation.certificate.consistency import Consistency, Estimate, judge
from probation.certificate.fits import PARAMETERS, CertificateFits, estimates, joint_covariance
from probation.certificate.hardening import reaches_hardening, regress_hardening
from probation.certificate.prediction import predict
from probation.certificate.result import Certificate
from probation.certificate.verdict import decide
from probation.errors import InputError
from probation.identify.fit import gap_of
from probation.inference.gap import as_tolerance
from probation.inference.parameter import outside_name
from probation.law.schemes import DIFFERENTIABLE, as_scheme
from probation.parallel import without_blas_threads
from probation.progress import Part, shows_progress
from probation.records.as_tested import as_tested
from probation.settings.certificate import CERTIFICATE
from probation.smoothing.excitation import excitations_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from probation._arrays import FloatArray
    from probation.certificate.prediction import Prediction
    from probation.identify.result import Fit
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.campaign import Campaign
    from probation.records.record import Record
    from probation.smoothing.methods import Method as ExcitationMethod

ByRecord: TypeAlias = "dict[str, dict[str, Estimate]]"
"""Estimates by record and parameter."""


@shows_progress
@without_blas_threads
def certify(
    campaign: Campaign,
    scheme: Scheme | SchemeName = "be2",
    *,
    tolerance: float = CERTIFICATE.tolerance,
    hold: Mapping[str, float] | None = None,
    excitation: ExcitationMethod = "auto",
    progress: Callable[[float], None] | None = None,
) -> Certificate:
    """Put the law on probation, to see whether it is intrinsic to the material.

    1. The parameters are identified on the records with role "identify", unless the campaign holds them all.
    2. The others are predicted with nothing adjusted. Without held-out records each is predicted from all others.
    3. Each record, held-out ones too, is identified alone: tau_max (or alpha) and G with E_u as identified before
       (the paper's identifications 2, 3), then all three (identification 4). These fits judge whether a parameter keeps
       its value; no prediction uses them. Where E_u itself changes, all are judged on the latter.
    4. The test of `probation.diagnose` says whether the records, and the predictions of those held out, hold more than
       noise and the uncertainty of the parameters at all.
    5. If the law has a companion relation, each record is also identified without it (Figure 3).

    Parameters
    ----------
    campaign : Campaign
        Two records at least.
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
    tolerance : float
        Systematic error that is let pass, as a fraction of the record's largest stress.
    hold : dict of str to float, optional
        Parameters held, by name with unit; on top of the campaign's own.
    excitation
        As in `probation.fit`.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    Certificate

    Raises
    ------
    InputError
        For a single record, a tolerance that is not positive, or what `probation.fit` raises.

    References
    ----------
    André et al., section 5; Figures 3 to 6, S1; Tables 3, 4.
    """
    as_tolerance(tolerance)
    if len(campaign.records) < 2:
        raise InputError(
            f"campaign {campaign.name!r}: found one record, expected at least two: "
            "the probation test predicts one record from others"
        )
    campaign = as_tested(campaign)
    if hold:
        campaign = replace(campaign, law=replace(campaign.law, fixed={**campaign.law.fixed, **hold}))
    fits = CertificateFits(campaign, as_scheme(scheme, DIFFERENTIABLE), excitation)
    records, rated = campaign.records, campaign.law.companion is not None
    total = 1 + (len(records) if not campaign.held_out else 0) + len(records) * (3 + rated)
    done = 0

    def step(fit: Fit) -> Fit:
        nonlocal done
        done += 1
        if progress:
            progress(Part(done / total, f"identification {min(done + 1, total)} of {total}"))
        return fit

    base = step(fits.base())
    gap = gap_of(campaign)
    scatter = None if gap is None else gap.scatter
    relation = CalibratedCompanion.from_settings(campaign.law.companion)
    further = campaign.identify if campaign.held_out else ()
    driven = excitations_of(campaign.held_out or campaign.records, excitation, further=further)
    predictions = {
        record.id: predict(source, known, record, tolerance, driven[record.id], relation)
        for source, known, record in _pairs(fits, base, step)
    }
    free = {record.id: step(fits.on([record], fits.holding(base, []))) for record in records}
    own = {record: estimates(fit, record, relation=relation, specimens=scatter) for record, fit in free.items()}
    modulus, modulus_error = _modulus(base, own, held="unrelaxed_modulus_MPa" in campaign.law.fixed)
    known_modulus = replace(campaign.law, fixed={"unrelaxed_modulus_MPa": modulus})
    alone = {record.id: step(fits.on([record], known_modulus)) for record in records}
    held = {record: estimates(fit, record, modulus_error, relation, scatter) for record, fit in alone.items()}
    parameters = _judge(own, held)
    failing = [name for name, parameter in parameters.items() if not parameter.passes]
    kept = [name for name in parameters if name not in failing]
    shared = fits.holding(base, kept)
    if len(base.records) > 1:  # which disagree, so that the values identified on all of them are nobody's
        means = {outside_name(name): parameters[name].mean for name in kept if parameters[name].tested}
        shared = replace(shared, fixed={**shared.fixed, **means})
    if not failing or not kept:
        described = free
    elif shared == known_modulus:
        described = alone
    else:
        described = {record.id: step(fits.on([record], shared)) for record in records}
    without = {}
    if rated:
        bare = replace(campaign.law, companion=None, fixed={})
        without = {record.id: step(fits.on([record], bare)) for record in records}
    tolerances = {record.id: tolerance * float(np.max(np.abs(record.true_stress))) for record in records}
    verdict, reason = decide(
        parameters,
        predictions,
        {name: fit.bias_MPa for name, fit in described.items()},
        tolerances,
        {
            name: campaign.law.fixed[outside_name(name)]
            for name in parameters
            if outside_name(name) in campaign.law.fixed
        },
        gap,
    )
    if progress:
        progress(1.0)
    return Certificate(
        campaign=campaign.name,
        verdict=verdict,
        reason=reason,
        tolerance=tolerance,
        gap=gap,
        base=base,
        parameters=parameters,
        predictions=predictions,
        alone=alone,
        free=free,
        described=described,
        without_companion=without,
        regressions={
            record.id: regress_hardening(record.true_strain, record.true_stress)
            for record in records
            if reaches_hardening(record.true_strain)
        },
        warnings=tuple(dict.fromkeys([*base.warnings, *_rates(base, predictions), *_doubts(parameters, campaign)])),
        data_sha256=campaign.data_hash,
    )


def _pairs(fits: CertificateFits, base: Fit, step: Callable[[Fit], Fit]) -> Iterator[tuple[Fit, FloatArray, Record]]:
    """What predicts what, and its covariance: the identified law every held-out record; else each by all others."""
    campaign = fits.campaign
    if campaign.held_out or fits.all_given:
        known = joint_covariance(base)
        for record in campaign.held_out or campaign.records:
            yield base, known, record
        return
    for record in campaign.records:
        source = step(fits.on(other for other in campaign.records if other.id != record.id))
        yield source, joint_covariance(source), record


def _modulus(base: Fit, own: ByRecord, *, held: bool) -> tuple[float, float]:
    """E_u that is held on each record, and its standard error [MPa].

    As identified. Where several records were identified together it is the mean of what each says alone: if another
    parameter differs between them, the joint fit bends E_u to make up for it.
    """
    name = "unrelaxed_modulus"
    identified = base.law.unrelaxed_modulus, base.parameters[name].se or 0.0
    if held or len(base.records) == 1:
        return identified
    known = {record: own[record][name] for record in base.records}
    errors = [estimate.se for estimate in known.values() if estimate.se]
    if not errors:
        return identified
    return judge({name: known})[name].mean, float(np.sum(np.power(errors, -2.0)) ** -0.5)


def _judge(own: ByRecord, held: ByRecord) -> dict[str, Consistency]:
    """Judge E_u on the fits with all parameters free, the others on those with E_u held; on the former if E_u fails.

    `own` and `held` are the estimates of those fits, by record.
    """
    judged = judge(_by_parameter({record: own[record] | held[record] for record in own}))
    if judged["unrelaxed_modulus"].passes:
        return judged
    judged_on_own = judge(_by_parameter(own))  # an E_u that is not the record's would push its error into the others
    return judged if judged_on_own["unrelaxed_modulus"].passes else judged_on_own


def _by_parameter(estimated: ByRecord) -> dict[str, dict[str, Estimate]]:
    """By parameter and record what was by record and parameter."""
    names = next(iter(estimated.values()))
    return {name: {record: values[name] for record, values in estimated.items()} for name in names}


def _rates(base: Fit, predictions: Mapping[str, Prediction]) -> list[str]:
    """Where predicted records ask the companion relation outside the rates that it is calibrated on."""
    companion = base.law.companion
    if companion is None:
        return []
    warned = (
        (record, companion.extrapolation(prediction.excitation.rate)) for record, prediction in predictions.items()
    )
    return [f"{record}: {text}" for record, text in warned if text]


def _doubts(parameters: Mapping[str, Consistency], campaign: Campaign) -> list[str]:
    doubts = [
        f"{outside_name(name)} is not tested: fewer than two records determine it"
        for name, parameter in parameters.items()
        if not parameter.tested
    ]
    if not campaign.held_out and len(campaign.law.fixed) < PARAMETERS:
        doubts.append("no record is held out: each was predicted from all others")
    warm = {
        record.id: float(np.mean(record.temperature)) for record in campaign.records if record.temperature is not None
    }
    if warm and max(warm.values()) - min(warm.values()) > CERTIFICATE.same_temperature:
        cold, hot = min(warm, key=lambda name: warm[name]), max(warm, key=lambda name: warm[name])
        doubts.append(
            f"{cold} was tested at {warm[cold]:.0f} °C, {hot} at {warm[hot]:.0f} °C: what differs between them may be "
            "the temperature rather than the strain-rate history; these records cannot discriminate the two"
        )
    for name, parameter in parameters.items():
        if outside_name(name) not in campaign.law.fixed:
            continue
        held = campaign.law.fixed[outside_name(name)]
        judgement = (
            "contradict it" if parameter.contradicts(held) else "agree" if parameter.tested else "say little of it"
        )
        doubts.append(f"{outside_name(name)} is held at {held:g} by the campaign; the records alone {judgement}")
    return doubts
