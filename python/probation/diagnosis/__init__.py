"""Diagnosing the sim-to-real gap: where it sits, which effect causes it, how far it shrinks."""

from probation.diagnosis.closure import Closure
from probation.diagnosis.diagnose import diagnose
from probation.diagnosis.result import Diagnosis, Explanation

__all__ = ["Closure", "Diagnosis", "Explanation", "diagnose"]
