"""A diagnosis in figures: records before and after, probabilities, closure."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, StrMethodFormatter

from probation.report.diagnosis_tables import WORTH_A_ROW
from probation.report.diagnosis_words import closed, explanation_name, short_ids
from probation.report.figures import legend_outside, styled_figure, thinned
from probation.report.style import colour
from probation.wording import chance, percent

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.result import Diagnosis, Explanation, RecordCurves

_DOTS, _POINTS = 90, 240
_BARS = 10
_LINE = 30  # letters of a label in one line
_PROBES = 40


def diagnosis_figure(diagnosis: Diagnosis) -> Figure:
    """Every record: stress with and without known effects; beside it what both miss, in units of the noise."""
    names = short_ids(diagnosis.curves, 44)
    with styled_figure(7.6, 0.4 + 2.1 * len(diagnosis.curves)) as figure:
        panels = figure.subplots(len(diagnosis.curves), 2, squeeze=False, width_ratios=(1, 1))
        for at, ((left, right), curves) in enumerate(zip(panels, diagnosis.curves.values(), strict=True)):
            label = _draw(left, right, curves, diagnosis)
            left.set_title(_title(curves, names), fontsize=9)
            left.set_xlabel(label)
            right.set_xlabel(label)
            if at == 0:
                left.legend(loc="best", fontsize=7.5)
    return figure


def record_figure(diagnosis: Diagnosis, record_id: str) -> Figure:
    """One record: stress with and without known effects, below it what both miss, in units of the noise."""
    curves = diagnosis.curves[record_id]
    with styled_figure(3.9, 3.7) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.35, 1))
        below.set_xlabel(_draw(above, below, curves, diagnosis))
        above.set_title(fill(_title(curves, short_ids(diagnosis.curves, 44)), 46), fontsize=9)
        above.legend(loc="best", fontsize=7.5)
    return figure


def _title(curves: RecordCurves, names: dict[str, str]) -> str:
    return names[curves.id] if curves.role == "identify" else f"{names[curves.id]} – not fitted"


def _draw(stress: Axes, errors: Axes, record: RecordCurves, diagnosis: Diagnosis) -> str:
    """Both panels of a record; returns the label of their common axis."""
    x, label = _axis(record)
    stress.plot(*thinned(x, record.data, _DOTS), ".", ms=5, mew=0, color=colour("data"), label="measured")
    curves = [("base law", record.base, "second")]
    if record.explained is not None:
        curves.append(("with the explanation", record.explained, "model"))
    for name, model, shade in curves:
        stress.plot(*thinned(x, model, _POINTS), color=colour(shade), lw=1.0, label=name)
        errors.plot(
            *thinned(x, (model - record.data) / np.maximum(record.noise, 1e-300), _POINTS), color=colour(shade), lw=0.7
        )
    for region in diagnosis.located:
        if region.record == record.id:
            inside = x[region.samples]
            for axes in (stress, errors):
                axes.axvspan(float(inside.min()), float(inside.max()), color=colour("second"), alpha=0.1, lw=0)
    errors.axhspan(-2.0, 2.0, color=colour("data"), alpha=0.25, lw=0)
    errors.axhline(0.0, color=colour("muted"), lw=0.6)
    stress.set_ylabel("true stress [MPa]")
    errors.set_ylabel("error / noise [–]")
    return label


def _axis(curves: RecordCurves) -> tuple[FloatArray, str]:
    """Strain where it grows all along, time otherwise."""
    probes = curves.true_strain[np.linspace(0, len(curves.time) - 1, _PROBES).astype(int)]
    steps = np.diff(probes)
    if steps.min() > 0.1 * steps.mean() > 0.0:
        return curves.true_strain, "true strain [–]"
    return curves.time, "time [s]"


def probability_figure(diagnosis: Diagnosis) -> Figure:
    """A bar for every explanation that matters; those that the data do not exclude are starred."""
    shown = _shown(diagnosis)
    others = len(diagnosis.explanations) - len(shown)
    names = [fill(explanation_name(explanation, diagnosis), _LINE) for explanation in shown]
    if others:
        names.append(f"{others} other{'s' if others > 1 else ''}")
    places, rows = _rows(names)
    with styled_figure(5.3, 0.8 + 0.36 * rows) as figure:
        axes = figure.subplots()
        for at, shown_explanation in zip(places, shown, strict=False):
            inside = shown_explanation.effects in diagnosis.answer_set
            size = 100.0 * shown_explanation.probability
            axes.barh(at, size, height=0.62, color=colour("model" if inside else "data"), alpha=1.0 if inside else 0.6)
            axes.text(
                size + 1.0,
                at,
                f"{chance(shown_explanation.probability)}{'  ★' if inside else ''}",
                va="center",
                fontsize=8.5,
            )
        if others:
            rest = max(1.0 - sum(explanation.probability for explanation in shown), 0.0)
            axes.barh(places[-1], 100.0 * rest, height=0.62, color=colour("data"), alpha=0.6)
            axes.text(100.0 * rest + 1.0, places[-1], percent(rest), va="center", fontsize=8.5)
        axes.set_yticks(places, names)
        axes.set(xlim=(0.0, 128.0), ylim=(rows - 0.4, -0.6), xlabel="probability [%]")
        axes.set_xticks(range(0, 101, 20))
        axes.set_ylabel("explanation")
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
    return figure


def _rows(names: list[str]) -> tuple[list[float], float]:
    """The middle of each row from the first, and their sum: a row has room for two lines, and grows with more."""
    heights = [max(1.0, 0.16 + 0.42 * len(name.splitlines())) for name in names]
    middles = [sum(heights[:at]) + 0.5 * height - 0.5 for at, height in enumerate(heights)]
    return middles, sum(heights)


def _shown(diagnosis: Diagnosis) -> list[Explanation]:
    """The probable ones, the answer set, and always "none" and "unknown"."""
    always = [
        explanation
        for explanation in diagnosis.explanations
        if explanation.effects in diagnosis.answer_set or explanation.effects in ((), ("unknown",))
    ]
    room = _BARS - len(always)
    probable = [
        explanation
        for explanation in diagnosis.explanations
        if explanation not in always and explanation.probability >= WORTH_A_ROW
    ]
    kept = [*always, *probable[: max(room, 0)]]
    return [explanation for explanation in diagnosis.explanations if explanation in kept]


def closure_figure(diagnosis: Diagnosis) -> Figure:
    """Error of every record without and with known effects, against the noise, on a logarithmic scale."""
    shrink, names = diagnosis.shrink, short_ids(diagnosis.curves)
    rows: list[tuple[str, Closure]] = [("all fitted records", shrink.identify)]
    if shrink.held_out is not None:
        rows.append(("all held-out records", shrink.held_out))
    together = len(rows)
    rows += [(names.get(record, record), closure) for record, closure in shrink.records.items()]
    with styled_figure(5.3, 1.1 + 0.34 * len(rows)) as figure:
        axes = figure.subplots()
        for at, (_, errors) in enumerate(rows):
            axes.plot([errors.before_MPa, errors.after_MPa], [at, at], color=colour("muted"), lw=0.9, zorder=1)
        for label, shade, marker, values in (
            ("noise", "ink", "|", [closure.noise_MPa for _, closure in rows]),
            ("before", "second", "o", [closure.before_MPa for _, closure in rows]),
            ("after", "model", "o", [closure.after_MPa for _, closure in rows]),
        ):
            size = 13 if marker == "|" else 5.5
            axes.plot(values, range(len(rows)), marker, color=colour(shade), ms=size, mew=1.2, label=label)
        axes.set_xscale("log")
        _plain_decades(axes, [v for _, e in rows for v in (e.before_MPa, e.after_MPa, e.noise_MPa)])
        for at, (_, errors) in enumerate(rows):
            axes.annotate(
                closed(errors), (1.01, at), xycoords=("axes fraction", "data"), va="center", fontsize=8.5, clip_on=False
            )
        axes.axhline(together - 0.5, color=colour("muted"), lw=0.6)
        axes.set_yticks(range(len(rows)), [fill(name, 20) for name, _ in rows])
        axes.set(ylim=(len(rows) - 0.4, -0.6), xlabel="rms error [MPa]", ylabel="records")
        axes.set_title("gap closed", loc="right", fontsize=8.5, fontweight="normal")
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        legend_outside(figure, *axes.get_legend_handles_labels(), columns=3)
    return figure


def _plain_decades(axes: Axes, values: list[float]) -> None:
    """Round numbers on a logarithmic axis, also where it spans less than a decade."""
    drawn = [value for value in values if value > 0.0] or [1.0]
    low, high = min(drawn), max(drawn)
    axes.set_xlim(low / 1.4, high * 1.4)
    steps = (1.0, 2.0, 5.0) if high / low < 50.0 else (1.0,)
    axes.xaxis.set_major_locator(LogLocator(subs=steps) if high > 3.0 * low else MaxNLocator(4))
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
