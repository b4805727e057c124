"""Tables as laboratories write them: what the program reads, before anything goes wrong."""

from __future__ import annotations

import math
from dataclasses import dataclass

SAMPLES = 14


@dataclass(frozen=True)
class Rows:
    """The cells of a file.

    Attributes
    ----------
    cells : list of list of str
    first : int
        Index of the first row of numbers.
    heading : int or None
        Index of the row of headings.
    separator : str
        That such a file has.
    encoding : str
    options : tuple of str
        With which the program reads it as it is meant.
    """

    cells: list[list[str]]
    first: int
    heading: int | None
    separator: str = ","
    encoding: str = "utf-8"
    options: tuple[str, ...] = ()


def _columns(*columns: list[float]) -> list[list[str]]:
    return [[f"{value:.9g}" for value in row] for row in zip(*columns, strict=True)]


def _curve(samples: int = SAMPLES) -> tuple[list[float], list[float], list[float]]:
    """Time [s], true strain [-] and true stress [MPa] of a ramp with a little scatter."""
    time = [0.5 * at for at in range(samples)]
    strain = [0.012 * at for at in range(samples)]
    stress = [22.0 * (1.0 - math.exp(-at / 3.0)) + 0.02 * math.sin(37.0 * at * at) for at in range(samples)]
    return time, strain, stress


def plain() -> Rows:
    """The default form."""
    return Rows([["time_s", "true_strain", "true_stress_MPa"], *_columns(*_curve())], 1, 0)


def plain_truth() -> dict[str, list[float]]:
    """What `plain` must read as."""
    names = ("time", "true_strain", "true_stress")
    columns = zip(*plain().cells[1:], strict=True)
    return {name: [float(cell) for cell in column] for name, column in zip(names, columns, strict=True)}


def with_rate_and_temperature() -> Rows:
    """All optional columns."""
    time, strain, stress = _curve()
    names = ["time_s", "true_strain", "true_stress_MPa", "strain_rate_per_s", "transverse_strain", "temperature_C"]
    columns = (time, strain, stress, [0.024] * SAMPLES, [-0.5 * each for each in strain], [23.0] * SAMPLES)
    return Rows([names, *_columns(*columns)], 1, 0)


def machine() -> Rows:
    """Metadata above, units below the headings, a force and a displacement."""
    time, strain, stress = _curve()
    cells = [
        ["Test", "tension 7"],
        ["Operator", "nobody"],
        [],
        ["Time", "Extension", "Load", "Segment"],
        ["s", "mm", "kN", "-"],
        *([*row, "1"] for row in _columns(time, [25.0 * each for each in strain], [0.04 * each for each in stress])),
    ]
    return Rows(cells, 5, 3, options=("--specimen", "area_mm2=40", "--specimen", "gauge_length_mm=25"))


def german() -> Rows:
    """Decimal commas between semicolons, names of another language, cp1252."""
    time, strain, stress = _curve()
    numbers = [[cell.replace(".", ",") for cell in row] for row in _columns(time, [100.0 * e for e in strain], stress)]
    options = (
        "--column",
        "time=Prüfzeit",
        "--column",
        "engineering_strain=Dehnung",
        "--column",
        "true_stress=Spannung",
    )
    names = ["Prüfzeit / s", "Dehnung / %", "Spannung / MPa"]
    return Rows([names, *numbers], 1, 0, ";", "cp1252", options)


def vhb() -> Rows:
    """The profile `vhb`: Chinese headings in GBK, units below them."""
    time, strain, stress = _curve()
    numbers = _columns(time, [80.0 * each for each in strain], [0.1 * each for each in stress])
    return Rows([[], ["时间", "位移", "力"], ["s", "mm", "N"], *numbers], 3, 1, encoding="gbk")


def silicone() -> Rows:
    """The profile `silicone`: a block of metadata."""
    cells = [
        ["PARAMETER", "INFO", ""],
        ["Material", "Dragon", ""],
        ["Rate", "450 mm/min", ""],
        ["Time (s)", "True Strain", "True Stress (MPa)"],
        *_columns(*_curve()),
    ]
    return Rows(cells, 4, 3, ";")


def etfe() -> Rows:
    """The profile `etfe`: fifteen columns without headings."""
    time, strain, stress = _curve()
    zero = [0.0] * SAMPLES
    columns = (time, *[strain] * 2, stress, *[strain] * 2, zero, *[strain] * 2, *[stress] * 2, *[zero] * 4)
    return Rows(_columns(*columns), 0, None)


def etfe_relaxation() -> Rows:
    """The profile `etfe_relaxation`: nine columns under headings that do not fit them."""
    time, strain, stress = _curve()
    zero = [0.0] * SAMPLES
    names = [
        "t01",
        "exx01",
        "S01",
        "eyy01",
        "z",
        "exxHencky01SOI",
        "StressTrue01AVG",
        "SR0Hencky1AVG",
        "eyyHencky01AVG",
    ]
    return Rows([names, *_columns(time, strain, stress, zero, zero, time, strain, stress, zero)], 1, 0)


def etfe_temperature() -> Rows:
    """The profile `etfe_temperature`: a log of temperatures."""
    time, _, _ = _curve()
    return Rows([["t", "TMean01", "TMean02"], *_columns(time, [23.0] * SAMPLES, [24.0] * SAMPLES)], 1, 0)


def history() -> Rows:
    """A strain history."""
    time, strain, _ = _curve()
    return Rows([["time_s", "true_strain"], *_columns(time, strain)], 1, 0)


def history_with_rate() -> Rows:
    """A strain history with its rate, in other units."""
    time, strain, _ = _curve()
    minutes = [each / 60.0 for each in time]
    names = ["Time [min]", "True strain [%]", "Strain rate [1/min]"]
    return Rows([names, *_columns(minutes, [100.0 * each for each in strain], [1.44] * SAMPLES)], 1, 0)


def rate_table() -> Rows:
    """Relaxation times by strain rate."""
    rates = [5e-5, 2e-4, 1e-3, 4e-3, 1e-2]
    times = [(0.00464 * math.log10(rate) + 0.0367) / rate * (1.0 + 0.01 * (-1) ** at) for at, rate in enumerate(rates)]
    names = ["rate_per_s", "tau_max_s", "se_s", "hardening_modulus_MPa"]
    return Rows([names, *_columns(rates, times, [0.02 * each for each in times], [2.0, 2.1, 2.2, 2.1, 2.0])], 1, 0)


RECORDS = (plain, with_rate_and_temperature, machine, german, vhb, silicone, etfe, etfe_relaxation, etfe_temperature)
WITH_HEADINGS = (plain, with_rate_and_temperature, machine, silicone)
"""Of those, the ones that are read from a workbook or between tabs, too."""
HISTORIES = (history, history_with_rate)
