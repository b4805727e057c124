"""Limits of what is read: no file may exhaust the memory or the patience of the one who reads it.

Each is generous: ten times and more what a laboratory's largest export holds. A file beyond one is refused in one
line that names the limit. Change a limit here; nothing else states it.
"""

MEBIBYTE = 2**20

FILE_BYTES = 128 * MEBIBYTE
"""Size of any file that is read [byte]. 2 million rows of 60 characters; read in about ten seconds."""

INFLATED_BYTES = 128 * MEBIBYTE
"""Size of what a .gz or an .xlsx unpacks to [byte]. That of a plain file: packing gives no way around it."""

ROWS = 2_000_000
"""Rows of a table. 20 samples a second for a day; twice what an Excel sheet holds (1 048 576)."""

COLUMNS = 16_384
"""Columns of a table: as many as an Excel sheet holds."""

CELLS = 10_000_000
"""Cells of a table, rows times columns. About 1 GB of memory while they are text."""

LINE_CHARACTERS = 1_000_000
"""Characters in a line of text. 16 384 columns of 60 characters."""

CELL_CHARACTERS = 131_072
"""Characters in a cell: the limit of Python's csv module, four times that of an Excel cell (32 767)."""

UNIT_CHARACTERS = 40
"""Characters of a unit. The longest that laboratories write ("kilonewtons per square millimetre") has 33."""

TOML_BYTES = 4 * MEBIBYTE
"""Size of a campaign.toml [byte]. 20 000 records of 200 characters."""

NESTING = 32
"""Depth of tables and lists in a TOML or JSON file, dotted keys included. A campaign has 4, an answer 8."""

NUMBER_DIGITS = 100
"""Digits of a whole number in a TOML or JSON file. Seeds and hashes of 256 bits have 78."""

LARGEST = {
    "time": 1e12,
    "engineering_strain": 1e6,
    "stretch": 1e6,
    "displacement": 1e9,
    "true_stress": 1e9,
    "engineering_stress": 1e9,
    "force": 1e15,
    "strain_rate": 1e12,
    "transverse_strain": 300.0,
    "temperature": 1e6,
}
"""Largest magnitude of a measured quantity, in its internal unit (s, -, mm, MPa, N, 1/s, °C).

30 000 years; a million times the length (a true strain has a limit of its own, `records.strain_limits`); 1000 km; a
million times the strength of steel (1 PN on 1 mm²); faster than light crosses an atom. Squares and products of such
numbers stay below the largest float, 1e308.
"""

SMALLEST = {"true_strain": 1e-30, "true_stress": 1e-30}
"""Smallest that the largest magnitude of a measured quantity may be, other than zero, in its internal unit (-, MPa)."""

SHORTEST_STEP = 1e-15
"""Shortest time from one sample to the next [s]: a femtosecond, in which no specimen strains."""

SMALLEST_DIMENSION, LARGEST_DIMENSION = 1e-9, 1e9
"""Of a specimen, in mm or mm²: from below an atom to a thousand kilometres."""

LARGEST_PARAMETER = 1e30
"""Largest magnitude of a number in campaign.toml, in its own unit: moduli, times, coefficients, variances."""

MOST_MODES = 10_000
"""Modes of a law, at most: what the engine has room for."""

LARGEST_DECADES = 100.0
"""Decades that the relaxation times of a law span, at most; the square of the shortest stays above 1e-308 s²."""

SMALLEST_PARAMETER = 1e-30
"""Smallest magnitude, other than zero, of a parameter or noise level there; squares stay above 1e-308."""


def is_usable(value: float) -> bool:
    """Whether a parameter or noise level is zero or within `SMALLEST_PARAMETER` and `LARGEST_PARAMETER`."""
    return value == 0 or SMALLEST_PARAMETER <= abs(value) <= LARGEST_PARAMETER


USABLE = f"0 or a magnitude from {SMALLEST_PARAMETER:g} to {LARGEST_PARAMETER:g}"
"""The same in words."""
