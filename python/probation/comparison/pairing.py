"""Which reference records a record is held against."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation._complaint import suggestion
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation.records.campaign import Campaign


def pair(
    campaign: Campaign, reference: Campaign, pairs: Mapping[str, str | Sequence[str]] | None = None
) -> dict[str, tuple[str, ...]]:
    """Ids of the reference records of every record that has some.

    Parameters
    ----------
    campaign, reference : Campaign
    pairs : dict of str to str or sequence of str, optional
        Reference records of the same test by record id; those of the same id where it is left out.

    Raises
    ------
    InputError
        For an unknown record, or if nothing can be held against anything.
    """
    there = [record.id for record in reference.records]
    here = [record.id for record in campaign.records]
    together: dict[str, tuple[str, ...]] = {}
    if pairs is None:
        together = {record: (record,) for record in here if record in there}
        if not together:
            raise InputError(
                f"against: found no record of {campaign.name} in {reference.name}, expected one of the same id at "
                f"least; {', '.join(here)} here and {', '.join(there)} there; say which belong together"
            )
        return together
    for record, others in pairs.items():
        if record not in here:
            raise InputError(f"pairs: found no record {record!r} in {campaign.name}; {suggestion(record, here)}")
        together[record] = (others,) if isinstance(others, str) else tuple(others)
        for other in together[record]:
            if other not in there:
                raise InputError(f"pairs: found no record {other!r} in {reference.name}; {suggestion(other, there)}")
        if not together[record]:
            raise InputError(f"pairs: found no reference for {record!r}, expected one at least")
    if not together:
        raise InputError("pairs: found none, expected one at least")
    return together
