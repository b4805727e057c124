"""From records to the law's parameters, and what is known about them."""

from probation.identify.fit import fit
from probation.identify.parameter import Parameter, Status
from probation.identify.result import METHODS, Fit, Method, RecordFit

__all__ = ["METHODS", "Fit", "Method", "Parameter", "RecordFit", "Status", "fit"]
