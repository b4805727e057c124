"""tau_max and the Weissenberg number against the strain rate: the paper's Figure S2."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D

from probation.errors import InputError
from probation.normal import TWO_SIDED_95
from probation.report.figures import legend_outside, styled_figure
from probation.report.style import colour, series_colour

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.calibration.calibrated import CalibratedCompanion
    from probation.calibration.result import Calibration
    from probation.law.companion import Companion

_BEYOND = 10.0  # drawn to so many times below and above the calibrated rates
_POINTS = 241


def companion_figure(
    calibration: Calibration, beside: Mapping[str, Companion] | None = None, relative_bars: float | None = None
) -> Figure:
    """Data and relations, tau_max on the left, We on the right; beyond the calibrated rates dashed.

    The band is that of 95 % of the chosen relation, from the covariance of its parameters.

    Parameters
    ----------
    beside : mapping of name to Companion, optional
        Further relations to draw.
    relative_bars : float, optional
        Bars of a table without standard errors, as a part of tau_max.
    """
    further = [(name, relation, series_colour(at)) for at, (name, relation) in enumerate((beside or {}).items(), 3)]
    shown = [name for name, candidate in calibration.candidates.items() if not candidate.form.reference]
    shown.sort(key=lambda name: name != calibration.chosen)
    if calibration.chosen not in shown:
        shown.insert(0, calibration.chosen)
    companion = calibration.companion
    low, high = companion.relation.calibrated or (1e-4, 1e-2)
    rates = np.geomspace(low / _BEYOND, high * _BEYOND, _POINTS)
    with styled_figure(9.2, 4.4) as figure:
        left, right = figure.subplots(1, 2)
        for axes, power in ((left, 0.0), (right, 1.0)):
            _band(axes, companion, rates, power, (low, high))
            for at, name in enumerate(shown):
                relation = calibration.candidates[name].companion.relation
                _curve(axes, relation, rates, power, (low, high), series_colour(at))
            for _, relation, shade in further:
                _curve(axes, relation, rates, power, (low, high), shade, width=0.9)
            _data(axes, calibration, power, relative_bars)
            axes.set_xscale("log")
            axes.set_xlabel("true strain rate [1/s]")
        left.set_yscale("log")
        left.set_ylabel("τ_max [s]")
        right.set_ylabel("We = τ_max·rate [–]")
        _limits(right, calibration, rates, (low, high))
        handles = [
            Line2D([], [], color=series_colour(at), label=_label(calibration, name)) for at, name in enumerate(shown)
        ]
        handles += [Line2D([], [], color=shade, lw=0.9, label=name) for name, _, shade in further]
        legend_outside(figure, handles, [str(handle.get_label()) for handle in handles], columns=3)
        left.set_title("dashed: beyond the calibrated rates")
        right.set_title(f"band: 95 % of {calibration.chosen}" if companion.covariance is not None else "")
    return figure


def _label(calibration: Calibration, name: str) -> str:
    regressed = (
        f"{name}, regressed in {calibration.candidates[name].form.measure}" if calibration.route == "table" else name
    )
    return f"{regressed} (chosen)" if name == calibration.chosen else regressed


def _curve(
    axes: Axes,
    relation: Companion,
    rates: FloatArray,
    power: float,
    calibrated: tuple[float, float],
    shade: str,
    width: float = 1.4,
) -> None:
    """One relation times rate^power, dashed beyond the calibrated rates; nothing where it gives no positive time."""
    values = _times(relation, rates) * rates**power
    inside = (rates >= calibrated[0] * 0.999) & (rates <= calibrated[1] * 1.001)
    axes.plot(rates, np.where(inside, values, np.nan), color=shade, lw=width)
    axes.plot(rates, np.where(inside, np.nan, values), color=shade, lw=width, ls=(0, (4, 2)))


def _times(relation: Companion, rates: FloatArray) -> FloatArray:
    try:
        return relation.relaxation_time(rates)
    except InputError:
        return np.array([_time(relation, rate) for rate in rates])


def _time(relation: Companion, rate: float) -> float:
    try:
        return float(relation.relaxation_time([rate])[0])
    except InputError:
        return float("nan")


def _band(
    axes: Axes, companion: CalibratedCompanion, rates: FloatArray, power: float, calibrated: tuple[float, float]
) -> None:
    if companion.covariance is None:
        return
    values = _times(companion.relation, rates)
    with np.errstate(invalid="ignore"):
        reach = TWO_SIDED_95 * companion.log_time_se(np.where(np.isfinite(values), rates, np.nan_to_num(calibrated[1])))
    reach = np.minimum(reach, 20.0)
    low, high = (values * np.exp(side * reach) * rates**power for side in (-1.0, 1.0))
    axes.fill_between(rates, low, high, color=series_colour(0), alpha=0.16, lw=0)


def _data(axes: Axes, calibration: Calibration, power: float, relative_bars: float | None) -> None:
    look = {"fmt": "o", "ms": 4.5, "color": colour("ink"), "ecolor": colour("data"), "elinewidth": 1.0, "capsize": 2.5}
    if calibration.table is not None:
        table = calibration.table
        scale = table.rates**power
        bars = None if relative_bars is None else relative_bars * table.tau_max * scale
        if table.se is not None:
            bars = TWO_SIDED_95 * table.se * scale
        axes.errorbar(table.rates, table.tau_max * scale, yerr=bars, zorder=4, **look)  # type: ignore[arg-type]
        return
    chosen = calibration.candidates[calibration.chosen]
    for rate, residual in zip(calibration.record_rates, chosen.percent_residual, strict=True):
        needed = 1.0 + residual / 100.0
        along = np.geomspace(rate.slow, rate.fast, 20)
        times = _times(chosen.companion.relation, along) / needed
        axes.plot(along, times * along**power, color=colour("ink"), lw=2.2, zorder=4)


def _limits(axes: Axes, calibration: Calibration, rates: FloatArray, calibrated: tuple[float, float]) -> None:
    """We of the calibrated rates fills the plot; what relations do far beyond may leave it."""
    within = np.geomspace(*calibrated, 30)
    values = np.concatenate(
        [
            _times(candidate.companion.relation, within) * within
            for candidate in calibration.candidates.values()
            if not candidate.form.reference
        ]
        + ([] if calibration.table is None else [calibration.table.tau_max * calibration.table.rates])
    )
    values = values[np.isfinite(values)]
    axes.set_ylim(0.0, 1.6 * float(values.max()))
    axes.set_xlim(rates[0], rates[-1])
