"""What is to be exported: a law, and what a finite-element code needs in addition."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.law.answer import law_answer
from probation.law.spectrum import Reduction, Spectrum, reduce_spectrum

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.law.modal import Law

TYPICAL_WEISSENBERG = 0.03
"""Where a law with a constant tau_max is looked at: near the paper's We [-]."""

BULK_TO_SHEAR = 100.0
"""Bulk modulus, where none is given, over the shear modulus E_u / 3: Poisson's ratio 0.495 [-]."""


@dataclass(frozen=True)
class Request:
    """What is to be exported.

    Attributes
    ----------
    law : Law
        With the modes that are written.
    original : Law
        As identified.
    source : str
        Where it comes from, in words.
    name : str
        Of the material: letters, digits, underscores.
    rate : float or None
        At which a linear part is taken [1/s].
    rates : tuple of float or None
        Of tables and checks, increasing [1/s].
    strain : float
        Largest true strain of tables and checks [-].
    bulk_modulus : float
        [MPa].
    density : float
        [t/mm3]; codes of explicit dynamics want it.
    stress_tolerance : float
        [MPa]; 0: increments are not asked to be smaller.
    reduction : Reduction or None
        Fewer modes than the original's.
    """

    law: Law
    original: Law
    source: str
    name: str
    rate: float | None
    rates: tuple[float, ...] | None
    strain: float
    bulk_modulus: float
    density: float
    stress_tolerance: float = 0.0
    reduction: Reduction | None = None

    def __post_init__(self) -> None:
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,39}", self.name):
            raise InputError(
                f"name: found {self.name!r}, expected a letter, then at most 39 letters, digits and underscores"
            )
        for name in ("strain", "bulk_modulus", "density", "rate"):
            value = getattr(self, name)
            if value is not None and not (np.isfinite(value) and value > 0.0):
                raise InputError(f"{name}: found {value}, expected a positive number")
        if not (np.isfinite(self.stress_tolerance) and self.stress_tolerance >= 0.0):
            raise InputError(f"stress_tolerance: found {self.stress_tolerance}, expected a number of at least 0")
        if self.rates is not None:
            if not self.rates or not all(np.isfinite(rate) and rate > 0.0 for rate in self.rates):
                raise InputError(f"rates: found {list(self.rates)}, expected positive numbers")
            if list(self.rates) != sorted(set(self.rates)):
                raise InputError(f"rates: found {list(self.rates)}, expected them increasing, none twice")

    def with_fewer_modes(self, *, accuracy: float | None = None, modes: int | None = None) -> Request:
        """The same with the kernel refitted."""
        assert self.original.spectrum is not None
        reduction = reduce_spectrum(self.original.spectrum, accuracy=accuracy, modes=modes)
        if reduction.spectrum is self.original.spectrum:
            return self
        return replace(self, law=replace(self.original, spectrum=reduction.spectrum), reduction=reduction)

    @property
    def check_rates(self) -> FloatArray:
        """Strain rates at which the round trip is made [1/s]."""
        if self.rates is not None:
            return np.array(self.rates)
        if self.law.companion is None:
            assert self.law.tau_max is not None
            return TYPICAL_WEISSENBERG / self.law.tau_max * np.array([0.1, 1.0, 10.0])
        low, high = self.law.companion.calibrated or (1e-4, 1e-2)
        return np.geomspace(low, high, 3) if high > low else np.array([low])

    def lines(self) -> list[str]:
        """The law in words, for a header."""
        answer = law_answer(self.original)
        parameters = ", ".join(f"{key} = {value:.6g}" for key, value in answer["parameters"].items())
        relation = answer["companion"]
        lines = [
            f"law: the modal (DNLR) law, {parameters}",
            "tau_max: "
            + (
                "constant"
                if relation is None
                else "alpha times the companion relation "
                + ", ".join(f"{key} = {_short(value)}" for key, value in relation.items() if value is not None)
            ),
            self._modes(),
            "units: MPa, s, mm, t",
        ]
        return [f"source: {self.source}", *lines]

    def _modes(self) -> str:
        law = self.original
        if law.spectrum == Spectrum.log_spaced(law.modes, law.decades):
            words = f"modes: {law.modes} over {law.decades:g} decades"
        else:
            words = f"modes: {law.modes}, identified with a spectrum of its own"
        return words if self.reduction is None else f"{words}; written with fewer: {self.reduction.summary()}"


def _short(value: object) -> str:
    if isinstance(value, tuple):
        return "[" + ", ".join(f"{entry:.6g}" for entry in value[:6]) + (", ..." if len(value) > 6 else "") + "]"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
