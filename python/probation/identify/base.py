"""The campaign's own law as a base fit: which strain drives it, and how many steps it takes from sample to sample."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import uniform_filter1d

from probation.effects.record_view import views_of
from probation.identify.substeps import enough_substeps, predicted
from probation.inference.base_fit import BaseFit, fit_views
from probation.inference.modal_law import DnlrLaw
from probation.inference.time_range import time_range
from probation.law.schemes import scheme_of
from probation.noise.segments import leftover
from probation.settings.identification import IDENTIFICATION
from probation.settings.noise import NOISE
from probation.smoothing.excitation import excitations_of, excite

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.identify.result import Fit
    from probation.records.campaign import Campaign
    from probation.smoothing.excitation import Excitation


def base_fit(campaign: Campaign, fit: Fit) -> BaseFit:
    """Fit the engine's law to the identify records of a campaign by generalised least squares.

    Parameters
    ----------
    fit : Fit
        Where the search begins, from `identify.fit.plain_fit`; its scheme is used, and what it holds stays held.
    """
    samples = _excitations(campaign, fit)
    steps = enough_substeps(campaign, fit, samples)
    views = views_of(campaign, excitations=samples, scheme=scheme_of(fit.scheme, fit.start))
    views = tuple(view.with_substeps(steps[view.id]) for view in views)
    held = [name for name in fit.law.parameter_names if name not in fit.names]
    law = DnlrLaw(fit.law, held=held, times=time_range(campaign.identify, fit.law))
    base = fit_views(law, views, campaign.specimens)
    return replace(base, other_starts=_other_starts(base))


def _other_starts(base: BaseFit) -> tuple[FloatArray, ...]:
    """With E_u by the records' first slope, and tau_max by what is known best, E_u tau_max; where that is far away."""
    names = list(base.law.parameter_names)
    if "unrelaxed_modulus_MPa" not in names:
        return ()
    at = names.index("unrelaxed_modulus_MPa")
    time = next((index for index, name in enumerate(names) if name in ("tau_max_s", "alpha")), None)
    slope = IDENTIFICATION.modulus_over_first_slope * max(_first_slope(view) for view in base.model.views)
    ratio = base.parameters[at] / slope if slope > 0.0 else 1.0
    if 1.0 / IDENTIFICATION.far_modulus < ratio < IDENTIFICATION.far_modulus:
        return ()
    moved = base.parameters.copy()
    moved[at] = slope
    if time is not None:
        moved[time] *= ratio
    return (np.clip(moved, *base.law.bounds),)


def _first_slope(view: RecordView) -> float:
    """Steepest secant from the first sample to one of the next few [MPa]."""
    first = slice(1, IDENTIFICATION.samples_of_first_slope)
    strain = view.sampled(view.true_strain)[first] - view.true_strain[0]
    stress = view.data[first] - view.data[0]
    moving = np.abs(strain) > IDENTIFICATION.least_part_of_strain * float(np.max(np.abs(strain), initial=0.0))
    return float(np.max(np.abs(stress[moving] / strain[moving]), initial=0.0)) if moving.any() else 0.0


def _excitations(campaign: Campaign, fit: Fit) -> dict[str, Excitation]:
    """What drives the law: the smoothed strains, or the recorded ones if the stress shows their wiggles to be real.

    What a smoother takes off a strain is noise of its record, which the specimen never saw, or the test's own restless
    control, which it did. The strain does not show which; the stress does, of all smoothed records together, by what is
    rougher than any effect that the law may lack. Where it shows nothing, since the law is soft there or lacks what
    makes it stiff, the wiggles are noise: a law that follows the rate would make much of them.
    """
    chosen = excitations_of(campaign.records)
    raw = {record.id: excite(record, "raw") for record in campaign.records if chosen[record.id].operators is not None}
    favours_raw, discriminated = 0.0, 0.0
    for record in campaign.identify:
        if record.id in raw:
            smooth, recorded = (
                predicted(fit, way[record.id], fit.substeps) - record.true_stress for way in (chosen, raw)
            )
            rough = [leftover(residual, chosen[record.id].jumps) for residual in (smooth, recorded)]
            variance = _local_noise_variance(smooth)
            favours_raw += float(np.sum((rough[0] ** 2 - rough[1] ** 2) / variance))
            discriminated += float(np.sum((rough[0] - rough[1]) ** 2 / variance))
    # Were the wiggles noise, the sum would have the mean -discriminated and the variance 4 discriminated.
    by_chance = 2.0 * NOISE.strain_beyond_chance * np.sqrt(discriminated) - discriminated
    return chosen | raw if favours_raw > max(by_chance, 0.0) else chosen


def _local_noise_variance(residual: FloatArray) -> FloatArray:
    """Variance of the rough part of a residual along its record, shape (n,): a force's noise grows with the stretch."""
    rough = np.pad(np.diff(residual, 2), 1, mode="edge") ** 2
    power = uniform_filter1d(rough, max(len(rough) // NOISE.local_parts, 1), mode="nearest")
    return np.asarray(np.maximum(power, NOISE.least_local_variance * float(np.mean(power)) + 1e-300), dtype=np.float64)
