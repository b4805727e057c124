"""Put a constitutive law on probation."""

from probation._core import __version__
from probation.bulk import BulkIdentification, identify_many
from probation.calibration import CalibratedCompanion, Calibration, RateTable, calibrate_companion
from probation.certificate import Certificate, certify
from probation.change import Change, Direction, PowerActivation, SelfHeating, StressActivation
from probation.companion import Exponential, PowerLaw, RateFunction, Table, Weissenberg
from probation.comparison import Comparison, Reference, compare
from probation.creep import creep
from probation.crosscheck import CrossCheck, crosscheck
from probation.diagnosis import Diagnosis, diagnose
from probation.errors import ConvergenceError, InputError
from probation.excitation import Excitation, excite
from probation.export import Export, export
from probation.histories import ImposedHistory, named_history
from probation.history_file import read_history
from probation.identify import Fit, fit
from probation.kinematics import haward_thackray_strain
from probation.law import Law, Spectrum
from probation.ramp import ramp_stress
from probation.records import Campaign, Noise, Record, preview
from probation.reduction import Reduction, reduce_spectrum
from probation.simulate import Simulation, simulate

__all__ = [
    "BulkIdentification",
    "CalibratedCompanion",
    "Calibration",
    "Campaign",
    "Certificate",
    "Change",
    "Comparison",
    "ConvergenceError",
    "CrossCheck",
    "Diagnosis",
    "Direction",
    "Excitation",
    "Exponential",
    "Export",
    "Fit",
    "ImposedHistory",
    "InputError",
    "Law",
    "Noise",
    "PowerActivation",
    "PowerLaw",
    "RateFunction",
    "RateTable",
    "Record",
    "Reduction",
    "Reference",
    "SelfHeating",
    "Simulation",
    "Spectrum",
    "StressActivation",
    "Table",
    "Weissenberg",
    "__version__",
    "calibrate_companion",
    "certify",
    "compare",
    "creep",
    "crosscheck",
    "diagnose",
    "excite",
    "export",
    "fit",
    "haward_thackray_strain",
    "identify_many",
    "named_history",
    "preview",
    "ramp_stress",
    "read_history",
    "reduce_spectrum",
    "simulate",
]
