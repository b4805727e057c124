"""The strain of a second file, a film of the test, taken at the times of the force file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from probation._complaint import joined
from probation.errors import InputError
from probation.records.clock import FloatArray, Shift, estimate_shift
from probation.settings.reading import READING


@dataclass(frozen=True, eq=False)
class Film:
    """The strain of a test, on a clock of its own.

    Attributes
    ----------
    file : str
        Name of its file.
    time : ndarray, shape (m,) [s]
    true_strain : ndarray, shape (m,) [-]
    warnings : tuple of str
    shift : float or None [s]
        What is added to its time; None where it is to be estimated.
    """

    file: str
    time: FloatArray
    true_strain: FloatArray
    warnings: tuple[str, ...]
    shift: float | None


@dataclass(frozen=True, eq=False)
class Joined:
    """A test's strain on the clock of its force.

    Attributes
    ----------
    within : ndarray of bool, shape (n,)
        The samples of the force file at which there is a strain.
    true_strain : ndarray, shape (n_within,) [-]
    note : str
        Which file, which shift, how well it is known.
    """

    within: NDArray[np.bool_]
    true_strain: FloatArray
    shift: Shift
    note: str


def join(path: Path, film: Film, time: FloatArray, force: FloatArray, displacement: FloatArray | None) -> Joined:
    """Take the strain of a film at the times of a force file.

    Parameters
    ----------
    path : Path
        The force file.
    time : ndarray, shape (n,) [s]
    force : ndarray, shape (n,)
        Force or stress.
    displacement : ndarray, shape (n,), or None
        What the force file has of displacement or strain.

    Raises
    ------
    InputError
        If the records do not tell the shift, or have too few samples in common.
    """
    if film.shift is None:
        # A displacement is a sum of elongations, so it goes with engineering strain.
        shift = estimate_shift(time, force, displacement, film.time, np.expm1(film.true_strain))
        if not np.isfinite(shift.se):
            raise _untold(path, film, shift)
    else:
        shift = Shift(film.shift, 0.0, "")
    at = time - shift.value
    within = (at >= film.time[0]) & (at <= film.time[-1])
    if within.sum() < READING.fewest_samples:
        raise InputError(
            f"{path}: found {int(within.sum())} samples within the time of {film.file}, shifted by "
            f"{shift.value:.6g} s, expected at least {READING.fewest_samples}; check shift_s and the units of time"
        )
    strain = np.interp(at[within], film.time, film.true_strain)
    return Joined(within, strain, shift, _note(film, shift, int((~within).sum())))


def _untold(path: Path, film: Film, shift: Shift) -> InputError:
    """Complain that the two files do not tell how their clocks differ."""
    fits = joined((f"{value:.4g} s" for value in (shift.value, *shift.others)), "and")
    evidence = (
        f"{len(shift.others) + 1} shifts at which the strain of {film.file} fits about as well ({fits})"
        if shift.others
        else f"nothing that tells the shift of {film.file}, no start of the test in both (best {fits})"
    )
    return InputError(
        f"{path}: found {evidence}, expected one; say it: strain_from = {{ …, shift_s = … }} (--strain-shift), "
        "what is added to the time of that file"
    )


def _note(film: Film, shift: Shift, left_out: int) -> str:
    known = f" ± {shift.se:.2g} s (one standard error, by {shift.by})" if shift.by else " s, as stated"
    cut = f"; {left_out} samples of the force without strain are left out" if left_out else ""
    way = "back" if shift.value < 0.0 else "forward"
    return f"the strain is that of {film.file}, its clock set {way} by {_rounded(shift)}{known}{cut}"


def _rounded(shift: Shift) -> str:
    """How far, with no more digits than its standard error has."""
    digits = max(int(1.0 - np.floor(np.log10(shift.se))), 0) if shift.se > 0.0 else 6
    return f"{abs(shift.value):.{digits}f}" if shift.se > 0.0 else f"{abs(shift.value):.6g}"
