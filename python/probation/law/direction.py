"""A direction in which the inputs of the law move, for sensitivities."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation._arrays import as_samples

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False)  # arrays have no single answer to ==
class Direction:
    """A direction in which the inputs of the law move: what a sensitivity is taken along.

    Whatever is left out does not move. Sampled quantities are one number or have the shape (n_times,).

    Parameters
    ----------
    unrelaxed_modulus : array_like [MPa]
    log_relaxation_time : array_like [-]
        Of ln tau_max.
    relaxed_stress : array_like [MPa]
    log_load_bearing_area : array_like [-]
    true_strain : array_like, shape (n_times,) [-]
        Rates (unless the history has its own), tau_max and the relaxed stress move with it.
    strain_rate : array_like, shape (n_times,) [1/s]
        Where the history has its own rates.
    modal_weight, log_relaxation_ratio, initial_modal_stress : array_like, shape (modes,)
    extra_modulus, log_extra_time : array_like, shape (extra modes,)
    feedback : int
        Which feedback's parameter moves by one unit; -1 for none.
    feedback_parameter : int
    """

    unrelaxed_modulus: ArrayLike | None = None
    log_relaxation_time: ArrayLike | None = None
    relaxed_stress: ArrayLike | None = None
    log_load_bearing_area: ArrayLike | None = None
    true_strain: ArrayLike | None = None
    strain_rate: ArrayLike | None = None
    modal_weight: ArrayLike | None = None
    log_relaxation_ratio: ArrayLike | None = None
    initial_modal_stress: ArrayLike | None = None
    extra_modulus: ArrayLike | None = None
    log_extra_time: ArrayLike | None = None
    feedback: int = -1
    feedback_parameter: int = 0

    def _engine(self) -> _core.Direction:
        direction = _core.Direction()
        for name, values in vars(self).items():
            if name.startswith("feedback"):
                setattr(direction, name, values)
            elif values is not None:
                setattr(direction, name, as_samples(np.atleast_1d(values), f"direction.{name}"))
        return direction
