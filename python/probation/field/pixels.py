"""The law identified on the pixels of a block."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from probation.bulk import identify_many
from probation.field.between import between
from probation.field.noise import scatter
from probation.field.samples import bridged, of_equal_samples
from probation.field.smoothing import smoothed_records
from probation.field.status import Status
from probation.inference.parameter import outside_name
from probation.settings.reading import READING

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.bulk import Method
    from probation.field.samples import BoolArray, IndexArray
    from probation.field.source import Samples
    from probation.law.modal import Law
    from probation.law.schemes import Scheme


Substeps: TypeAlias = int | Literal["auto"]
"""Steps of the scheme from sample to sample; "auto": as many as each block needs."""


@dataclass(frozen=True)
class Way:
    """How each pixel is identified.

    Attributes
    ----------
    law : Law
        Spectrum, companion relation, and the values of what is held.
    held : tuple of str
        Parameters that are not identified.
    smoothing : bool
        Whether the noise of the strain is taken out first.
    substeps : int or "auto"
        Steps of the scheme from sample to sample.
    threads : int or None
        Of the engine; None: all cores.
    """

    law: Law
    scheme: Scheme
    method: Method
    held: tuple[str, ...]
    smoothing: bool
    substeps: Substeps
    threads: int | None


@dataclass(frozen=True)
class Pixels:
    """Estimates: parameters and standard_error (pixels, 3), rms_residual (pixels,) [MPa], status (pixels,)."""

    parameters: FloatArray
    standard_error: FloatArray
    rms_residual: FloatArray
    status: NDArray[np.int8]

    @property
    def identified(self) -> BoolArray:
        """Where the law was identified."""
        return np.asarray(self.status == Status.IDENTIFIED)


def identify_pixels(
    way: Way, time: FloatArray, strain: Samples, stress: Samples, used: BoolArray, substeps: int
) -> Pixels:
    """Estimates on every pixel, from its samples in use.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    strain, stress, used : ndarray, shape (pixels, n_times) [-], [MPa], bool
    substeps : int
        Steps of the scheme from sample to sample; what `way` says of them is not looked at.
    """
    count = len(strain)
    empty = np.where(used.any(axis=1), Status.TOO_FEW_SAMPLES, Status.NO_DATA).astype(np.int8)
    found = Pixels(np.full((count, 3), np.nan), np.full((count, 3), np.nan), np.full(count, np.nan), empty)
    drawn = smoothed_records(time, strain, used) if way.smoothing else strain
    for pixels, samples in of_equal_samples(used):
        if np.count_nonzero(samples) < READING.fewest_samples:
            continue
        fine, driving = between(time[samples], drawn[np.ix_(pixels, samples)], substeps, smooth=way.smoothing)
        some = identify_many(
            way.law,
            fine,
            driving,
            stress[np.ix_(pixels, samples)],
            way.scheme,
            method=way.method,
            hold={outside_name(name): getattr(way.law, name) for name in way.held},
            substeps=substeps,
            threads=way.threads,
        )
        found.parameters[pixels], found.standard_error[pixels] = some.parameters, some.standard_error
        found.rms_residual[pixels], found.status[pixels] = some.rms_residual, some.status
    return found


def with_more_noise(
    time: FloatArray,
    strain: Samples,
    stress: Samples,
    used: BoolArray,
    neighbourhood: IndexArray,
    chance: np.random.Generator,
) -> tuple[Samples, Samples, FloatArray]:
    """The same records with as much noise once more, of what each record scatters; see `noise.scatter`.

    Returns
    -------
    strain, stress : ndarray, shape (pixels, n_times) [-], [MPa]
    level : ndarray, shape (pixels,) [MPa]
        Root mean square of the stress noise; NaN where the record is too short.
    """
    noisier, level = [], np.full(len(strain), np.nan)
    for values in (strain, stress):
        noise = np.zeros(values.shape)
        for pixels, samples, own in bridged(time, values, used):
            if np.count_nonzero(samples) >= READING.fewest_samples:
                part = scatter(time[samples], own, neighbourhood[pixels])
                noise[np.ix_(pixels, samples)] = part
                level[pixels] = np.sqrt(np.mean(part**2, axis=1))  # the stress comes last
        more = values.copy()
        more += noise * chance.standard_normal(values.shape)
        noisier.append(more)
    return noisier[0], noisier[1], level
