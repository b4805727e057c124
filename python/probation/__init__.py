"""Put a constitutive law on probation."""

from probation._core import __version__
from probation.errors import ConvergenceError, InputError

__all__ = ["ConvergenceError", "InputError", "__version__"]
