"""Specimens that differ: what each of them has of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import BaseLaw

USUAL = (0.02, 0.03, 0.03, 0.01, 1e-3)
"""Usual standard deviations: of E_u, tau_max, G and the section, relative, and of the start of the strain [-]."""


@dataclass(frozen=True)
class Own:
    """One specimen's deviations.

    Attributes
    ----------
    parameters : tuple of float
        Of E_u, tau_max and G, relative.
    section : float
        Relative; a larger one carries more force, so that more stress is recorded.
    start : float [-]
        Strain that is recorded before the specimen is strained.
    """

    parameters: tuple[float, float, float] = (0.0, 0.0, 0.0)
    section: float = 0.0
    start: float = 0.0

    def law(self, law: BaseLaw) -> BaseLaw:
        """The specimen's own."""
        for which, relative in enumerate(self.parameters):
            law = law.shifted(which, relative)
        return law


def draw_sizes(random: Generator) -> tuple[float, ...]:
    """Standard deviations of a campaign's specimens, as `USUAL`."""
    return tuple(float(size) for size in np.array(USUAL) * random.uniform(0.4, 1.4, len(USUAL)))


def draw_own(random: Generator, sizes: tuple[float, ...]) -> Own:
    """One specimen."""
    modulus, time, hardening, section, start = np.array(sizes) * random.standard_normal(len(sizes))
    return Own((float(modulus), float(time), float(hardening)), float(section), float(start))
