"""How it shows that a law cannot be solved with some cause."""

from __future__ import annotations

UNSOLVABLE = (ArithmeticError, RuntimeError, ValueError)
"""Errors of a solve and of an effect's own functions; `ConvergenceError` and `InputError` are among them."""
