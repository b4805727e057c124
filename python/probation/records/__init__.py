"""Records: what laboratories measured, read into MPa, seconds and true strain."""

from probation.records.calibration_settings import CalibrationSettings
from probation.records.campaign import Campaign
from probation.records.preview import Preview, preview
from probation.records.profiles import PROFILES
from probation.records.reading import read_record, read_records
from probation.records.record import Noise, Record
from probation.records.settings import CompanionSettings, LawSettings
from probation.records.strain_history import StrainHistory, read_strain_history

__all__ = [
    "PROFILES",
    "CalibrationSettings",
    "Campaign",
    "CompanionSettings",
    "LawSettings",
    "Noise",
    "Preview",
    "Record",
    "StrainHistory",
    "preview",
    "read_record",
    "read_records",
    "read_strain_history",
]
