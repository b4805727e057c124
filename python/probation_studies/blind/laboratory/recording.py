"""The data: the finely integrated truth through the channels' filter, their noise and their converters."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.filters import low_pass
from probation_studies.blind.laboratory.rig import REFINEMENT
from probation_studies.blind.laboratory.trial import Trial, recorded_stress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratory.bank import Bank, Bench
    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.noise import Noise, RecordNoise
    from probation_studies.blind.laboratory.placing import Planted
    from probation_studies.blind.laboratory.trial import Acting

_DRIFT_LIMIT = 0.95
_PASSES = 5000


@dataclass(frozen=True)
class Recorded:
    """What the channels wrote, and what it amounts to.

    Attributes
    ----------
    strain, stress : list of ndarray, each (n,) [-], [MPa]
    clean : ndarray, shape (n_all,)
        Whitened, projected: what the causes add, without noise.
    observed : ndarray, shape (n_all,)
        The same of the recorded stress less the base law along the recorded strain.
    added_rms : list of float [MPa]
        What the causes add to each record.
    noise : list of ndarray, each (n,) [MPa]
        What the true law with its causes leaves of each record, along the recorded strain.
    drift_detectability : float
        See `Truth`.
    """

    strain: list[FloatArray]
    stress: list[FloatArray]
    clean: FloatArray
    observed: FloatArray
    added_rms: list[float]
    noise: list[FloatArray]
    drift_detectability: float


def record_all(
    bench: Bench,
    noise: Noise,
    noises: Sequence[RecordNoise],
    bank: Bank,
    planted: Sequence[Planted],
    undisturbed: Undisturbed,
) -> Recorded:
    """Run every test on the fine grid and record it."""
    drifts, drift_left = _nuisance_drifts(bank, noises)
    strains, stresses, added_rms, left = [], [], [], []
    clean, residual = {}, {}
    for k, each in enumerate(noises):
        causes = [one.acting for one in planted if one.record is None or one.record == k]
        plain, seen, specimen = undisturbed.stress[k], undisturbed.strain[k], bench.specimen(k)
        truth = _channels(bench, k, causes, noise)[0] if causes else plain
        added_rms.append(float(np.sqrt(np.mean((truth - plain) ** 2))))
        strain = _converted(seen + specimen.start + each.strain, noise.strain_quantum)
        stress = _converted(truth + each.rough + drifts[k], noise.quantum)
        strains.append(_as_written(strain))
        stresses.append(_as_written(stress))
        left.append(stresses[k] - _own_stress(bench, k, strains[k]) - (truth - plain))
        if k in bench.identified:
            clean[k], residual[k] = truth - plain, stresses[k] - _base_stress(bench, k, strains[k])
    return Recorded(
        strain=strains,
        stress=stresses,
        clean=bank.column(clean),
        observed=bank.column(residual),
        added_rms=added_rms,
        noise=left,
        drift_detectability=drift_left,
    )


@dataclass(frozen=True)
class Undisturbed:
    """The same without causes and noise: stress and strain of every record, on the samples.

    `sampling_detectability` is what sampling and filtering alone make of the base law's stress.
    """

    stress: list[FloatArray]
    strain: list[FloatArray]
    sampling_detectability: float


def run_undisturbed(bench: Bench, noise: Noise, bank: Bank) -> Undisturbed:
    """Run every test on the fine grid with nothing acting."""
    stress, strain = zip(*(_channels(bench, k, (), noise) for k in range(len(bench.tests))), strict=True)
    added = {k: stress[k] - _own_stress(bench, k, strain[k] + bench.specimen(k).start) for k in bench.identified}
    return Undisturbed(list(stress), list(strain), float(np.linalg.norm(bank.column(added))))


def _nuisance_drifts(bank: Bank, noises: Sequence[RecordNoise]) -> tuple[list[FloatArray], float]:
    """The drifts without what would look like an effect, and the largest projection on an effect that is left.

    The direction that is most alike is taken down to what is allowed, and again until all are.
    """
    drifts = [noise.drift.copy() for noise in noises]
    if not any(np.any(each) for each in drifts):
        return drifts, 0.0
    directions = np.stack([signal.column / signal.norm for signal in bank.signals if not signal.cause.outside], axis=1)
    alike = directions.T @ bank.column({k: drifts[k] for k in bank.bench.identified})
    cosines = directions.T @ directions
    taken = np.zeros_like(alike)
    for _ in range(_PASSES):
        worst = int(np.argmax(np.abs(alike)))
        if abs(alike[worst]) <= _DRIFT_LIMIT:
            break
        excess = alike[worst] - np.sign(alike[worst]) * 0.8 * _DRIFT_LIMIT
        taken[worst] += excess
        alike -= excess * cosines[:, worst]
    for k, samples in bank.samples(directions @ taken).items():
        drifts[k] -= samples
    return drifts, float(np.max(np.abs(alike)))


def _channels(bench: Bench, k: int, causes: Sequence[Acting], noise: Noise) -> tuple[FloatArray, FloatArray]:
    """Recorded stress of a record's own specimen, and its strain, on the samples, before noise."""
    test, specimen = bench.tests[k], bench.specimen(k)
    stress = recorded_stress([(bench.trial(k, fine=True, law=specimen.law(bench.law)), causes)])[0]
    stress = stress * (1.0 + specimen.section)
    time_constant = noise.filter_samples * float(np.min(np.diff(test.time)))
    stress, strain = (
        low_pass(test.fine_time, each, time_constant)[::REFINEMENT] for each in (stress, test.fine_strain)
    )
    return stress, strain


def _base_stress(bench: Bench, k: int, strain: FloatArray) -> FloatArray:
    """The base law along a recorded strain that is straight between its samples."""
    trial = Trial(bench.law, bench.tests[k].time, strain, 0.0, bench.reference_rate)
    return recorded_stress([(trial, ())])[0]


def _own_stress(bench: Bench, k: int, strain: FloatArray) -> FloatArray:
    """The same of the record's own specimen, whose strain starts late."""
    specimen = bench.specimen(k)
    own = replace(bench, law=specimen.law(bench.law))
    return _base_stress(own, k, strain - specimen.start) * (1.0 + specimen.section)


def _converted(samples: FloatArray, quantum: float) -> FloatArray:
    return np.asarray(np.round(samples / quantum) * quantum) if quantum > 0.0 else samples


def _as_written(samples: FloatArray) -> FloatArray:
    """Twelve digits, as in the file."""
    return np.array([float(f"{sample:.12g}") for sample in samples])
