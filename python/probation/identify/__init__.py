"""From records to the law's parameters, and what is known about them."""

from probation.identify.fit import METHODS, Fit, Method, RecordFit, fit
from probation.identify.parameter import Parameter, Status

__all__ = ["METHODS", "Fit", "Method", "Parameter", "RecordFit", "Status", "fit"]
