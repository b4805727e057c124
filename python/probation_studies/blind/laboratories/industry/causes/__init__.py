"""Causes of a misfit, each in several forms taken from the literature, and what the catalogue calls them."""

from probation_studies.blind.laboratories.industry.causes.beyond import BEYOND
from probation_studies.blind.laboratories.industry.causes.form import Cause, Form
from probation_studies.blind.laboratories.industry.causes.material import MATERIAL
from probation_studies.blind.laboratories.industry.causes.rig import RIG

CATALOGUE = {
    "network_locking": "finite_extensibility",
    "rate_dependent_flow": "rate_dependent_relaxation",
    "rate_dependent_network": "rate_dependent_hardening",
    "activated_flow": "stress_activated_flow",
    "plastic_heating": "self_heating",
    "ductile_damage": "damage",
    "other_spectrum": "spectrum_shape",
    "rejuvenation": "structural_softening",
    "frame_compliance": "machine_compliance",
    "slack": "strain_offset",
    "bending": "strain_offset",
    "cell_gain": "force_gain",
    "extensometer_scale": "strain_gain",
    "cell_zero": "force_offset",
    "cell_thermal_drift": "force_drift",
    "amplifier_lag": "force_strain_lag",
    "preload": "prestress",
    "grip_slip": "grip_slip",
    "machine_vibration": "periodic_disturbance",
    "mullins": "mullins_softening",
    "kinematic_hardening": "back_stress",
    "cell_hysteresis": "cell_hysteresis",
    "guide_friction": "guide_friction",
    "ageing_between_tests": "change_between_tests",
    "crystallisation": "strain_induced_crystallisation",
}
"""The catalogue's name of a cause: the only thing here that knows of it. What is not listed lies outside."""

UNKNOWN = "unknown"
CAUSES = {cause.name: cause for cause in (*MATERIAL, *RIG, *BEYOND)}


def effect(cause: str) -> str:
    """What an answer should call a cause."""
    return CATALOGUE.get(cause, UNKNOWN)


__all__ = ["CATALOGUE", "CAUSES", "UNKNOWN", "Cause", "Form", "effect"]
