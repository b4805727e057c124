"""The machines that are known, in the order in which they are asked. A new one is a file and a line here."""

from probation.records.grid import Grid
from probation.records.profiles import bluehill, catman, kammrath_weiss, testsuite, testxpert, trapezium
from probation.records.profiles.machine import Machine, head

MACHINES: tuple[Machine, ...] = (
    kammrath_weiss.MACHINE,
    catman.MACHINE,
    testsuite.MACHINE,
    testxpert.MACHINE,
    bluehill.MACHINE,
    trapezium.MACHINE,
)


def machine_of(grid: Grid, name: str | None = None) -> Machine | None:
    """The machine of that name, or the first that recognises the first rows; None where none does."""
    if name is not None:
        return next((machine for machine in MACHINES if machine.name == name), None)
    text = head(grid)
    return next((machine for machine in MACHINES if machine.recognises(text)), None)
