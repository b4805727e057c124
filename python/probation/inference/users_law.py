"""A user's law whose errors name the record and the parameters at which it raised them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.errors import ConvergenceError, InputError
from probation.inference.wrapped_law import WrappedLaw

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.law.modification import Modification


class UsersLaw(WrappedLaw):
    """Another law as it is, but for its errors; a `ConvergenceError` passes, since a search goes on from it."""

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
