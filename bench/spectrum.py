"""What are the modes of the law? Eqs. (3)-(5), written apart from the engine."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MODES, DECADES = 50, 6.0


def modes() -> tuple[Array, Array]:
    """r_j = tau_j / tau_max, eq. (4), and p_j, eq. (5), fastest mode first."""
    ratio = 10.0 ** (-(MODES - np.arange(1, MODES + 1)) * DECADES / (MODES - 1))
    root = np.sqrt(ratio)
    return ratio, root / root.sum()


def hardening_strain(true_strain: Array) -> Array:
    """e_HT = e^{2 e} - e^{-e}, below eq. (3)."""
    return np.expm1(2.0 * true_strain) - np.expm1(-true_strain)
