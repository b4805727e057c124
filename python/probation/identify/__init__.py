"""From records to the law's parameters, and what is known about them."""

from probation.identify.fit import fit
from probation.identify.parameter import Parameter, Status
from probation.identify.profile import INTERVALS, Intervals, Profile
from probation.identify.result import METHODS, Fit, Method, RecordFit
from probation.identify.weighting import WEIGHTINGS, Weighting

__all__ = [
    "INTERVALS",
    "METHODS",
    "WEIGHTINGS",
    "Fit",
    "Intervals",
    "Method",
    "Parameter",
    "Profile",
    "RecordFit",
    "Status",
    "Weighting",
    "fit",
]
