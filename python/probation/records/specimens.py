"""How specimens of one material differ: what a campaign says of it."""

from collections.abc import Mapping
from dataclasses import dataclass

from probation._complaint import quoted, suggestion
from probation.errors import InputError

DEVIATIONS = ("unrelaxed_modulus", "tau", "hardening_modulus", "area", "strain_offset")
"""What may differ: relative, but for the offset of the strain; tau is tau_max or alpha."""

LARGEST_SCATTER = 1.0
"""Largest standard deviation that a campaign may state [-]."""

WAYS = ("estimate", "none")

SPECIMENS_KEYS = ("scatter",)


@dataclass(frozen=True)
class Specimens:
    """How far specimens of one material differ.

    Attributes
    ----------
    scatter : {"estimate", "none"} or dict of str to float
        "estimate": from replicates where there are any, else `specimen_scatter` of the settings. "none": specimens are
        alike but for noise, as in virtual campaigns. A table of standard deviations by name, of `DEVIATIONS`:
        relative for ``unrelaxed_modulus``, ``tau`` (tau_max or alpha), ``hardening_modulus`` and ``area``, strain
        for ``strain_offset``; a name left out has none.

    Raises
    ------
    InputError
        For another word, an unknown name, or a number that is not from 0 to `LARGEST_SCATTER`.
    """

    scatter: str | Mapping[str, float] = "estimate"

    def __post_init__(self) -> None:
        if isinstance(self.scatter, str):
            if self.scatter not in WAYS:
                raise InputError(
                    f"specimens: found scatter = {quoted(self.scatter)}, expected 'estimate', 'none' or a table of "
                    f"standard deviations; {suggestion(self.scatter, WAYS)}"
                )
            return
        if not isinstance(self.scatter, Mapping):
            raise InputError(
                f"specimens: found scatter = {self.scatter!r}, expected 'estimate', 'none' or a table of standard "
                "deviations, as in {'tau': 0.03}"
            )
        for name, value in self.scatter.items():
            if name not in DEVIATIONS:
                raise InputError(f"specimens.scatter: found {quoted(name)}; {suggestion(name, DEVIATIONS)}")
            number = isinstance(value, int | float) and not isinstance(value, bool)
            if not number or not 0.0 <= value <= LARGEST_SCATTER:
                raise InputError(
                    f"specimens.scatter: found {name} = {value!r}, expected a standard deviation from 0 to "
                    f"{LARGEST_SCATTER:g} (3 % is 0.03)"
                )
        object.__setattr__(self, "scatter", {name: float(value) for name, value in self.scatter.items()})

    @property
    def alike(self) -> bool:
        """Whether no deviation is allowed for."""
        return self.scatter == "none" or (
            not isinstance(self.scatter, str) and not any(value > 0.0 for value in self.scatter.values())
        )
