"""Put a constitutive law on probation."""

from probation._core import __version__
from probation.change import Change, Direction, SelfHeating, StressActivation
from probation.companion import Exponential, PowerLaw, RateFunction, Table, Weissenberg
from probation.creep import creep
from probation.errors import ConvergenceError, InputError
from probation.kinematics import haward_thackray_strain
from probation.law import Law, Spectrum
from probation.ramp import ramp_stress

__all__ = [
    "Change",
    "ConvergenceError",
    "Direction",
    "Exponential",
    "InputError",
    "Law",
    "PowerLaw",
    "RateFunction",
    "SelfHeating",
    "Spectrum",
    "StressActivation",
    "Table",
    "Weissenberg",
    "__version__",
    "creep",
    "haward_thackray_strain",
    "ramp_stress",
]
