"""The law in CalculiX: decks, runs and what they print; ``python -m probation.fe.calculix``."""

from probation.fe.calculix.dumbbell import Dumbbell
from probation.fe.calculix.element import Comparison, stretch_element, turn_element
from probation.fe.calculix.necking import NeckingRun, neck
from probation.fe.calculix.printed import Printed, read_printed
from probation.fe.calculix.program import can_load_routines, find_ccx, run

__all__ = [
    "Comparison",
    "Dumbbell",
    "NeckingRun",
    "Printed",
    "can_load_routines",
    "find_ccx",
    "neck",
    "read_printed",
    "run",
    "stretch_element",
    "turn_element",
]
