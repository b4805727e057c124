"""What a record offers of its noise: outliers set aside, growth, and the spectra that no law's error reaches."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.fft import dct

from probation.noise.arma import Periodogram
from probation.noise.growth import growth_of
from probation.noise.outliers import find_outliers, without_outliers
from probation.noise.segments import in_segments, legendre
from probation.noise.smooth_basis import smooth_basis, waves
from probation.noise.span import span_of
from probation.records.noise import noise_level
from probation.records.quantisation import quantisation_noise, quantisation_step
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.model import Growth
    from probation.noise.record_residual import RecordResidual


@dataclass(frozen=True, eq=False)
class NoiseEvidence:
    """What a record says of its noise.

    Attributes
    ----------
    record : RecordResidual
    outliers : tuple of int
        Samples that are set aside.
    white : float
        Scatter of neighbouring samples [MPa], no less than the readings' step makes it.
    quantum : float
        The readings' step [MPa]; 0 where none is seen.
    growth : Growth
    profile : ndarray, shape (n_samples,)
        Size of the noise along the record, of mean square 1.
    rough : Periodogram or None
        Of what no law's error reaches; None where the record is too short.
    whole : Periodogram or None
        Of the whole record, its low frequencies included, a bias among them.
    source : str
        Where all this was read.
    """

    record: RecordResidual
    outliers: tuple[int, ...]
    white: float
    quantum: float
    growth: Growth
    profile: FloatArray
    rough: Periodogram | None
    whole: Periodogram | None
    source: str


def noise_evidence(record: RecordResidual) -> NoiseEvidence:
    """What a record says: its repeat before its dwells, these before what no smooth curve takes."""
    count = len(record)
    outliers = find_outliers(record.residual, record.jumps)
    residual = without_outliers(record.residual, outliers)
    white = noise_level(record.time, residual)
    quantum = 0.0 if record.measured is None else quantisation_step(record.measured)
    if record.measured is not None and quantum == 0.0:
        quantum = quantisation_step(record.measured * np.exp(-record.true_strain))  # the force was read, not the stress
    white = max(white, quantisation_noise(quantum))
    coarse = quantum > NOISE.coarse_step * white
    nothing = NoiseEvidence(
        record, outliers, white, quantum, "constant", np.ones(count), None, None, "robust differences: a short record"
    )
    if (
        count < NOISE.fewest_for_a_spectrum
        or white <= 1e-12 * float(np.max(np.abs(residual), initial=0.0))
        or white == 0.0
    ):
        return nothing
    if record.replicate is not None:
        values = without_outliers(record.replicate, find_outliers(record.replicate))
        growth, profile = growth_of(record, values, coarse)
        whole = _whole(values, waves(count, 2), 2, profile)
        return replace(nothing, growth=growth, profile=profile, rough=whole, source="the difference from its repeat")
    quiet = [part for part in record.quiet if len(range(*part.indices(count))) >= NOISE.shortest_segment]
    if quiet and sum(len(range(*part.indices(count))) for part in quiet) >= NOISE.quiet_samples:
        segments = [residual[part] for part in quiet]
        rough = _rough(segments, [np.ones(len(part)) for part in segments], degree=3, robust=False)
        return replace(nothing, rough=rough, source="dwells and pre-load")
    growth, profile = growth_of(record, residual, coarse)
    rough = _rough(
        in_segments(residual, record.jumps), in_segments(profile, record.jumps), NOISE.segment_degree, robust=True
    )
    if rough is None:
        return nothing
    smooth = smooth_basis(record.time, record.jumps).columns
    basis = span_of(np.hstack([record.tangent, smooth]))
    whole = _whole(residual, basis, NOISE.smooth_waves, profile)
    return replace(
        nothing, growth=growth, profile=profile, rough=rough, whole=whole, source="what no smooth curve takes"
    )


def _rough(segments: list[FloatArray], profiles: list[FloatArray], degree: int, robust: bool) -> Periodogram | None:
    """Cosine coefficients of the segments, polynomials projected out; segments with a transient left out."""
    rows: list[tuple[FloatArray, FloatArray, FloatArray]] = []
    for values, profile in zip(segments, profiles, strict=True):
        each = _whole(values, legendre(len(values), degree), degree + 1, profile)
        rows.append((each.frequency, each.power, each.weight))
    if not rows:
        return None
    if robust and len(rows) >= 3:
        rough = [
            float(np.quantile(np.abs(np.diff(values / profile, 2)), NOISE.edgeless)) ** 2
            for values, profile in zip(segments, profiles, strict=True)
        ]
        transient = _transient([power for _, power, _ in rows], rough)
        rows = [row for row, out in zip(rows, transient, strict=True) if not out]
    frequency, power, weight = (np.concatenate([row[i] for row in rows]) for i in range(3))
    return Periodogram(frequency, power, weight)


def _transient(powers: Sequence[FloatArray], rough: Sequence[float]) -> NDArray[np.bool_]:
    """Which segments hold a transient of the model: from their powers, and from squares of large second differences.

    A burst of noise has high frequencies, too, and many large differences. A transient has low ones; one with an edge
    has both, few large differences, and is in one place.
    """
    low = [float(np.mean(power[: NOISE.low_coefficients])) for power in powers]
    high = [float(np.mean(power[NOISE.low_coefficients :])) for power in powers]
    slow = _over_median(np.array(low) / np.maximum(high, 1e-300)) > NOISE.transient_ratio
    large = _over_median(np.array([float(np.mean(power)) for power in powers])) > NOISE.transient_size
    edged = large & (_over_median(np.array(rough)) <= NOISE.transient_ratio)
    return slow | edged if np.count_nonzero(edged & ~slow) <= NOISE.edged_segments else slow


def _over_median(values: FloatArray) -> FloatArray:
    """Numbers that are not negative over their median."""
    sizes = np.maximum(values, 1e-300)
    return np.asarray(sizes / np.median(sizes))


def _whole(values: FloatArray, basis: FloatArray, lowest: int, profile: FloatArray | float = 1.0) -> Periodogram:
    """Cosine coefficients from order `lowest` on of what `basis` (orthonormal columns) leaves, over the profile.

    The profile comes last: before, its own bends would make a smooth bias rough.
    """
    left = (values - basis @ (basis.T @ values)) / profile
    power = dct(left, type=2, norm="ortho") ** 2
    weight = 1.0 - np.sum(dct(basis, type=2, norm="ortho", axis=0) ** 2, axis=1)
    frequency = np.pi * np.arange(len(values)) / len(values)
    keep = np.flatnonzero(weight > NOISE.least_left)
    keep = keep[keep >= lowest]
    return Periodogram(frequency[keep], power[keep] / weight[keep], weight[keep])
