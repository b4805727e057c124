"""The noise of one record: level, correlation, growth; whitening and simulation at O(n)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation import _core
from probation.noise.arma import Arma
from probation.noise.joint_noise import FewRoot, FullRoot, joint_root

if TYPE_CHECKING:
    from probation._arrays import FloatArray

Growth = Literal["constant", "force", "local"]


@dataclass(frozen=True, eq=False)
class NoiseModel:
    """x = profile * ARMA(1,1) + propagated * N(0, 1) + drift * N(0, 1) + specimen * N(0, 1).

    docs/diagnosis-method.md, section 1.

    Attributes
    ----------
    name : str
        The record's id.
    arma : Arma
        Of x over its profile; its level is the one that counts at low frequency.
    profile : ndarray, shape (n,)
        Growth of the standard deviation along the record, of mean square 1.
    growth : {"constant", "force", "local"}
        Constant stress noise; constant force noise, which grows as e^eps; or as the record itself shows (bursts).
    sigma : float
        Standard deviation of the rough noise over the record [MPa], as measured.
    white : float
        By robust differences [MPa]; below `sigma` where the noise is correlated or comes in bursts.
    quantum : float
        Step of the readings [MPa or as the force over its area], 0 if there is none.
    propagated : ndarray, shape (n, k) [MPa]
        A: the stress noise that independent unit errors of the strain make; k may be 0.
    level_variance, shape_variance : float
        Of the logarithm of the noise spectrum at low frequency: by this record's own level, and by the shape, which
        records may share.
    outliers : tuple of int
        Readings that are kept out.
    source : str
        Where the estimate is from, in words.
    drift : ndarray, shape (n, k) [MPa], optional
        The part of the drift that may resemble an effect (`noise.drift`). Whitening and draws have it; `deviation` has
        not.
    nuisance_drift : ndarray, shape (n, k) [MPa], optional
        The rest of the drift, whose part along every effect is small. Tests on smooth waves, evidence and the
        uncertainty of predictions have it; whitening has not.
    specimen : ndarray, shape (n, k) [MPa], optional
        What deviations of the record's specimen do, of one standard deviation each. Whitening and draws have it;
        `deviation` has not: it is no noise of the record, and the same in all records of the specimen.
    specimen_id : str, optional
        Records of one specimen share these deviations: see `Whitener`.
    """

    name: str
    arma: Arma
    profile: FloatArray
    growth: Growth
    sigma: float
    white: float
    quantum: float
    propagated: FloatArray
    level_variance: float
    shape_variance: float
    outliers: tuple[int, ...]
    source: str
    drift: FloatArray | None = None
    nuisance_drift: FloatArray | None = None
    specimen: FloatArray | None = None
    specimen_id: str | None = None

    @classmethod
    def stationary(cls, name: str, arma: Arma, count: int, source: str = "as given") -> NoiseModel:
        """The same all along a record of so many samples, known exactly, without strain noise."""
        return cls(
            name=name,
            arma=arma,
            profile=np.ones(count),
            growth="constant",
            sigma=arma.deviation,
            white=arma.innovation,
            quantum=0.0,
            propagated=np.zeros((count, 0)),
            level_variance=0.0,
            shape_variance=0.0,
            outliers=(),
            source=source,
        )

    def __len__(self) -> int:
        return len(self.profile)

    @property
    def correlation(self) -> float:
        """Of neighbouring samples of the rough noise [-]."""
        phi, theta = self.arma.phi, self.arma.theta
        return (phi + theta) * (1.0 + phi * theta) / (1.0 + 2.0 * phi * theta + theta**2)

    @property
    def plain(self) -> bool:
        """Whether it is white, of one size all along, and of the stress alone."""
        return self.correlation == 0.0 and self.growth == "constant" and not self.outliers and not self.carries_strain

    @property
    def carries_strain(self) -> bool:
        """Whether it has strain noise, as the law propagates it."""
        return bool(self.propagated.shape[1])

    def with_propagated(self, propagated: FloatArray | None) -> NoiseModel:
        """The same with other propagated strain noise, shape (n, k) [MPa]; None for none."""
        return replace(self, propagated=np.zeros((len(self), 0)) if propagated is None else propagated)

    @property
    def deviation(self) -> FloatArray:
        """Standard deviation of a sample, shape (n,) [MPa]."""
        rough = self.arma.deviation * self.profile
        return np.asarray(np.sqrt(rough**2 + np.sum(self.propagated**2, axis=1)), dtype=np.float64)

    @property
    def weight(self) -> FloatArray:
        """What a sample counts in a mean square, shape (n,), of mean 1 [-]: less where its noise is above the median.

        Where the strain jumps, its noise is many times that of the stress. By their variance a few samples there would
        decide what is said of a whole record.
        """
        deviation = np.maximum(self.deviation, 1e-300)
        usual = np.median(deviation)
        weight = (usual / np.maximum(deviation, usual)) ** 2
        return np.asarray(weight / np.mean(weight), dtype=np.float64)

    @property
    def long_run(self) -> FloatArray:
        """What sqrt(m) times the mean of m neighbouring samples scatters by, shape (n,) [MPa]."""
        return self.arma.long_run * self.profile

    @property
    def square_inflation(self) -> float:
        """Variance of a mean square over that of as many independent samples: 1 + 2 sum of squared autocorrelations."""
        first, phi = self.correlation, self.arma.phi
        return 1.0 + 2.0 * first**2 / (1.0 - phi**2)

    @property
    def slow_inflation(self) -> float:
        """Variance of a product with something slow over that of as many independent samples (at least 1)."""
        return float(max((self.arma.long_run / max(self.arma.deviation, 1e-300)) ** 2, 1.0))

    def whiten(self, matrix: FloatArray) -> FloatArray:
        """Columns of `matrix` (n,) or (n, m) in coordinates in which the noise is white with unit variance."""
        values = np.asarray(matrix, dtype=np.float64)
        white = self._whitening.of(values.reshape(len(values), -1)).reshape(values.shape)
        return self._root.whiten(white) if isinstance(self._root, FullRoot) else white

    @cached_property
    def log_determinant(self) -> float:
        """Logarithm of the covariance's determinant, in MPa."""
        rough = self.arma.log_determinant(len(self)) + 2.0 * float(np.log(self.profile).sum())
        return rough + self._root.log_determinant

    def strain_errors(self, residual: FloatArray) -> FloatArray:
        """Likeliest strain errors of a residual (n,), in standard deviations: A^T Sigma^-1 r; (k,)."""
        white = self._root.whiten_transposed(self.whiten(residual))
        return np.asarray(self.arma.whiten(self.propagated / self.profile[:, None]).T @ white)

    def simulate(self, rng: np.random.Generator, size: int = 1) -> FloatArray:
        """Draws of the noise, shape (size, n) [MPa]."""
        rough = self.profile * self.arma.simulate(rng, len(self), size)
        slow = self._slow
        if not slow.shape[1]:
            return rough
        return np.asarray(rough + rng.standard_normal((size, slow.shape[1])) @ slow.T)

    @cached_property
    def alike(self) -> NoiseModel:
        """The same without deviations of the specimen."""
        return replace(self, specimen=None)

    @cached_property
    def white_specimen(self) -> FloatArray:
        """What deviations of the specimen do, in coordinates in which the rest of the noise is white; shape (n, k)."""
        if self.specimen is None or not self.specimen.shape[1]:
            return np.zeros((len(self), 0))
        return self.alike.whiten(self.specimen)

    @property
    def drifting(self) -> NoiseModel:
        """The same with all of its drift along any direction, that of effects included."""
        if self.drift is None or self.nuisance_drift is None:
            return self
        return replace(self, drift=np.hstack([self.drift, self.nuisance_drift]), nuisance_drift=None)

    def with_specimen_as_noise(self) -> NoiseModel:
        """The same with deviations of the specimen as noise of the record, as a prediction has it."""
        if self.specimen is None:
            return self
        return replace(self, propagated=np.hstack([self.propagated, self.specimen]), specimen=None)

    def scaled(self, factor: float) -> NoiseModel:
        """The same noise with `factor` times the standard deviation."""
        return replace(
            self,
            arma=replace(self.arma, innovation=self.arma.innovation * factor),
            sigma=self.sigma * factor,
            white=self.white * factor,
            propagated=self.propagated * factor,
            drift=None if self.drift is None else self.drift * factor,
            nuisance_drift=None if self.nuisance_drift is None else self.nuisance_drift * factor,
        )

    @property
    def _slow(self) -> FloatArray:
        return np.hstack(
            [self.propagated, *(columns for columns in (self.drift, self.specimen) if columns is not None)]
        )

    @cached_property
    def _root(self) -> FewRoot | FullRoot:
        """Of the whitened slow noise together with white noise."""
        return joint_root(self.arma.whiten(self._slow / self.profile[:, None]))

    @cached_property
    def _whitening(self) -> _core.Whitening:
        """By the process and, where they are few, by the directions of the slow noise."""
        root = self._root
        none = np.zeros((len(self), 0)), np.zeros(0)
        few = none if isinstance(root, FullRoot) else (root.directions, root.shrink)
        arma = self.arma
        return _core.Whitening(self.profile * arma.innovation, arma.phi, arma.theta, arma.first_variances, *few)
