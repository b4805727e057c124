"""From measured, noisy strain to the strain and rate that drive the law."""

from probation.excitation.excitation import Excitation, excite
from probation.excitation.methods import DEFAULT, METHODS, Method

__all__ = ["DEFAULT", "METHODS", "Excitation", "Method", "excite"]
