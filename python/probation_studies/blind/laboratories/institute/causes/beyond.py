"""Causes that catalogues of such effects leave out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.causes.cause import Cause, Change, Form, Shape, shifted

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation_studies.blind.laboratories.institute.modal import FloatArray
    from probation_studies.blind.laboratories.institute.series import Test


def _beside(test: Test, stress: FloatArray) -> Change:
    return Change(stress=lambda own: own + stress[::2])


def _bauwens(test: Test, a: float, shape: Shape) -> Change:
    """A second process of flow in parallel, which stress alone drives."""
    x = test.rate / test.setting.rate / shape["turn"]
    return _beside(test, a * test.setting.flow_stress * np.arcsinh(x) / np.arcsinh(1.0 / shape["turn"]))


def _voigt(test: Test, a: float, shape: Shape) -> Change:
    return _beside(test, a * test.setting.flow_stress * test.rate / test.setting.rate)


def _lai_bakker(test: Test, a: float, shape: Shape) -> Change:
    """On the way back another time runs."""
    return shifted(np.where(test.rate < 0.0, a, 0.0))


def _deep_return(test: Test, a: float, shape: Shape) -> Change:
    """The further below its largest strain, the slower."""
    missing = test.largest - test.strain
    return shifted(-a * np.expm1(-missing * test.setting.modulus / (shape["width"] * test.setting.flow_stress)))


def _structure(test: Test, step: Callable[[float, float, float], float]) -> FloatArray:
    """A number of the structure, 1 at rest, by steps of time over the recovery's and of strain."""
    found = np.ones(len(test.time))
    recovery = np.diff(test.time) / (10.0 * test.setting.time)
    strain = np.abs(np.diff(test.strain))
    for n in range(len(strain)):
        found[n + 1] = step(float(found[n]), float(recovery[n]), float(strain[n]))
    return found


def _moore(test: Test, a: float, shape: Shape) -> Change:
    """S' = (1 - s)/T - k s |eps'|: built up in time, broken by strain."""
    strain = shape["strain"]

    def step(s: float, time: float, moved: float) -> float:
        speed = time + moved / strain
        return float(s * np.exp(-speed) + time * -np.expm1(-speed) / speed)

    return shifted(a * _structure(test, step))


def _coussot(test: Test, a: float, shape: Shape) -> Change:
    """S' = 1/T - k s |eps'|: no bound at rest; ln(tau_max) goes with ln(1 + s)."""
    strain = shape["strain"]
    found = _structure(test, lambda s, time, moved: float((s + time) * np.exp(-moved / strain)))
    return shifted(a * np.log1p(found))


BEYOND = (
    Cause(
        "second process of flow", 0.05, 0.8,
        (Form("Bauwens-Crowet 1973", _bauwens, {"turn": (0.01, 0.3)}), Form("Voigt 1892", _voigt)),
    ),
    Cause(
        "another time on the way back", 0.3, 3.0,
        (Form("Lai and Bakker 1995", _lai_bakker), Form("by the distance", _deep_return, {"width": (0.3, 2.0)})),
        signed=True, needs="cycles",
    ),
    Cause(
        "structure that rests and breaks", 0.3, 3.0,
        (
            Form("Moore 1959", _moore, {"strain": (0.03, 0.3)}),
            Form("Coussot 2002", _coussot, {"strain": (0.05, 0.5)}),
        ),
    ),
)  # fmt: skip
