"""Profile ``etfe_temperature``: chamber temperatures of Comitti and Bosi's tests."""

from probation.records.cell import decimal_mark
from probation.records.grid import read_grid
from probation.records.options import ReadOptions
from probation.records.profiles.profile import Profile, Reading
from probation.records.source import Source
from probation.records.table import Column, Table


def recognises(source: Source) -> bool:
    """Know the headings ``t,TMean01,TMean02,…``."""
    return source.first_line.startswith("t,TMean")


def read(source: Source, options: ReadOptions) -> Reading:
    """Read one time column, shared, and a temperature for each specimen."""
    grid = read_grid(source)
    rows, decimal = grid.rows[1:], decimal_mark(grid.rows[1:])
    time = Column(label="t", name="t", unit="s", position=0)
    tables = tuple(
        Table(
            path=source.path,
            columns=(time, Column(label=label, name=label, unit="degC", position=at)),
            rows=rows,
            row_numbers=grid.row_numbers[1:],
            header_row=1,
            decimal=decimal,
            roles={"time": "t", "temperature": label},
        )
        for at, label in enumerate(grid.rows[0])
        if at > 0
    )
    return Reading(tables=tables, separator=grid.separator, auxiliary="temperatures over time")


PROFILE = Profile(name="etfe_temperature", title="ETFE chamber temperatures", recognises=recognises, read=read)
