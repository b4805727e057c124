"""The campaign.toml that a person goes on from: each record as it is read, and what else may be said, in comments."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from probation._text import printable
from probation.records.record import Record
from probation.records.said_once import of_all
from probation.records.saving import lines_of


@dataclass(frozen=True)
class Entry:
    """A record of the campaign, as its [[record]] says it.

    Attributes
    ----------
    file : str
        As campaign.toml names it.
    keys : dict of str to object
        How it is read: ``columns``, ``units``, ``specimen``, ``sheet``, …, those that are needed.
    read : str
        One line: which column is which.
    stated : dict of str to float
        Dimensions of the specimen that its file states.
    """

    record: Record
    file: str
    keys: Mapping[str, Any]
    read: str
    stated: Mapping[str, float]


def campaign_text(name: str, entries: Sequence[Entry]) -> str:
    """The campaign.toml of these records, with a constant tau_max."""
    common = of_all([entry.record for entry in entries])
    shared = "".join(f"# note, of every record: {printable(warning)}\n" for warning in common)
    parts = [_HEAD, lines_of({"name": name}), _LAW + shared, *(_entry(entry, common) for entry in entries)]
    return "\n".join(parts)


def _entry(entry: Entry, common: Sequence[str]) -> str:
    record = entry.record
    comments = [f"read: {entry.read}"]
    if entry.stated:
        stated = ", ".join(f"{key} = {value:.6g}" for key, value in sorted(entry.stated.items()))
        comments.append(f"stated in the file: {stated}")
    comments += [f"note: {warning}" for warning in record.warnings if warning not in common]
    keys = {"id": record.id, "file": entry.file, "control": record.control, "role": record.role, **entry.keys}
    return "[[record]]\n" + "".join(f"# {printable(comment)}\n" for comment in comments) + lines_of(keys)


_HEAD = """\
# A campaign: records of one material, and the law that they put to the test.
# Go on with:  probation fit FOLDER     probation certify FOLDER     probation diagnose FOLDER
# Every key: the page "formats" of the documentation, section 1.
"""

_LAW = """\
[law]
modes = 50
decades = 6.0
# The largest relaxation time is a constant. A relation to the strain rate instead, from tests at several rates:
#   probation companion FOLDER --toml   prints a [law.companion] to put here.

# control: "strain-rate", "displacement-rate", "hold", "cyclic" or "other".
# role: "identify", or "held-out": never fitted, only predicted. certify and diagnose are sharper with one held out.
# specimen_id: the same for records of one specimen; left out, each record is a specimen of its own.
# noise = { stress_MPa = …, strain = … }: standard deviations, where they are known.
"""
