"""A wave or a slip in a residual is no noise: it is taken out before the noise is estimated.

An ARMA(1,1) has no line in its spectrum. Where a residual has one, the process takes it for noise with a long memory:
a ripple of 0.5 MPa in noise of 0.17 MPa was noise of 0.85 MPa, in which nothing shows. So it does with what is periodic
in the strain: the pitch of a screw, 0.4 MPa in noise of 0.045 MPa, was noise of 0.4 to 1.0 MPa. A slip of 2 MPa, from
which the stress recovers within forty samples, made noise of 0.11 MPa of 0.05.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.detection.hidden_steps import without_hidden_steps
from probation.detection.lines_and_steps import find_lines, without_steps
from probation.detection.strain_periodic import along, find_strain_periodic, shown
from probation.detection.without_lines import without_wave
from probation.noise.estimate import estimate_noise
from probation.noise.whitening import Whitened
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation.noise.evidence import NoiseEvidence
    from probation.noise.record_residual import RecordResidual

    Taken: TypeAlias = "dict[int, RecordResidual]"
    """Records from which something was taken, by index."""


def without_sharp(records: Sequence[RecordResidual]) -> Whitened:
    """The records without certain waves and steps, whitened by the noise that is left.

    They are taken out one by one in every record, as long as that does not raise its noise: a transient has a peak in
    its periodogram, too, and a wave in its place disturbs the rest of the record. Lines in time come first. What is
    periodic in the strain has to lower the noise by much: a part of a gap that is not periodic may look so. Steps come
    last, since teeth that recur are steps, too: first several that hide each other, which has to lower the noise by
    much as well, then single ones.

    Parameters
    ----------
    records : sequence of RecordResidual
    """
    known: dict[RecordResidual, NoiseEvidence] = {}
    whitened = Whitened.of(records, estimate_noise(records, known=known))
    for strongest, most_left in (
        (_lines, 1.0),
        (_strain_periodic, DETECTION.noise_without_strain_period),
        (without_hidden_steps, DETECTION.noise_without_hidden_steps),
        (_steps, 1.0),
    ):
        whitened = _one_by_one(whitened, strongest, most_left, known)
    return whitened


def _one_by_one(
    whitened: Whitened,
    strongest: Callable[[Whitened], Taken],
    most_left: float,
    known: dict[RecordResidual, NoiseEvidence],
) -> Whitened:
    """What leaves no more than a part of its record's noise; a record in which something leaves more stays as it is."""
    refused: set[int] = set()
    for _ in range(DETECTION.most_taken_out):
        taken = {index: record for index, record in strongest(whitened).items() if index not in refused}
        while taken:
            cleaned = [taken.get(index, record) for index, record in enumerate(whitened.records)]
            after = Whitened.of(cleaned, estimate_noise(cleaned, known=known))
            left = {i: after.noises[i].deviation.mean() / whitened.noises[i].deviation.mean() for i in taken}
            raised = {index for index, part in left.items() if part > most_left}
            if not raised:
                break
            refused |= raised
            taken = {index: record for index, record in taken.items() if index not in raised}
        if not taken:
            break
        whitened = after
    return whitened


def _steps(whitened: Whitened) -> Taken:
    """Without the strongest step of each record."""
    return without_steps(whitened, DETECTION.sharp_is_no_noise)


def _lines(whitened: Whitened) -> Taken:
    """Without the strongest line of each record."""
    lines = {line.record: line for line in find_lines(whitened) if line.p_value < DETECTION.sharp_is_no_noise}
    return {
        index: without_wave(whitened, index, record.time, lines[record.name].frequency_Hz)
        for index, record in enumerate(whitened.records)
        if record.name in lines
    }


def _strain_periodic(whitened: Whitened) -> Taken:
    """Without what is most certainly periodic in the strain, in a record by itself or in all; it may grow with stretch.

    Where a record shows it at all: from some periods on, and as many harmonics as its samples resolve.
    """
    found = [each for each in find_strain_periodic(whitened) if each.p_value < DETECTION.sharp_is_no_noise]
    taken: Taken = {}
    for index, record in enumerate(whitened.records):
        most = len(record) // DETECTION.samples_per_harmonic
        for wave in found:
            place = along(wave.coordinate, record.true_strain)
            periods = float(np.ptp(place)) / wave.period
            if most and wave.record in (None, record.name) and shown(np.array([periods]), len(record)).all():
                resolved = int(len(record) / (DETECTION.shortest_harmonic * periods))
                taken[index] = without_wave(
                    whitened,
                    index,
                    place,
                    1.0 / wave.period,
                    harmonics=min(wave.harmonics, resolved),
                    most=most,
                    growth=np.exp(record.true_strain),
                )
                break
    return taken
