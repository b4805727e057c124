"""Put a constitutive law on probation."""

from probation._core import __version__
from probation.change import Change, Direction, SelfHeating, StressActivation
from probation.companion import Exponential, PowerLaw, RateFunction, Table, Weissenberg
from probation.creep import creep
from probation.errors import ConvergenceError, InputError
from probation.identify import Fit, fit
from probation.kinematics import haward_thackray_strain
from probation.law import Law, Spectrum
from probation.ramp import ramp_stress
from probation.records import Campaign, Noise, Record, preview

__all__ = [
    "Campaign",
    "Change",
    "ConvergenceError",
    "Direction",
    "Exponential",
    "Fit",
    "InputError",
    "Law",
    "Noise",
    "PowerLaw",
    "RateFunction",
    "Record",
    "SelfHeating",
    "Spectrum",
    "StressActivation",
    "Table",
    "Weissenberg",
    "__version__",
    "creep",
    "fit",
    "haward_thackray_strain",
    "preview",
    "ramp_stress",
]
