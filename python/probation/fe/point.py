"""The compiled material point, the same code that finite-element programs load, through its C interface."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from probation._arrays import FloatArray, as_number, as_samples
from probation.errors import InputError
from probation.exporting.constants import MaterialConstants
from probation.fe.where import library_path

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation.law.modal import Law

_CUT_STEP = 1
_COARSE_STEP = 5


class CutStep(RuntimeError):  # noqa: N818 -- what to do, not what went wrong
    """No update at this increment, or none within the stress tolerance; a smaller one may work.

    Attributes
    ----------
    point : int or None
        Which of several points failed first.
    """

    def __init__(self, status: int, point: int | None = None) -> None:
        what = "no update" if status == _CUT_STEP else "no update within the stress tolerance"
        super().__init__(f"{what} at this increment; try a smaller one")
        self.point = point


@dataclass(frozen=True, eq=False)
class MaterialPoint:
    """The law at one or many points, in one dimension and in three.

    Parameters
    ----------
    constants : array_like, shape (constants,)
        In the order of probation/material/constants.hpp; `from_law` makes them.

    Raises
    ------
    InputError
        Naming the constant that cannot be.

    Examples
    --------
    >>> import probation
    >>> law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=1.8)
    >>> point = MaterialPoint.from_law(law, bulk_modulus=2e4)
    >>> stress, tangent, state = point.uniaxial(0.001, 0.2)
    >>> round(stress, 3), round(tangent)
    (2.581, 2581)
    """

    constants: FloatArray

    def __post_init__(self) -> None:
        constants = as_samples(self.constants, "constants").copy()
        constants.flags.writeable = False
        object.__setattr__(self, "constants", constants)
        text = ctypes.create_string_buffer(500)
        if _library().probation_message(_pointer(constants), len(constants), text, len(text)):
            raise InputError(text.value.decode().removeprefix("probation: "))

    @classmethod
    def from_law(
        cls, law: Law, bulk_modulus: float, *, rate_filter: float = 0.0, stress_tolerance: float = 0.0
    ) -> MaterialPoint:
        """The point of a law; arguments as in `probation.exporting.constants.MaterialConstants.of`."""
        return cls(np.array(MaterialConstants.of(law, bulk_modulus, rate_filter, stress_tolerance).values))

    @property
    def state_size(self) -> int:
        """State variables of one point in three dimensions."""
        return int(_library().probation_state_size(_pointer(self.constants), len(self.constants)))

    @property
    def uniaxial_state_size(self) -> int:
        """State variables of one point in one dimension."""
        return int(_library().probation_uniaxial_state_size(_pointer(self.constants), len(self.constants)))

    def uniaxial(
        self, strain_increment: float, dt: float, state: ArrayLike | None = None
    ) -> tuple[float, float, FloatArray]:
        """One increment of true strain.

        Parameters
        ----------
        strain_increment : float [-]
        dt : float [s]
            0: at once.
        state : array_like, shape (uniaxial_state_size,), optional
            At the start of the increment; left out: relaxed and unstrained.

        Returns
        -------
        true_stress : float [MPa]
        tangent : float [MPa]
            d true_stress / d strain_increment.
        state : ndarray, shape (uniaxial_state_size,)

        Raises
        ------
        CutStep
        """
        size = self.uniaxial_state_size
        after = np.zeros(size) if state is None else as_samples(state, "state", size).copy()
        stress, tangent = ctypes.c_double(), ctypes.c_double()
        status = _library().probation_uniaxial(
            _pointer(self.constants),
            len(self.constants),
            as_number(strain_increment, "strain_increment"),
            as_number(dt, "dt"),
            _pointer(after),
            _pointer(after),
            ctypes.byref(stress),
            ctypes.byref(tangent),
        )
        if status:
            raise CutStep(status)
        return stress.value, tangent.value, after

    def first_piola(
        self, deformation_gradient: ArrayLike, dt: float, state: ArrayLike | None = None, *, with_tangent: bool = True
    ) -> tuple[FloatArray, FloatArray | None, FloatArray]:
        """One increment of many points.

        Parameters
        ----------
        deformation_gradient : array_like, shape (points, 3, 3)
            F at the end of the increment.
        dt : float [s]
        state : array_like, shape (points, state_size), optional
            At the start of the increment; left out: relaxed and undeformed.

        Returns
        -------
        stress : ndarray, shape (points, 3, 3) [MPa]
            First Piola-Kirchhoff stress P.
        tangent : ndarray, shape (points, 3, 3, 3, 3) [MPa], or None
            dP / dF.
        state : ndarray, shape (points, state_size)

        Raises
        ------
        CutStep
            With the first point at which there is no update.
        InputError
            For arrays of other shapes.
        """
        f = np.ascontiguousarray(deformation_gradient, dtype=np.float64)
        if f.ndim != 3 or f.shape[1:] != (3, 3):
            raise InputError(f"deformation_gradient has the shape {f.shape}; expected (points, 3, 3)")
        points, size = len(f), self.state_size
        before = np.zeros((points, size)) if state is None else np.ascontiguousarray(state, dtype=np.float64)
        if before.shape != (points, size):
            raise InputError(f"state has the shape {before.shape}; expected {(points, size)}")
        after, stress = np.empty((points, size)), np.empty((points, 3, 3))
        tangent = np.empty((points, 3, 3, 3, 3)) if with_tangent else None
        failed = ctypes.c_int()
        status = _library().probation_first_piola(
            _pointer(self.constants),
            len(self.constants),
            points,
            _pointer(f),
            as_number(dt, "dt"),
            _pointer(before),
            _pointer(after),
            _pointer(stress),
            None if tangent is None else _pointer(tangent),
            ctypes.byref(failed),
        )
        if status in (_CUT_STEP, _COARSE_STEP):
            raise CutStep(status, failed.value)
        assert status == 0  # the constants were checked when this was made
        return stress, tangent, after


def _pointer(array: FloatArray) -> Any:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


@lru_cache(maxsize=1)
def _library() -> ctypes.CDLL:
    try:
        library = ctypes.CDLL(str(library_path()))
    except OSError as error:
        raise InputError(
            f"{library_path()}: found no compiled material point, expected it beside the package ({error}); "
            "install probation by `pip install .` or from a wheel, which bring it"
        ) from None
    array, number, whole = ctypes.POINTER(ctypes.c_double), ctypes.c_double, ctypes.c_int
    library.probation_message.argtypes = [array, whole, ctypes.c_char_p, whole]
    library.probation_state_size.argtypes = [array, whole]
    library.probation_uniaxial_state_size.argtypes = [array, whole]
    library.probation_uniaxial.argtypes = [array, whole, number, number, array, array, array, array]
    library.probation_first_piola.argtypes = [
        *(array, whole, whole, array, number),
        *(array, array, array, array, ctypes.POINTER(whole)),
    ]
    return library
