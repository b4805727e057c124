"""One rig makes one noise: a record that says otherwise at low frequencies only says that its gap is rough.

Teeth on all of one record are as rough as noise, and a model that grows to hold them makes them vanish. Neighbouring
samples distinguish the two: they scatter by the rig's noise wherever no tooth breaks.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.noise.model import NoiseModel


def of_one_rig(noises: Sequence[NoiseModel]) -> tuple[NoiseModel, ...]:
    """The noises; for one that is larger than all others' though neighbouring samples scatter as theirs, theirs.

    Parameters
    ----------
    noises : sequence of NoiseModel
        Of the records of one rig, each by what its own residual shows.
    """
    return tuple(_believed(each, [other for other in noises if other is not each]) for each in noises)


def _believed(own: NoiseModel, others: list[NoiseModel]) -> NoiseModel:
    if len(others) < NOISE.fewest_other_records or own.white <= 0.0:
        return own
    largest = max(others, key=lambda each: each.sigma)
    scatter = [each.white / own.white for each in others]
    if (
        own.sigma <= NOISE.unlike_others * largest.sigma
        or not 1.0 / NOISE.neighbours_alike <= min(scatter) <= max(scatter) <= NOISE.neighbours_alike
    ):
        return own
    arma = replace(largest.arma, innovation=largest.arma.innovation * own.white / largest.white)
    return replace(
        own,
        arma=arma,
        profile=np.ones(len(own)),
        growth="constant",
        sigma=float(arma.deviation),
        level_variance=largest.level_variance,
        shape_variance=largest.shape_variance,
        source=f"what the other records show ({largest.name}): neighbouring samples scatter alike",
    )
