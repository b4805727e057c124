"""Companion relations from records or tables: tau_max identified at several rates, and what is known about it."""

from probation.calibration.calibrate import calibrate_companion
from probation.calibration.calibrated import CalibratedCompanion
from probation.calibration.rate_table import RateTable
from probation.calibration.result import Calibration, Candidate
from probation.calibration.table_2 import TABLE_2

__all__ = ["TABLE_2", "CalibratedCompanion", "Calibration", "Candidate", "RateTable", "calibrate_companion"]
