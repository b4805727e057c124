"""What the laboratory can withhold: the catalogue's names in the laboratory's own forms, and things outside it."""

from probation_studies.blind.laboratory.causes import (
    flow,
    force,
    network,
    outside,
    section,
    spectrum,
    strain,
    temperature,
)
from probation_studies.blind.laboratory.trial import Cause

KNOWN: tuple[Cause, ...] = (
    *flow.CAUSES,
    *network.CAUSES,
    *section.CAUSES,
    *spectrum.CAUSES,
    *force.CAUSES,
    *strain.CAUSES,
)
"""All that has a name in the catalogue; a name may have several forms."""

AT_TEMPERATURES: tuple[Cause, ...] = temperature.CAUSES
"""What has a name, too, and shows in tests at several temperatures only."""

OUTSIDE: tuple[Cause, ...] = outside.CAUSES

NAMES: tuple[str, ...] = tuple(dict.fromkeys(cause.name for cause in KNOWN))
"""The names of `KNOWN`, each once."""
