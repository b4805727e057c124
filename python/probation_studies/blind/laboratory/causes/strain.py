"""What the recorded strain holds that the specimen did not see."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.trial import Cause

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial


def _toe(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Slack that is taken up softly: the specimen misses a (1 - e^(-e / (k a))), k above 1."""
    reach = shape["reach"] * max(amplitude, 1e-12)
    trial.strain = trial.strain + amplitude * np.expm1(-np.maximum(trial.nominal, 0.0) / reach)


def _frame(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Frame and grips, stiffer the more they are loaded."""
    force = shape["stiffening_MPa"]

    def given_way(nominal_stress: FloatArray) -> FloatArray:
        softer = shape["softness"] / (1.0 + np.abs(nominal_stress) / force)
        return np.asarray(amplitude * nominal_stress * (1.0 + softer))

    trial.compliance = given_way


def _slip(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The grips let go within some samples: a smooth step."""
    instant = shape["instant_of_record"] * trial.elapsed[-1]
    width = shape["width_of_record"] * trial.elapsed[-1]
    away = 1.0 / (1.0 + np.exp(-np.clip((trial.elapsed - instant) / width, -60.0, 60.0)))
    trial.strain = trial.strain - amplitude * (away - away[0])


def _instant(random: Generator, setting: Setting) -> Shape:
    return {
        "instant_of_record": random.uniform(0.08, 0.92),
        "width_of_record": random.uniform(0.7, 1.5) * setting.sample / setting.duration,
    }


CAUSES = (
    Cause(
        "strain_offset",
        0.005,
        lambda r, s: {"reach": r.uniform(1.05, 3.0)},
        strain=_toe,
        placements=("one", "all"),
    ),
    Cause(
        "machine_compliance",
        1e-4,
        lambda r, s: {"softness": r.uniform(0.0, 0.5), "stiffening_MPa": r.uniform(3.0, 20.0)},
        strain=_frame,
        placements=("all", "one"),
        draws=1,
    ),
    Cause("grip_slip", 0.005, _instant, strain=_slip, placements=("one",), localised=True, draws=5),
)
