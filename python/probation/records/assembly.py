"""A specimen's table to a record."""

from probation.records.conversions import shrinks_in_tension, true_stress_from
from probation.records.extraction import dimension, dimension_warning, extract
from probation.records.joining import Film
from probation.records.options import ReadOptions
from probation.records.profiles import Reading
from probation.records.record import Noise, Record
from probation.records.roles import OPTIONAL_ROLES, STRESS_ROLES
from probation.records.source import Source
from probation.records.start import as_started
from probation.records.table import Table


def assemble(
    source: Source | None,
    profile: str,
    reading: Reading,
    table: Table,
    options: ReadOptions,
    *,
    record_id: str,
    control: str = "other",
    role: str = "identify",
    noise: Noise | None = None,
    start: str = "auto",
    specimen_id: str | None = None,
    film: Film | None = None,
) -> Record:
    """Turn the columns of one specimen into a record; `source` is None for what is in memory.

    Raises
    ------
    InputError
        At the first thing that is wrong, by file, row and column.
    """
    extracted = extract(table, reading, options, film=film)
    measure = next(name for name in STRESS_ROLES if name in extracted.samples)
    area = dimension(table, reading, options, "area_mm2", measure) if measure == "force" else None
    transverse = extracted.samples.get("transverse_strain")
    shrinks = transverse is not None and shrinks_in_tension(extracted.true_strain, transverse)
    section = None if shrinks else transverse
    record = Record(
        id=record_id,
        time=extracted.samples["time"],
        true_strain=extracted.true_strain,
        true_stress=true_stress_from(measure, extracted.samples[measure], extracted.stretch, area, section),
        **{name: extracted.samples.get(name) for name in OPTIONAL_ROLES},
        control=control,
        role=role,
        specimen_id=specimen_id,
        noise=noise or Noise(),
        file=None if source is None else source.path,
        sha256="" if source is None else source.sha256,
        warnings=(
            *extracted.warnings,
            *dimension_warning(table, reading, options, "area_mm2", area),
            *_section_warning(measure, measured=section is not None, shrinks=shrinks),
        ),
        profile=profile,
        clock=extracted.clock,
    )
    return as_started(record, start)


def _section_warning(measure: str, *, measured: bool, shrinks: bool) -> tuple[str, ...]:
    if measure == "true_stress":
        return ()
    made = f"true stress made from {measure.replace('_', ' ')} by"
    if measured:
        return (f"{made} the measured transverse strain, taken alike in width and thickness",)
    if shrinks:
        return (
            f"{made} constant volume: by the measured transverse strain the volume would shrink in tension, so that "
            "width and thickness do not shrink alike",
        )
    return (f"{made} constant volume",)
