"""Maps in words: the verdict first."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.field.status import MEANINGS, Status

if TYPE_CHECKING:
    from probation.field.maps import FieldMaps

SYMBOLS = {
    "unrelaxed_modulus_times_tau_max": "E_u τ_max",
    "unrelaxed_modulus_times_alpha": "E_u α",
    "unrelaxed_modulus": "E_u",
    "tau_max": "τ_max",
    "alpha": "α",
    "hardening_modulus": "G",
}


def field_summary(maps: FieldMaps) -> str:
    """The verdict, then what became of the pixels, the parameters, and how it was made."""
    return "\n".join(
        [_verdict(maps), "", *_pixels(maps), "", *_parameters(maps), *_closeness(maps), "", *_origin(maps)]
    )


def _verdict(maps: FieldMaps) -> str:
    good, all_ = int(np.count_nonzero(maps.identified)), maps.maps["status"].size
    beyond = int(np.count_nonzero(maps.beyond_noise))
    text = f"{good} of {all_} pixels identified; the residual of {beyond} of them is beyond the noise"
    return (
        text if maps.blocks_done == maps.blocks else f"unfinished, {maps.blocks_done} of {maps.blocks} blocks: {text}"
    )


def _pixels(maps: FieldMaps) -> list[str]:
    lines = [f"  {number:>9}  {MEANINGS[status]}" for status, number in maps.counts().items()]
    beyond = maps.beyond_noise
    if beyond.any():
        rows, columns = np.nonzero(beyond)
        where = [maps.y[rows.min()], maps.y[rows.max()], maps.x[columns.min()], maps.x[columns.max()]]
        y0, y1, x0, x1 = (f"{each:.4g}" for each in where)
        unit = f" {maps.length_unit}" if maps.length_unit else ""
        lines.append(f"  beyond the noise: y from {y0} to {y1}{unit}, x from {x0} to {x1}{unit}")
    return lines


def _parameters(maps: FieldMaps) -> list[str]:
    good = maps.identified
    if not good.any():
        return []
    lines = [f"  {'':12}{'median':>12}  {'5 to 95 % of the pixels':>26}  {'median standard error':>22}"]
    for name in maps.names:
        values, unit = maps.maps[name][good], maps.units[name]
        low, middle, high = np.nanpercentile(values, [5, 50, 95])
        error = np.nanmedian(maps.maps[f"{name}_standard_error"][good] / np.abs(values))
        shown = "" if unit == "1" else unit
        lines.append(f"  {SYMBOLS[name]:12}{middle:>12.5g}  {low:>12.5g} to {high:>10.5g}  {error:>20.2%}  {shown}")
    rms, noise = (float(np.nanmedian(maps.maps[name][good])) for name in ("rms_residual", "noise"))
    return [*lines, f"  residual, median: {rms:.4g} MPa; noise alone would leave {noise:.4g} MPa"]


def _closeness(maps: FieldMaps) -> list[str]:
    if not maps.closeness:
        return []
    lines = ["", "  beside the truth    bias   scatter   error over standard error   in the 95 % interval"]
    for each in maps.closeness:
        numbers = f"{each.bias:>12.3%}{each.scatter:>10.3%}{each.spread:>28.2f}{each.coverage:>23.1%}"
        lines.append(f"  {SYMBOLS[each.name]:12}{numbers}")
    return lines


def _origin(maps: FieldMaps) -> list[str]:
    run = maps.run
    done = int(np.count_nonzero(maps.maps["status"] != Status.PENDING))
    had_data = int(np.count_nonzero(maps.maps["samples"] > 0))
    commit = f", commit {run['commit']}" if run.get("commit") else ""
    lines = [
        f"  {run['scheme']}, {_steps(maps.substeps)}, {run['method']}",
        f"  probation {run['version']}{commit}; field {run['field_sha256'][:16]}",
    ]
    if maps.cpu_seconds > 0.0 and done:
        rate = had_data / maps.cpu_seconds
        lines.append(f"  {maps.cpu_seconds:.3g} s of CPU in all: {rate:.4g} pixels with data per second and core")
    return lines


def _steps(substeps: tuple[int, int]) -> str:
    """Of the scheme from sample to sample."""
    fewest, most = substeps
    if most == 1:
        return "one step from sample to sample"
    return f"{fewest if fewest == most else f'{fewest} to {most}'} steps from sample to sample"
