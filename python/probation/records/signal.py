"""What a record must show before a law is put against it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation._complaint import quoted
from probation.errors import InputError

if TYPE_CHECKING:
    from probation.records.record import Record


def require_signal(record: Record) -> None:
    """Refuse a record that a law cannot be put against: its strain does not move, or it bears no stress.

    Raises
    ------
    InputError
        It names the record.
    """
    strain = record.true_strain
    if np.ptp(strain) == 0.0:
        raise InputError(
            f"record {quoted(record.id)}: found a true strain of {strain[0]:.4g} at every sample, expected a strain "
            "that changes; check the column, or leave the record out"
        )
    if not record.true_stress.any():
        raise InputError(
            f"record {quoted(record.id)}: found a true stress of 0 MPa at every sample, expected a test under load; "
            "check the column and its unit, or leave the record out"
        )
