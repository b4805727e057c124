"""The weights of the modes are not proportional to the root of their times."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.relaxation_spectra import cole_cole, stretched_exponential
from probation.law.modification import Modification, OtherSpectrum

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


_PART = EffectParameter(
    name="part_of_the_modulus",
    unit="",
    lower=0.0,
    upper=1.0,
    scale=0.4,
    reason="some tenths of it: a process in addition to the law's; 1 is another spectrum altogether",
)
_TIME = EffectParameter(
    name="time_over_tau_max",
    unit="",
    lower=1e-5,
    upper=50.0,
    centre=0.1,
    scale=2.5,
    log=True,
    starts=(0.01, 0.5),
    reason="within the decades of the law's own times, or just beyond",
)
_COLE_COLE = EffectParameter(
    name="cole_cole_exponent",
    unit="",
    lower=0.1,
    upper=0.9,
    centre=0.5,
    scale=0.2,
    starts=(0.5,),
    reason="0.3 to 0.7 for the glass transition and the secondary relaxations of polymers",
)
_STRETCH = EffectParameter(
    name="stretching_exponent",
    unit="",
    lower=0.15,
    upper=0.9,
    centre=0.5,
    scale=0.2,
    starts=(0.5,),
    reason="0.3 to 0.7 for polymers about their glass transition",
)


def _weights(view: RecordView, values: Values) -> Modification:
    """p_j proportional to tau_j^(1/2 + a), sum 1."""
    return Modification(weight_exponent=values[0])


def _cole_cole(view: RecordView, values: Values) -> Modification:
    """The part a of E_u relaxes as a fractional Maxwell element, E_c(-(t / t_0)^c), t_0 in units of tau_max."""
    part, time, exponent = values
    return Modification(other_spectrum=OtherSpectrum(part, lambda ratio: cole_cole(ratio / time, exponent)))


def _stretched(view: RecordView, values: Values) -> Modification:
    """The part a of E_u relaxes as exp(-(t / t_0)^b), t_0 in units of tau_max."""
    part, time, exponent = values
    return Modification(other_spectrum=OtherSpectrum(part, lambda ratio: stretched_exponential(ratio / time, exponent)))


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None = None) -> list[tuple[float, ...]]:
    """A fifth of the modulus by a faster process or a slower one, or nearly all of it.

    The slope at none of it leads a search far astray: a part that takes the place of the law's own times needs another
    modulus.
    """
    return [(part, time, 0.5) for part, times in ((0.2, (0.01, 0.5)), (0.9, (0.01, 0.1))) for time in times]


EFFECT = Effect(
    name="spectrum_shape",
    title="another shape of the spectrum",
    physics=(
        "Equipartition of entropy production gives weights that follow the root of the relaxation time, eq. (5).\n"
        "Amplitude: what must be added to the exponent 1/2, positive for more slow modes; or the part of E_u that "
        "relaxes by a Cole-Cole distribution or a stretched exponential instead."
    ),
    source=(
        "André et al., eq. (5); Cunat 2001, Mech. Time-Depend. Mater. 5, 39; Cole & Cole 1941, J. Chem. Phys. 9, 341; "
        "Schiessel et al. 1995, J. Phys. A 28, 6567; Williams & Watts 1970, Trans. Faraday Soc. 66, 80"
    ),
    shows_in="every record with fast and slow parts: onset, rate jumps, dwells",
    kind="material",
    coordinate="log_time",
    forms=(
        Form(
            "power",
            (
                EffectParameter(
                    name="spectrum_exponent_change",
                    unit="",
                    lower=-0.5,
                    upper=1.0,
                    scale=0.1,
                    reason="measured spectra of polymers have slopes of 0.3 to 0.7 in log-log axes",
                ),
            ),
            modification=_weights,
        ),
        *(
            Form(name, (_PART, _TIME, shape), modification=hook, starts=_starts, threshold=True, variant=True)
            for name, shape, hook in (
                ("cole_cole", _COLE_COLE, _cole_cole),
                ("stretched_exponential", _STRETCH, _stretched),
            )
        ),
    ),
)
