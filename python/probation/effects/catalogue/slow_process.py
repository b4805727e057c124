"""A relaxation slower than the spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import gamma

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.maxwell_element import maxwell_element
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

REFERENCE_TIME = 100.0
"""Time after a step at which a power of the time has the modulus of its amplitude [s]."""

SHORTEST, LONGEST, FOREVER, PER_DECADE = 0.1, 30.0, 100.0, 3
"""Times of its elements: from a tenth of the shortest step to 30 durations, three a decade; slower ones are one."""

_TIME = EffectParameter(
    name="slow_time_s",
    unit="s",
    lower=1.0,
    upper=1e6,
    centre=1000.0,
    scale=2.0,
    log=True,
    reason="beyond tau_max, minutes to days",
)


def _slow_mode(view: RecordView, values: Values) -> Modification:
    """A Maxwell element in parallel to the spectrum, whose time no rate shifts."""
    return Modification(extra_modulus=(values[0],), extra_relaxation_time=(values[1],))


def _springpot(view: RecordView, values: Values) -> Modification:
    """Stress after a step of the strain that falls as a (t / 100 s)^-b: a spectrum of times as a power of the time.

    Between any two ends of times one element has the modulus and the viscosity that the spectrum has there; one more
    the viscosity of all that is faster, and one the modulus of all that is slower.
    """
    size, power = values
    shortest, longest = SHORTEST * float(np.min(np.diff(view.time))), LONGEST * view.duration
    ends = np.geomspace(shortest, longest, int(np.ceil(PER_DECADE * np.log10(longest / shortest))) + 1)
    slower = ends**-power / gamma(1.0 + power)
    viscosity = ends ** (1.0 - power) / ((1.0 - power) * gamma(power))
    moduli = [viscosity[0] / shortest, *-np.diff(slower), slower[-1]]
    times = [shortest, *np.diff(viscosity) / -np.diff(slower), FOREVER * longest]
    return Modification(
        extra_modulus=size * REFERENCE_TIME**power * np.array(moduli), extra_relaxation_time=np.array(times)
    )


def _network(view: RecordView, values: Values) -> Modification:
    """A neo-Hookean network that relaxes: m times e_HT, of which every part fades with one time (Bergstrom and Boyce).

    Their time shortens with the stress; here it is one number.
    """
    lagging = maxwell_element(view.time, view.haward_thackray_strain, values[1])
    return Modification(added_relaxed_stress=values[0] * lagging)


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Relaxation times of a tenth of the longest record and of all of it [s]."""
    longest = max(view.duration for view in views)
    return [(_TIME.inside(part * longest),) for part in (0.1, 1.0)]


EFFECT = Effect(
    name="slow_process",
    title="a slow process",
    physics=(
        "One more relaxation, slower than the spectrum or broader, and not shifted by the rate (crystals sliding, "
        "say).\n"
        "Amplitude: modulus of that Maxwell element; of a power of the time, the modulus after 100 s; of a "
        "network that relaxes, its G."
    ),
    source=(
        "Na et al. 2007, J. Phys. Chem. B 111, 13206; Boyd 1985, Polymer 26, 1123; Scott Blair 1947 (power of the "
        "time); Schiessel et al. 1995 (as elements); Bergstrom & Boyce 1998, J. Mech. Phys. Solids 46, 931 (a network "
        "that relaxes)"
    ),
    shows_in="slow records and long dwells, against fast records",
    kind="material",
    coordinate="log_time",
    forms=(
        Form(
            "maxwell",
            (
                EffectParameter(
                    "slow_modulus_MPa", "MPa", 0.0, 1000.0, 20.0, "adds some MPa at a strain of some tenths"
                ),
                _TIME,
            ),
            modification=_slow_mode,
            starts=_starts,
        ),
        Form(
            "network",
            (
                EffectParameter("slow_network_MPa", "MPa", 0.0, 200.0, 2.0, "as much as the network that stays, G"),
                _TIME,
            ),
            modification=_network,
            starts=_starts,
            variant=True,
        ),
        Form(
            "springpot",
            (
                EffectParameter(
                    "modulus_at_100_s_MPa", "MPa", 0.0, 1000.0, 20.0, "adds some MPa at a strain of some tenths"
                ),
                EffectParameter(
                    name="power",
                    unit="",
                    lower=0.02,
                    upper=0.95,
                    centre=0.4,
                    scale=0.25,
                    starts=(0.25, 0.6),
                    reason="0 is a spring, 1 a dashpot",
                ),
            ),
            modification=_springpot,
            variant=True,
        ),
    ),
)
