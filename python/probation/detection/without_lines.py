"""A line in a residual is no noise: it is taken out before the noise is estimated.

An ARMA(1,1) has no line in its spectrum. Where a residual has one, the process takes it for noise with a long memory:
a ripple of 0.5 MPa in noise of 0.17 MPa was noise of 0.85 MPa, in which nothing shows.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.detection.lines_and_steps import Line, find_lines, fitted_sine, left_by_slow_waves, uneven_power
from probation.noise.estimate import estimate_noise
from probation.noise.whitening import Whitened
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.evidence import NoiseEvidence
    from probation.noise.record_residual import RecordResidual

PLACES = 33
"""Frequencies that are tried within one spacing around a line's."""


def without_lines(records: Sequence[RecordResidual]) -> Whitened:
    """The records without certain lines, whitened by the noise that is left.

    Lines are taken out one by one in every record, as long as that does not raise the noise: a transient has a peak in
    its periodogram, too, and a wave in its place disturbs the rest of the record.

    Parameters
    ----------
    records : sequence of RecordResidual
    """
    known: dict[RecordResidual, NoiseEvidence] = {}
    whitened = Whitened.of(records, estimate_noise(records, known=known))
    for _ in range(DETECTION.most_lines):
        lines = {line.record: line for line in find_lines(whitened) if line.p_value < DETECTION.line_is_no_noise}
        touched = [index for index, record in enumerate(whitened.records) if record.name in lines]
        if not touched:
            break
        cleaned = list(whitened.records)
        for index in touched:
            cleaned[index] = _without(whitened, index, lines[cleaned[index].name])
        after = Whitened.of(cleaned, estimate_noise(cleaned, known=known))
        noises = [(whitened.noises[index], after.noises[index]) for index in touched]
        if any(new.deviation.mean() > old.deviation.mean() for old, new in noises):
            break
        whitened = after
    return whitened


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
        _without(whitened, index, lines[record.name], np.exp(record.true_strain)) if record.name in lines else record
        for index, record in enumerate(whitened.records)
    ]
    return Whitened.of(records, whitened.noises) if lines else whitened


def _without(whitened: Whitened, index: int, line: Line, growth: FloatArray | None = None) -> RecordResidual:
    """A record without a line, the frequency of which is refined; slow waves and the record's own refit are left.

    With a `growth` (n,) the line may be partly in proportion to it.
    """
    record = whitened.records[index]
    left, white = left_by_slow_waves(whitened, index, DETECTION.slowest_line)
    near = line.frequency_Hz + np.linspace(-0.5, 0.5, PLACES) / float(record.time[-1] - record.time[0])
    frequency = near[int(np.argmax(uneven_power(record.time, left, near)))]
    waves, size = fitted_sine(whitened, index, left, white, frequency, growth)
    return replace(record, residual=record.residual - waves @ size)
