"""What the extensometer, the pictures and the frame do to the strain."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.causes.cause import Cause, Change, Form, Shape
from probation_studies.blind.laboratories.institute.modal import Course, FloatArray, plain

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation_studies.blind.laboratories.institute.series import Test


def of_strain(added: Callable[[FloatArray, FloatArray], FloatArray]) -> Change:
    """Adds to the strain what depends on strain and force."""
    return Change(channels=lambda strain, force: (strain + added(strain, force), force))


def _missed_zero(test: Test, a: float, shape: Shape) -> Change:
    return of_strain(lambda strain, force: np.full_like(strain, a))


def _taken_up(test: Test, a: float, shape: Shape) -> Change:
    """Slack that is taken up as the force grows (toe of ISO 527-1)."""
    load = shape["load"] * test.setting.flow_stress
    return of_strain(lambda strain, force: -a * np.expm1(-np.maximum(force, 0.0) / load))


def _wrong_gauge(test: Test, a: float, shape: Shape) -> Change:
    """The gauge length is not what was typed in (ISO 9513)."""
    return of_strain(lambda strain, force: np.log1p((1.0 + a) * np.expm1(strain)) - strain)


def _arms(test: Test, a: float, shape: Shape) -> Change:
    """Arms of the extensometer swing on an arc: the gain changes with the opening."""
    most = np.expm1(test.setting.reach)
    return of_strain(lambda strain, force: np.log1p(np.expm1(strain) * (1.0 + a * np.expm1(strain) / most)) - strain)


def _out_of_plane(test: Test, a: float, shape: Shape) -> Change:
    """A single camera: the face goes back as the specimen gets thinner, and the picture shrinks (Sutton 2008)."""
    return of_strain(lambda strain, force: a * np.expm1(-0.5 * strain))


def _camera_warms(test: Test, a: float, shape: Shape) -> Change:
    """A camera that warms stretches its pictures (Ma 2012)."""
    x = np.maximum(test.time[::2], 0.0) / test.time[-1]
    return of_strain(lambda strain, force: -a * np.expm1(-x / shape["part"]))


def _spring(test: Test, a: float, shape: Shape) -> Change:
    """Travel that was corrected with a wrong stiffness of the frame; `a` is the strain at the flow stress."""
    return of_strain(lambda strain, force: a * force / test.setting.flow_stress)


def _hertz(test: Test, a: float, shape: Shape) -> Change:
    """Spring and contacts in series: a part goes with the power 2/3 of the force (Hertz 1882)."""

    def added(strain: FloatArray, force: FloatArray) -> FloatArray:
        x = force / test.setting.flow_stress
        return np.asarray(a * ((1.0 - shape["contact"]) * x + shape["contact"] * np.sign(x) * np.abs(x) ** (2.0 / 3.0)))

    return of_strain(added)


def _slips(test: Test, at: float, width: float) -> FloatArray:
    """From 0 to 1 at a part of the record, on the grid."""
    x = np.maximum(test.time, 0.0) / test.time[-1]
    return np.asarray(np.clip((x - at) / width, 0.0, 1.0))


def _specimen_slips(test: Test, a: float, shape: Shape) -> Change:
    """The specimen slips out of a grip: travel goes on, the specimen's strain falls behind."""
    course_strain = test.strain - a * _slips(test, shape["at"], shape["width"])

    def course(before: Course) -> Course:
        slipped = plain(test.polymer, test.time, course_strain)
        own = test.course
        return replace(
            before,
            strain=before.strain + slipped.strain - own.strain,
            log_time=before.log_time + slipped.log_time - own.log_time,
            relaxed=before.relaxed + slipped.relaxed - own.relaxed,
        )

    return Change(
        course=course,
        channels=lambda strain, force: (strain, force * np.exp(test.strain - course_strain)[::2]),
    )


def _edge_slips(test: Test, a: float, shape: Shape) -> Change:
    """A knife edge of the extensometer jumps on the specimen."""
    step = _slips(test, shape["at"], 1e-9)[::2]
    return of_strain(lambda strain, force: -a * step)


_SLIP = {"at": (0.1, 0.8), "width": (0.01, 0.1)}
STRAIN = (
    Cause(
        "zero of the strain", 1e-3, 0.08,
        (
            Form("missed zero", _missed_zero),
            Form("slack taken up", _taken_up, {"load": (0.02, 0.2)}),
            Form("camera that warms", _camera_warms, {"part": (0.05, 0.6)}),
        ),
        rig=True, signed=True,
    ),
    Cause(
        "wrong gauge length", 0.02, 0.4,
        (Form("wrong length", _wrong_gauge), Form("arms on an arc", _arms), Form("out of plane", _out_of_plane)),
        rig=True, signed=True,
    ),
    Cause(
        "stiffness of the frame", 2e-3, 0.15,
        (Form("spring", _spring), Form("Hertz 1882", _hertz, {"contact": (0.1, 0.5)})), rig=True,
    ),
    Cause(
        "slip", 4e-3, 0.1,
        (Form("out of the grip", _specimen_slips, _SLIP), Form("of a knife edge", _edge_slips, {"at": (0.1, 0.8)})),
        rig=True,
    ),
)  # fmt: skip
