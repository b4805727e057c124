from . import batch
from ._core import __version__
from .bulk import BulkIdentification, identify_many
from .calibration.calibrate import calibrate_companion
from .calibration.calibrated import CalibratedCompanion
from .calibration.rate_table import RateTable
from .calibration.result import Calibration
from .certificate.certify import certify
from .certificate.result import Certificate
from .comparison.compare import compare
from .comparison.reference import Reference
from .comparison.result import Comparison
from .design.plan import Plan, plan
from .diagnosis.diagnose import diagnose
from .diagnosis.result import Diagnosis
from .errors import ConvergenceError, InputError
from .exporting.exporting import export
from .exporting.result import Export
from .histories import named_history
from .histories.file import read_history
from .histories.imposed import ImposedHistory
from .identify.band import StressBand
from .identify.draws import Draws
from .identify.fit import fit
from .identify.result import Fit
from .inference.callable_law import CallableLaw
from .law.companion import Exponential, PowerLaw, RateFunction, Table, Weissenberg
from .law.creep import creep
from .law.direction import Direction
from .law.history import StrainHistory
from .law.kinematics import haward_thackray_strain
from .law.modal import Law
from .law.modification import (
    InitialStress,
    Modification,
    OtherSpectrum,
    PowerActivation,
    RateShift,
    SelfHeating,
    StressActivation,
)
from .law.ramp import ramp_stress
from .law.schemes import BE2, CVODE, SA2, SA3, Exact
from .law.settings import CompanionSettings, LawSettings
from .law.spectrum import Reduction, Spectrum, reduce_spectrum
from .records.campaign import Campaign
from .records.initial.init_campaign import init_campaign
from .records.preview import preview
from .records.record import Noise, Record
from .records.specimens import Specimens
from .results.labelled import LabelledMatrix
from .schemes.crosscheck import crosscheck
from .schemes.result import CrossCheck
from .simulation import Simulation, simulate
from .smoothing.excitation import Excitation, excite

__all__ = [
    "BE2",
    "CVODE",
    "SA2",
    "SA3",
    "BulkIdentification",
    "CalibratedCompanion",
    "Calibration",
    "CallableLaw",
    "Campaign",
    "Certificate",
    "CompanionSettings",
    "Comparison",
    "ConvergenceError",
    "CrossCheck",
    "Diagnosis",
    "Direction",
    "Draws",
    "Exact",
    "Excitation",
    "Exponential",
    "Export",
    "Fit",
    "ImposedHistory",
    "InitialStress",
    "InputError",
    "LabelledMatrix",
    "Law",
    "LawSettings",
    "Modification",
    "Noise",
    "OtherSpectrum",
    "Plan",
    "PowerActivation",
    "PowerLaw",
    "RateFunction",
    "RateShift",
    "RateTable",
    "Record",
    "Reduction",
    "Reference",
    "SelfHeating",
    "Simulation",
    "Specimens",
    "Spectrum",
    "StrainHistory",
    "StressActivation",
    "StressBand",
    "Table",
    "Weissenberg",
    "__version__",
    "batch",
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
    "init_campaign",
    "named_history",
    "plan",
    "preview",
    "ramp_stress",
    "read_history",
    "reduce_spectrum",
    "simulate",
]
