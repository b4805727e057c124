"""A law that stands on another one: what its parameters are and what it can follow is the other's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.protocol import GapLaw


class WrappedLaw:
    """Base of a `GapLaw` that adds to the stress, or to the errors, of another.

    Parameters
    ----------
    law : GapLaw
    """

    def __init__(self, law: GapLaw) -> None:
        self.law = law

    def around(self, law: GapLaw) -> Self:
        """The same around another law."""
        return type(self)(law)

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of the identified parameters, with their units."""
        return self.law.parameter_names

    @property
    def start(self) -> FloatArray:
        """Where a search may begin, shape (n_parameters,)."""
        return self.law.start

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, each of shape (n_parameters,)."""
        return self.law.bounds

    @property
    def capabilities(self) -> frozenset[str]:
        """Which fields of `Modification` it can follow."""
        return self.law.capabilities
