"""What a catalogue calls this institute's causes: all that it knows of that."""

NAMES = {
    "flow of other rates": "rate_dependent_relaxation",
    "activation by stress": "stress_activated_flow",
    "heat of deformation": "self_heating",
    "temperature of the chamber": "temperature_dependence",
    "chamber that warms": "temperature_drift",
    "rejuvenation of an aged polymer": "structural_softening",
    "other weights of the spectrum": "spectrum_shape",
    "process beyond the spectrum": "slow_process",
    "kinematic hardening": "back_stress",
    "modulus that grows with orientation": "orientation",
    "stress of clamping": "prestress",
    "storage between tests": "change_between_tests",
    "hardening of other rates": "rate_dependent_hardening",
    "chains of limited length": "finite_extensibility",
    "network that comes late": "delayed_hardening",
    "crystals by stretching": "strain_induced_crystallisation",
    "loss of section that carries": "damage",
    "softening below the largest strain": "mullins_softening",
    "neck across the section": "neck_triaxiality",
    "jerky flow": "serrated_flow",
    "volume that grows": "volume_change",
    "strip that buckles": "slack_strip",
    "zero of the cell": "force_offset",
    "drift of the cell": "force_drift",
    "gain of the cell": "force_gain",
    "channels apart in time": "force_strain_lag",
    "end of the amplifier's range": "force_saturation",
    "friction in the cell": "cell_hysteresis",
    "hum": "periodic_disturbance",
    "zero of the strain": "strain_offset",
    "wrong gauge length": "strain_gain",
    "stiffness of the frame": "machine_compliance",
    "slip": "grip_slip",
}
"""A cause that is not here lies outside: "unknown"."""

UNKNOWN = "unknown"


def name_of(cause: str) -> str:
    """By which a cause goes."""
    return NAMES.get(cause, UNKNOWN)
