"""The strain of a test that is yet to be done, as it will drive the law: as imposed, or smoothed from noisy samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.histories.imposed import ImposedHistory
from probation.inference.strain_noise import StrainNoise
from probation.law.creep import creep
from probation.records.record import Noise, Record
from probation.settings.design import DESIGN
from probation.settings.noise import NOISE
from probation.smoothing.excitation import excite
from probation.smoothing.operators import Operators

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.law.modal import Law
    from probation.law.schemes import SchemeName
    from probation.smoothing.excitation import Excitation

History = ImposedHistory | tuple["FloatArray", "FloatArray"]


def imposed(histories: Mapping[str, History], law: Law) -> dict[str, ImposedHistory]:
    """Strain histories by test; the strain that an imposed stress makes is the law's.

    Raises
    ------
    InputError
        If there is none, for what is no history, and where `creep` raises one.
    """
    if not isinstance(histories, Mapping) or not histories:
        kind = "none" if isinstance(histories, Mapping) else type(histories).__name__
        raise InputError(f"histories: found {kind}, expected at least one planned test by its name")
    strains = {}
    for name, given in histories.items():
        history = given
        if isinstance(history, tuple | list) and len(history) == 2:
            try:
                history = ImposedHistory("as given", *history)
            except InputError as error:
                raise InputError(f"histories, {name!r}: {error}") from None
        if not isinstance(history, ImposedHistory):
            raise InputError(
                f"histories, {name!r}: found {type(given).__name__}, expected an ImposedHistory or (time, true_strain)"
            )
        if history.true_stress is not None:
            jumps = "auto" if history.jumps is None else history.jumps or None
            strain = creep(law, history.time, history.true_stress, jumps=jumps)
            history = ImposedHistory(history.name, history.time, true_strain=strain, jumps=history.jumps)
        strains[name] = history
    return strains


def planned_record(name: str, history: ImposedHistory, stress_noise: float, strain_noise: float) -> Record:
    """A planned test as a record; it has no stress yet, `as_predicted` gives it the law's.

    Raises
    ------
    InputError
        As `Record`, naming the test, the quantity and the sample.
    """
    assert history.true_strain is not None
    return Record(
        id=name,
        time=history.time,
        true_strain=history.true_strain,
        true_stress=np.zeros(len(history)),
        # Rates are not measured: those of noisy strain are had from it.
        strain_rate=None if strain_noise else history.strain_rate,
        control="strain-rate",
        noise=Noise(stress_noise, strain_noise),
    )


def planned_excitation(record: Record, rng: np.random.Generator) -> Excitation:
    """Strain and rate of a planned test.

    Where the strain will be noisy, how it is going to be smoothed is found on draws of the noise: the one with the
    median of the degrees of freedom counts, since single draws are smoothed far less. The strain is what that smoother
    makes of the one imposed; the covariance of its errors is the mean over the draws.

    Raises
    ------
    InputError
        For a record with noisy strain that is too long for the matrices of `StrainNoise`.
    """
    deviation = record.noise.strain
    if not deviation:
        return excite(record)
    if len(record) > NOISE.most_with_strain_noise:
        raise InputError(
            f"record {record.id!r}: found {len(record)} samples, "
            f"expected at most {NOISE.most_with_strain_noise} where strain_noise is "
            "given; use fewer samples"
        )
    noise = deviation * rng.standard_normal((DESIGN.strain_draws, len(record)))
    drawn = [excite(replace(record, true_strain=record.true_strain + error)) for error in noise]
    usual = sorted(drawn, key=lambda excitation: excitation.freedom)[DESIGN.strain_draws // 2]
    strain, rate = usual.strain_operator(), usual.rate_operator()
    if strain is None or rate is None:
        return excite(record, "raw")
    return replace(
        usual,
        true_strain=strain @ record.true_strain,
        strain_rate=rate @ record.true_strain,
        noise_inflation=1.0,
        errors=partial(_mean_errors, drawn),
    )


def _mean_errors(drawn: Sequence[Excitation]) -> Operators:
    """Errors whose covariance is the mean of those of several smoothed strains."""
    made = [excitation.errors() for excitation in drawn if excitation.errors is not None]
    weight = len(made) ** -0.5
    return Operators(
        weight * np.hstack([operators.strain for operators in made]),
        weight * np.hstack([operators.rate for operators in made]),
    )


def propagated(excitation: Excitation, law: Law, scheme: SchemeName) -> FloatArray:
    """Factor A of the stress covariance A A^T that the noise of the strain makes, (n_samples, n_directions) [MPa]."""
    if not excitation.strain_noise:
        return np.zeros((len(excitation.time), 0))
    return StrainNoise.of(excitation, scheme).propagated(law)
