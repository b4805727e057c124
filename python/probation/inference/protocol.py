"""The protocol by which the diagnosis talks to any law."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.law.modification import Modification


class GapLaw(Protocol):
    """A law whose gap to reality is to be diagnosed: it predicts a record, says how that depends on its parameters,
    and what it can follow (its capabilities).

    `DnlrLaw` is the engine's law; `probation.CallableLaw` makes one of a Python function. With
    `threads=N` methods are called in copies of the process.
    """

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of the identified parameters, with their units: what leaves the program."""

    @property
    def start(self) -> FloatArray:
        """Where a search may begin, shape (n_parameters,)."""

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, each of shape (n_parameters,)."""

    @property
    def capabilities(self) -> frozenset[str]:
        """Which fields of `Modification` it can follow; effects that need others are left out for this law."""

    def stress(self, view: RecordView, parameters: FloatArray, modification: Modification | None = None) -> FloatArray:
        """True stress along a record, at the view's instants; shape (n,) [MPa]."""

    def sensitivity(
        self, view: RecordView, parameters: FloatArray, modification: Modification | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """True stress (n,) [MPa] and its derivatives (n, n_parameters)."""
