"""How a record starts: relaxed, as the law takes its first sample, or loaded by a ramp that was cut off.

A record that is cut starts at a strain and a stress that the law does not know the history of. Where the strain still
counts from the unloaded specimen, the missing part is known well enough: a straight line from zero at the strain rate
of the first samples. One sample at zero strain and zero stress before the others gives the law that line.

A record that a trigger started lacks what happened before its first sample: until the force left its noise, and up to
one interval. Then the lines through the first samples of strain and of stress meet zero at the same time, not long
before the first sample, and both are beyond their noise there. Such a start is restored without being asked for. An
offset of the force and a prestress leave the strain at zero, and stay what they are.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from probation._complaint import quoted
from probation.errors import InputError
from probation.records.noise import noise_level
from probation.records.record import Record
from probation.settings.reading import READING

FloatArray = NDArray[np.float64]

STARTS = ("auto", "relaxed", "loaded")
"""`auto` is loaded where no more than a trigger may lose is missing, and else relaxed."""


def as_started(record: Record, start: str = "auto") -> Record:
    """Copy a record as its start is to be taken: one of `STARTS`.

    Raises
    ------
    InputError
        Where it starts loaded and no ramp leads to its first sample.
    """
    if start == "loaded":
        return with_loading(record)
    line = _lost_before_the_first_sample(record) if start == "auto" else None
    if line is not None:
        return _with_line(record, *line)
    return replace(record, warnings=(*record.warnings, *start_doubts(record)))


def start_doubts(record: Record) -> tuple[str, ...]:
    """Question a first strain or stress that is far from zero, since the law starts relaxed there."""
    if not (is_far(record.time, record.true_strain) or is_far(record.time, record.true_stress)):
        return ()
    restore = "" if _line_before(record) is None else 'if it is cut, say start = "loaded" in its [[record]]; '
    return (
        f"the record starts at true strain {record.true_strain[0]:.3g} and {record.true_stress[0]:.3g} MPa, and the "
        f"law takes that state as relaxed: the record is cut at its start, or a prestress acts; {restore}"
        "probation diagnose weighs a prestress",
    )


def with_loading(record: Record) -> Record:
    """Copy a record that is cut at its start, with the ramp before it restored.

    One sample of zero strain and zero stress is put before the others, as far back as the strain rate of the
    first samples needs from zero to them.

    Parameters
    ----------
    record : Record
        Its strain counts from the unloaded specimen.

    Raises
    ------
    InputError
        If the first strain is zero within its noise, or does not grow from zero.
    """
    line = _line_before(record)
    if line is None:
        raise InputError(
            f'record {quoted(record.id)}, start = "loaded": found a first true strain of {record.true_strain[0]:.3g} '
            "that no ramp from zero leads to, expected one that grows away from zero; leave start out, or add the "
            "loading to the file"
        )
    return _with_line(record, *line)


def _with_line(record: Record, duration: float, rate: float) -> Record:
    """Put one sample of the unloaded specimen so long before the first one."""
    first = {"time": record.time[0] - duration, "true_strain": 0.0, "true_stress": 0.0}
    for name, value in (("strain_rate", rate), ("transverse_strain", 0.0)):
        if getattr(record, name) is not None:
            first[name] = value
    if record.temperature is not None:
        first["temperature"] = record.temperature[0]
    note = f"starts loaded: a ramp from zero at {rate:.3g} 1/s, {duration:.3g} s long, is put before the first sample"
    samples: dict[str, Any] = {name: np.insert(getattr(record, name), 0, value) for name, value in first.items()}
    return replace(record, **samples, warnings=(*record.warnings, note))


def is_far(time: FloatArray, values: FloatArray) -> bool:
    """Whether the first of strains or stresses is no start from rest: far from zero, and beyond the noise."""
    first, largest = abs(float(values[0])), float(np.abs(values).max())
    return first > max(READING.far_start * largest, READING.start_noise * noise_level(time, values))


def _lost_before_the_first_sample(record: Record) -> tuple[float, float] | None:
    """Duration [s] and true strain rate [1/s] of a ramp from zero, no longer than what a trigger may lose.

    None where stress or strain start at zero within their noise, where more is missing, or where the strain does not
    come from zero with the stress: a prestress, a force that is off, or a start at a strain that was held.
    """
    time, strain, stress = record.time - record.time[0], record.true_strain, record.true_stress
    beyond = np.flatnonzero(np.abs(stress) > READING.start_reach * abs(stress[0]))
    at_least, at_most = READING.start_samples_of_stress, READING.start_samples
    straight = int(np.clip(beyond[0] if beyond.size else len(stress), at_least, at_most))
    loading, first = np.polyfit(time[:straight], stress[:straight], 1)
    force_noise = noise_level(record.time, stress)
    if min(abs(first), abs(stress[0])) <= READING.start_noise * force_noise or not loading:
        return None
    time = time[:at_most]
    rate, reached = np.polyfit(time, strain[:at_most], 1)
    if not rate:  # steps of the extensometer may hide the first strains
        return None
    by_force, by_strain = (float(first / loading), _since_zero(time, stress)), float(reached / rate)
    noise = noise_level(record.time, strain)
    error = noise * np.sqrt((1.0 + np.mean(time) ** 2 / np.var(time)) / len(time)) / abs(rate)
    # The stress bends from the start: its line comes from too far back. A parabola does not, but takes in more noise.
    shown = by_strain > READING.start_noise * error
    recent = by_strain < READING.start_intervals * float(np.median(np.diff(time)))
    agree = any(
        abs(by_strain - each) <= READING.start_noise * error + READING.start_bend * abs(each) for each in by_force
    )
    return (by_strain, float(rate)) if shown and recent and agree else None


def _since_zero(time: FloatArray, values: FloatArray) -> float:
    """How long before the first sample a parabola through the first three meets zero [s]; NaN if it does not."""
    roots = np.roots(np.polyfit(time[:3], values[:3], 2))
    before = [-float(root.real) for root in roots if abs(root.imag) == 0.0 and root.real < 0.0]
    return min(before, default=float("nan"))


def _line_before(record: Record) -> tuple[float, float] | None:
    """Duration [s] and true strain rate [1/s] of the ramp from zero to the first samples; None where there is none.

    The line is fitted to the samples up to four times the first strain, so that extrapolation adds little to their
    noise: in true strain, or in engineering strain where the displacement was driven.
    """
    time, strain = record.time - record.time[0], record.true_strain
    beyond = np.flatnonzero(np.abs(strain) > READING.start_reach * abs(strain[0]))
    count = max(int(beyond[0]) if beyond.size else len(strain), READING.start_samples)
    driven = np.expm1(strain) if record.control == "displacement-rate" else strain
    rate, first = np.polyfit(time[:count], driven[:count], 1)
    noise = noise_level(record.time, driven)
    uncertain = noise / (np.sqrt(count) * float(np.std(time[:count])))
    if (
        abs(first) <= READING.start_noise * noise
        or abs(rate) <= READING.start_noise * uncertain
        or not 0.0 < first / rate < time[-1]
    ):
        return None
    duration = float(first / rate)
    return duration, float(strain[0]) / duration
