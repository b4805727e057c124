"""Spectra of the noise: low frequencies count where every record agrees with its high ones; else a bias may hide."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from probation.noise.arma import Arma, ArmaFit, Periodogram, fit_arma
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation.noise.evidence import NoiseEvidence


@dataclass(frozen=True)
class KnownSpectrum:
    """Spectrum of one record's noise, with the variances of the logarithm of its level and of its shape."""

    arma: Arma
    level_variance: float
    shape_variance: float


def fit_spectra(prepared: list[NoiseEvidence], pool: bool) -> list[KnownSpectrum]:
    """ARMA(1,1) of the rough part of the residuals; of the whole residuals where every record agrees with it."""
    rough = [evidence.rough for evidence in prepared if evidence.rough is not None]
    wholes = [own if evidence.whole is None else evidence.whole for evidence, own in zip(prepared, rough, strict=True)]
    bottom = min(float(part.frequency.min()) for part in wholes)
    groups = _groups(rough, bottom, pool)
    if all(_agrees(wholes[i], rough[i], fit, at) for group, fit in groups for at, i in enumerate(group)):
        groups = _groups(wholes, bottom, pool)
    known = {
        index: KnownSpectrum(fit.models[at], fit.level_variance[at], fit.shape_variance)
        for group, fit in groups
        for at, index in enumerate(group)
    }
    return [known[index] for index in range(len(prepared))]


def _groups(parts: list[Periodogram], bottom: float, pool: bool) -> list[tuple[list[int], ArmaFit]]:
    """One fit for all records where a shape of the spectrum for each earns no more than chance would, else one each."""
    everyone = list(range(len(parts)))
    if pool or len(parts) == 1:
        shared = fit_arma(parts, bottom)
        if len(parts) == 1:
            return [(everyone, shared)]
    alone = [_alone(part, bottom) for part in parts]
    extra = 2.0 * (len(parts) - 1)  # mean of a chi-square
    if pool and shared.deviance - sum(fit.deviance for fit in alone) <= extra + NOISE.own_shape_errors * np.sqrt(
        2.0 * extra
    ):
        return [(everyone, shared)]
    return [([index], fit) for index, fit in enumerate(alone)]


@lru_cache
def _alone(part: Periodogram, bottom: float) -> ArmaFit:
    """Of one record; kept, since of all records one or two change from a round to the next."""
    return fit_arma([part], bottom)


def _agrees(whole: Periodogram, own: Periodogram, fit: ArmaFit, at: int) -> bool:
    """Whether a record's power below the rough part's frequencies, all of it and the lowest, is what the fit predicts.

    A bias shows first at the lowest frequencies. Power beyond the prediction is allowed for 1.5 standard errors of the
    logarithm of the predicted spectrum.
    """
    allowed = float(np.exp(NOISE.prediction_margin * min(float(np.sqrt(fit.shape_variance)), NOISE.prediction_error)))
    below = np.flatnonzero(whole.frequency < own.frequency.min())
    for part in (below[: NOISE.lowest_coefficients], below):
        weight = whole.weight[part]
        power = float(np.sum(weight * whole.power[part] / fit.models[at].spectrum(whole.frequency[part]))) / allowed
        if part.size and float(chdtrc(float(np.sum(weight)), power)) < NOISE.agreement_level:
            return False
    return True
