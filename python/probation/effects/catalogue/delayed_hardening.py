"""The network builds up late."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.maxwell_element import maxwell_element, maxwell_element_in_strain
from probation.effects.record_view import largest_strain_of
from probation.law.kinematics import haward_thackray_strain
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_BUILT_AT = EffectParameter(
    name="fibril_strain",
    unit="",
    lower=0.02,
    upper=1.0,
    centre=0.3,
    scale=0.7,
    log=True,
    reason="fibrils form within some tenths of strain after yield",
)
_SHARPNESS = EffectParameter(
    name="transition_exponent",
    unit="",
    lower=1.0,
    upper=8.0,
    centre=2.5,
    scale=0.5,
    log=True,
    reason="from a rate that begins at once to a step; 2 to 4 are transformations whose nuclei grow",
)

SMALL = 1e-9
"""e_HT [-] below which the hardening is zero to rounding."""

_LAGS = (0.03, 0.15, 0.6)
"""Lags [true strain] from which searches begin: a lag of some tenths is not what a small one is."""

_TIME = EffectParameter(
    name="build_up_time_s",
    unit="s",
    lower=0.01,
    upper=1e6,
    centre=100.0,
    scale=2.0,
    log=True,
    reason="between the time of a yield and that of a whole test",
)


def _lag(view: RecordView, time_constant: float) -> FloatArray:
    """Part of e_HT that is not yet there when it builds up with a time constant; 0 where e_HT is zero to rounding."""
    strain = view.haward_thackray_strain
    return _part_of(maxwell_element(view.time, strain, time_constant), strain)


def _part_of(missing: FloatArray, strain: FloatArray) -> FloatArray:
    """What is missing as a part of e_HT."""
    return np.divide(missing, strain, out=np.zeros(len(strain)), where=np.abs(strain) > SMALL)


def _whole(view: RecordView, values: Values) -> Modification | None:
    """All of G e_HT lags by a first-order delay of a."""
    if values[0] <= 0.0:
        return None
    return Modification(hardening_factor=1.0 - _lag(view, values[0]))


def _part(view: RecordView, values: Values) -> Modification:
    """The part a of G e_HT lags, the rest is there at once."""
    return Modification(hardening_factor=1.0 - values[0] * _lag(view, values[1]))


def _in_strain(view: RecordView, values: Values) -> Modification | None:
    """All of G e_HT lags by a strain of a: what lacks is made up for by straining further, not by waiting."""
    if values[0] <= 0.0:
        return None
    largest = view.largest_strain
    strain = haward_thackray_strain(largest)
    missing = maxwell_element_in_strain(largest, strain, values[0])
    return Modification(hardening_factor=1.0 - _part_of(missing, strain))


def _built(view: RecordView, values: Values) -> Modification:
    """The part a of G is built with the fibrils, as 1 - e^(-(e/e_c)^n), e the largest strain so far."""
    return Modification(hardening_factor=1.0 - values[0] * np.exp(-((view.largest_strain / values[1]) ** values[2])))


def _in_time(view: RecordView, values: Values) -> Modification:
    """The part a of G is built in the course of the test, as 1 - e^(-(t/t_c)^n): nuclei form and grow (Avrami)."""
    return Modification(hardening_factor=1.0 - values[0] * np.exp(-((view.elapsed / values[1]) ** values[2])))


def _starts_in_time(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Build-up times of 10 and 50 % of the shortest record and of 20 % of the longest [s]."""
    durations = [view.duration for view in views]
    times = 0.1 * min(durations), 0.5 * min(durations), 0.2 * max(durations)
    return [(_TIME.inside(time), _SHARPNESS.centre) for time in times]


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Build-up times of 3 and 30 % of the longest record [s]."""
    longest = max(view.duration for view in views)
    return [(_TIME.inside(part * longest),) for part in (0.03, 0.3)]


def _starts_of_transition(
    views: Sequence[RecordView], residuals: Sequence[FloatArray] | None
) -> list[tuple[float, ...]]:
    """Built about at 35 and 65 % of the largest true strain."""
    largest = largest_strain_of(views)
    return [(_BUILT_AT.inside(part * largest), _SHARPNESS.centre) for part in (0.35, 0.65)]


EFFECT = Effect(
    name="delayed_hardening",
    title="delayed hardening",
    physics=(
        "The fibrillar network forms in time, or with further strain, not at once: the relaxed stress lags.\n"
        "Amplitude: the lag of all of it in time or in strain, or the part of it that lags in time, or is built with "
        "the fibrils."
    ),
    source=(
        "André et al., section 4 (G changes 'only in a delayed manner'); Farge et al. 2015; in strain: Armstrong & "
        "Frederick 1966 (reprinted 2007, Mater. High Temp. 24, 1); from spherulites to fibrils: Peterlin 1971, J. "
        "Mater. Sci. 6, 490; Weibull 1951 (over a range of strains); Avrami 1939, J. Chem. "
        "Phys. 7, 1103 (in the course of time)"
    ),
    shows_in="fast records, dwells after large strains, unloading",
    kind="material",
    forms=(
        Form(
            "whole",
            (
                EffectParameter(
                    "lag_s", "s", 0.0, 1e4, 20.0, "a strain of some hundredths at usual rates (1e-3 to 1e-2 1/s)"
                ),
            ),
            modification=_whole,
        ),
        Form(
            "part",
            (EffectParameter("lagging_part", "", 0.0, 1.0, 0.3, "some tenths of the network"), _TIME),
            modification=_part,
            starts=_starts,
        ),
        Form(
            "in_strain",
            (
                EffectParameter(
                    "lag_strain", "", 0.0, 2.0, 0.2, "fibrils form within some tenths of strain after yield"
                ),
            ),
            modification=_in_strain,
            threshold=True,
            starts=lambda _views, _residuals: [(lag,) for lag in _LAGS],
        ),
        Form(
            "transition",
            (
                EffectParameter("late_part", "", 0.0, 1.0, 0.3, "some tenths of the network"),
                _BUILT_AT,
                _SHARPNESS,
            ),
            modification=_built,
            starts=_starts_of_transition,
            variant=True,
        ),
        Form(
            "in_time",
            (EffectParameter("late_part", "", 0.0, 1.0, 0.3, "some tenths of the network"), _TIME, _SHARPNESS),
            modification=_in_time,
            starts=_starts_in_time,
            variant=True,
        ),
    ),
)
