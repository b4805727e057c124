"""What is left where a form is wrong or an effect unknown: smooth waves over every record, and over the strain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.detection.strain_periodic import strain_periodic_waves
from probation.noise.nuisance_drift import nuisance_drift
from probation.noise.smooth_basis import smooth_basis
from probation.noise.span import span_of
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.whitening import Whitened


DEPENDENT = 1e-4
"""Part of a wave that smoother ones leave, below which it adds nothing."""


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """Smooth waves over every record, whitened and orthonormal, and the spectrum of a discrepancy along them.

    Attributes
    ----------
    columns : tuple of ndarray, shape (n_r, d_r)
        By record.
    spectrum : tuple of ndarray, shape (d_r,)
        Shares of the waves in a discrepancy's energy; sum to 1 in each record.
    slices : tuple of slice
        Rows of each record.
    places : tuple of slice
        Its waves among all.
    drift : ndarray, shape (d, d)
        Covariance of the slow noise along the waves that whitening has left; see `noise.nuisance_drift`.
    common : ndarray, shape (N, m)
        Whitened waves over the strain, the same in all records; the energies of all sum to 1.
    specimens : ndarray, shape (N, m)
        What other parameters in one record alone do, whitened; none where there is one record.
    strain_periodic : ndarray, shape (N, m)
        Whitened waves of what is periodic in the strain; none where nothing certainly is.
    log_strain_periodic_share : float
        What the choice of their period costs; see `StrainPeriodic.log_share`.
    """

    columns: tuple[FloatArray, ...]
    spectrum: tuple[FloatArray, ...]
    slices: tuple[slice, ...]
    places: tuple[slice, ...]
    drift: FloatArray
    common: FloatArray
    specimens: FloatArray
    strain_periodic: FloatArray
    log_strain_periodic_share: float

    @classmethod
    def of(cls, whitened: Whitened, signals: FloatArray | None = None, *, periodic: bool = True) -> Discrepancy:
        """Of the identify records.

        Parameters
        ----------
        whitened : Whitened
        signals : ndarray, shape (N, n_signals), optional
            Whitened signals of effects, of which the slow noise is known to hold little.
        periodic : bool
            Whether to look for what is periodic in the strain.
        """
        columns, spectrum, places, at = [], [], [], 0
        for record, noise in zip(whitened.records, whitened.noises, strict=True):
            basis = smooth_basis(record.time, record.jumps, EVIDENCE.roughest_discrepancy)
            left, upper = np.linalg.qr(noise.whiten(basis.columns / np.linalg.norm(basis.columns, axis=0)))
            size = np.abs(np.diag(upper))
            kept = size > DEPENDENT * float(size.max())
            columns.append(left[:, kept])
            spectrum.append(np.mean(spectra(basis.order[kept]), axis=0))
            places.append(slice(at, at + int(kept.sum())))
            at = places[-1].stop
        drift = nuisance_drift(whitened, columns, signals)
        nothing = np.zeros((len(whitened), 0)), 0.0
        strain_periodic, log_strain_periodic_share = strain_periodic_waves(whitened) if periodic else nothing
        return cls(
            columns=tuple(columns),
            spectrum=tuple(spectrum),
            slices=whitened.slices,
            places=tuple(places),
            drift=drift,
            common=_over_strain(whitened),
            specimens=_own_tangents(whitened),
            strain_periodic=strain_periodic,
            log_strain_periodic_share=log_strain_periodic_share,
        )

    def __len__(self) -> int:
        return int(self.places[-1].stop)

    def of_columns(self, matrix: FloatArray) -> FloatArray:
        """B^T times whitened columns (N,) or (N, m)."""
        return np.concatenate([own.T @ matrix[part] for own, part in zip(self.columns, self.slices, strict=True)])

    def energy(self, values: FloatArray) -> FloatArray:
        """Energy of whitened samples (N,) by record, shape (n_records,)."""
        return np.array([float(values[part] @ values[part]) for part in self.slices])

    def variances(self, energy: FloatArray) -> FloatArray:
        """D for a discrepancy of so much energy in each record, shape (d,)."""
        parts = [size * share for size, share in zip(energy, self.spectrum, strict=True)]
        return np.asarray(np.concatenate(parts), dtype=np.float64)

    def factor(self, energy: FloatArray) -> FloatArray:
        """B D^(1/2) for a discrepancy of so much energy in each record, shape (N, d)."""
        columns = np.zeros((self.slices[-1].stop, len(self)))
        size = np.sqrt(self.variances(energy))
        for own, part, place in zip(self.columns, self.slices, self.places, strict=True):
            columns[part, place] = own * size[place]
        return columns


def spectra(order: NDArray[np.intp]) -> FloatArray:
    """Shares of waves of these orders in a discrepancy's energy, by its softness; shape (n_softness, d)."""
    falls = (1.0 + order) ** -np.array(EVIDENCE.discrepancy_softness)[:, None]
    return np.asarray(falls / falls.sum(axis=1, keepdims=True))


def _over_strain(whitened: Whitened) -> FloatArray:
    """Waves over the strain that all records share, falling as a discrepancy's do."""
    largest = max(float(np.max(record.true_strain)) for record in whitened.records)
    if not largest > 0.0:
        return np.zeros((len(whitened), 0))
    orders = np.arange(EVIDENCE.common_discrepancy)
    columns = whitened.whiten(
        [np.cos(np.pi / largest * np.outer(record.true_strain, orders)) for record in whitened.records]
    )
    return np.asarray(columns / np.linalg.norm(columns, axis=0) * np.sqrt(np.mean(spectra(orders), axis=0)))


def _own_tangents(whitened: Whitened) -> FloatArray:
    """Orthonormal columns of every record's own tangent; the energies of all sum to 1."""
    if len(whitened.records) < 2:
        return np.zeros((len(whitened), 0))
    blocks = []
    for record, noise, part in zip(whitened.records, whitened.noises, whitened.slices, strict=True):
        own = span_of(noise.whiten(record.tangent))
        block = np.zeros((len(whitened), own.shape[1]))
        block[part] = own
        blocks.append(block)
    columns = np.hstack(blocks)
    return np.asarray(columns / np.sqrt(max(columns.shape[1], 1)))
