"""Lower frequencies are believed to be noise where all records agree that they are; else a bias may hide there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from probation.noise.arma import Arma, ArmaFit, Periodogram, fit_arma, matched_level
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation.noise.evidence import NoiseEvidence


@dataclass(frozen=True)
class KnownSpectrum:
    """What the spectra say of one record's noise."""

    arma: Arma
    level_variance: float
    shape_variance: float


def fit_spectra(prepared: list[NoiseEvidence], pool: bool) -> list[KnownSpectrum]:
    """ARMA(1,1) of the rough leftovers; of the whole records where all of these agree with it."""
    rough = [each.rough for each in prepared if each.rough is not None]
    wholes = [own if each.whole is None else each.whole for each, own in zip(prepared, rough, strict=True)]
    bottom = min(float(part.frequency.min()) for part in wholes)
    groups = _groups(rough, bottom, pool)
    chosen = list(rough)
    if all(_predicted(wholes[i], rough[i], found, at) for group, found in groups for at, i in enumerate(group)):
        chosen = wholes
    elif len(groups) == 1:
        alike = _alike(wholes, rough, bottom)
        chosen = [wholes[i] if i in alike else rough[i] for i in range(len(rough))]
    groups = _groups(chosen, bottom, pool)
    known: dict[int, KnownSpectrum] = {}
    for group, found in groups:
        lifted = _lifted([chosen[index] for index in group], found)
        for at, index in enumerate(group):
            known[index] = KnownSpectrum(*lifted[at], found.shape_variance)
    return [known[index] for index in range(len(prepared))]


def _groups(parts: list[Periodogram], bottom: float, pool: bool) -> list[tuple[list[int], ArmaFit]]:
    """One fit for all records where a shape of the spectrum for each earns no more than chance would, else one each."""
    everyone = list(range(len(parts)))
    if pool or len(parts) == 1:
        shared = fit_arma(parts, bottom)
        if len(parts) == 1:
            return [(everyone, shared)]
    alone = [fit_arma([part], bottom) for part in parts]
    extra = 2.0 * (len(parts) - 1)  # chi-square: mean + 3 standard deviations
    if pool and shared.deviance - sum(each.deviance for each in alone) <= extra + 3.0 * np.sqrt(2.0 * extra):
        return [(everyone, shared)]
    return [([index], each) for index, each in enumerate(alone)]


def _lifted(parts: list[Periodogram], found: ArmaFit) -> list[tuple[Arma, float]]:
    """The fits at the level of their own lowest band, with the variance of its logarithm."""
    low = [_low_level(part, model) for part, model in zip(parts, found.models, strict=True)]
    total = sum(weight for _, weight in low)
    together = sum(ratio * weight for ratio, weight in low) / total
    # Taken down only where chance cannot explain it, up more readily: false alarms cost more.
    chance = float(np.sqrt(2.0 / total))
    together = (
        max(together - chance, 1.0) if together > 1.0 else min(together * (1.0 + NOISE.level_errors * chance), 1.0)
    )
    result = []
    for model, (ratio, weight), level in zip(found.models, low, found.level_variance, strict=True):
        # A record's own low band counts as far as it is known; all records' together tell the rest.
        prior = 200.0
        lift = max(together, (ratio * weight + together * prior) / (weight + prior))
        variance = level + (0.0 if lift == 1.0 else 2.0 / total)
        result.append((replace(model, innovation=float(model.innovation * np.sqrt(lift))), variance))
    return result


def _fits(whole: Periodogram, own: Periodogram, arma: Arma, slack: float) -> float:
    """Probability of as much power below the rough leftovers' frequencies: in the lowest band, or in all of them."""
    below = np.flatnonzero(whole.frequency < own.frequency.min())
    least = 1.0
    for part in (below[: NOISE.lowest_coefficients], below):
        if part.size:
            weight = whole.weight[part]
            power = float(np.sum(weight * whole.power[part] / arma.spectrum(whole.frequency[part]))) / slack
            least = min(least, float(chdtrc(float(np.sum(weight)), power)))
    return least


def _predicted(whole: Periodogram, own: Periodogram, found: ArmaFit, at: int) -> bool:
    """Whether a record's lower frequencies hold what the rough leftovers predict, within what these can tell."""
    slack = float(np.exp(1.5 * min(float(np.sqrt(found.shape_variance)), NOISE.prediction_error)))
    return _fits(whole, own, found.models[at], slack) >= NOISE.agreement_level


def _alike(wholes: list[Periodogram], rough: list[Periodogram], bottom: float) -> set[int]:
    """Records whose lower frequencies are what all the other records' are, beside their own rough leftovers.

    A noise is the same in every record; a bias is another in each. The record that the others predict worst is left
    out, again and again; where too many go, the bias is in all of them, and nothing is known of the lower frequencies.
    """
    left = set(range(len(wholes)))
    while len(left) >= max(2, int(np.ceil(NOISE.records_that_agree * len(wholes)))):
        probability = {}
        for index in left:
            others = fit_arma([wholes[other] for other in sorted(left - {index})], bottom)
            level = matched_level(rough[index], others.models[0])
            arma = replace(others.models[0], innovation=level)
            slack = float(np.exp(min(float(np.sqrt(others.shape_variance)), NOISE.prediction_error)))
            probability[index] = _fits(wholes[index], rough[index], arma, slack)
        worst = min(probability, key=lambda index: probability[index])
        if probability[worst] >= NOISE.agreement_level:
            return left
        left.remove(worst)
    return set()


def _low_level(part: Periodogram, model: Arma) -> tuple[float, float]:
    """Power over the fit's in the lowest `NOISE.low_band` coefficients, and their weight."""
    order = np.argsort(part.frequency)[: NOISE.low_band]
    ratio = part.power[order] / model.spectrum(part.frequency[order])
    weight = part.weight[order]
    # A lone coefficient of a wave must not speak for the band.
    ratio = np.minimum(ratio, 12.0)
    return float(weight @ ratio / weight.sum()), float(weight.sum())
