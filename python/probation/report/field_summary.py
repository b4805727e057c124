"""Maps in words: the verdict first."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.field.status import MEANINGS, Status
from probation.report.table import Table

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
    parts = [field_verdict(maps), "\n".join(filter(None, (pixel_table(maps).text(), _indented(beyond_noise(maps)))))]
    if Status.IDENTIFIED in maps.counts:
        parts.append(f"{parameter_table(maps).text()}\n{_indented(residual_text(maps))}")
    if maps.closeness:
        parts.append(closeness_table(maps).text())
    return "\n\n".join([*parts, "\n".join(map(_indented, origin(maps)))])


def _indented(text: str) -> str:
    return f"  {text}" if text else ""


def field_verdict(maps: FieldMaps) -> str:
    """How many pixels were identified, and how many the law misses."""
    good, all_ = maps.counts.get(Status.IDENTIFIED, 0), sum(maps.counts.values())
    text = (
        f"{good} of {all_} pixels identified; the residual of {maps.facts['beyond_noise']} of them is beyond the noise"
    )
    return (
        text if maps.blocks_done == maps.blocks else f"unfinished, {maps.blocks_done} of {maps.blocks} blocks: {text}"
    )


def pixel_table(maps: FieldMaps) -> Table:
    """What became of the pixels."""
    rows = tuple((MEANINGS[Status(status)], str(number)) for status, number in maps.counts.items())
    return Table(("what became of a pixel", "pixels"), rows)


def beyond_noise(maps: FieldMaps) -> str:
    """Where the residual is beyond the noise; empty if nowhere."""
    where = maps.facts["where_beyond_noise"]
    if where is None:
        return ""
    y0, y1, x0, x1 = (f"{position:.4g}" for position in (*where["y"], *where["x"]))
    unit = f" {maps.length_unit}" if maps.length_unit else ""
    return f"beyond the noise: y from {y0} to {y1}{unit}, x from {x0} to {x1}{unit}"


def parameter_table(maps: FieldMaps) -> Table:
    """Median and spread over the pixels, and the median standard error, of every parameter."""
    rows = []
    for name, known in maps.facts["parameters"].items():
        low, high = known["percentiles_5_95"]
        label = SYMBOLS[name] if known["unit"] == "1" else f"{SYMBOLS[name]} [{known['unit']}]"
        error = known["median_relative_standard_error"]
        rows.append((label, f"{known['median']:.5g}", f"{low:.5g} to {high:.5g}", f"{error:.2%}"))
    return Table(("parameter", "median", "5 to 95 % of the pixels", "median standard error"), tuple(rows))


def residual_text(maps: FieldMaps) -> str:
    """The median residual, and what noise alone would leave."""
    facts = maps.facts
    return (
        f"residual, median: {facts['rms_residual_MPa']:.4g} MPa; noise alone would leave {facts['noise_MPa']:.4g} MPa"
    )


def closeness_table(maps: FieldMaps) -> Table:
    """How near the maps are to the truth, where that is known."""
    rows = tuple(
        (
            SYMBOLS[map_closeness.name],
            f"{map_closeness.bias:.3%}",
            f"{map_closeness.scatter:.3%}",
            f"{map_closeness.spread:.2f}",
            f"{map_closeness.coverage:.1%}",
        )
        for map_closeness in maps.closeness
    )
    return Table(("against the truth", "bias", "scatter", "error over standard error", "in the 95 % interval"), rows)


def origin(maps: FieldMaps) -> list[str]:
    """How the maps were made, and how long that took."""
    run = maps.run
    done = any(status != Status.PENDING for status in maps.counts)
    commit = f", commit {run['commit']}" if run.get("commit") else ""
    lines = [
        f"{run['scheme']}, {_steps(maps.substeps)}, {run['method']}",
        f"probation {run['version']}{commit}; field {run['field_sha256'][:16]}",
    ]
    if maps.cpu_seconds > 0.0 and done:
        rate = maps.facts["pixels_with_data"] / maps.cpu_seconds
        lines.append(f"{maps.cpu_seconds:.3g} s of CPU in all: {rate:.4g} pixels with data per second and core")
    return lines


def _steps(substeps: tuple[int, int]) -> str:
    """Of the scheme from sample to sample."""
    fewest, most = substeps
    if most == 1:
        return "one step from sample to sample"
    return f"{fewest if fewest == most else f'{fewest} to {most}'} steps from sample to sample"
