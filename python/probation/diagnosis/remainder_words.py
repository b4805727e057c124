"""A remainder in one sentence that a mechanician can act on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.diagnosis.variables import PHASES
from probation.settings.remainder import REMAINDER
from probation.wording import listed, percent, percentage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.diagnosis.free_function import Dependence, RemainderCurve


def description(
    what: str,
    left_MPa: float,
    noise_MPa: float,
    depends_on: Sequence[Dependence],
    curve: RemainderCurve | None,
    most: float,
) -> str:
    """One sentence.

    Parameters
    ----------
    what : str
        "what is left", or "the gap" where nothing of it is explained.
    left_MPa, noise_MPa : float
    depends_on : sequence of Dependence
    curve : RemainderCurve or None
        Of the first of these.
    most : float
        The most that any function explains.
    """
    size = f"{what[0].upper()}{what[1:]}, {left_MPa:.3g} MPa (noise {noise_MPa:.2g} MPa),"
    if not depends_on or curve is None:
        return (
            f"{size} follows no single variable: a free function of the strain, the rate, the time or what else was "
            f"recorded closes at most {percent(max(most, 0.0))} of it where it was not fitted."
        )
    first, *others = depends_on
    judged = "records left out" if first.judged_on == "records" else "parts of the records left out"
    text = f"{size} is a function of {function_name(first)}, which closes {percent(first.explained)} of it in {judged}"
    text += f": {_size(curve, first.explained)}"
    rivals = [
        function_name(dependence)
        for dependence in others
        if dependence.explained > first.explained - REMAINDER.not_discriminated
    ]
    if rivals:
        text += f"; these records do not distinguish it from a function of {listed(rivals)}"
    return f"{text}."


def function_name(each: Dependence) -> str:
    """Such as "the largest strain so far, on unloading only"."""
    return each.title if each.when is None else f"{each.title}, {PHASES[each.when]}"


def _size(curve: RemainderCurve, explained: float) -> str:
    """Where the function is largest, and how large: "the law, refitted jointly, is up to 12 % above …".

    Not where what is left of it, without what the law's parameters follow, is smaller than what it explains.
    """
    at = int(np.argmax(np.abs(curve.function_y)))
    value = float(curve.function_y[at])
    missing = curve.y[curve.inside]
    if abs(value) < np.sqrt(max(explained, 0.0) * np.mean(missing**2)):
        return "the law's parameters follow most of such a function, so that its course is not known"
    size = f"{percentage(0.01 * abs(value))} %" if curve.unit == "%" else f"{abs(value):.2g} MPa"
    side = "below" if value > 0.0 else "above"
    return f"the law, refitted jointly with it, is up to {size} {side} the measured stress, at {_place(curve, at)}"


def _place(curve: RemainderCurve, at: int) -> str:
    name, bracket, unit = curve.label.partition(" [")
    value = float(curve.function_x[at])
    if not bracket:  # a count or a group
        return f"{name} {value:.0f}"
    if unit.startswith("log₁₀"):
        return f"a strain rate of {10.0**value:.2g} 1/s"
    shown = f"{value:.3g} {unit.rstrip(']')}".removesuffix(" –")
    return f"{name} {shown}" if name[0].isupper() else f"a {name} of {shown}"
