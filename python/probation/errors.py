"""What can go wrong, and whose mistake it is."""

from probation._core import ConvergenceError, InputError

__all__ = ["ConvergenceError", "InputError"]
