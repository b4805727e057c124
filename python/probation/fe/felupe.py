"""The law as a material of felupe; needs the extra ``fe`` (pip install 'probation[fe]')."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.fe.point import MaterialPoint


def felupe_material(point: MaterialPoint, dt: float) -> Any:
    """A ``felupe.Material`` with the state of `point`, for solid, plane-strain and axisymmetric fields.

    Parameters
    ----------
    dt : float [s]
        Length of the increment; change it between increments with ``material.kwargs["dt"] = …``.

    Returns
    -------
    felupe.Material
        Raises CutStep out of felupe's Newton iteration where there is no update.
    """
    import felupe  # noqa: PLC0415 -- an extra

    def stress(x: list[FloatArray], dt: float) -> list[FloatArray]:
        piola, _, state = point.first_piola(_points(x[0]), dt, _points(x[-1]), with_tangent=False)
        return [_fields(piola, x[0]), _fields(state, x[0])]

    def elasticity(x: list[FloatArray], dt: float) -> list[FloatArray]:
        _, tangent, _ = point.first_piola(_points(x[0]), dt, _points(x[-1]))
        assert tangent is not None
        return [_fields(tangent, x[0])]

    return felupe.Material(stress=stress, elasticity=elasticity, nstatevars=point.state_size, dt=dt)


def _points(field: FloatArray) -> FloatArray:
    """(…, points of a cell, cells) -> (points, …)."""
    return np.ascontiguousarray(np.moveaxis(field.reshape(*field.shape[:-2], -1), -1, 0))


def _fields(values: FloatArray, like: FloatArray) -> FloatArray:
    """(points, …) -> (…, points of a cell, cells)."""
    return np.moveaxis(values, 0, -1).reshape(*values.shape[1:], *like.shape[-2:])
