"""How a file would be read, as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation._text import printable
from probation.records.noise import noise_level
from probation.records.said_once import of_all, said_once
from probation.records.text_plot import text_plot

if TYPE_CHECKING:
    from collections.abc import Collection

    from probation._arrays import FloatArray
    from probation.records.preview import Preview
    from probation.records.record import Record

_FACTS = 20  # shown of those above the headings

_LABELS = {
    "time": ("time", "s"),
    "true_strain": ("true strain", ""),
    "true_stress": ("true stress", "MPa"),
    "strain_rate": ("strain rate", "1/s"),
    "transverse_strain": ("transverse strain", ""),
    "temperature": ("temperature", "°C"),
}


def preview_summary(shown: Preview) -> str:
    """All of it as text, the verdict first, with a plot of each record."""
    parts = [_verdict(shown), _layout(shown), _columns(shown)]
    if shown.specimen:
        stated = ", ".join(f"{key} = {value:.6g}" for key, value in sorted(shown.specimen.items()))
        parts.append(f"specimen  {stated}, stated in the file")
    if shown.metadata:
        facts = [printable(f"{key}: {text}") for key, text in shown.metadata.items()]
        more = [f"and {len(facts) - _FACTS} more"] if len(facts) > _FACTS else []
        parts.append("\n".join(["metadata", *(f"  {fact}" for fact in (*facts[:_FACTS], *more))]))
    common = of_all(shown.records)
    if common:
        parts.append("\n".join(["all records", *(f"  warning: {warning}" for warning in common)]))
    parts += [_describe(record, common) for record in shown.records]
    parts.append(_first_rows(shown))
    return "\n\n".join(parts)


def _verdict(shown: Preview) -> str:
    known = f"{printable(str(shown.path))}: reads as {shown.profile} ({shown.title})"
    if shown.auxiliary:
        return f"{known}: {shown.auxiliary}, no stress-strain record"
    count = len(shown.records)
    records = "1 record" if count == 1 else f"{count} records, one per specimen"
    warned = len(said_once(shown.records))
    return f"{known}, {records}" + (f", {warned} warning{'s' if warned > 1 else ''}" if warned else "")


def _layout(shown: Preview) -> str:
    headings = f"headings in row {shown.header_row}" if shown.header_row else "no headings"
    decimal = "comma" if shown.decimal == "," else "point"
    separator = f"separator {shown.separator}" if shown.encoding else shown.separator
    facts = [separator, f"decimal {decimal}", headings, f"{shown.rows} rows"]
    return "layout    " + ", ".join(([f"encoding {shown.encoding}"] if shown.encoding else []) + facts)


def _columns(shown: Preview) -> str:
    cells = [(printable(label), printable(unit or "no unit"), role) for label, unit, role in shown.columns]
    width = max(len(label) for label, _, _ in cells)
    lines = [f"  {label:<{width}}  {unit:<8}  {'→ ' + role if role else 'not used'}" for label, unit, role in cells]
    return "\n".join(["columns", *lines])


def _first_rows(shown: Preview) -> str:
    """Show the first rows of the columns in use; of all where none is."""
    used = [at for at, (_, _, role) in enumerate(shown.columns) if role] or list(range(len(shown.columns)))
    headed = [tuple(label for label, _, _ in shown.columns), *shown.first_rows]
    lines = ("  " + "  ".join(printable(row[at].strip()) for at in used) for row in headed)
    return "\n".join(["first rows", *lines])


def _describe(record: Record, common: Collection[str]) -> str:
    """One record in text: ranges, sampling, noise, warnings that are not `common` to all, and a plot."""
    duration = record.time[-1] - record.time[0]
    lines = [f"{record.id}: {len(record)} samples over {duration:.6g} s, {_sampling(record.time)}"]
    for name, values in record.samples.items():
        label, unit = _LABELS[name]
        noise = ""
        if name in ("true_strain", "true_stress"):
            noise = f", noise about {noise_level(record.time, values):.2g} {unit}".rstrip()
        span = f"{values.min() + 0.0:.6g} to {values.max() + 0.0:.6g} {unit}".rstrip()  # + 0.0: no "-0"
        lines.append(f"  {label:<17}  {span}{noise}")
    lines += [f"  warning: {warning}" for warning in record.warnings if warning not in common]
    lines.append(text_plot(record.true_strain, record.true_stress, "true strain [–]", "true stress [MPa]"))
    return "\n".join(lines)


def _sampling(time: FloatArray) -> str:
    steps = np.diff(time)
    if steps.max() - steps.min() <= 1e-3 * np.median(steps):
        return f"every {np.median(steps):.4g} s"
    return f"unevenly, every {steps.min():.4g} to {steps.max():.4g} s (median {np.median(steps):.4g} s)"
