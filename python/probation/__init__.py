"""Put a constitutive law on probation."""

from probation._core import __version__
from probation.change import Change, Direction, SelfHeating, StressActivation
from probation.companion import Exponential, PowerLaw, RateFunction, Table, Weissenberg
from probation.creep import creep
from probation.crosscheck import CrossCheck, crosscheck
from probation.errors import ConvergenceError, InputError
from probation.histories import ImposedHistory, named_history
from probation.history_file import read_history
from probation.kinematics import haward_thackray_strain
from probation.law import Law, Spectrum
from probation.ramp import ramp_stress
from probation.simulate import Simulation, simulate

__all__ = [
    "Change",
    "ConvergenceError",
    "CrossCheck",
    "Direction",
    "Exponential",
    "ImposedHistory",
    "InputError",
    "Law",
    "PowerLaw",
    "RateFunction",
    "SelfHeating",
    "Simulation",
    "Spectrum",
    "StressActivation",
    "Table",
    "Weissenberg",
    "__version__",
    "creep",
    "crosscheck",
    "haward_thackray_strain",
    "named_history",
    "ramp_stress",
    "read_history",
    "simulate",
]
