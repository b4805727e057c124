"""The probation test: whether a law is intrinsic to its material."""

from probation.certificate.certify import TOLERANCE, certify
from probation.certificate.consistency import Consistency, Estimate
from probation.certificate.hardening import HardeningRegression, regress_hardening
from probation.certificate.prediction import Prediction
from probation.certificate.result import Certificate

__all__ = [
    "TOLERANCE",
    "Certificate",
    "Consistency",
    "Estimate",
    "HardeningRegression",
    "Prediction",
    "certify",
    "regress_hardening",
]
