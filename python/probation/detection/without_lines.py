"""Records without a wave: of one frequency in time, or periodic in the strain."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.detection.lines_and_steps import find_lines, fitted_waves, left_by_slow_waves, uneven_power
from probation.noise.whitening import Whitened
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.record_residual import RecordResidual

PLACES = 33
"""Frequencies that are tried within one spacing around a wave's."""


def without_one_line_each(whitened: Whitened, level: float) -> Whitened:
    """The same noise, and of every record what its strongest line in time leaves, where its p-value is below a level.

    Its size may grow or fall with the stretch: what is constant in force does.

    Parameters
    ----------
    whitened : Whitened
    level : float
    """
    lines = {line.record: line for line in find_lines(whitened) if line.p_value < level}
    records = [
        without_wave(whitened, index, record.time, lines[record.name].frequency_Hz, growth=np.exp(record.true_strain))
        if record.name in lines
        else record
        for index, record in enumerate(whitened.records)
    ]
    return Whitened.of(records, whitened.noises) if lines else whitened


def without_wave(
    whitened: Whitened,
    index: int,
    place: FloatArray,
    frequency: float,
    *,
    harmonics: int = 1,
    most: int = 1,
    growth: FloatArray | None = None,
) -> RecordResidual:
    """A record without a wave, the frequency of which is refined; slow waves and the record's own refit are left.

    Parameters
    ----------
    whitened : Whitened
    index : int
        The record's.
    place : ndarray, shape (n,)
        Time or strain.
    frequency : float
        Over that.
    harmonics : int
        So many it has, itself among them.
    most : int
        So many of them are taken out at most, the strongest.
    growth : ndarray, shape (n,), optional
        The wave may be partly in proportion to it.
    """
    record = whitened.records[index]
    left, white = left_by_slow_waves(whitened, index, DETECTION.slowest_line)
    near = frequency + np.linspace(-0.5, 0.5, PLACES) / float(np.ptp(place))
    orders = np.arange(1, harmonics + 1)
    power = np.array([uneven_power(place, left, order * near) for order in orders])
    best = int(np.argmax(power.sum(axis=0)))
    strongest = orders[np.argsort(-power[:, best])[:most]]
    phases = 2.0 * np.pi * near[best] * np.outer(place, strongest)
    waves, size = fitted_waves(whitened, index, left, white, phases, growth)
    return replace(record, residual=record.residual - waves @ size)
