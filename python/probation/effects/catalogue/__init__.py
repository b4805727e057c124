"""The effects, one file each: a new one is its file, with an `EFFECT` in it, and its line here."""

from importlib import import_module

from probation.effects.effect import Effect

NAMES = (
    "rate_dependent_relaxation",
    "rate_dependent_hardening",
    "finite_extensibility",
    "spectrum_shape",
    "stress_activated_flow",
    "self_heating",
    "damage",
    "structural_softening",
    "slow_process",
    "delayed_hardening",
    "force_offset",
    "force_drift",
    "force_gain",
    "force_strain_lag",
    "strain_offset",
    "strain_gain",
    "machine_compliance",
    "volume_change",
    "prestress",
    "grip_slip",
    "periodic_disturbance",
    "temperature_drift",
    "force_saturation",
    "temperature_dependence",
    "mullins_softening",
    "back_stress",
    "strain_induced_crystallisation",
    "change_between_tests",
    "cell_hysteresis",
    "slack_strip",
    "neck_triaxiality",
    "serrated_flow",
    "orientation",
    "guide_friction",
    "ageing",
)


def load_effects() -> tuple[Effect, ...]:
    """The effects of this folder, in the order of `NAMES`."""
    return tuple(import_module(f"{__name__}.{name}").EFFECT for name in NAMES)
