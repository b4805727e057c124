"""The records of a file that is looked at, as a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.figures import new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation.records.preview import Preview


def preview_figure(shown: Preview) -> Figure:
    """Stress over strain, and both over time, of every record."""
    figure = new_figure(10.0, 4.0)
    over_strain, over_time = figure.subplots(1, 2)
    strain_axis = over_time.twinx()
    for record in shown.records:
        (line,) = over_strain.plot(record.true_strain, record.true_stress, lw=1.0, label=record.id)
        over_time.plot(record.time, record.true_stress, lw=1.0, color=line.get_color())
        strain_axis.plot(record.time, record.true_strain, lw=1.0, ls="--", color=line.get_color())
    over_strain.set(xlabel="true strain [–]", ylabel="true stress [MPa]", title=shown.path.name)
    over_time.set(xlabel="time [s]", ylabel="true stress [MPa], solid")
    strain_axis.set_ylabel("true strain [–], dashed")
    if shown.records:
        over_strain.legend(frameon=False)
    return figure
