"""What this laboratory's causes are called in the catalogue of effects: all that it knows of that."""

CATALOGUE_NAMES = {
    "rate-dependent flow": "rate_dependent_relaxation",
    "stress-activated flow": "stress_activated_flow",
    "self-heating": "self_heating",
    "yield softening": "structural_softening",
    "another spectrum": "spectrum_shape",
    "slow process": "slow_process",
    "ageing during the test": "ageing",
    "limited chains": "finite_extensibility",
    "rate-dependent hardening": "rate_dependent_hardening",
    "delayed hardening": "delayed_hardening",
    "damage": "damage",
    "Mullins softening": "mullins_softening",
    "compliance": "machine_compliance",
    "slack": "strain_offset",
    "missed zero of strain": "strain_offset",
    "gain of the load cell": "force_gain",
    "offset of the load cell": "force_offset",
    "drift of the load cell": "force_drift",
    "lag of the load cell": "force_strain_lag",
    "prestress of clamping": "prestress",
    "slip in a grip": "grip_slip",
    "hum of the mains": "periodic_disturbance",
}
"""A cause that is not here lies outside: "unknown"."""

UNKNOWN = "unknown"


def catalogue_name(cause: str) -> str:
    """By which a cause goes."""
    return CATALOGUE_NAMES.get(cause, UNKNOWN)
