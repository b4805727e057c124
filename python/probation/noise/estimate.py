"""The noise of a record, estimated so that it does not absorb the discrepancy (docs/diagnosis-method.md, section 1).

High frequencies come first; lower ones are used only where they agree.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.noise.arma import Arma
from probation.noise.evidence import NoiseEvidence, noise_evidence
from probation.noise.model import NoiseModel
from probation.noise.spectra import KnownSpectrum, fit_spectra
from probation.records.quantisation import quantisation_noise
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.record_residual import RecordResidual


def estimate_noise(
    records: Sequence[RecordResidual], pool: bool = True, known: dict[RecordResidual, NoiseEvidence] | None = None
) -> tuple[NoiseModel, ...]:
    """The noise of every record, by what is rougher than any law's error.

    (1) Outliers are set aside; the growth of the noise along the record is found: constant, with e^eps (a constant
    force noise), or in bursts. (2) The base tangent and piecewise polynomials of degree 5 on 12 segments are projected
    out; Whittle's likelihood gives an ARMA(1,1) of what is left. Bias of any amplitude that is smooth over a segment is
    gone with them; so are the low frequencies. (3) They come back, from the 12th half period of a record on, if they
    agree with that ARMA(1,1) in every record: then noise and only noise is there, and it is fitted with them. Quiet
    segments and replicates override (2) and (3).

    Parameters
    ----------
    records : sequence of RecordResidual
    pool : bool
        One shape (phi, theta) for all records where their spectra allow it: the same rig.
    known : dict of RecordResidual to NoiseEvidence, optional
        What records say that were asked before; that of the others is added.

    Returns
    -------
    tuple of NoiseModel
        In the order of the records.
    """
    known = {} if known is None else known
    known |= {record: noise_evidence(record) for record in records if record not in known}
    prepared = [known[record] for record in records]
    seen = [evidence for evidence in prepared if evidence.rough is not None]
    fits = iter(fit_spectra(seen, pool) if seen else ())
    return tuple(
        _fallback(evidence) if evidence.rough is None else _model(evidence, next(fits)) for evidence in prepared
    )


def _model(evidence: NoiseEvidence, known: KnownSpectrum) -> NoiseModel:
    arma = known.arma
    floor = max(quantisation_noise(evidence.quantum), evidence.record.given_noise or 0.0)
    source = evidence.source
    if arma.deviation < floor:
        arma = replace(arma, innovation=arma.innovation * floor / arma.deviation)
        source += "; raised to the noise that is given or to the readings' step"
    return NoiseModel(
        evidence.record.name,
        arma,
        evidence.profile,
        evidence.growth,
        float(arma.deviation),
        evidence.white,
        evidence.quantum,
        _propagated(evidence.record),
        known.level_variance,
        known.shape_variance,
        evidence.outliers,
        source,
        specimen=evidence.record.specimen,
        specimen_id=evidence.record.specimen_id,
    )


def _fallback(evidence: NoiseEvidence) -> NoiseModel:
    record = evidence.record
    size = float(np.max(np.abs(record.residual if record.measured is None else record.measured), initial=0.0))
    level = max(evidence.white, record.given_noise or 0.0, 1e-7 * size, 1e-12)
    if not record.given_noise and len(record) < NOISE.fewest_for_a_spectrum:
        level = max(level, NOISE.least_level_of_few * float(np.std(np.diff(record.residual))))
    return NoiseModel(
        record.name,
        Arma(innovation=level),
        evidence.profile,
        evidence.growth,
        level,
        evidence.white,
        evidence.quantum,
        _propagated(record),
        0.0 if record.given_noise else NOISE.level_variance_of_few / len(record),
        0.0,
        evidence.outliers,
        "as given" if record.given_noise and record.given_noise >= evidence.white else evidence.source,
        specimen=record.specimen,
        specimen_id=record.specimen_id,
    )


def _propagated(record: RecordResidual) -> FloatArray:
    return np.zeros((len(record), 0)) if record.propagated is None else record.propagated
