"""A measured record as a fit and a prediction take it: by itself, no record before or behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.record_view import RecordView, view_of
from probation.law.schemes import Scheme, SchemeName, at_samples
from probation.records.signal import require_signal

if TYPE_CHECKING:
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation


def measured_view(record: Record, excitation: Excitation, scheme: Scheme | SchemeName, substeps: int = 1) -> RecordView:
    """The view of a record.

    Parameters
    ----------
    record : Record
    excitation : Excitation
        What drives the law along it, at the samples.
    scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`
    substeps : int
        Steps of the scheme from sample to sample.

    Raises
    ------
    InputError
        For a record whose strain does not move or that bears no stress.
    """
    require_signal(record)
    return view_of(record, excitation, scheme=at_samples(scheme), substeps=substeps)
