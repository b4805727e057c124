"""Import profiles: one kind of file each. A new one is a file here and a line in ``PROFILES``."""

from probation._complaint import quoted, suggestion
from probation.errors import InputError
from probation.records.options import ReadOptions
from probation.records.profiles import (
    delimited,
    etfe,
    etfe_relaxation,
    etfe_temperature,
    excel,
    silicone,
    vhb,
)
from probation.records.profiles.machine import Machine
from probation.records.profiles.machines import MACHINES
from probation.records.profiles.profile import Profile, Reading
from probation.records.source import Source

__all__ = ["PROFILES", "Profile", "Reading", "find_profile"]


def _of(machine: Machine) -> Profile:
    """A machine's files by name; left out, `excel` and `csv` recognise them by their cells."""

    def read(source: Source, options: ReadOptions) -> Reading:
        container = excel.PROFILE if excel.recognises(source) else delimited.PROFILE
        return container.read(source, options)

    return Profile(name=machine.name, title=machine.title, recognises=lambda source: False, read=read)


# Asked in this order; the last one takes everything.
PROFILES: tuple[Profile, ...] = (
    *map(_of, MACHINES),
    excel.PROFILE,
    etfe.PROFILE,
    etfe_relaxation.PROFILE,
    etfe_temperature.PROFILE,
    vhb.PROFILE,
    silicone.PROFILE,
    delimited.PROFILE,
)


def find_profile(source: Source, name: str | None = None) -> Profile:
    """Find the profile of that name, or the first that recognises the content.

    Raises
    ------
    InputError
        If there is no profile of that name.
    """
    if name is None:
        return next(profile for profile in PROFILES if profile.recognises(source))
    by_name = {profile.name: profile for profile in PROFILES}
    if name not in by_name:
        raise InputError(f"{source.path}: found no profile {quoted(name)}; {suggestion(name, by_name)}")
    return by_name[name]
