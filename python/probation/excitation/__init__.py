"""From measured, noisy strain to the strain and rate that drive the law."""

from probation.excitation.excitation import METHODS, Excitation, Method, excite

__all__ = ["METHODS", "Excitation", "Method", "excite"]
