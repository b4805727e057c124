"""What the statistics of a gap know of one record: arrays, and nothing of any law."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import as_samples
from probation.errors import InputError
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class RecordResidual:
    """One record at the base fit.

    Attributes
    ----------
    name : str
        The record's id.
    time, true_strain, strain_rate : ndarray, shape (n,) [s], [-], [1/s]
    residual : ndarray, shape (n,) [MPa]
        Model minus data at the base fit.
    tangent : ndarray, shape (n, p) [MPa per parameter]
        Derivatives of the model along the base parameters that all records share.
    jumps : tuple of int
        Indices at which the strain rate is discontinuous.
    measured : ndarray, shape (n,) [MPa], optional
        The data, whose own grid shows the quantisation.
    given_noise : float, optional
        Standard deviation of the stress noise [MPa] as the user states it; never narrows what the data show.
    propagated : ndarray, shape (n, k) [MPa], optional
        A with A A^T = J_eps Sigma_eps J_eps^T: the noise of a smoothed strain, or of the first sample of a raw one,
        as stress (`inference.propagated`). What is rougher shows in the residual and is measured there.
    wander : ndarray, shape (n, k) [MPa], optional
        What a machine's speed does that wanders at one frequency, hidden in the strain's noise; of one standard
        deviation each, one frequency at a time (`inference.speed_wander`).
    specimen : ndarray, shape (n, k) [MPa], optional
        What deviations of its specimen from the material's mean do, of one standard deviation each
        (`inference.scatter`).
    specimen_id : str, optional
        Records of one specimen share these deviations.
    temperature : float, optional
        At which the test starts, as declared or recorded [°C].
    quiet : tuple of slice
        Dwells and pre-load segments: the noise is taken there if they are long enough.
    replicate : ndarray, shape (n,) [MPa], optional
        Half-difference noise: (data of this record - data of its repeat)/sqrt(2) at the same instants. It holds no
        bias, so that the noise is estimated from it down to the lowest frequencies.

    Raises
    ------
    InputError
        Where shapes disagree, a number is not finite, or there are fewer than three samples.
    """

    name: str
    time: FloatArray
    true_strain: FloatArray
    strain_rate: FloatArray
    residual: FloatArray
    tangent: FloatArray
    jumps: tuple[int, ...] = ()
    measured: FloatArray | None = None
    given_noise: float | None = None
    propagated: FloatArray | None = None
    wander: FloatArray | None = None
    specimen: FloatArray | None = None
    specimen_id: str | None = None
    temperature: float | None = None
    quiet: tuple[slice, ...] = ()
    replicate: FloatArray | None = None

    def __post_init__(self) -> None:
        count = len(as_samples(self.time, f"{self.name}: time"))
        if count < 3:
            raise InputError(f"{self.name} has {count} samples; at least 3 are needed")
        for name in ("true_strain", "strain_rate", "residual"):
            as_samples(getattr(self, name), f"{self.name}: {name}", count)
        for name in ("measured", "replicate"):
            if getattr(self, name) is not None:
                as_samples(getattr(self, name), f"{self.name}: {name}", count)
        for name in ("tangent", "propagated", "wander", "specimen"):
            matrix = getattr(self, name)
            if matrix is None:
                continue
            if np.ndim(matrix) != 2 or len(matrix) != count:
                raise InputError(f"{self.name}: {name} has the shape {np.shape(matrix)}; expected ({count}, columns)")
            if not np.isfinite(matrix).all():
                raise InputError(f"{self.name}: {name} has entries that are not finite")

    def __len__(self) -> int:
        return len(self.time)

    @property
    def phase(self) -> FloatArray:
        """+1 loading, -1 unloading, 0 dwell; shape (n,). A dwell strains below `NOISE.dwell_rate`."""
        speed = float(np.median(np.abs(self.strain_rate[self.strain_rate != 0.0]))) if self.strain_rate.any() else 0.0
        moving = np.abs(self.strain_rate) > NOISE.dwell_rate * speed
        return np.asarray(np.sign(self.strain_rate) * moving, dtype=np.float64)
