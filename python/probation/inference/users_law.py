"""A user's law whose errors name the record and the parameters at which it raised them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from probation.errors import ConvergenceError, InputError

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.law.modification import Modification


@dataclass(frozen=True)
class UsersLaw:
    """Another law as it is, but for its errors; a `ConvergenceError` passes, since a search goes on from it.

    Parameters
    ----------
    law : GapLaw
    """

    law: GapLaw

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """As the law has them."""
        return self.law.parameter_names

    @property
    def start(self) -> FloatArray:
        """As the law has it."""
        return self.law.start

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """As the law has them."""
        return self.law.bounds

    @property
    def capabilities(self) -> frozenset[str]:
        """As the law does."""
        return self.law.capabilities

    def stress(self, view: RecordView, parameters: FloatArray, modification: Modification | None = None) -> FloatArray:
        """True stress along a record, shape (n,) [MPa].

        Raises
        ------
        InputError
            Where the law raises anything: it names the record and the parameters.
        """
        try:
            return self.law.stress(view, parameters, modification)
        except ConvergenceError:
            raise
        except Exception as error:
            raise self._named(error, view, parameters) from error

    def sensitivity(
        self, view: RecordView, parameters: FloatArray, modification: Modification | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """True stress (n,) [MPa] and its derivatives (n, n_parameters); raises as `stress`."""
        try:
            return self.law.sensitivity(view, parameters, modification)
        except ConvergenceError:
            raise
        except Exception as error:
            raise self._named(error, view, parameters) from error

    def _named(self, error: Exception, view: RecordView, parameters: FloatArray) -> InputError:
        values = ", ".join(
            f"{name} = {value:.6g}" for name, value in zip(self.parameter_names, parameters, strict=True)
        )
        what = str(error) if isinstance(error, InputError) else f"{type(error).__name__}: {error}"
        return InputError(f"record {view.id!r}: the law could not be solved at {values}; it raised {what}")
