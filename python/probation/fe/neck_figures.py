"""The numbers that tell a neck, however it was computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def neck_figures(
    nominal_strain: FloatArray,
    nominal_stress: FloatArray,
    centre_strain: FloatArray,
    centre_rate: FloatArray,
    top: int,
    fastest: int,
) -> dict[str, float]:
    """The force maximum, the plateau, the largest rate over the smallest before, and the end.

    Parameters
    ----------
    nominal_strain, nominal_stress : ndarray, shape (increments,) [-], [MPa]
        Grip displacement over the half that is pulled, force over initial area.
    centre_strain, centre_rate : ndarray, shape (increments,) [-], [1/s]
        Of the centre section.
    top, fastest : int
        Increments of the largest force, and of the largest rate of the centre.
    """
    slowest = float(centre_rate[: fastest + 1].min())
    return {
        "largest_nominal_stress_MPa": float(nominal_stress[top]),
        "nominal_strain_at_largest_stress": float(nominal_strain[top]),
        "lowest_nominal_stress_after_MPa": float(nominal_stress[top:].min()),
        "nominal_stress_at_end_MPa": float(nominal_stress[-1]),
        "slowest_centre_rate_per_s": slowest,
        "fastest_centre_rate_per_s": float(centre_rate[fastest]),
        "centre_rate_ratio": float(centre_rate[fastest]) / slowest,
        "centre_strain_at_fastest_rate": float(centre_strain[fastest]),
        "centre_strain_at_end": float(centre_strain[-1]),
        "nominal_strain_at_end": float(nominal_strain[-1]),
        "increments": len(nominal_strain),
    }
