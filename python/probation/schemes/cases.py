"""What the schemes are compared on: the embedded synthetic data, or the records of a campaign."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.histories.necking import NECKING_SETS
from probation.law.history import StrainHistory
from probation.law.modal import Law
from probation.provenance import samples_sha256
from probation.published.experiments import GRIP_LAWS, experiment, necking_history
from probation.schemes.candidates import StrainPath
from probation.schemes.smooth import RampHistory, SmoothHistory

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.records.record import Record

_FINER = 50
"""Steps of the reference in one of the record."""


@dataclass(frozen=True, eq=False)
class Case:
    """One record on which the schemes are compared.

    Attributes
    ----------
    reference : ndarray, shape (n_times,) [MPa]
    reference_name : str
        For people.
    smooth : SmoothHistory or None
        Where to observe the order; None: not for this record.
    """

    name: str
    law: Law
    path: StrainPath
    reference: FloatArray
    reference_name: str
    smooth: SmoothHistory | None
    smooth_name: str
    data_sha256: str


def twin_case(number: Literal[1, 3]) -> Case:
    """The synthetic record of experiment 1 (a ramp, constant tau_max) or 3 (necking, companion relation (11))."""
    twin = experiment(number)
    if number == 1:
        rate = float(twin.true_strain[-1] / twin.time[-1])
        path = StrainPath(twin.time, twin.true_strain, ramp_rate=rate)
        reference = twin.truth.stress(twin.time, twin.true_strain, "exact")
        smooth: SmoothHistory = RampHistory(rate, float(twin.time[-1]))
        named = "exact", f"ramp at {rate:g} 1/s"
    else:
        smooth = necking_history(number)
        path = StrainPath(twin.time, twin.true_strain, twin.strain_rate, smooth=True)
        fine = np.linspace(0.0, smooth.duration, _FINER * (len(twin.time) - 1) + 1)
        reference = GRIP_LAWS[number].stress(StrainHistory(fine, smooth.true_strain(fine), jumps=None), scheme="exact")[
            ::_FINER
        ]
        named = f"exact on {_FINER} times finer a grid", "necking (A-1)"
    sha256 = samples_sha256(twin.time, twin.true_strain)
    return Case(twin.name, twin.truth, path, reference, named[0], smooth, named[1], sha256)


def record_case(record: Record, law: Law, *, with_steps: bool) -> Case:
    """A record; with steps, the order is observed on a necking history of its duration and largest strain."""
    path = StrainPath(record.time - record.time[0], record.true_strain, record.strain_rate)
    reference = law.stress(StrainHistory(path.time, path.true_strain, strain_rate=path.strain_rate), scheme="exact")
    smooth = None
    if with_steps:
        plain = NECKING_SETS["P2"]
        stretched = plain.slowed(float(path.time[-1]) / plain.duration)
        reach = float(np.ptp(record.true_strain)) / float(stretched.true_strain([stretched.duration])[0])
        smooth = replace(stretched, b=stretched.b * reach)
    named = "exact, for the samples as recorded", "necking (A-1) of the record's duration and strain"
    return Case(record.id, law, path, reference, named[0], smooth, named[1], record.sha256)
