"""An effect in one of its forms, placed in records: what may explain a gap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from probation.effects.effect import Effect, Form
from probation.effects.registry import effect as named_effect
from probation.errors import InputError

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.effect import Values


@dataclass(frozen=True)
class Cause:
    """An effect in one form, in all records or in some.

    Attributes
    ----------
    form : Form
        One of the effect's.
    records : tuple of str, or None
        Ids of the records it touches, with one set of parameters; None for all.
    """

    effect: Effect
    form: Form
    records: tuple[str, ...] | None = None

    @property
    def label(self) -> str:
        """The effect's name, with the records that it is confined to: "force_offset[grip-0.02]"."""
        return self.effect.name if self.records is None else f"{self.effect.name}[{','.join(self.records)}]"

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of its parameters within a model: "force_offset[grip-0.02].offset_MPa"."""
        return tuple(f"{self.label}.{parameter.name}" for parameter in self.form.parameters)

    def touches(self, record_id: str) -> bool:
        """Whether it acts in that record."""
        return self.records is None or record_id in self.records

    def log_prior(self, values: Values) -> float:
        """Log density of the prior of its parameters, in their search coordinates."""
        return sum(parameter.log_prior(value) for parameter, value in zip(self.form.parameters, values, strict=True))

    def checked(self, values: Values | FloatArray) -> tuple[float, ...]:
        """Its values as numbers.

        Raises
        ------
        InputError
            If there are too many or too few.
        """
        numbers = tuple(float(value) for value in values)
        if len(numbers) != len(self.form.parameters):
            expected = ", ".join(parameter.name for parameter in self.form.parameters)
            raise InputError(f"{self.label}: found {len(numbers)} values, expected {expected}")
        return numbers


def cause(effect: str | Effect, form: str | Form | None = None, records: str | Sequence[str] | None = None) -> Cause:
    """A cause by name.

    Parameters
    ----------
    effect : str or Effect
    form : str or Form, optional
        The effect's first form if left out.
    records : str or sequence of str, optional
        Ids of the records it is confined to.

    Raises
    ------
    InputError
        For an unknown name, suggesting the nearest.
    """
    resolved = named_effect(effect) if isinstance(effect, str) else effect
    chosen = resolved.forms[0] if form is None else resolved.form(form) if isinstance(form, str) else form
    confined = (records,) if isinstance(records, str) else None if records is None else tuple(records)
    return Cause(resolved, chosen, confined)
