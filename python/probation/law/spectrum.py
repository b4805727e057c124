"""The modes of the law, eqs. (4) and (5), and fewer of them with the same relaxation kernel."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

from probation import _core
from probation._arrays import FloatArray, as_number, as_samples, as_whole_number
from probation._short_repr import ShortRepr
from probation.errors import InputError
from probation.law.reduction import fewer_modes
from probation.results.data import Stored

ACCURACIES = (1e-5, 0.5)
"""Finest and coarsest relative error that a spectrum of fewer modes may be asked for [-]."""


@dataclass(frozen=True, eq=False)
class Spectrum(ShortRepr):
    """The modes: relaxation times as fractions of tau_max, and weights.

    Parameters
    ----------
    relaxation_ratio : array_like, shape (modes,) [-]
        tau_j / tau_max, fastest mode first.
    modal_weight : array_like, shape (modes,) [-]
        p_j.
    """

    relaxation_ratio: FloatArray
    modal_weight: FloatArray

    def __post_init__(self) -> None:
        for name in ("relaxation_ratio", "modal_weight"):
            samples = as_samples(getattr(self, name), name).copy()
            samples.flags.writeable = False
            object.__setattr__(self, name, samples)
        object.__setattr__(self, "_built", _core.Spectrum(self.relaxation_ratio, self.modal_weight))

    @classmethod
    def log_spaced(cls, modes: int = 50, decades: float = 6.0) -> Spectrum:
        """The paper's spectrum: log-spaced times, eq. (4), weights proportional to sqrt(tau_j), eq. (5)."""
        return _log_spaced(as_whole_number(modes, "modes"), as_number(decades, "decades"))

    def reduced(self, *, accuracy: float | None = None, modes: int | None = None) -> Spectrum:
        """Fewer modes with the same kernel, to an accuracy or as good as so many can; as in `reduce_spectrum`."""
        return reduce_spectrum(self, accuracy=accuracy, modes=modes).spectrum

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Spectrum):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> tuple[type[Spectrum], tuple[FloatArray, FloatArray]]:
        return type(self), (self.relaxation_ratio, self.modal_weight)  # through __init__: read-only again

    def _key(self) -> tuple[bytes, bytes]:
        return self.relaxation_ratio.tobytes(), self.modal_weight.tobytes()

    def _engine(self) -> _core.Spectrum:
        built: _core.Spectrum = self.__dict__["_built"]
        return built


@lru_cache(maxsize=16)  # of immutable values: most laws have the same modes
def _log_spaced(modes: int, decades: float) -> Spectrum:
    engine = _core.Spectrum.log_spaced(modes, decades)
    return Spectrum(engine.relaxation_ratio, engine.modal_weight)


@dataclass(frozen=True, eq=False)
class Reduction(Stored):
    """A spectrum of fewer modes in the place of another.

    Attributes
    ----------
    spectrum : Spectrum
        Its times are fractions of the same tau_max.
    original : Spectrum
    error : float
        Bound of the relative error of the stress [-]: along any history it errs by no more than this fraction of the
        viscous stress that a ramp has at the history's largest Weissenberg number after the same reduced time. (As long
        as the hardening is no steeper than 2 E_u.)
    ramp_error : float
        Largest relative error of the viscous stress on a ramp, at any rate and strain [-].
    """

    SCHEMA: ClassVar[str] = "probation.reduction/1"

    spectrum: Spectrum
    original: Spectrum
    error: float
    ramp_error: float

    @property
    def modes(self) -> int:
        """How many are left."""
        return len(self.spectrum.modal_weight)

    def to_dict(self) -> dict[str, Any]:
        """The reduced spectrum and its errors, as Python objects."""
        return {
            "relaxation_ratio": self.spectrum.relaxation_ratio,
            "modal_weight": self.spectrum.modal_weight,
            "original_modes": len(self.original.modal_weight),
            "error": self.error,
            "ramp_error": self.ramp_error,
        }

    def summary(self) -> str:
        """One line."""
        before = len(self.original.modal_weight)
        return (
            f"{self.modes} modes for {before}: the stress errs by at most {self.error:.1e} of the flow stress on any "
            f"history, {self.ramp_error:.1e} on ramps"
        )


def reduce_spectrum(
    spectrum: Spectrum | None = None, *, accuracy: float | None = None, modes: int | None = None
) -> Reduction:
    """Refit the kernel of a spectrum with fewer modes.

    Weights by non-negative least squares, relaxation times by Gauss-Newton around it, one mode more at a time.

    Parameters
    ----------
    spectrum : Spectrum, optional
        The paper's 50 modes over 6 decades if left out.
    accuracy : float, optional
        Take the fewest modes whose `Reduction.error` is no larger [-].
    modes : int, optional
        Take the best spectrum of no more modes. Give one of the two.

    Returns
    -------
    Reduction
        The original where fewer modes do not reach the accuracy, or are not wanted.

    Raises
    ------
    InputError
        Unless one of `accuracy` (1e-5 to 0.5) and `modes` (at least 1) is given.

    Examples
    --------
    >>> reduce_spectrum(accuracy=1e-3).modes
    9
    """
    if (accuracy is None) == (modes is None):
        given = "neither" if accuracy is None else "both"
        raise InputError(f"accuracy and modes: found {given}, expected one of them")
    original = Spectrum.log_spaced() if spectrum is None else spectrum
    if modes is not None:
        count = as_whole_number(modes, "modes")
        if count < 1:
            raise InputError(f"modes is {count}; at least 1 is needed")
        return _reduced(original, 0.0, count)
    wanted = as_number(accuracy, "accuracy")
    finest, coarsest = ACCURACIES
    if not finest <= wanted <= coarsest:
        raise InputError(f"accuracy is {wanted:g}; a relative error from {finest:g} to {coarsest:g} is needed")
    return _reduced(original, wanted, len(original.modal_weight))


def spectrum_of(modes: int, decades: float, accuracy: float | None) -> Spectrum:
    """The spectrum that a campaign or the command line names: eqs. (4), (5), refitted where an accuracy is given."""
    spectrum = Spectrum.log_spaced(modes, decades)
    return spectrum if accuracy is None else spectrum.reduced(accuracy=accuracy)


@lru_cache(maxsize=16)  # of immutable values; a refit takes half a second
def _reduced(original: Spectrum, accuracy: float, most: int) -> Reduction:
    if most < len(original.modal_weight) or accuracy > 0.0:
        finest = max(accuracy, 0.5 * ACCURACIES[0])
        best = fewer_modes(original.relaxation_ratio, original.modal_weight, finest, most)
        if best is not None and (best.error <= accuracy or accuracy == 0.0):
            return Reduction(Spectrum(best.relaxation_ratio, best.modal_weight), original, best.error, best.ramp_error)
    return Reduction(original, original, 0.0, 0.0)
