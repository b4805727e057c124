"""What a test imposes on the specimen: a strain history, or a stress history in creep."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from probation._arrays import as_samples
from probation._short_repr import ShortRepr
from probation.errors import InputError
from probation.law.history import StrainHistory

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class ImposedHistory(ShortRepr):
    """A history to simulate.

    Attributes
    ----------
    name : str
        What it is, for people: "ramp at 0.005 1/s to true strain 2".
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-], or None
        None where the stress is imposed.
    true_stress : ndarray, shape (n_times,) [MPa], or None
        Imposed stress; None where the strain is imposed.
    strain_rate : ndarray, shape (n_times,) [1/s], or None
        Where it is known rather than differentiated.
    jumps : tuple of float, or None [s]
        Instants at which the rate is discontinuous; None: to be found in the samples.
    """

    name: str
    time: FloatArray
    true_strain: FloatArray | None = None
    true_stress: FloatArray | None = None
    strain_rate: FloatArray | None = None
    jumps: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        if (self.true_strain is None) == (self.true_stress is None):
            raise InputError("a history imposes either true_strain or true_stress; expected exactly one of them")
        time = as_samples(self.time, "time")
        object.__setattr__(self, "time", time)
        for name in ("true_strain", "true_stress", "strain_rate"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, as_samples(getattr(self, name), name, len(time)))

    def strain_history(self) -> StrainHistory:
        """The same as `Law.stress` takes it.

        Raises
        ------
        InputError
            If the stress is imposed.
        """
        if self.true_strain is None:
            raise InputError(f"{self.name}: found an imposed stress, expected a strain history; creep takes it")
        jumps = "auto" if self.jumps is None else self.jumps or None
        return StrainHistory(self.time, self.true_strain, strain_rate=self.strain_rate, jumps=jumps)

    def __len__(self) -> int:
        return len(self.time)
