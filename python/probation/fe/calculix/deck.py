"""The blocks of a CalculiX input deck; mm, N, s, MPa."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.exporting.constants import MaterialConstants

Degree = tuple[int | str, int]
"""Node or set of nodes, and direction 1 to 3."""

MOST_CONSTANTS = 21
"""CalculiX passes no more to a native routine."""


def number(value: float) -> str:
    """As CalculiX reads it: in at most 20 characters."""
    return f"{value:.12e}"


def nodes(points: FloatArray) -> str:
    """Nodes 1, 2, … at those places, shape (nodes, 3) [mm]."""
    rows = (f"{at},{','.join(number(coordinate) for coordinate in point)}" for at, point in enumerate(points, start=1))
    return "\n".join(("*NODE, NSET=ALL", *rows))


def elements(kind: str, connectivity: Iterable[Sequence[int]]) -> str:
    """Elements 1, 2, … in the set BODY; a line holds 10 numbers and goes on after a comma."""
    rows = []
    for at, corners in enumerate(connectivity, start=1):
        numbers = [str(node) for node in (at, *corners)]
        rows.append(",\n".join(",".join(numbers[k : k + 10]) for k in range(0, len(numbers), 10)))
    return "\n".join((f"*ELEMENT, TYPE={kind}, ELSET=BODY", *rows))


def node_set(name: str, members: Iterable[int]) -> str:
    """A set of nodes; the name in capitals."""
    return "\n".join((f"*NSET, NSET={name}", *(f"{member}," for member in members)))


def material(constants: MaterialConstants, state_size: int) -> str:
    """The native external behaviour DNLR of libPROBATION.so, for the set BODY.

    Raises
    ------
    InputError
        If there are more constants than CalculiX passes.
    """
    values = constants.values
    if len(values) > MOST_CONSTANTS:
        raise InputError(
            f"constants: found {len(values)}, expected at most {MOST_CONSTANTS}, for CalculiX passes no more; "
            "compile a kernel or a table of your own in with -DPROBATION_CONSTANTS"
        )
    rows = [",".join(number(value) for value in values[k : k + 8]) for k in range(0, len(values), 8)]
    lines = [
        "*MATERIAL, NAME=@PROBATION_DNLR",
        f"*USER MATERIAL, CONSTANTS={len(values)}",
        *rows,
        "*DEPVAR",
        str(state_size),
        "*SOLID SECTION, ELSET=BODY, MATERIAL=@PROBATION_DNLR",
    ]
    return "\n".join(lines)


def fixed(rows: Iterable[Degree]) -> str:
    """What does not move."""
    return "\n".join(("*BOUNDARY", *(f"{node},{direction},{direction}" for node, direction in rows)))


def amplitude(name: str, time: Sequence[float] | FloatArray, value: Sequence[float] | FloatArray) -> str:
    """A value over total time, straight between the times [s]."""
    rows = (f"{number(t)},{number(v)}" for t, v in zip(time, value, strict=True))
    return "\n".join((f"*AMPLITUDE, NAME={name}, TIME=TOTAL TIME", *rows))


def step(
    static: str,
    moved: Mapping[Degree, tuple[float, str]],
    printed: Sequence[str],
    *,
    controls: str = "",
) -> str:
    """One step.

    Parameters
    ----------
    static : str
        ``*STATIC`` and its line.
    moved : mapping of Degree to (displacement [mm], amplitude)
        An empty amplitude: straight from what it was to that over the step.
    printed : sequence of str
        ``*NODE PRINT`` and their lines.
    controls : str
        ``*CONTROLS`` and their lines.
    """
    lines = ["*STEP, NLGEOM, INC=100000"]
    if controls:
        lines.append(controls)
    lines.append(static)
    for (node, direction), (displacement, name) in moved.items():
        lines += [
            f"*BOUNDARY{f', AMPLITUDE={name}' if name else ''}",
            f"{node},{direction},{direction},{number(displacement)}",
        ]
    return "\n".join((*lines, *printed, "*END STEP"))


def printing(quantity: str, name: str, *, total: bool = False) -> str:
    """``*NODE PRINT`` of U or RF of a set at every increment."""
    return f"*NODE PRINT, NSET={name}{', TOTALS=ONLY' if total else ''}\n{quantity}"


def deck(*blocks: str) -> str:
    """The blocks one after the other."""
    return "\n".join(blocks) + "\n"
