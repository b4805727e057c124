"""Noise without eating the bias, gap-method section 1: rough leftovers first, lower frequencies only if they agree."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.fft import dct
from scipy.ndimage import uniform_filter1d
from scipy.special import chdtrc

from probation.gap.arma import Arma, ArmaFit, Periodogram, fit_arma, matched_level
from probation.gap.local_size import local_size
from probation.gap.noise_model import Growth, NoiseModel
from probation.gap.quantisation import quantisation_noise, quantisation_step
from probation.gap.smooth_basis import WAVES, smooth_basis, waves
from probation.gap.span import span_of
from probation.gap.spikes import find_spikes, without_spikes
from probation.records.noise import scatter

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation._arrays import FloatArray
    from probation.gap.record_residual import RecordResidual

FEW = 48
"""Shorter records are given white noise by robust differences: a spectrum needs more."""

BLOCKS, DEGREE = 12, 5
"""The finest smooth basis: polynomials of this degree on so many stretches of a record."""

BLOCK = 40
"""Least samples of a stretch."""

OUTLIER = 4.0
"""A stretch whose low frequencies hold this many times as much, beside its high ones, as the median stretch's holds a
transient of the model, and is left out."""

AGREES = 1e-3
"""Probability below which the power at lower frequencies is no longer believed to be what the rough ones foretell."""

CERTAIN = 3.0
"""Standard errors by which a level must differ to be taken down."""

MOST_ALIKE = 0.75
"""Part of the records that must agree with each other for their lower frequencies to be taken for noise."""

LOWEST = 12
"""Coefficients next to the bias's own, where it would show first."""

FORETELLS = 0.4
"""Largest standard error of the logarithm of what the rough leftovers foretell that is let excuse a difference."""

LOW_BAND = 60
"""Coefficients of a record at the low end of what was fitted, whose level overrules the fit's where it is higher."""

QUIET = 80
"""Quiet samples that suffice for an estimate of their own."""

COARSE = 1.2
"""Readings whose step is this many standard deviations of the noise say nothing of how it grows."""


@dataclass(frozen=True, eq=False)
class _Prepared:
    """A record without its spikes, over its growth, with the two periodograms that it offers."""

    record: RecordResidual
    spikes: tuple[int, ...]
    white: float
    quantum: float
    growth: Growth
    profile: FloatArray
    rough: Periodogram | None
    whole: Periodogram | None
    source: str


def estimate_noise(records: Sequence[RecordResidual], pool: bool = True) -> tuple[NoiseModel, ...]:
    """The noise of every record, by what is rougher than any law's error.

    (1) Spikes are set aside; the growth of the noise along the record is found: constant, with e^eps (a constant force
    noise), or in bursts. (2) The base tangent and piecewise polynomials of degree 5 on 12 stretches are projected out;
    Whittle's likelihood gives an ARMA(1,1) of what is left. Bias of any amplitude that is smooth over a stretch is
    gone with them; so are the low frequencies. (3) They come back, from the 12th half period of a record on, if they
    agree with that ARMA(1,1) in every record, or else in those records where the others foretell them: then noise
    and only noise is there, and it is fitted with them.
    (4) Where the lowest band of the fit holds more than the fit says (1/f), its own level counts. Quiet stretches and
    replicates override (2) and (3).

    Parameters
    ----------
    records : sequence of RecordResidual
    pool : bool
        One shape (phi, theta) for all records where their spectra allow it: the same rig.

    Returns
    -------
    tuple of NoiseModel
        In the order of the records.
    """
    prepared = [_prepare(record) for record in records]
    seen = [each for each in prepared if each.rough is not None]
    fits = iter(_fit_all(seen, pool) if seen else ())
    return tuple(_fallback(each) if each.rough is None else _model(each, next(fits)) for each in prepared)


def carried_strain_noise(
    apply: Callable[[FloatArray], FloatArray],
    deviation: FloatArray | float,
    count: int,
    rank: int = WAVES,
) -> FloatArray:
    """Smooth part of J_eps Sigma_eps J_eps^T as A A^T, A of shape (count, rank): strain noise seen as stress.

    J_eps is never formed: the strain noise is expanded in `rank` slow waves; the rough rest shows in the fit residual
    and is measured there. Needed where the strain was smoothed: an unsmoothed strain's noise is roughest where the law
    is stiffest, and the level that is measured covers its slow part too.

    Parameters
    ----------
    apply : callable
        (count, k) strain perturbations [-] to (count, k) stress perturbations [MPa], the model's and its
        differentiator's doing.
    deviation : float or ndarray, shape (count,)
        Standard deviation of the white strain noise [-].
    count : int
        Samples.
    rank : int
        Waves; by default those at which the noise is extrapolated, not measured.
    """
    columns = waves(count, rank) * (np.asarray(deviation, dtype=np.float64) * np.ones(count))[:, None]
    return np.asarray(apply(columns), dtype=np.float64)


def _prepare(record: RecordResidual) -> _Prepared:
    count = len(record)
    spikes = find_spikes(record.residual, record.jumps)
    residual = without_spikes(record.residual, spikes)
    white = scatter(record.time, residual)
    quantum = 0.0 if record.measured is None else quantisation_step(record.measured)
    if record.measured is not None and quantum == 0.0:
        quantum = quantisation_step(record.measured * np.exp(-record.true_strain))  # the force was read, not the stress
    white = max(white, quantisation_noise(quantum))
    coarse = quantum > COARSE * white
    nothing = _Prepared(
        record, spikes, white, quantum, "constant", np.ones(count), None, None, "robust differences: a short record"
    )
    if count < FEW or white <= 1e-12 * float(np.max(np.abs(residual), initial=0.0)) or white == 0.0:
        return nothing
    if record.replicate is not None:
        values = without_spikes(record.replicate, find_spikes(record.replicate))
        growth, profile = _growth(record, values, coarse)
        whole = _whole(values, waves(count, 2), 2, profile)
        return replace(nothing, growth=growth, profile=profile, rough=whole, source="the difference from its repeat")
    quiet = [part for part in record.quiet if len(range(*part.indices(count))) >= BLOCK]
    if quiet and sum(len(range(*part.indices(count))) for part in quiet) >= QUIET:
        stretches = [residual[part] for part in quiet]
        rough = _rough(stretches, [np.ones(len(part)) for part in stretches], degree=3, robust=False)
        return replace(nothing, rough=rough, source="dwells and pre-load")
    growth, profile = _growth(record, residual, coarse)
    rough = _rough(_stretches(residual, record.jumps), _stretches(profile, record.jumps), DEGREE, robust=True)
    if rough is None:
        return nothing
    smooth = smooth_basis(record.time, record.jumps).columns
    basis = span_of(np.hstack([record.tangent, smooth]))
    whole = _whole(residual, basis, WAVES, profile)
    return replace(
        nothing, growth=growth, profile=profile, rough=rough, whole=whole, source="what no smooth curve takes"
    )


def _stretches(values: FloatArray, jumps: Sequence[int]) -> list[FloatArray]:
    """Stretches of nearly equal length that end at the jumps."""
    count = len(values)
    target = max(count // BLOCKS, BLOCK)
    borders = [0, *sorted(jumps), count]
    parts: list[FloatArray] = []
    for first, last in pairwise(borders):
        pieces = max((last - first) // target, 1)
        parts += [part for part in np.array_split(values[first:last], pieces) if len(part) >= BLOCK // 2]
    return parts


@lru_cache(maxsize=256)
def _legendre(count: int, degree: int) -> FloatArray:
    place = np.linspace(-1.0, 1.0, count)
    return np.linalg.qr(np.polynomial.legendre.legvander(place, degree))[0]


def _rough(stretches: list[FloatArray], profiles: list[FloatArray], degree: int, robust: bool) -> Periodogram | None:
    """Cosine coefficients of the stretches, polynomials projected out; stretches with a transient left out."""
    rows: list[tuple[FloatArray, FloatArray, FloatArray]] = []
    for values, profile in zip(stretches, profiles, strict=True):
        each = _whole(values, _legendre(len(values), degree), degree + 1, profile)
        rows.append((each.frequency, each.power, each.weight))
    if not rows:
        return None
    if robust and len(rows) >= 3:
        # Low against high: a burst of noise has both.
        low = np.array([np.mean(power[:8]) / max(float(np.mean(power[8:])), 1e-300) for _, power, _ in rows])
        rows = [row for row, size in zip(rows, low, strict=True) if size <= OUTLIER * np.median(low)]
    frequency, power, weight = (np.concatenate([row[i] for row in rows]) for i in range(3))
    return Periodogram(frequency, power, weight)


def _whole(values: FloatArray, basis: FloatArray, lowest: int, profile: FloatArray | float = 1.0) -> Periodogram:
    """Cosine coefficients from order `lowest` on of what `basis` (orthonormal columns) leaves, over the profile.

    The profile comes last: before, its own bends would make a smooth bias rough.
    """
    left = (values - basis @ (basis.T @ values)) / profile
    power = dct(left, type=2, norm="ortho") ** 2
    weight = 1.0 - np.sum(dct(basis, type=2, norm="ortho", axis=0) ** 2, axis=1)
    frequency = np.pi * np.arange(len(values)) / len(values)
    keep = np.flatnonzero(weight > 0.3)
    keep = keep[keep >= lowest]
    return Periodogram(frequency[keep], power[keep] / weight[keep], weight[keep])


def _leftover(values: FloatArray, jumps: Sequence[int]) -> FloatArray:
    """What polynomials on stretches leave, every sample; short stretches give zeros."""
    parts = []
    target = max(len(values) // BLOCKS, BLOCK)
    borders = [0, *sorted(jumps), len(values)]
    for first, last in pairwise(borders):
        for part in np.array_split(values[first:last], max((last - first) // target, 1)):
            basis = _legendre(len(part), min(DEGREE, max(len(part) - 2, 0))) if len(part) else np.zeros((0, 1))
            parts.append(part - basis @ (basis.T @ part))
    return np.concatenate(parts)


def _growth(record: RecordResidual, residual: FloatArray, coarse: bool) -> tuple[Growth, FloatArray]:
    """How the size of the noise changes along a record.

    The size of neighbouring differences is regressed on the strain: a slope near 1 is constant force noise on a
    shrinking section. What then still comes in bursts is followed by a moving mean, drawn towards 1 by as much as
    chance would move it.
    """
    count = len(residual)
    if coarse:
        return "constant", np.ones(count)
    left = _leftover(residual, record.jumps)
    # Seconds differences see no transient of the model; a correlated noise keeps its size in them.
    size = np.abs(np.convolve(left, [1.0, -2.0, 1.0], mode="same"))
    size = uniform_filter1d(size, 5, mode="nearest")
    if not np.any(size > 0.0):
        return "constant", np.ones(count)
    size = np.maximum(size, 0.05 * float(np.mean(size)))
    strain = record.true_strain - record.true_strain.mean()
    spread = float(strain @ strain)
    growth: Growth = "constant"
    profile = np.ones(count)
    if spread > 0.0:
        logs = np.log(size)
        slope = float(strain @ logs) / spread
        # Neighbouring sizes share samples: about 7 of them are one.
        error = float(np.std(logs - logs.mean() - slope * strain)) * np.sqrt(7.0 / spread)
        if slope > 0.5 and slope > 3.0 * error:
            growth, profile = "force", np.exp(record.true_strain)
    profile = profile / np.sqrt(np.mean(profile**2))
    local = local_size(left / profile)
    if local is not None:
        profile, growth = profile * local, "local"
    return growth, profile / np.sqrt(np.mean(profile**2))


@dataclass(frozen=True)
class _Known:
    """What the spectra say of one record's noise."""

    arma: Arma
    level_variance: float
    shape_variance: float


def _fit_all(prepared: list[_Prepared], pool: bool) -> list[_Known]:
    """ARMA(1,1) of the rough leftovers; of the whole records where all of these agree with it."""
    rough = [each.rough for each in prepared if each.rough is not None]
    wholes = [own if each.whole is None else each.whole for each, own in zip(prepared, rough, strict=True)]
    bottom = min(float(part.frequency.min()) for part in wholes)
    groups = _groups(rough, bottom, pool)
    chosen = list(rough)
    if all(_foretold(wholes[i], rough[i], found, at) for group, found in groups for at, i in enumerate(group)):
        chosen = wholes
    elif len(groups) == 1:
        alike = _alike(wholes, rough, bottom)
        chosen = [wholes[i] if i in alike else rough[i] for i in range(len(rough))]
    groups = _groups(chosen, bottom, pool)
    known: dict[int, _Known] = {}
    for group, found in groups:
        lifted = _lifted([chosen[index] for index in group], found)
        for at, index in enumerate(group):
            known[index] = _Known(*lifted[at], found.shape_variance)
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
    together = max(together - chance, 1.0) if together > 1.0 else min(together * (1.0 + CERTAIN * chance), 1.0)
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
    for part in (below[:LOWEST], below):
        if part.size:
            weight = whole.weight[part]
            power = float(np.sum(weight * whole.power[part] / arma.spectrum(whole.frequency[part]))) / slack
            least = min(least, float(chdtrc(float(np.sum(weight)), power)))
    return least


def _foretold(whole: Periodogram, own: Periodogram, found: ArmaFit, at: int) -> bool:
    """Whether a record's lower frequencies hold what the rough leftovers foretell, within what these can tell."""
    slack = float(np.exp(1.5 * min(float(np.sqrt(found.shape_variance)), FORETELLS)))
    return _fits(whole, own, found.models[at], slack) >= AGREES


def _alike(wholes: list[Periodogram], rough: list[Periodogram], bottom: float) -> set[int]:
    """Records whose lower frequencies are what all the other records' are, beside their own rough leftovers.

    A noise is the same in every record; a bias is another in each. The record that the others foretell worst is left
    out, again and again; where too many go, the bias is in all of them, and nothing is known of the lower frequencies.
    """
    left = set(range(len(wholes)))
    while len(left) >= max(2, int(np.ceil(MOST_ALIKE * len(wholes)))):
        probability = {}
        for index in left:
            others = fit_arma([wholes[other] for other in sorted(left - {index})], bottom)
            level = matched_level(rough[index], others.models[0])
            arma = replace(others.models[0], innovation=level)
            slack = float(np.exp(min(float(np.sqrt(others.shape_variance)), FORETELLS)))
            probability[index] = _fits(wholes[index], rough[index], arma, slack)
        worst = min(probability, key=lambda index: probability[index])
        if probability[worst] >= AGREES:
            return left
        left.remove(worst)
    return set()


def _low_level(part: Periodogram, model: Arma) -> tuple[float, float]:
    """Power over the fit's in the lowest `LOW_BAND` coefficients, and their weight."""
    order = np.argsort(part.frequency)[:LOW_BAND]
    ratio = part.power[order] / model.spectrum(part.frequency[order])
    weight = part.weight[order]
    # A lone coefficient of a wave must not speak for the band.
    ratio = np.minimum(ratio, 12.0)
    return float(weight @ ratio / weight.sum()), float(weight.sum())


def _model(each: _Prepared, known: _Known) -> NoiseModel:
    arma = known.arma
    floor = max(quantisation_noise(each.quantum), each.record.given_noise or 0.0)
    source = each.source
    if arma.deviation < floor:
        arma = replace(arma, innovation=arma.innovation * floor / arma.deviation)
        source += "; raised to the noise that is given or to the readings' step"
    return NoiseModel(
        each.record.name,
        arma,
        each.profile,
        each.growth,
        float(arma.deviation),
        each.white,
        each.quantum,
        _carried(each.record),
        known.level_variance,
        known.shape_variance,
        each.spikes,
        source,
    )


def _fallback(each: _Prepared) -> NoiseModel:
    record = each.record
    size = float(np.max(np.abs(record.residual if record.measured is None else record.measured), initial=0.0))
    level = max(each.white, record.given_noise or 0.0, 1e-7 * size, 1e-12)
    if not record.given_noise and len(record) < FEW:
        # Median of few differences: its own error, and never less than a third of what scatters at all.
        level = max(level, 0.1 * float(np.std(np.diff(record.residual))))
    return NoiseModel(
        record.name,
        Arma(innovation=level),
        each.profile,
        each.growth,
        level,
        each.white,
        each.quantum,
        _carried(record),
        0.0 if record.given_noise else 5.0 / len(record),
        0.0,
        each.spikes,
        "as given" if record.given_noise and record.given_noise >= each.white else each.source,
    )


def _carried(record: RecordResidual) -> FloatArray:
    return np.zeros((len(record), 0)) if record.carried is None else record.carried
